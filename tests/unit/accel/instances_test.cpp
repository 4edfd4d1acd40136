// Which surfaces exist for rays, in which order, and what the alpha test reads.
#include "tests/unit/accel/scene_kit.h"

#include "renderer/accel/ray_world_cpu.h"

#include <gtest/gtest.h>

namespace kilolux::test {

namespace {

Material blended(double alpha) {
    Material material;
    material.alphaMode = AlphaMode::Blend;
    material.baseColorFactor.a = alpha;
    return material;
}

Material transmissive(double transmission) {
    Material material;
    material.transmission = transmission;
    return material;
}

// A card over [0, 1]^2 with u along x and v along y, and a texture whose alpha is the given list of texels.
Scene cardScene(const TextureRef& texture, int width, int height, const std::vector<int>& alphas) {
    auto image = std::make_shared<Image>();
    image->width = width;
    image->height = height;
    for (const int alpha : alphas)
        for (const int value : {0, 0, 0, alpha})
            image->rgba8.push_back(std::uint8_t(value));
    Primitive card = makePrimitive({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0, 1, 2, 0, 2, 3});
    card.uv0 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    card.material = 0;
    Scene scene = makeScene({card});
    scene.images.push_back(image);
    Material material;
    material.alphaMode = AlphaMode::Mask;
    material.baseColor = texture;
    material.baseColor.image = 0;
    scene.materials.push_back(material);
    return scene;
}

// What a ray through (u, v) of the card meets.
bool stopsAt(const RayWorld& world, float u, float v) {
    return occluded(world, glm::vec3(u, v, 1.0f), glm::vec3(0.0f, 0.0f, -1.0f), 0.0f, 2.0f);
}

} // namespace

TEST(Instances, AreOnePerVisibleNodeAndPrimitiveInNodeOrder) {
    Scene scene = makeScene({makeBox({1, 1, 1}), makeSphere(8, 8)});
    Mesh both;
    both.primitives = {makeBox({1, 1, 1}), makeSphere(8, 8)};
    scene.meshes.push_back(std::make_shared<const Mesh>(both));
    addNode(scene, 2, glm::dmat4(1.0));
    scene.nodes[1].visible = false;
    addNode(scene, -1, glm::dmat4(1.0));
    const std::vector<Instance> instances = enumerateInstances(scene);
    ASSERT_EQ(instances.size(), 3u);
    EXPECT_EQ(instances[0].node, 0);
    EXPECT_EQ(instances[1].node, 2);
    EXPECT_EQ(instances[2].primitive, 1);
    EXPECT_EQ(instances[1].firstTriangle, 12u);
    EXPECT_EQ(instances[2].firstTriangle, 24u);
    EXPECT_EQ(instances[2].triangleCount, both.primitives[1].indices.size() / 3);
}

TEST(Instances, LightPassesWhatIsMostlyTransparent) {
    EXPECT_TRUE(castsShadow(Material{}));
    EXPECT_TRUE(castsShadow(blended(0.5)));
    EXPECT_FALSE(castsShadow(blended(0.49)));
    EXPECT_TRUE(castsShadow(transmissive(0.5)));
    EXPECT_FALSE(castsShadow(transmissive(0.9)));
    Material faintButOpaque; // alpha means nothing in OPAQUE mode
    faintButOpaque.baseColorFactor.a = 0.1;
    EXPECT_TRUE(castsShadow(faintButOpaque));
    Scene scene = makeScene({makeBox({1, 1, 1})});
    scene.materials = {blended(0.2), blended(0.8)};
    for (const int material : {0, 1}) {
        Mesh mesh = *scene.meshes[0];
        mesh.primitives[0].material = material;
        scene.meshes[0] = std::make_shared<const Mesh>(mesh);
        const RayWorld world = worldOf(scene);
        EXPECT_EQ(occluded(world, glm::vec3(0.0f), glm::vec3(1, 0, 0), 0.0f, 1e30f), material == 1);
    }
}

TEST(Instances, MasksThatCannotVaryAreDecidedAtOnce) {
    Scene scene = cardScene({}, 1, 1, {255});
    EXPECT_EQ(enumerateInstances(scene)[0].role, SurfaceRole::Opaque);
    scene.materials[0].baseColorFactor.a = 0.4;
    EXPECT_EQ(enumerateInstances(scene)[0].role, SurfaceRole::Absent);
    EXPECT_EQ(enumerateInstances(cardScene({}, 2, 1, {255, 0}))[0].role, SurfaceRole::AlphaTested);
}

TEST(AlphaMask, FollowsTexelsFilterWrapAndTransform) {
    TextureRef nearestRepeat;
    nearestRepeat.nearestFilter = true;
    const RayWorld halves = worldOf(cardScene(nearestRepeat, 2, 1, {255, 0}));
    EXPECT_TRUE(stopsAt(halves, 0.1f, 0.5f));
    EXPECT_TRUE(stopsAt(halves, 0.49f, 0.5f));
    EXPECT_FALSE(stopsAt(halves, 0.51f, 0.5f));

    // Bilinear: half way between the texel centres, and round the edge when the texture repeats.
    const RayWorld smooth = worldOf(cardScene({}, 2, 1, {255, 0}));
    EXPECT_TRUE(stopsAt(smooth, 0.4f, 0.5f));
    EXPECT_FALSE(stopsAt(smooth, 0.6f, 0.5f));
    EXPECT_TRUE(stopsAt(smooth, 0.1f, 0.5f));
    EXPECT_FALSE(stopsAt(smooth, 0.95f, 0.5f));

    TextureRef shifted = nearestRepeat;
    shifted.offset = {0.5, 0.0};
    EXPECT_FALSE(stopsAt(worldOf(cardScene(shifted, 2, 1, {255, 0})), 0.1f, 0.5f));
    EXPECT_TRUE(stopsAt(worldOf(cardScene(shifted, 2, 1, {255, 0})), 0.9f, 0.5f));
    shifted.wrapS = WrapMode::ClampToEdge;
    EXPECT_FALSE(stopsAt(worldOf(cardScene(shifted, 2, 1, {255, 0})), 0.9f, 0.5f));
    shifted.wrapS = WrapMode::MirroredRepeat;
    shifted.offset = {1.0, 0.0};
    EXPECT_FALSE(stopsAt(worldOf(cardScene(shifted, 2, 1, {255, 0})), 0.1f, 0.5f));
    shifted.offset = {-2.0, 0.0};
    EXPECT_TRUE(stopsAt(worldOf(cardScene(shifted, 2, 1, {255, 0})), 0.1f, 0.5f));

    TextureRef doubled = nearestRepeat;
    doubled.scale = {2.0, 1.0};
    EXPECT_TRUE(stopsAt(worldOf(cardScene(doubled, 2, 1, {255, 0})), 0.6f, 0.5f));
    EXPECT_FALSE(stopsAt(worldOf(cardScene(doubled, 2, 1, {255, 0})), 0.3f, 0.5f));
    // A quarter turn: u' = v, v' = -u.
    TextureRef turned = nearestRepeat;
    turned.rotationRad = 1.57079632679489661923;
    const RayWorld turnedWorld = worldOf(cardScene(turned, 2, 1, {255, 0}));
    EXPECT_TRUE(stopsAt(turnedWorld, 0.9f, 0.2f));
    EXPECT_FALSE(stopsAt(turnedWorld, 0.2f, 0.9f));
}

TEST(AlphaMask, MultipliesFactorTextureAndVertexAlpha) {
    Scene scene = cardScene({}, 1, 1, {200});
    EXPECT_TRUE(stopsAt(worldOf(scene), 0.3f, 0.6f));
    scene.materials[0].baseColorFactor.a = 0.6;
    EXPECT_FALSE(stopsAt(worldOf(scene), 0.3f, 0.6f)); // 0.78 * 0.6 < 0.5
    scene.materials[0].alphaCutoff = 0.45;
    EXPECT_TRUE(stopsAt(worldOf(scene), 0.3f, 0.6f));
    Mesh mesh = *scene.meshes[0];
    mesh.primitives[0].colors = {{1, 1, 1, 0}, {1, 1, 1, 1}, {1, 1, 1, 1}, {1, 1, 1, 0}};
    scene.meshes[0] = std::make_shared<const Mesh>(mesh);
    EXPECT_FALSE(stopsAt(worldOf(scene), 0.9f, 0.5f)); // 0.47 * 0.9
    EXPECT_TRUE(stopsAt(worldOf(scene), 0.98f, 0.5f));
    EXPECT_FALSE(stopsAt(worldOf(scene), 0.05f, 0.5f));
    // Blend counts as a mask at one half.
    scene.materials[0].alphaMode = AlphaMode::Blend;
    scene.materials[0].baseColorFactor.a = 1.0;
    EXPECT_FALSE(stopsAt(worldOf(scene), 0.5f, 0.5f));
    EXPECT_TRUE(stopsAt(worldOf(scene), 0.8f, 0.5f));
}

TEST(AlphaMask, NearestPassesThroughHoles) {
    TextureRef nearestRepeat;
    nearestRepeat.nearestFilter = true;
    Scene scene = cardScene(nearestRepeat, 2, 1, {255, 0});
    glm::dmat4 behind(1.0);
    behind[3] = glm::dvec4(0.0, 0.0, -1.0, 1.0);
    addNode(scene, 0, behind);
    scene.meshes.push_back(std::make_shared<const Mesh>(Mesh{"", {makeBox({5.0, 5.0, 0.1})}}));
    glm::dmat4 wall(1.0);
    wall[3] = glm::dvec4(0.0, 0.0, -3.1, 1.0);
    addNode(scene, 1, wall);
    const RayWorld world = worldOf(scene);
    const glm::vec3 dir(0.0f, 0.0f, -1.0f);
    EXPECT_EQ(nearest(world, {0.2f, 0.5f, 1.0f}, dir, 0.0f, 1e30f).instance, 0u);
    EXPECT_EQ(nearest(world, {0.8f, 0.5f, 1.0f}, dir, 0.0f, 1e30f).instance, 2u);
    EXPECT_FALSE(occluded(world, {0.8f, 0.5f, 1.0f}, dir, 0.0f, 3.5f));
    EXPECT_TRUE(occluded(world, {0.8f, 0.5f, 1.0f}, dir, 0.0f, 5.0f));
}

} // namespace kilolux::test
