// Moving lights and cameras do not change the mean of the raw estimator: frames of one moment of a periodic
// motion are replicas, and their mean is the reference of that moment.
#include "tests/image/motion/motion_kit.h"

namespace kilolux::test {
namespace {

constexpr int kWidth = 48, kHeight = 32;

std::vector<double> litLuminance(const FrameTargets& targets) {
    std::vector<double> values;
    for (std::size_t i = 0; i < targets.pixels(); ++i)
        values.push_back(luminanceOf(targets.rgb("sceneColor", i)));
    return values;
}

// Mean of the reference 'split' at a time, of the same settings otherwise.
std::vector<double> splitAt(const Scene& scene, RenderOptions options, double timeS) {
    options.method = "split";
    options.settings.timeS = timeS;
    options.settings.timeStepS = 0.0;
    options.settings.raysPerLight = 16;
    FrameRig rig(scene, options);
    std::vector<double> sum;
    constexpr int kFrames = 12;
    for (int i = 0; i < kFrames; ++i) {
        const std::vector<double> frame = litLuminance(rig.frame());
        sum.resize(frame.size());
        for (std::size_t p = 0; p < frame.size(); ++p)
            sum[p] += frame[p] / kFrames;
    }
    return sum;
}

double total(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double v : values)
        sum += v;
    return sum;
}

// Holds the mean of replicas to the reference: the whole picture within 1 % and blocks of 16 x 16 pixels
// within five standard errors.
void expectMean(const std::vector<std::vector<double>>& replicas, const std::vector<double>& reference) {
    const double count = double(replicas.size());
    double sum = 0.0;
    for (const std::vector<double>& replica : replicas)
        sum += total(replica) / count;
    EXPECT_NEAR(sum / total(reference), 1.0, 0.01);
    for (int block = 0; block < (kWidth / 16) * (kHeight / 16); ++block) {
        const int left = block % (kWidth / 16) * 16, top = block / (kWidth / 16) * 16;
        const auto blockSum = [&](const std::vector<double>& picture) {
            double s = 0.0;
            for (int y = top; y < top + 16; ++y)
                for (int x = left; x < left + 16; ++x)
                    s += picture[std::size_t(y * kWidth + x)];
            return s;
        };
        double mean = 0.0, square = 0.0;
        for (const std::vector<double>& replica : replicas) {
            const double s = blockSum(replica);
            mean += s / count;
            square += s * s / count;
        }
        const double error = std::sqrt(std::max(square - mean * mean, 0.0) / (count - 1.0));
        EXPECT_NEAR(mean, blockSum(reference), 5.0 * error + 0.005 * mean) << "block " << block;
    }
}

// Lights swing with a period of 2 s: every fourth frame finds them at one place.
TEST(MovingMean, OfSwayingLightsIsTheMomentsReference) {
    const Scene scene = stageScene({lightCases()[0], lightCases()[2], lightCases()[4]});
    const RenderOptions options =
        stochasticOptions(kWidth, kHeight, {"picture=raw", "lightsSway=0.4", "timeStepS=0.5", "timeS=0.2"});
    FrameRig rig(scene, options);
    std::vector<std::vector<double>> replicas;
    rig.frames(4);
    for (int i = 0; i < 100; ++i) {
        rig.frames(3);
        replicas.push_back(litLuminance(rig.frame())); // frames 7, 11, ...: 0.2 s + 1.5 s + a multiple of 2 s
    }
    expectMean(replicas, splitAt(scene, options, 0.2 + 1.5));
    // The test would see lights that stand still.
    EXPECT_GT(std::abs(total(splitAt(scene, options, 0.2)) / total(splitAt(scene, options, 0.2 + 1.5)) - 1.0),
              0.02);
}

// The camera goes to and fro, so that every second frame looks the same way and comes from elsewhere.
TEST(MovingMean, OfAMovingCameraIsTheMomentsReference) {
    Scene scene = stageScene({lightCases()[0], lightCases()[2], lightCases()[4]});
    const Camera here = scene.cameras[0], there = cameraLooking({-0.6, 2.1, 4.2}, {0.3, 0.5, -0.4});
    const RenderOptions options = stochasticOptions(kWidth, kHeight, {"picture=raw"});
    FrameRig rig(scene, options);
    std::vector<std::vector<double>> replicas;
    for (int i = 0; i < 120; ++i) {
        rig.renderer().setCamera(there, Renderer::CameraChange::Move);
        rig.frames(1);
        rig.renderer().setCamera(here, Renderer::CameraChange::Move);
        replicas.push_back(litLuminance(rig.frame()));
    }
    expectMean(replicas, splitAt(scene, options, 0.0));
}

// cameraTurn and cameraDolly by themselves: frame k shows what the camera sees at that time, and where the
// settings say it then is.
TEST(MovingCamera, StandsWhereTheSettingsSay) {
    Scene scene = stageScene({lightCases()[0]});
    const std::vector<std::string> motion{"cameraTurn=8", "cameraDolly=0.5"};
    RenderOptions options = stochasticOptions(kWidth, kHeight, motion);
    options.settings.timeStepS = 0.25;
    FrameRig moving(scene, options);
    moving.frames(3);
    const FrameTargets fourth = moving.frame();
    options.settings.timeStepS = 0.0;
    options.settings.timeS = 0.75;
    const FrameTargets then = FrameRig(scene, options).frame();
    EXPECT_TRUE(fourth.named("gDepth").texels == then.named("gDepth").texels);

    // 6 degrees to the left about the vertical, and 0.375 m along the direction that it has at rest.
    Camera& camera = scene.cameras[0];
    const glm::dvec3 position(camera.worldFromCamera[3]), back(camera.worldFromCamera[2]);
    const glm::dmat3 turned =
        glm::dmat3(glm::rotate(glm::dmat4(1.0), glm::radians(6.0), glm::dvec3(0, 1, 0))) *
        glm::dmat3(camera.worldFromCamera);
    camera.worldFromCamera = glm::dmat4(turned);
    camera.worldFromCamera[3] = glm::dvec4(position - 0.375 * back, 1.0);
    const FrameTargets placed = FrameRig(scene, stochasticOptions(kWidth, kHeight)).frame();
    int different = 0;
    for (std::size_t i = 0; i < placed.pixels(); ++i) {
        const PixelSurface a = placed.surface(i), b = then.surface(i);
        different += a.seen != b.seen || (a.seen && std::abs(a.depthM - b.depthM) > 1e-4 * a.depthM);
    }
    EXPECT_LE(different, 3) << "pixels on edges";
    // The statistics of a moving camera: hardly anything is lost.
    moving.frames(8);
    EXPECT_LT(moving.renderer().statistics().missedShare, 0.25);
    EXPECT_EQ(moving.renderer().statistics().historyReset, "first frame");
}

} // namespace
} // namespace kilolux::test
