// Textured, normal-mapped, masked and mirrored surfaces against the oracle: every field of the G-buffer, and
// the light of both references on it.
#include "tests/image/image_scenes.h"
#include "tests/image/oracle_kit.h"
#include "tests/unit/accel/scene_kit.h"

#include <cmath>
#include <iostream>

namespace kilolux::test {
namespace {

using glm::dvec3;
using glm::dvec4;

// Textures are magnified (a pixel is less than a texel), so that both sides read their base level.
TextureRef magnified(int image) {
    TextureRef ref;
    ref.image = image;
    ref.scale = {0.012, 0.015};
    ref.offset = {0.21, 0.37};
    ref.rotationRad = 0.6;
    return ref;
}

int addImage(SceneBuilder& b, const std::function<dvec4(int, int)>& texel) {
    b.scene.images.push_back(makeImage(texel));
    return int(b.scene.images.size()) - 1;
}

double wave(double x, double period) {
    return 0.5 + 0.5 * std::sin(2.0 * oracle::kPi * x / period);
}

// A material that reads all four textures.
int texturedMaterial(SceneBuilder& b) {
    const int material = b.material({0.9, 0.8, 0.7}, 0.9, 0.95);
    Material& m = b.scene.materials[std::size_t(material)];
    m.baseColor = magnified(addImage(b, [](int x, int y) {
        return dvec4(0.3 + 0.6 * wave(x, 5.0), 0.2 + 0.6 * wave(y, 4.0), 0.3 + 0.5 * wave(x + y, 6.0), 1.0);
    }));
    m.metallicRoughness = magnified(
        addImage(b, [](int x, int y) { return dvec4(0.0, 0.35 + 0.6 * wave(y, 5.0), wave(x, 6.0), 1.0); }));
    m.normal = magnified(addImage(b, [](int x, int y) {
        const dvec3 n = glm::normalize(dvec3(0.5 * std::sin(x * 0.7), 0.4 * std::sin(y * 0.5 + 1.0), 1.0));
        return dvec4(n * 0.5 + 0.5, 1.0);
    }));
    m.normalScale = 0.7;
    m.emissiveNit = {0.4, 0.6, 0.9};
    m.emissive =
        magnified(addImage(b, [](int x, int y) { return dvec4(wave(x, 20.0), wave(y, 25.0), 0.5, 1.0); }));
    return material;
}

// A floor and a wall of the material under a rectangle and a sphere.
Scene materialScene(SceneBuilder b, int material, const glm::dmat4& mirror = glm::dmat4(1.0)) {
    b.quad(floorAt({0, 0, 0}) * mirror, 6, 6, material);
    b.quad(lookingAlong({0, 1.5, -2.5}, {0, 0, -1}) * mirror, 6, 3, material);
    for (const std::size_t light : {0u, 2u})
        b.light(lightCases()[light].def, lightCases()[light].worldFromLight);
    b.scene.cameras.push_back(cameraLooking({0.3, 2.3, 4.6}, {0, 0.6, -0.4}));
    return std::move(b.scene);
}

void expectBothAgree(const Scene& scene) {
    for (const char* method : {"true", "split"}) {
        const LightComparison result =
            compareLight(scene, {.method = method, .frames = std::string(method) == "true" ? 64 : 32});
        std::cout << method << ": " << result << "\n";
        expectEquivalent(result);
        EXPECT_LT(result.worstBlock, 0.02);
    }
}

TEST(Material, TexturesAndNormalMapsAgree) {
    SceneBuilder b;
    const int material = texturedMaterial(b);
    expectBothAgree(materialScene(std::move(b), material));
}

// Mirrored by a node: windings, tangent space and culling turn with it.
TEST(Material, MirroredNodesAgree) {
    SceneBuilder b;
    const int material = texturedMaterial(b);
    const int plain = b.material({0.6, 0.6, 0.6}, 0.0, 0.5);
    const glm::dmat4 mirror = glm::scale(glm::dmat4(1.0), dvec3(-1.0, 1.0, 1.0));
    const glm::dmat4 uneven =
        glm::scale(glm::translate(glm::dmat4(1.0), dvec3(0.8, 0.6, -0.3)), dvec3(0.5, -1.3, 0.8));
    addPrimitive(b, makeSphere(16, 24, 0.4), Shading::Round, uneven, plain);
    addPrimitive(b, makeBox({0.3, 0.3, 0.3}), Shading::Flat,
                 glm::scale(glm::translate(glm::dmat4(1.0), dvec3(-0.6, 0.5, 0.3)), dvec3(-1.0, -1.2, -0.7)),
                 plain);
    expectBothAgree(materialScene(std::move(b), material, mirror));
}

// The second set of texture coordinates and vertex colours.
TEST(Material, SecondUvSetAndVertexColorsAgree) {
    SceneBuilder b;
    const int material = texturedMaterial(b);
    b.scene.materials[std::size_t(material)].baseColor.texCoord = 1;
    Scene scene = materialScene(std::move(b), material);
    for (std::shared_ptr<const Mesh>& mesh : scene.meshes) {
        Mesh changed = *mesh;
        Primitive& p = changed.primitives[0];
        p.uv1 = {{0.1f, 0.9f}, {0.7f, 0.8f}, {0.9f, 0.2f}, {0.0f, 0.3f}};
        p.colors = {{1, 0.5, 0.2, 1}, {0.3, 1, 0.4, 1}, {0.8, 0.7, 1, 1}, {0.2, 0.9, 0.6, 1}};
        mesh = std::make_shared<Mesh>(changed);
    }
    expectBothAgree(scene);
}

// A masked screen that is seen and throws its shadow on the floor; the mask's edges are as sharp as its
// texels.
TEST(Material, AlphaMasksAgree) {
    SceneBuilder b;
    const int floor = b.material({0.7, 0.6, 0.5}, 0.0, 0.7);
    const int mask = b.material({0.3, 0.7, 0.3}, 0.0, 0.6);
    Material& m = b.scene.materials[std::size_t(mask)];
    m.alphaMode = AlphaMode::Mask;
    m.alphaCutoff = 0.4;
    m.doubleSided = true;
    m.baseColorFactor.a = 0.9;
    m.baseColor.image = addImage(b, [](int x, int y) {
        return dvec4(0.5, 0.6, 0.7,
                     wave(x, 64.0) * wave(y, 52.0) > 0.3 ? 0.3 + 0.7 * wave(x + 2 * y, 40.0) : 0.1);
    });
    m.baseColor.wrapS = WrapMode::MirroredRepeat;
    m.baseColor.wrapT = WrapMode::ClampToEdge;
    m.baseColor.scale = {2.5, 1.3};
    b.quad(lookingAlong({-0.3, 1.1, 0.4}, {0.3, 0.1, -1}), 1.6, 1.6, mask);
    b.quad(lookingAlong({0.9, 0.9, -0.6}, {0.5, 0.5, 1}) * glm::scale(glm::dmat4(1.0), dvec3(-1, 1, 1)), 1.2,
           1.2, mask);
    expectBothAgree(materialScene(std::move(b), floor));
}

} // namespace
} // namespace kilolux::test
