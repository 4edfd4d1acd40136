// Outlines of lights: where they are drawn is where they are picked; and the ray that finds the surface for a
// new light.
#include "renderer/document/light_words.h"
#include "tests/unit/edits/edits_kit.h"
#include "ui/outline_geometry.h"
#include "ui/scene_ray.h"

namespace kilolux {
namespace {

Viewport lookingDownZ() {
    Viewport viewport;
    viewport.rect = {200, 30, 800, 600};
    viewport.camera.yfovRad = 1.0;
    return viewport;
}

void addLight(Scene& scene, const glm::dvec3& at, const LightDef& def) {
    Node node;
    node.localFromNode[3] = glm::dvec4(at, 1.0);
    LightNode light;
    light.id = scene.lights.size() + 1;
    light.node = int(scene.nodes.size());
    light.def = int(scene.lightDefs.size());
    scene.nodes.push_back(node);
    scene.lightDefs.push_back(def);
    scene.lights.push_back(light);
    updateWorldTransforms(scene);
}

TEST(Outlines, HaveTheSizeOfTheSource) {
    const Viewport viewport = lookingDownZ();
    for (const auto& word : kLightTypeWords) {
        Scene scene;
        LightDef def;
        def.type = word.type;
        def.radiusM = 0.4;
        def.lengthM = 1.0;
        def.widthM = 0.8;
        def.heightM = 0.6;
        addLight(scene, {0.1, -0.2, -4.0}, def);
        OutlineSet set;
        set.build(scene, viewport, 1.0);
        ASSERT_EQ(set.outlines().size(), 1u) << word.name;
        const LightOutline& outline = set.outlines()[0];
        const double pxPerM = 1.0 / viewport.metresPerPixel({0.1, -0.2, -4.0});
        double widest = 0.0;
        const auto segments = set.segmentsOf(outline);
        ASSERT_GT(segments.size(), 3u) << word.name;
        for (std::size_t i = 0; i < segments.size() - outline.hasStem; ++i)
            widest = std::max(widest, std::abs(segments[i].from.x - outline.centerPx.x));
        double expectedM = 0.4;
        if (word.type == LightType::Tube) expectedM = 0.9;
        if (word.type == LightType::Directional) {
            EXPECT_NEAR(widest, 7.0, 0.01);
            continue;
        }
        EXPECT_NEAR(widest, expectedM * pxPerM, 0.02 * expectedM * pxPerM) << word.name;
        // All around the outline it can be clicked, in the middle of a large one it cannot.
        EXPECT_EQ(set.at(segments[0].from, 6.0), std::vector<int>{0}) << word.name;
        EXPECT_TRUE(set.at(outline.centerPx + glm::dvec2(500, 0), 6.0).empty());
    }
}

TEST(Outlines, SmallSourcesCanBeSeenAndClicked) {
    const Viewport viewport = lookingDownZ();
    Scene scene;
    addLight(scene, {0, 0, -300}, LightDef{}); // a point, far off
    addLight(scene, {0, 0, 5}, LightDef{});    // behind
    addLight(scene, {500, 0, -4}, LightDef{}); // outside
    OutlineSet set;
    set.build(scene, viewport, 1.0);
    ASSERT_EQ(set.outlines().size(), 1u);
    EXPECT_EQ(set.at(set.outlines()[0].centerPx, 6.0), std::vector<int>{0});
    set.build(scene, viewport, 2.0);
    EXPECT_NEAR(
        glm::distance(glm::dvec2(set.segmentsOf(set.outlines()[0])[0].from), set.outlines()[0].centerPx), 8.0,
        1e-4);
}

TEST(Outlines, TheNearestInPixelsComesFirstThenTheNearestInDepth) {
    const Viewport viewport = lookingDownZ();
    Scene scene;
    addLight(scene, {0, 0, -8}, LightDef{});
    addLight(scene, {0, 0, -4}, LightDef{});
    addLight(scene, {0.03, 0, -4}, LightDef{});
    OutlineSet set;
    set.build(scene, viewport, 1.0);
    const glm::dvec2 center = *viewport.project({0, 0, -4});
    EXPECT_EQ(set.at(center, 10.0), (std::vector<int>{1, 0, 2}));
    EXPECT_EQ(set.at(*viewport.project({0.03, 0, -4}), 2.0).front(), 2);
    EXPECT_EQ(set.within(center - 20.0, center + glm::dvec2(1, 20)).size(), 2u);
    EXPECT_EQ(set.within(center + glm::dvec2(30, 20), center - 20.0).size(), 3u);
}

TEST(SceneRay, FindsTheNearestSurfaceWhateverItsTransform) {
    const test::TempFolder folder;
    test::GltfBuilder builder;
    builder.addTriangle({{"translation", {-2, -1, -5}}, {"scale", {4, 3, 1}}});
    builder.addTriangle({{"translation", {-2, -1, -9}}, {"scale", {-4, 3, 1}}, {"rotation", {0, 1, 0, 0}}});
    auto scene = importGltf(builder.write(folder));
    ASSERT_TRUE(scene);
    const auto hit = nearestSurface(scene.value(), {{-1, 0, 1}, {0, 0, -1}});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distanceM, 6.0, 1e-9);
    EXPECT_LT(glm::distance(hit->pointWs, glm::dvec3(-1, 0, -5)), 1e-9);
    EXPECT_LT(glm::distance(hit->normalWs, glm::dvec3(0, 0, 1)), 1e-9);
    const auto behind = nearestSurface(scene.value(), {{-1, 0, -6}, {0, 0, -1}});
    ASSERT_TRUE(behind);
    EXPECT_NEAR(behind->distanceM, 3.0, 1e-9);
    EXPECT_NEAR(behind->normalWs.z, 1.0, 1e-9); // towards where the ray came from
    EXPECT_FALSE(nearestSurface(scene.value(), {{-1, 0, 1}, {0, 0, 1}}));
    EXPECT_FALSE(nearestSurface(scene.value(), {{10, 0, 1}, {0, 0, -1}}));
}

} // namespace
} // namespace kilolux
