// What a primary ray reads: textures, wrap modes, transforms, sRGB, normal maps on plain and mirrored nodes,
// alpha masks for camera and shadow rays, back faces, surfaces that are drawn later.
#include "tests/unit/oracle/scene_builder.h"

#include <gtest/gtest.h>

namespace kilolux::oracle {
namespace {

using glm::dvec2;
using glm::dvec3;

// A unit quad that faces +Z, uv (0,0) upper left, with one material that the test fills in.
struct QuadScene {
    SceneBuilder builder;
    explicit QuadScene(const glm::dmat4& worldFromNode = glm::dmat4(1.0)) {
        builder.quad(worldFromNode, 1.0, 1.0, builder.material(dvec3(1.0)));
    }
    Material& material() { return builder.scene.materials[0]; }
    int addImage(int width, int height, std::vector<std::uint8_t> rgba) {
        builder.scene.images.push_back(
            std::make_shared<Image>(Image{"test", width, height, std::move(rgba), {}}));
        return static_cast<int>(builder.scene.images.size()) - 1;
    }
    // Looks at the texture coordinate (u right, v down) from +Z.
    std::optional<OracleHit> hitAt(double u, double v) const {
        return Oracle(builder.scene).tracePrimary({u - 0.5, 0.5 - v, 2.0}, {0, 0, -1});
    }
};

double decoded(double byte) {
    const double v = byte / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

const std::vector<std::uint8_t> kTwoByOne = {200, 40, 10, 255, 100, 240, 0, 255};

TEST(Texture, BilinearInDecodedSrgb) {
    QuadScene scene;
    scene.material().baseColor.image = scene.addImage(2, 1, kTwoByOne);
    scene.material().baseColor.wrapS = WrapMode::ClampToEdge;
    scene.material().baseColorFactor = {0.5, 1.0, 1.0, 1.0};
    EXPECT_NEAR(scene.hitAt(0.25, 0.5)->point.material.baseColor.r, 0.5 * decoded(200), 1e-6)
        << "texel centre";
    EXPECT_NEAR(scene.hitAt(0.4, 0.5)->point.material.baseColor.r,
                0.5 * (0.7 * decoded(200) + 0.3 * decoded(100)), 1e-6);
    EXPECT_NEAR(scene.hitAt(0.4, 0.5)->point.material.baseColor.g, 0.7 * decoded(40) + 0.3 * decoded(240),
                1e-6);
    EXPECT_NEAR(scene.hitAt(0.01, 0.5)->point.material.baseColor.r, 0.5 * decoded(200), 1e-6) << "clamped";
    scene.material().baseColor.nearestFilter = true;
    EXPECT_NEAR(scene.hitAt(0.49, 0.5)->point.material.baseColor.r, 0.5 * decoded(200), 1e-6);
    EXPECT_NEAR(scene.hitAt(0.51, 0.5)->point.material.baseColor.r, 0.5 * decoded(100), 1e-6);
}

TEST(Texture, WrapModes) {
    QuadScene scene;
    TextureRef& texture = scene.material().baseColor;
    texture.image = scene.addImage(2, 1, kTwoByOne);
    texture.nearestFilter = true;
    texture.offset = {1.0, 0.0}; // u runs from 1 to 2
    EXPECT_NEAR(scene.hitAt(0.25, 0.5)->point.material.baseColor.r, decoded(200), 1e-9);
    texture.wrapS = WrapMode::MirroredRepeat;
    EXPECT_NEAR(scene.hitAt(0.25, 0.5)->point.material.baseColor.r, decoded(100), 1e-9);
    texture.wrapS = WrapMode::ClampToEdge;
    EXPECT_NEAR(scene.hitAt(0.25, 0.5)->point.material.baseColor.r, decoded(100), 1e-9);
    texture.offset = {-1.0, 0.0};
    EXPECT_NEAR(scene.hitAt(0.9, 0.5)->point.material.baseColor.r, decoded(200), 1e-9);
    texture.wrapS = WrapMode::Repeat;
    EXPECT_NEAR(scene.hitAt(0.9, 0.5)->point.material.baseColor.r, decoded(100), 1e-9);
}

// The extension's own example: offset (0,1), rotation pi/2, scale 1/2 shows only the lower left quadrant.
TEST(Texture, TransformShowsTheLowerLeftQuadrant) {
    QuadScene scene;
    std::vector<std::uint8_t> rgba(4 * 16, 255);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x)
            rgba[4 * (4 * y + x)] = x < 2 && y >= 2 ? 255 : 0;
    TextureRef& texture = scene.material().baseColor;
    texture.image = scene.addImage(4, 4, rgba);
    texture.nearestFilter = true;
    texture.offset = {0.0, 1.0};
    texture.rotationRad = 0.5 * kPi;
    texture.scale = {0.5, 0.5};
    for (const double u : {0.1, 0.5, 0.9})
        for (const double v : {0.1, 0.6, 0.9})
            EXPECT_EQ(scene.hitAt(u, v)->point.material.baseColor.r, 1.0) << u << " " << v;
}

TEST(Texture, MetallicRoughnessAndEmissive) {
    QuadScene scene;
    scene.material().metallicRoughness.image = scene.addImage(1, 1, {9, 51, 204, 255});
    scene.material().metallicFactor = 0.5;
    scene.material().roughnessFactor = 1.0;
    scene.material().emissiveNit = {10.0, 20.0, 0.0};
    scene.material().emissive.image = scene.addImage(1, 1, {255, 128, 255, 255});
    const OracleHit hit = *scene.hitAt(0.5, 0.3);
    EXPECT_NEAR(hit.point.material.roughness, 0.2, 1e-9);
    EXPECT_NEAR(hit.point.material.metallic, 0.4, 1e-9);
    EXPECT_NEAR(hit.emissionNit.r, 10.0, 1e-9);
    EXPECT_NEAR(hit.emissionNit.g, 20.0 * decoded(128), 1e-9);
}

// A map that leans the normal to +X of the texture (to the right in the picture) on plain, mirrored and
// stretched nodes: the lean follows the picture, wherever the node puts it.
TEST(NormalMap, LeansWithThePicture) {
    const dvec3 scales[] = {{1, 1, 1}, {-1, 1, 1}, {2, 0.5, 1}};
    for (const dvec3& scale : scales) {
        QuadScene scene(glm::scale(glm::dmat4(1.0), scale));
        scene.material().doubleSided = true;
        scene.material().normal.image = scene.addImage(1, 1, {218, 128, 218, 255});
        const dvec3 n = scene.hitAt(0.5, 0.45)->point.shadingNormalWs;
        EXPECT_NEAR(glm::length(n), 1.0, 1e-12);
        EXPECT_NEAR(n.x, std::copysign(0.7071, scale.x), 0.003);
        EXPECT_NEAR(n.z, 0.7071, 0.003);
    }
    QuadScene up;
    up.material().normal.image = up.addImage(1, 1, {128, 218, 218, 255});
    up.material().normalScale = 2.0;
    const dvec3 n = up.hitAt(0.5, 0.45)->point.shadingNormalWs;
    EXPECT_NEAR(n.y / n.z, 2.0, 0.02) << "green is up, scale stretches the tangent part";
}

TEST(NormalMap, GreenIsUpOnAMirroredNodeToo) {
    QuadScene scene(glm::scale(glm::dmat4(1.0), dvec3(-1, 1, 1)));
    scene.material().normal.image = scene.addImage(1, 1, {128, 218, 218, 255});
    const dvec3 n = scene.hitAt(0.5, 0.45)->point.shadingNormalWs;
    EXPECT_NEAR(n.y, 0.7071, 0.003);
    EXPECT_NEAR(n.z, 0.7071, 0.003);
}

TEST(NormalMap, SeenFromBehindItIsBentToTheView) {
    QuadScene scene;
    scene.material().normal.image = scene.addImage(1, 1, {255, 128, 150, 255}); // leans far to +X
    const dvec3 direction = glm::normalize(dvec3(1.0, 0.0, -0.3));
    const auto hit = Oracle(scene.builder.scene).tracePrimary(dvec3(0.1, 0.1, 0.0) - direction, direction);
    ASSERT_TRUE(hit);
    const double facing = glm::dot(hit->point.shadingNormalWs, hit->point.viewDirWs);
    EXPECT_GT(facing, 9e-4);
    EXPECT_LT(facing, 1e-2);
    EXPECT_GT(glm::dot(hit->point.geometricNormalWs, hit->point.viewDirWs), 0.0);
}

TEST(Alpha, MaskIsAHoleForCameraAndShadow) {
    QuadScene scene;
    std::vector<std::uint8_t> rgba = {255, 255, 255, 255, 255, 255, 255, 100};
    scene.material().baseColor.image = scene.addImage(2, 1, rgba);
    scene.material().baseColor.nearestFilter = true;
    scene.material().alphaMode = AlphaMode::Mask;
    EXPECT_TRUE(scene.hitAt(0.3, 0.5));
    EXPECT_FALSE(scene.hitAt(0.7, 0.5));
    const Oracle oracle(scene.builder.scene);
    EXPECT_TRUE(oracle.occluded({-0.2, 0.1, 1}, {0, 0, -1}, 2.0));
    EXPECT_FALSE(oracle.occluded({0.2, 0.1, 1}, {0, 0, -1}, 2.0));
    scene.material().alphaCutoff = 0.3;
    EXPECT_TRUE(scene.hitAt(0.7, 0.5));
    scene.material().baseColorFactor.a = 0.7; // 0.7 * 100/255 = 0.275
    EXPECT_FALSE(scene.hitAt(0.7, 0.5));
    scene.material().alphaMode = AlphaMode::Opaque;
    EXPECT_TRUE(scene.hitAt(0.7, 0.5)) << "opaque ignores alpha";
}

TEST(Alpha, VertexAlphaCounts) {
    QuadScene scene;
    Mesh mesh = *scene.builder.scene.meshes[0];
    mesh.primitives[0].colors = {{1, 1, 1, 0}, {1, 1, 1, 1}, {1, 1, 1, 1}, {1, 1, 1, 0}};
    scene.builder.scene.meshes[0] = std::make_shared<Mesh>(mesh);
    scene.material().alphaMode = AlphaMode::Mask;
    EXPECT_FALSE(scene.hitAt(0.45, 0.5));
    EXPECT_TRUE(scene.hitAt(0.55, 0.5));
}

TEST(Alpha, ThinAndClearSurfacesAreDrawnLater) {
    QuadScene scene;
    scene.material().alphaMode = AlphaMode::Blend;
    scene.material().baseColorFactor.a = 0.4;
    EXPECT_FALSE(scene.hitAt(0.5, 0.4));
    EXPECT_FALSE(Oracle(scene.builder.scene).occluded({0.1, 0.1, 1}, {0, 0, -1}, 2.0));
    scene.material().baseColorFactor.a = 0.6;
    EXPECT_TRUE(scene.hitAt(0.5, 0.4));
    scene.material().baseColor.image = scene.addImage(1, 1, {255, 255, 255, 200});
    EXPECT_FALSE(scene.hitAt(0.5, 0.4)) << "0.6 x 200/255 is below a half";
    scene.material().baseColorFactor.a = 0.8;
    EXPECT_TRUE(scene.hitAt(0.5, 0.4));
    scene.material().transmission = 0.9;
    EXPECT_FALSE(scene.hitAt(0.5, 0.4));
}

// Mirroring swaps the winding, not the front: glTF 2.0, section 3.7.4.
TEST(Faces, BackFacesAreUnseenButShadow) {
    for (const double mirror : {1.0, -1.0}) {
        QuadScene scene(glm::scale(glm::dmat4(1.0), dvec3(mirror, 1, 1)));
        const Oracle oracle(scene.builder.scene);
        const auto front = oracle.tracePrimary({0.1, 0.2, 2}, {0, 0, -1});
        ASSERT_TRUE(front);
        EXPECT_NEAR(front->point.geometricNormalWs.z, 1.0, 1e-12);
        EXPECT_FALSE(oracle.tracePrimary({0.1, 0.2, -2}, {0, 0, 1}));
        EXPECT_TRUE(oracle.occluded({0.1, 0.2, -2}, {0, 0, 1}, 3.0));
        scene.material().doubleSided = true;
        const auto back = Oracle(scene.builder.scene).tracePrimary({0.1, 0.2, -2}, {0, 0, 1});
        ASSERT_TRUE(back);
        EXPECT_NEAR(back->point.geometricNormalWs.z, -1.0, 1e-12);
        EXPECT_NEAR(back->point.shadingNormalWs.z, -1.0, 1e-12);
    }
}

TEST(Faces, HitIsRefinedInDouble) {
    const dvec3 normal = glm::normalize(dvec3(1, 2, 3));
    const dvec3 origin(10000.0, -5000.0, 7000.0);
    SceneBuilder builder;
    builder.quad(lookingAlong(origin, -normal), 3.0, 3.0, -1);
    const Oracle oracle(builder.scene);
    const dvec3 eye = origin + dvec3(1, 5, 2);
    const dvec3 direction = glm::normalize(origin + dvec3(0.3, -0.15, 0.0) - eye);
    const auto hit = oracle.tracePrimary(eye, direction);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(glm::dot(hit->point.positionWs - origin, normal), 0.0, 1e-11);
    EXPECT_NEAR(hit->distanceM, glm::dot(origin - eye, normal) / glm::dot(direction, normal), 1e-10);
    EXPECT_LT(glm::length(eye + direction * hit->distanceM - hit->point.positionWs), 1e-10);
    EXPECT_EQ(hit->point.material.metallic, 1.0) << "glTF's default material";
}

} // namespace
} // namespace kilolux::oracle
