// Steps of a sweep do to a scene what they say.
#include "renderer/bench/sweep.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <set>

namespace kilolux::bench {
namespace {

Scene sceneOf(int lights) {
    Scene scene;
    LightDef def;
    def.intensity = 8.0;
    scene.lightDefs.push_back(def);
    for (int i = 0; i < lights; ++i) {
        Node node;
        node.worldFromNode[3] = glm::dvec4(i, 2.0, 0.0, 1.0);
        scene.nodes.push_back(node);
        LightNode light;
        light.id = std::uint64_t(i) + 1;
        light.node = i;
        light.def = 0;
        scene.lights.push_back(light);
    }
    auto mesh = std::make_shared<Mesh>();
    Primitive primitive;
    primitive.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    primitive.normals.assign(4, {0, 0, 1});
    primitive.indices = {0, 1, 2, 0, 2, 3};
    mesh->primitives.push_back(primitive);
    scene.meshes.push_back(mesh);
    return scene;
}

TEST(Sweep, LightsAreKeptOrCopied) {
    Scene few = sceneOf(16);
    scaleLights(few, 0.125);
    EXPECT_EQ(few.lights.size(), 2u);
    EXPECT_LT(few.lights[0].id, few.lights[1].id) << "sorted by id";
    EXPECT_DOUBLE_EQ(few.lightDefs[0].intensity, 8.0);

    Scene many = sceneOf(16);
    scaleLights(many, 4.0);
    ASSERT_EQ(many.lights.size(), 64u);
    EXPECT_DOUBLE_EQ(many.lightDefs[0].intensity, 2.0) << "all together as bright as before";
    std::set<std::uint64_t> ids;
    for (const LightNode& light : many.lights.read()) {
        ids.insert(light.id);
        const Node& node = many.nodes[std::size_t(light.node)];
        EXPECT_EQ(node.localFromNode, light.node < 16 ? glm::dmat4(1.0) : node.worldFromNode);
        EXPECT_NEAR(node.worldFromNode[3].y, 2.0, 0.11);
    }
    EXPECT_EQ(ids.size(), 64u);
}

TEST(Sweep, TrianglesBecomeFourOnTheSameSurface) {
    Scene scene = sceneOf(1);
    scaleTriangles(scene, 16.0);
    const Primitive& primitive = scene.meshes[0]->primitives[0];
    EXPECT_EQ(primitive.indices.size(), 3u * 2u * 16u);
    EXPECT_EQ(primitive.positions.size(), 25u) << "a grid of 5 x 5: edges are shared";
    EXPECT_EQ(primitive.normals.size(), 25u);
    double area = 0.0;
    for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
        const glm::vec3 a = primitive.positions[primitive.indices[i]],
                        b = primitive.positions[primitive.indices[i + 1]],
                        c = primitive.positions[primitive.indices[i + 2]];
        area += 0.5 * double(glm::cross(b - a, c - a).z);
    }
    EXPECT_NEAR(area, 1.0, 1e-6) << "none is turned over";
}

TEST(Sweep, StepsScalePixelsAndRays) {
    Scene scene = sceneOf(1);
    int width = 320, height = 180;
    applySweep(Sweep::Resolution, 4.0, scene, width, height);
    EXPECT_EQ(width, 640);
    EXPECT_EQ(height, 360);
    Settings settings;
    applySweep(Sweep::Rays, 2.0, settings);
    EXPECT_EQ(settings.raysPerPixel, 2.0);
    EXPECT_EQ(settings.raysPerLight, 2);
    for (const Sweep sweep : {Sweep::Lights, Sweep::Resolution, Sweep::Triangles, Sweep::Rays}) {
        EXPECT_EQ(sweepFromName(sweepName(sweep)), sweep);
        EXPECT_EQ(std::count(sweepFactors(sweep).begin(), sweepFactors(sweep).end(), 1.0), 1);
    }
    EXPECT_FALSE(sweepFromName("everything"));
}

} // namespace
} // namespace kilolux::bench
