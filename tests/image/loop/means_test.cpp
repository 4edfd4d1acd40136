// The mean of the raw estimator is that of the reference 'split' in every mode: settings of sampling change
// the variance and never the mean. Blue noise, whose frames are no replicas, is measured against white.
#include "tests/image/loop/loop_kit.h"

namespace kilolux::test {
namespace {

constexpr int kWidth = 96, kHeight = 64;

struct Mode {
    const char* name;
    std::vector<std::string> settings;
    int pixelsPerRay = 1;
};

void expectUnbiased(const Scene& scene, const std::vector<Mode>& modes) {
    const Replicas reference = splitReference(scene, loopOptions(kWidth, kHeight));
    for (const Mode& mode : modes) {
        Loop loop(scene, loopOptions(kWidth, kHeight, mode.settings));
        expectSameMean(gather(framesOf(loop, 4, mode.pixelsPerRay)), reference, mode.name);
    }
}

void expectUnbiased(const std::vector<Mode>& modes) {
    expectUnbiased(crowdScene(24, 5), modes);
}

TEST(Means, GuidingAndMasksKeepThem) {
    expectUnbiased({{"guided", {}},
                    {"unguided", {"guiding=false"}},
                    {"no masks", {"areaMasks=false"}},
                    {"sharp masks", {"maskHiddenShare=0.01"}}});
}

TEST(Means, ResolutionsAndRaysKeepThem) {
    expectUnbiased({{"checkerboard", {"sampling=checkerboard"}},
                    {"rooks", {"sampling=rooks"}},
                    {"4 rays", {"raysPerPixel=4"}},
                    {"16 rays", {"raysPerPixel=16"}},
                    {"1/4 ray", {"raysPerPixel=0.25"}, 4},
                    {"1/4 ray, rooks", {"sampling=rooks", "raysPerPixel=0.25"}, 4}});
}

TEST(Means, CandidatesAndBudgetsKeepThem) {
    expectUnbiased({{"1 candidate", {"cellCandidates=1", "missCandidates=1"}},
                    {"all candidates", {"cellCandidates=1000"}},
                    {"few hidden", {"hiddenShare=0.02", "missHiddenShare=0.02"}},
                    {"short lists", {"listLength=3", "listMemory=1"}},
                    {"roulette", {"dimThreshold=0.2"}}});
}

// Doors, profiles, light functions, shadows of a scaled source, pictures.
TEST(Means, ShapedLightsKeepThem) {
    std::vector<LightCase> lights = shapedLights();
    for (const LightCase& light : pictureLights())
        lights.push_back(light);
    expectUnbiased(withIds(stageScene(lights)), {{"shaped", {}}});
}

// ---------------------------------------------------------------------------------------------------------
// Blue noise

// Two cycles of the mask, shifted against each other.
TEST(Means, BlueNoiseKeepsThem) {
    const Scene scene = crowdScene(24, 5);
    const Replicas reference = splitReference(scene, loopOptions(kWidth, kHeight));
    for (const char* sampling : {"sampling=full", "sampling=checkerboard"}) {
        for (std::uint32_t seed = 1; seed <= 3; ++seed) {
            RenderOptions options = loopOptions(kWidth, kHeight, {"noise=blue", sampling});
            options.seed = seed;
            Loop loop(scene, options);
            const Light light = framesOf(loop, 64)();
            const auto error = [&](int value) {
                return light.values[std::size_t(value)] / reference.mean(value).mean - 1.0;
            };
            double worst = 0.0;
            for (int value = 0; value < Light::Count; ++value)
                worst = std::max(worst, std::abs(error(value)));
            std::printf("blue, %s, seed %u: %+.3f %%, worst part %.2f %%\n", sampling, seed,
                        100 * error(Light::Luminance), 100 * worst);
            EXPECT_LT(std::abs(error(Light::Luminance)), 0.005);
            EXPECT_LT(worst, 0.04);
        }
    }
}

// ---------------------------------------------------------------------------------------------------------
// Dim lights

// `count` equal lights far above a small matt floor.
Scene dimScene(int count, double candela) {
    SceneBuilder b;
    b.quad(floorAt({0, 0, 0}), 4, 4, b.material({0.5, 0.5, 0.5}, 0.0, 1.0));
    const auto add = [&](double intensity, double aside) {
        LightDef def = lightDef(LightType::Sphere, intensity, LightUnit::Candela);
        def.rangeM = 500.0;
        b.light(def, lookingAlong({aside, 50, 0}, {0, -1, 0}));
    };
    for (int i = 0; i < count; ++i)
        add(candela, 1e-3 * i);
    b.scene.cameras.push_back(cameraLooking({0, 2, 0.01}, {0, 0, 0}, 0.6));
    return withIds(std::move(b.scene));
}

struct Dim {
    double luminance = 0.0, dropped = 0.0; // means; the second as the statistics say it
};
Dim meansOf(const Scene& scene, const std::vector<std::string>& settings, int frames) {
    Loop loop(scene, loopOptions(32, 32, settings));
    const double luminance = framesOf(loop, frames)().values[Light::Luminance];
    return {luminance, loop.renderer().statistics().droppedLightMean};
}

TEST(DimCrowd, RouletteKeepsItAndTheDropLosesIt) {
    constexpr double candela = 1000.0;
    RenderOptions options = loopOptions(32, 32);
    const double exposure = 1.0 / (1.2 * 1024.0); // of EV100 10
    const double one = splitReference(dimScene(1, candela), options).mean(Light::Luminance).mean;
    const std::string threshold = "dimThreshold=" + std::to_string(one * exposure / 0.9);
    const Scene crowd = dimScene(1000, candela);
    const Replicas reference = splitReference(crowd, options);
    for (const char* guiding : {"guiding=true", "guiding=false"}) {
        Loop loop(crowd, loopOptions(32, 32, {threshold, guiding}));
        expectSameMean(gather(framesOf(loop)), reference, std::string("dim crowd, ") + guiding);
        EXPECT_EQ(loop.renderer().statistics().droppedLightMean, 0.0);
        const Dim all = meansOf(crowd, {threshold, guiding, "dimLights=drop"}, 4);
        EXPECT_EQ(all.luminance, 0.0) << "all of it is dim";
        EXPECT_EQ(all.dropped, 1.0);
    }
    // Beside a light as strong as all of them the drop loses just half, beside stronger ones as much less.
    const std::string every = "cellCandidates=1000", missed = "missCandidates=1000";
    for (const double times : {1.0, 999.0}) {
        Scene uneven = crowd;
        uneven.lightDefs.write()[0].intensity = times * 999.0 * candela;
        const double whole = splitReference(uneven, options).mean(Light::Luminance).mean;
        const Dim kept = meansOf(uneven, {threshold, every, missed}, 32);
        const Dim left = meansOf(uneven, {threshold, "dimLights=drop", every, missed}, 8);
        const double lost = 1.0 / (1.0 + times);
        EXPECT_NEAR(kept.luminance / whole, 1.0, 0.005);
        EXPECT_EQ(kept.dropped, 0.0);
        EXPECT_NEAR(left.luminance / whole, 1.0 - lost, 0.005);
        EXPECT_NEAR(left.dropped, lost, 0.1 * lost);
    }
    // Of its cell a pixel sees every N-th light, and the strong one on its list. In the first frame there are
    // no lists, so that most pixels find dim lights alone.
    Scene half = crowd;
    half.lightDefs.write()[0].intensity = 999.0 * candela;
    EXPECT_NEAR(meansOf(half, {threshold, "dimLights=drop", "cellCandidates=100"}, 32).dropped, 0.5, 0.03);
}

} // namespace
} // namespace kilolux::test
