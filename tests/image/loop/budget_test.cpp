// Where the samples of the real pass go: directional lights within their budget indoors and out, and unlikely
// lights as often as the probability that is reported for them.
#include "shaders/shared/sampling.h"
#include "tests/image/loop/loop_kit.h"

namespace kilolux::test {
namespace {

using namespace shared;

// ---------------------------------------------------------------------------------------------------------
// Sun and lamps

constexpr std::uint32_t kDirectionalList = 2;

// A floor, with a room around it or under the open sky, a sun, and `lamps` of so many candela.
Scene sunScene(bool indoors, int lamps, double candela) {
    SceneBuilder b;
    const int matt = b.material({0.6, 0.6, 0.6}, 0.0, 0.9);
    b.quad(floorAt({0, 0, 0}), 8, 8, matt);
    if (indoors) {
        b.quad(floorAt({0, 3, 0}), 8, 8, matt);
        for (const glm::dvec3& out :
             {glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1)})
            b.quad(lookingAlong(4.0 * out + glm::dvec3(0, 1.5, 0), out), 8, 3, matt);
    }
    LightDef sun = lightDef(LightType::Directional, 20000, LightUnit::Lux);
    sun.angularDiameterRad = 0.01;
    b.light(sun, lookingAlong({0, 10, 0}, {0.3, -1.0, -0.2}));
    for (int i = 0; i < lamps; ++i) {
        LightDef lamp = lightDef(LightType::Sphere, candela, LightUnit::Candela);
        lamp.radiusM = 0.1;
        lamp.rangeM = 20.0;
        b.light(lamp, lookingAlong({i - 1.5, 2.4, 0.5 * i - 1.0}, {0, -1, 0}));
    }
    b.scene.cameras.push_back(cameraLooking({0.3, 2.0, 3.6}, {0, 0.0, -0.4}));
    return withIds(std::move(b.scene));
}

// Share of the chosen samples that go to the sun, over some frames after the first ones.
double sunShare(const Scene& scene, const std::vector<std::string>& settings) {
    RenderOptions options = loopOptions(64, 48, settings);
    options.keepTargets = true;
    Loop loop(scene, options);
    loop.frames(3);
    double chosen = 0.0, sun = 0.0;
    for (int frame = 0; frame < 6; ++frame) {
        loop.frames(1);
        for (const PixelSample& sample : samplesOf(loop.targets())) {
            chosen += sample.contribution > 0.0f;
            sun += sample.contribution > 0.0f && sample.list == kDirectionalList;
        }
    }
    EXPECT_GT(chosen, 1000.0);
    return sun / chosen;
}

TEST(DirectionalBudget, LampsIndoorsKeepTheirShare) {
    const Scene scene = sunScene(true, 4, 5000.0);
    const std::string blind = "guiding=false";
    EXPECT_NEAR(sunShare(scene, {blind}), 0.5, 0.02) << "the sun is far stronger, and hidden everywhere";
    EXPECT_NEAR(sunShare(scene, {blind, "directionalShare=0.2"}), 0.2, 0.02);
    EXPECT_LT(sunShare(scene, {}), 0.1) << "no tile has seen it";
    // Dim lamps, a hundredth of display white, are still all the light there is.
    EXPECT_NEAR(sunShare(sunScene(true, 4, 8.0), {blind, "exposureEv100=6"}), 0.5, 0.03) << "dim lamps";
    const RenderOptions options = loopOptions(64, 48);
    Loop loop(scene, options);
    expectSameMean(gather(framesOf(loop)), splitReference(scene, options), "hidden sun");
}

TEST(DirectionalBudget, SunOutdoorsTakesAll) {
    const Scene dusk = sunScene(false, 4, 0.02); // lamps under the sum at which the budget begins
    EXPECT_GT(sunShare(dusk, {}), 0.95);
    EXPECT_NEAR(sunShare(dusk, {"dimLights=keep", "directionalFreeBelow=0"}), 0.5, 0.02)
        << "without that sum the same lamps would take half";
    const RenderOptions options = loopOptions(64, 48);
    Loop loop(dusk, options);
    expectSameMean(gather(framesOf(loop)), splitReference(dusk, options), "sun and weak lamps");
}

// ---------------------------------------------------------------------------------------------------------
// Noise contract

// Two lights straight above a small floor, one about a thousandth as likely as the other.
Scene unevenScene() {
    SceneBuilder b;
    b.quad(floorAt({0, 0, 0}), 4, 4, b.material({0.5, 0.5, 0.5}, 0.0, 1.0));
    for (const double candela : {2.0e6, 1.8e3}) {
        LightDef def = lightDef(LightType::Sphere, candela, LightUnit::Candela);
        def.rangeM = 500.0;
        b.light(def, lookingAlong({0, 50, 0}, {0, -1, 0}));
    }
    b.scene.cameras.push_back(cameraLooking({0, 2, 0.01}, {0, 0, 0}, 0.6));
    return withIds(std::move(b.scene));
}

// The weak light's probability, and the sum of 1 / probability over the samples that chose it, per sample in
// all: 1 if it is chosen as often as reported.
struct Contract {
    double probability = 0.0, ratio = 0.0, samples = 0.0;
};

Contract contractOf(const std::vector<std::string>& settings, bool listed) {
    constexpr int size = 256, frames = 16;
    std::vector<std::string> all{"dimLights=keep"};
    all.insert(all.end(), settings.begin(), settings.end());
    RenderOptions options = loopOptions(size, size, all);
    options.keepTargets = true;
    Loop loop(unevenScene(), options);
    loop.frames(1);
    std::vector<glm::uvec2> lists(loop.renderer().visibleLists().size());
    for (std::size_t first = 0; first < lists.size(); first += LIST_TEXELS) {
        lists[first].x = 2;
        lists[first + 2].x = 1;
    }
    double chosen = 0.0, sum = 0.0, samples = 0.0;
    for (int frame = 0; frame < frames; ++frame) {
        if (listed) loop.renderer().replaceVisibleLists(lists);
        loop.frames(1);
        for (const PixelSample& sample : samplesOf(loop.targets())) {
            samples += sample.contribution > 0.0f;
            if (sample.contribution <= 0.0f || sample.slot != 1) continue;
            chosen += 1.0;
            sum += double(sample.contribution);
        }
    }
    return {chosen / sum, sum / samples, samples};
}

TEST(NoiseOfThePass, UnlikelyLightIsChosenAsOftenAsReported) {
    for (const char* noise : {"noise=blue", "noise=white"}) {
        for (const bool listed : {false, true}) {
            const Contract c = contractOf({noise, listed ? "guiding=true" : "guiding=false"}, listed);
            std::printf("%s, %s: probability %.5f, %.2f %% too often\n", noise, listed ? "listed" : "hidden",
                        c.probability, 100.0 * (c.ratio - 1.0));
            EXPECT_GT(c.samples, 1.0e6);
            EXPECT_GT(c.probability, 0.0008);
            EXPECT_LT(c.probability, 0.0012);
            EXPECT_NEAR(c.ratio, 1.0, 0.05);
        }
    }
}

} // namespace
} // namespace kilolux::test
