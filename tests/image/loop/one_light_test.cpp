// One light and nothing in its way: there is nothing to choose and nothing to miss, so a raw frame equals the
// analytic picture to float rounding, for every type of light, resolution of sampling and number of rays.
#include "tests/image/loop/loop_kit.h"

namespace kilolux::test {
namespace {

// A floor and a wall; the camera sees nothing else.
Scene openScene(const LightCase& light) {
    SceneBuilder b;
    const int matt = b.material({0.7, 0.5, 0.3}, 0.0, 0.9), glossy = b.material({0.2, 0.4, 0.6}, 0.0, 0.3),
              metal = b.material({0.9, 0.7, 0.4}, 1.0, 0.45);
    b.quad(floorAt({-5, 0, 0}), 10, 20, matt);
    b.quad(floorAt({5, 0, 0}), 10, 20, glossy);
    b.quad(lookingAlong({0, 5, -2.5}, {0, 0, -1}), 20, 10, metal);
    b.light(light.def, light.worldFromLight);
    b.scene.cameras.push_back(cameraLooking({0.3, 2.3, 4.6}, {0, 0.6, -0.4}));
    return withIds(std::move(b.scene));
}

// Of the pixels that had a turn and a neighbour to take samples from.
struct Difference {
    std::size_t compared = 0, reconstructed = 0;
    std::size_t wrong = 0;     // beyond float rounding, away from the border of the light's reach
    double worst = 0.0;        // of these, relative to the pixel, or to a thousandth of the brightest one
    double lostAtBorder = 0.0; // of the picture's light
};

// Whether the light does not reach some pixel within three.
bool isAtBorder(const Picture& truth, std::size_t pixel) {
    const int x = int(pixel) % truth.width, y = int(pixel) / truth.width;
    for (int v = std::max(y - 3, 0); v <= std::min(y + 3, truth.height - 1); ++v) {
        for (int u = std::max(x - 3, 0); u <= std::min(x + 3, truth.width - 1); ++u) {
            const float* p = &truth.rgb[3 * (std::size_t(v) * std::size_t(truth.width) + std::size_t(u))];
            if (p[0] + p[1] + p[2] <= 0.0f) return true;
        }
    }
    return false;
}

Difference compare(const Picture& frame, const FrameTargets& targets, const Picture& truth) {
    Difference d;
    const float brightest = *std::max_element(truth.rgb.begin(), truth.rgb.end());
    double whole = 0.0;
    for (std::size_t pixel = 0; pixel < targets.pixels(); ++pixel) {
        const float turn = targets.floats("litDiffuse").pixels[4 * pixel + 3];
        d.reconstructed += turn == 0.5f;
        if (turn != 1.0f) continue;
        ++d.compared;
        double worst = 0.0, lost = 0.0;
        for (std::size_t c = 3 * pixel; c < 3 * pixel + 3; ++c) {
            const double scale = std::max(truth.rgb[c], 1e-3f * brightest);
            worst = std::max(worst, std::abs(double(frame.rgb[c]) - truth.rgb[c]) / scale);
            lost += truth.rgb[c] - double(frame.rgb[c]);
            whole += truth.rgb[c];
        }
        if (worst <= 2e-5) continue;
        if (isAtBorder(truth, pixel)) {
            d.lostAtBorder += lost;
        } else {
            ++d.wrong;
            d.worst = std::max(d.worst, worst);
        }
    }
    d.lostAtBorder /= whole;
    return d;
}

struct Mode {
    const char* sampling;
    double rays;
    double share; // of the pixels that have a turn
};
constexpr Mode kModes[] = {{"full", 1, 1.0},   {"full", 4, 1.0},         {"full", 0.25, 0.25},
                           {"full", 16, 1.0},  {"checkerboard", 1, 1.0}, {"rooks", 4, 1.0},
                           {"rooks", 0.5, 0.5}};
constexpr std::size_t kFullModes = 3; // the first ones

// At the border of the light's reach, full modes may lose `borderLoss` of the picture's light.
void expectAnalytic(const Scene& scene, const std::string& light, std::span<const Mode> modes,
                    double borderLoss) {
    RenderOptions options = loopOptions(48, 32);
    options.method = "all-lights";
    const Picture truth = renderScene(scene, options).picture;
    options.method = "stochastic";
    options.keepTargets = true;
    Loop loop(scene, options);
    for (const Mode& mode : modes) {
        const std::string what = light + ", " + mode.sampling + ", rays " + std::to_string(mode.rays);
        // Quarters of the light that were not seen get fewer samples of more weight: right on average only.
        options = loopOptions(48, 32,
                              {"dimLights=keep", "areaMasks=false", std::string("sampling=") + mode.sampling,
                               "raysPerPixel=" + std::to_string(mode.rays)});
        ASSERT_FALSE(loop.renderer().setSettings(options.settings));
        for (int frame = 1; frame <= 2; ++frame) {
            const Picture picture = loop.next();
            const FrameTargets targets = loop.targets();
            if (frame == 1) expectClean(targets);
            const Difference d = compare(picture, targets, truth);
            EXPECT_EQ(d.wrong, 0u) << what << ", frame " << frame << ": worst " << d.worst << " of "
                                   << d.compared;
            // A half-resolution pixel beyond the light's reach cannot choose it for its neighbours within.
            EXPECT_LE(d.lostAtBorder, mode.sampling == std::string("full") ? borderLoss : 0.005) << what;
            EXPECT_LE(d.reconstructed, targets.pixels() / 100) << what;
            EXPECT_EQ(d.compared + d.reconstructed, std::size_t(mode.share * double(targets.pixels())))
                << what;
        }
    }
}

class OneLight : public testing::TestWithParam<LightCase> {};

TEST_P(OneLight, RawFrameIsTheAnalyticPicture) {
    expectAnalytic(openScene(GetParam()), GetParam().name, kModes, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Types, OneLight, testing::ValuesIn(lightCases()),
                         [](const auto& tested) { return tested.param.name; });

// Sunk to the middle into the floor: points below the horizon are drawn again, or the light would lose half.
// (Not a tube: from beyond its end so little is above that 64 draws are too few. A few
// pixels where a sphere touches the floor differ still, by up to 1 % of the picture.)
TEST(OneLightTest, HalfBelowTheHorizon) {
    for (const std::size_t index : {0u, 1u, 2u}) {
        LightCase light = lightCases()[index];
        light.worldFromLight = lookingAlong({-1.6, 0.0, 0.4}, {1.0, 0.0, -0.2});
        light.def.rangeM = 15.0;
        Scene scene = openScene(light);
        scene.cameras[0] =
            cameraLooking({-0.6, 4.0, 2.0}, {-0.6, 0.0, 0.4}); // the wall would see the floor hide half
        expectAnalytic(scene, light.name, std::span(kModes).first(kFullModes), 0.02);
    }
}

} // namespace
} // namespace kilolux::test
