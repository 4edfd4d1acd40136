// The baselines that resample: the unbiased ones have the mean of the reference 'true', reuse takes noise
// away and, biased, light.
#include "tests/image/dome_scenes.h"
#include "tests/image/loop/loop_kit.h"

#include "renderer/measure/metrics.h"

namespace kilolux::test {
namespace {

constexpr int kWidth = 96, kHeight = 64;

RenderOptions baselineOptions(const std::string& method, const std::vector<std::string>& settings = {}) {
    RenderOptions options = loopOptions(kWidth, kHeight, settings);
    options.method = method;
    return options;
}

// Frames that reuse are no replicas of one another: each begins with a cut.
MakeReplica framesAfterCut(Loop& loop, const Camera& camera, int frames) {
    return [&loop, camera, frames] {
        loop.renderer().setCamera(camera, Renderer::CameraChange::Cut);
        loop.frames(frames - 1);
        return lightOf(loop.next());
    };
}

Replicas trueReference(const Scene& scene) {
    Loop loop(scene, baselineOptions("true", {"raysPerLight=4"}));
    return gather(framesOf(loop, 1), 0.001, 64);
}

struct Baseline {
    const char* method;
    std::vector<std::string> settings;
    double error = 0.0014; // to which its mean is to be known
    double bound = 0.005;  // within which it is that of the reference
};

TEST(Baselines, UnbiasedOnesHaveTheMeanOfTrueBiasedReuseLosesLight) {
    const Scene scene = crowdScene(24, 5);
    const Replicas reference = trueReference(scene);
    for (const Baseline& b : {Baseline{"uniform", {}},
                              {"power", {}},
                              {"brdf", {}, 0.0025, 0.01},
                              {"hierarchy", {}, 0.001},
                              {"resampling", {"resampleCandidates=8"}},
                              {"resampling", {"resampleCandidates=8", "resampleFrom=power"}},
                              {"resampling", {"resampleCandidates=8", "resampleFrom=hierarchy"}}}) {
        Loop loop(scene, baselineOptions(b.method, b.settings));
        expectSameMean(gather(framesOf(loop), b.error), reference, b.method, b.bound);
    }
    Loop loop(scene, baselineOptions("restir", {"resampleCandidates=8", "reuseWeights=rays", "reuseFrames=20",
                                                "reuseRadius=30"}));
    expectSameMean(gather(framesAfterCut(loop, scene.cameras[0], 4)), reference, "restir, unbiased");

    // Biased reuse loses light at the borders of shadows.
    for (const char* weights : {"reuseWeights=counts", "reuseWeights=targets"}) {
        Loop biased(scene, baselineOptions("restir", {"resampleCandidates=8", weights, "reuseRadius=30"}));
        const Replicas light = gather(framesAfterCut(biased, scene.cameras[0], 4), 0.005, 64);
        const double ratio = light.mean(Light::Luminance).mean / reference.mean(Light::Luminance).mean;
        std::printf("restir, %s: %+.2f %%\n", weights, 100.0 * (ratio - 1.0));
        EXPECT_LT(ratio, 0.99) << weights;
        EXPECT_GT(ratio, 0.7) << weights;
    }
}

// Under a dome beside a local light: the tree holds it as what has no place.
TEST(Baselines, TheTreeHasTheMeanOfTrueUnderADome) {
    SceneBuilder b;
    const int grey = b.material({0.6, 0.5, 0.4}, 0.0, 1.0);
    b.quad(floorAt({0, 0, 0}), 6, 6, grey);
    b.quad(lookingAlong({0, 1, -1}, {0, 0, -1}), 2, 2, grey);
    b.light(lightCases()[0].def, lightCases()[0].worldFromLight);
    b.scene.cameras.push_back(cameraLooking({0.3, 2.3, 4.6}, {0, 0.6, -0.4}));
    Scene scene = withIds(std::move(b.scene));
    scene.dome.image = panorama(128, gradientSky);
    scene.dome.intensityNit = 20.0;
    const auto optionsOf = [](const char* method) {
        RenderOptions options = baselineOptions(method);
        options.width = 48;
        options.height = 32;
        return options;
    };
    const auto lightBy = [&](const char* method, double error) {
        Loop loop(scene, optionsOf(method));
        return gather(framesOf(loop, 1), error, 150);
    };
    const Replicas reference = lightBy("true", 0.0015);
    expectSameMean(lightBy("hierarchy", 0.002), reference, "hierarchy, dome", 0.0075);
    const double both = reference.mean(Light::Luminance).mean;
    scene.dome.intensityNit = 0.0;
    const double without = lightBy("true", 0.01).mean(Light::Luminance).mean;
    EXPECT_GT(without, 0.2 * both) << "both give their part";
    EXPECT_LT(without, 0.8 * both);
}

// As published: far less noise than the resampling that it builds on, from equally many candidates. The
// radius is that of a small picture.
TEST(Baselines, ReuseTakesNoiseAway) {
    const Scene scene = crowdScene(24, 5);
    Loop exact(scene, baselineOptions("all-lights", {"raysPerLight=16", "picture=mean"}));
    exact.frames(15);
    const Picture reference = exact.next();
    const auto errorOf = [&](const char* method, const std::vector<std::string>& settings) {
        Loop loop(scene, baselineOptions(method, settings));
        loop.frames(15);
        const Picture picture = loop.next();
        const measure::ImageView wanted{kWidth, kHeight, reference.rgb}, got{kWidth, kHeight, picture.rgb};
        return measure::relativeMeanSquaredError(wanted, got);
    };
    const double plain = errorOf("resampling", {"resampleCandidates=8"});
    const double inTime = errorOf("restir", {"resampleCandidates=8", "reuseNeighbours=0", "reuseFrames=20"});
    const double both =
        errorOf("restir", {"resampleCandidates=8", "reuseRadius=8", "reuseFrames=20", "reuseNeighbours=5"});
    const double unbiased = errorOf("restir", {"resampleCandidates=8", "reuseRadius=8", "reuseFrames=20",
                                               "reuseNeighbours=5", "reuseWeights=rays"});
    std::printf("squared relative error: resampling %.4f, in time %.4f, and space %.4f, unbiased %.4f\n",
                plain, inTime, both, unbiased);
    EXPECT_LT(inTime, 0.5 * plain);
    EXPECT_LT(both, 0.5 * plain);
    EXPECT_LT(unbiased, 0.75 * plain); // its weights are noisier
}

} // namespace
} // namespace kilolux::test
