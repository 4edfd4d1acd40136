// Views of a running renderer: switching them changes neither picture nor history; false colour of a known
// light is the band of its legend; what a pass wrote can be looked at.
#include "tests/image/loop/loop_kit.h"

#include "renderer/pass_output.h"

namespace kilolux::test {
namespace {

std::array<float, 3> colorAt(const Picture& picture, int x, int y) {
    const std::uint8_t* p = &picture.srgb8[3 * std::size_t(y * picture.width + x)];
    return {p[0] / 255.0f, p[1] / 255.0f, p[2] / 255.0f};
}

void expectColor(const std::array<float, 3>& found, const std::array<float, 3>& wanted,
                 const std::string& what) {
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(found[c], wanted[c], 1.01f / 255.0f) << what << ", channel " << c;
}

// Looks straight at a plane that emits and is lit from the front by a sun.
Scene wallScene(double emittedNit, double sunLux) {
    SceneBuilder b;
    const int material = b.material({0.4, 0.4, 0.4}, 0.0, 1.0);
    b.scene.materials[std::size_t(material)].emissiveNit = glm::dvec3(emittedNit);
    b.quad(glm::dmat4(1.0), 40, 40, material);
    LightDef sun = lightDef(LightType::Directional, sunLux, LightUnit::Lux);
    b.light(sun, lookingAlong({0, 0, 5}, {0, 0, -1}));
    b.scene.cameras.push_back(cameraLooking({0, 0, 3}, {0, 0, 0}));
    return withIds(b.scene);
}

Picture viewOf(const Scene& scene, const std::string& view, const std::string& exposure,
               FrameStatistics* statistics) {
    RenderOptions options = loopOptions(16, 8, {"exposureEv100=" + exposure, "picture=viewport"});
    options.view = view;
    Loop loop(scene, options);
    const Picture picture = loop.next();
    *statistics = loop.renderer().statistics();
    return picture;
}

TEST(ViewSwitch, KeepsPictureAndHistory) {
    const auto last = [](const std::vector<std::string>& views) {
        RenderOptions options = loopOptions(24, 16, {"picture=viewport"});
        options.settings.jitter = true;
        Loop loop(crowdScene(12, 9), options);
        for (const std::string& view : views) {
            if (auto error = loop.renderer().setView(view)) ADD_FAILURE() << error->message;
            loop.frames(1);
            EXPECT_EQ(loop.renderer().statistics().view, view);
        }
        EXPECT_FALSE(loop.renderer().setView("final"));
        const Picture picture = loop.next();
        EXPECT_EQ(loop.renderer().statistics().historyReset, "first frame");
        return std::pair(picture.srgb8, picture.rgb);
    };
    const auto still = last({"final", "final", "final", "final", "final"});
    const auto switched = last(
        {"final", "rejected-history", "lights-in-range", "pass:shade_samples/litDiffuseOut", "illuminance"});
    EXPECT_EQ(still, switched);
}

TEST(ViewSwitch, RefusesWhatIsNotThere) {
    RenderOptions options = loopOptions(16, 8);
    options.method = "all-lights";
    Loop loop(crowdScene(3, 9), options);
    loop.frames(1);
    EXPECT_TRUE(loop.renderer().setView("no-such-view"));
    EXPECT_TRUE(loop.renderer().setView("list-length")) << "of another method";
    loop.frames(1);
    EXPECT_EQ(loop.renderer().statistics().view, "final");
    // A pass is only known when the frame has run.
    EXPECT_FALSE(loop.renderer().setView("pass:no_such_pass"));
    loop.frames(1);
    EXPECT_NE(loop.renderer().statistics().viewProblem.find("no_such_pass"), std::string::npos);
}

// The denoiser's views want it even where the picture does without: history begins anew then, and only then.
TEST(ViewSwitch, BringsTheDenoiserThatTheSettingsLeaveOut) {
    Loop loop(crowdScene(6, 9), loopOptions(16, 8));
    loop.frames(2);
    ASSERT_FALSE(loop.renderer().setView("denoised-diffuse"));
    loop.frames(1);
    EXPECT_EQ(loop.renderer().statistics().historyReset, "view");
    const Picture picture = loop.next();
    EXPECT_GT(*std::max_element(picture.rgb.begin(), picture.rgb.end()), 0.0f);
}

TEST(FalseColor, LuminanceIsTheBandOfItsLegend) {
    FrameStatistics statistics;
    for (const double nit : {0.7, 20.0, 450.0}) {
        const Picture picture = viewOf(wallScene(nit, 0.001), "luminance", "5", &statistics);
        const Legend& legend = statistics.legend;
        EXPECT_EQ(legend.unit, "nit");
        EXPECT_NEAR(picture.rgb[3 * (4 * 16 + 8)], nit, 0.003 * nit);
        expectColor(colorAt(picture, 8, 4), legendColor(legend, legendPosition(legend, nit)), valueText(nit));
    }
}

TEST(FalseColor, IlluminanceIsThatOfTheSunWhateverTheMaterial) {
    FrameStatistics statistics;
    const Picture picture = viewOf(wallScene(30.0, 250.0), "illuminance", "5", &statistics);
    EXPECT_EQ(statistics.legend.unit, "lux");
    EXPECT_NEAR(picture.rgb[3 * (4 * 16 + 8)], 250.0, 0.5);
    expectColor(colorAt(picture, 8, 4),
                legendColor(statistics.legend, legendPosition(statistics.legend, 250.0)), "250 lux");
}

TEST(FalseColor, StopsCountFromMiddleGrey) {
    FrameStatistics statistics;
    // At EV 0 a luminance of 1.2 x 0.18 nit is exposed to 0.18 (exposure = 1 / (1.2 x 2^EV)).
    for (const double stops : {-3.5, 0.5, 2.5}) {
        const double nit = 1.2 * 0.18 * std::exp2(stops);
        const Picture picture = viewOf(wallScene(nit, 1e-6), "stops", "0", &statistics);
        EXPECT_NEAR(picture.rgb[3 * (4 * 16 + 8)], stops, 0.01);
        const Legend& legend = statistics.legend;
        expectColor(colorAt(picture, 8, 4), legendColor(legend, legendPosition(legend, stops)),
                    valueText(stops));
    }
}

TEST(FalseColor, IsolinesRunWhereTheBandChanges) {
    FrameStatistics statistics;
    RenderOptions options = loopOptions(96, 48, {"exposureEv100=3", "picture=viewport"});
    options.view = "illuminance";
    options.method = "all-lights";
    SceneBuilder b;
    b.quad(glm::dmat4(1.0), 40, 40, b.material({0.4, 0.4, 0.4}, 0.0, 1.0));
    LightDef bulb = lightDef(LightType::Sphere, 50.0, LightUnit::Candela);
    bulb.rangeM = 100.0;
    b.light(bulb, glm::translate(glm::dmat4(1.0), {0, 0, 0.5}));
    b.scene.cameras.push_back(cameraLooking({0, 0, 3}, {0, 0, 0}));
    Loop loop(withIds(b.scene), options);
    const Picture picture = loop.next();
    const Legend legend = loop.renderer().statistics().legend;
    int lines = 0;
    for (int y = 0; y + 1 < 48; ++y) {
        for (int x = 0; x + 1 < 96; ++x) {
            const auto lux = [&](int u, int v) { return double(picture.rgb[3 * std::size_t(v * 96 + u)]); };
            bool sharp = true; // else rounding decides
            const auto band = [&](int u, int v) {
                double sum = 0.0;
                for (int i = 0; i < 9; ++i)
                    sum +=
                        std::log10(lux(std::clamp(u + i % 3 - 1, 0, 95), std::clamp(v + i / 3 - 1, 0, 47)));
                sharp = sharp && std::abs(2.0 * sum / 9.0 - std::round(2.0 * sum / 9.0)) > 1e-3;
                return std::floor(2.0 * sum / 9.0);
            };
            const bool line = band(x + 1, y) != band(x, y) || band(x, y + 1) != band(x, y);
            if (!sharp) continue;
            std::array<float, 3> wanted = legendColor(legend, legendPosition(legend, lux(x, y)));
            for (float& channel : wanted)
                channel *= line ? 0.35f : 1.0f;
            expectColor(colorAt(picture, x, y), wanted,
                        "pixel " + std::to_string(x) + ", " + std::to_string(y));
            lines += line;
        }
    }
    EXPECT_GT(lines, 100);
}

TEST(Clipping, IsSaidOfBothEnds) {
    FrameStatistics statistics;
    EXPECT_EQ(viewOf(wallScene(1e5, 1e-6), "clipping", "0", &statistics).rgb[0], 1.0f);
    EXPECT_EQ(viewOf(wallScene(0.2, 1e-6), "clipping", "0", &statistics).rgb[0], 0.0f);
    EXPECT_EQ(viewOf(wallScene(1e-7, 1e-6), "clipping", "0", &statistics).rgb[0], -1.0f);
    EXPECT_EQ(statistics.legend.keys.size(), 2u);
}

TEST(ViewRangeSetting, MovesTheScale) {
    Loop loop(crowdScene(20, 9), loopOptions(24, 16));
    ASSERT_FALSE(loop.renderer().setView("lights-in-range", ViewRange{0.0, 8.0}));
    const Picture picture = loop.next();
    const Legend legend = loop.renderer().statistics().legend;
    EXPECT_EQ(legend.range, (ViewRange{0.0, 8.0}));
    const double count = picture.rgb[3 * (13 * 24 + 12)];
    EXPECT_GT(count, 0.0);
    expectColor(colorAt(picture, 12, 13), legendColor(legend, legendPosition(legend, count)),
                valueText(count));
}

TEST(PassOutput, IsWhatThePassWrote) {
    RenderOptions options = loopOptions(24, 16);
    options.view = "pass:shade_samples/litSpecular";
    options.keepTargets = true;
    Loop loop(crowdScene(6, 9), options);
    const Picture picture = loop.next();
    const FrameStatistics statistics = loop.renderer().statistics();
    EXPECT_EQ(statistics.view, "pass:shade_samples/litSpecularOut");
    EXPECT_EQ(statistics.viewOutputs, (std::vector<std::string>{"litDiffuseOut", "litSpecularOut"}));
    const FrameTargets targets = loop.targets();
    const FloatImage& specular = targets.floats("litSpecular");
    for (std::size_t i = 0; i < 24 * 16; ++i)
        ASSERT_EQ(picture.rgb[3 * i], specular.pixels[4 * i]) << "pixel " << i;
}

TEST(PassOutput, OfEveryPassThatWritesImages) {
    RenderOptions options = loopOptions(24, 16, {"picture=viewport", "sampling=rooks"});
    Loop loop(crowdScene(6, 9), options);
    loop.frames(2);
    int shown = 0;
    for (const PassTiming& pass : loop.renderer().statistics().passes) {
        ASSERT_FALSE(loop.renderer().setView("pass:" + pass.name));
        loop.frames(1);
        const std::string problem = loop.renderer().statistics().viewProblem;
        if (!problem.empty()) {
            EXPECT_NE(problem.find("buffers only"), std::string::npos) << problem;
            continue;
        }
        ++shown;
        EXPECT_EQ(loop.renderer().picture().srgb8.size(), 24u * 16u * 3u);
    }
    EXPECT_GE(shown, 14);
}

} // namespace
} // namespace kilolux::test
