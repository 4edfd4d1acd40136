// Both references of the GPU against the oracle, on one G-buffer: a light of each type over the stage, the
// stage far from the origin, tiny and huge, and materials with textures, masks and mirrored nodes.
#include "tests/image/image_scenes.h"
#include "tests/image/oracle_kit.h"

#include "renderer/document/ies_profile.h"

#include <iostream>

namespace kilolux::test {
namespace {

LightComparison compared(const Scene& scene, const LightOptions& options) {
    const LightComparison result = compareLight(scene, options);
    std::cout << options.method << ": " << result << "\n";
    return result;
}

// A block of 8 x 8 pixels may differ by what the fitted GGX of `split` loses; `true` fits nothing.
void expectSplitAgrees(const Scene& scene, LightOptions options = {}) {
    options.method = "split";
    options.frames = measure::kMinReplicas;
    const LightComparison result = compared(scene, options);
    expectEquivalent(result);
    EXPECT_LT(result.worstBlock, 0.02);
}

void expectBothAgree(const Scene& scene, LightOptions options = {}) {
    options.method = "true";
    options.frames = 192; // samples of a light of small solid angle spread wide under a glossy lobe
    const LightComparison result = compared(scene, options);
    expectEquivalent(result);
    EXPECT_LT(result.worstBlock, 0.005);
    expectSplitAgrees(scene, options);
}

class ReferenceByLight : public testing::TestWithParam<LightCase> {};

TEST_P(ReferenceByLight, Agrees) {
    expectBothAgree(stageScene({GetParam()}));
}

INSTANTIATE_TEST_SUITE_P(Types, ReferenceByLight, testing::ValuesIn(lightCases()),
                         [](const auto& tested) { return tested.param.name; });

TEST(Reference, CornellAgrees) {
    expectBothAgree(loadScene("cornell.glb"));
}

TEST(Reference, AllLightsTogetherAgree) {
    expectBothAgree(stageScene(lightCases()), {.raysPerLight = 8});
}

TEST(Reference, ShapedLightsAgree) {
    expectBothAgree(stageScene(shapedLights()), {.raysPerLight = 8});
}

// The setting scales every light's own; light that nothing shadows stays.
TEST(Reference, ThePenumbraSettingIsThatOfEveryLight) {
    std::vector<LightCase> halved = {lightCases()[0], lightCases()[2]};
    const Scene scene = stageScene(halved);
    for (LightCase& light : halved)
        light.def.penumbraScale = 0.5;
    const auto picture = [](const Scene& of, const char* setting) {
        RenderOptions options = smallOptions(64, 48, {setting, "raysPerLight=4"});
        options.method = "all-lights";
        return renderScene(of, options).picture.rgb;
    };
    const std::vector<float> bySetting = picture(scene, "penumbraScale=0.5");
    EXPECT_EQ(bySetting, picture(stageScene(halved), "penumbraScale=1"));
    EXPECT_NE(bySetting, picture(scene, "penumbraScale=1"));
}

// Points of the light are exact; the analytic light's picture is prefiltered, which is a model error.
TEST(Reference, PicturesAgree) {
    const Scene scene = stageScene(pictureLights());
    expectEquivalent(compared(scene, {.method = "true", .raysPerLight = 16, .frames = 288}));
    const LightComparison split = compared(scene, {.method = "split", .raysPerLight = 8});
    for (const measure::Equivalence& channel : split.channel)
        EXPECT_LT(std::abs(channel.relativeDifference), 0.02);
}

TEST(Reference, BothGBuffersAgree) {
    const Scene scene = stageScene({lightCases()[0], lightCases()[4]});
    // What a method makes of a G-buffer does not depend on who filled it.
    expectSplitAgrees(scene, {.settings = {"gbuffer=raster"}});
    expectSplitAgrees(scene, {.settings = {"gbuffer=compute"}});
}

// Lights beside the floor at its height: half of each is under the horizon of every point of the floor.
TEST(Reference, LightsHalfBelowTheHorizonAgree) {
    std::vector<LightCase> lights;
    const auto beside = [&](std::size_t index, double size, const glm::dvec3& at, const glm::dvec3& along) {
        LightCase light = lightCases()[index];
        light.worldFromLight = lookingAlong(at, along);
        light.def.radiusM *= size;
        light.def.rangeM = 12.0;
        lights.push_back(light);
    };
    beside(0, 1.0, {-3.4, 0.05, 0.3}, {1, 0, -0.1});
    beside(1, 1.0, {3.3, -0.1, 1.0}, {-1, 0, -0.3});
    beside(2, 1.5, {0.3, 0.0, 3.5}, {0, 0, -1});
    beside(3, 3.0, {-3.3, 0.0, 1.8}, {1, 0, -0.5});
    expectBothAgree(stageScene(lights));
}

// Seen at a grazing angle against the light, where half of the glossy floor's light is Fresnel's rise.
TEST(Reference, GrazingViewsAgree) {
    std::vector<LightCase> lights{lightCases()[0], lightCases()[2]};
    lights[0].worldFromLight = lookingAlong({1.2, 0.8, -2.2}, {0, -0.15, 1});
    lights[1].worldFromLight = lookingAlong({1.9, 0.7, -1.8}, {0, -1, 0});
    Scene scene = stageScene(lights);
    scene.cameras[0] = cameraLooking({1.5, 0.45, 4.2}, {1.4, 0.1, 0.0}, 0.5);
    expectEquivalent(compared(scene, {.method = "true", .frames = 320}));
    // The fitted lobe is at its worst here, up to 12 % of a pixel: its model error, not the estimator's.
    const LightComparison split = compared(scene, {.method = "split"});
    for (const measure::Equivalence& channel : split.channel)
        EXPECT_LT(std::abs(channel.relativeDifference), 0.04);
    EXPECT_NEAR(split.diffuseRatio, 1.0, 0.005);
}

class ReferenceByPlace : public testing::TestWithParam<std::pair<double, glm::dvec3>> {};

TEST_P(ReferenceByPlace, Agrees) {
    const Scene scene = stageScene({lightCases()[0], lightCases()[2], lightCases()[3]});
    const auto [scale, place] = GetParam();
    // Rays and lights are the same for both methods: `true`, which needs many frames, goes to one place of
    // each kind.
    if (scale == 0.01 && place != glm::dvec3(0.0))
        expectBothAgree(placedScene(scene, scale, place));
    else
        expectSplitAgrees(placedScene(scene, scale, place));
}

INSTANTIATE_TEST_SUITE_P(Places, ReferenceByPlace,
                         testing::Values(std::pair(0.01, glm::dvec3(0.0)), std::pair(1000.0, glm::dvec3(0.0)),
                                         std::pair(1.0, glm::dvec3(1e4, 0.0, 0.0)),
                                         std::pair(1.0, glm::dvec3(-7e3, 300.0, 7e3)),
                                         std::pair(0.01, glm::dvec3(50.0, 0.0, -80.0))));

} // namespace
} // namespace kilolux::test
