// What follows the denoiser: anti-aliasing, and which picture is shown. Most tests replace what was sampled
// by light that they know.
#include "tests/image/filter_kit.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace kilolux::test {
namespace {

// One bright pixel among dark ones stands outside its neighbours' spread in every frame, and is no change.
TEST(AntiAlias, SmallHighlightsKeepTheirLight) {
    RenderOptions options = filterOptions({"picture=denoised", "denoise=off", "jitter=false"}, 24);
    options.replaceLit = [&](int) {
        LitTexels lit = evenLight(0.1f);
        for (std::size_t i = 0; i < kFilteredPixels; ++i) {
            const bool bright = i % kFilteredWidth % 7 == 3 && i / kFilteredWidth % 7 == 3;
            for (std::size_t c = 0; c < 3 && bright; ++c)
                lit.diffuse[4 * i + c] = 4.0f;
        }
        return lit;
    };
    renderScene(litStage(), options, [&](int frame, const FrameTargets& t) {
        if (frame < 20) return;
        EXPECT_NEAR(meanOf(t, "antiAliased"), meanOf(t, "sceneColor"), 0.005 * meanOf(t, "sceneColor"))
            << "frame " << frame;
    });
}

// The order in which a pass takes its pixels, by rows on CPU devices and by tiles on others, changes nothing.
TEST(AntiAlias, TakesPixelsInAnyOrder) {
    const Scene scene = litStage();
    std::vector<std::vector<float>> pictures;
    withFiltersOfAllDevices([&](bool cpuFilters) {
        RenderOptions options = filterOptions({"picture=viewport", "denoise=off"}, 4);
        options.width = 61;
        options.height = 43;
        options.settings.jitter = true;
        options.cpuFilters = cpuFilters;
        pictures.push_back(renderScene(scene, options).picture.rgb);
    });
    EXPECT_EQ(pictures[0], pictures[1]);
}

TEST(PictureChoices, DisabledFiltersGiveTheRawFrame) {
    const Scene scene = litStage();
    const Rendered raw = renderScene(scene, filterOptions({"picture=raw"}, 4));
    const Rendered off =
        renderScene(scene, filterOptions({"picture=denoised", "denoise=off", "antiAlias=off"}, 4));
    const Rendered on = renderScene(scene, filterOptions({"picture=denoised"}, 4));
    EXPECT_EQ(raw.picture.rgb, off.picture.rgb);
    EXPECT_EQ(raw.picture.srgb8, off.picture.srgb8);
    EXPECT_NE(raw.picture.rgb, on.picture.rgb);
    EXPECT_FALSE(raw.targets.has("historyDiffuse") || raw.targets.has("antiAliased") ||
                 raw.targets.has("meanColor"))
        << "images that nobody reads";
}

// The mean is that of the raw frames, and the viewport becomes it: after 48 frames with a generous
// settleError, never with none.
TEST(PictureChoices, TheViewportSettlesOnTheMean) {
    const Scene scene = litStage();
    constexpr int kFrames = 48;
    std::vector<double> sum(3 * kFilteredPixels, 0.0);
    renderScene(scene, filterOptions({"picture=raw"}, kFrames), [&](int, const FrameTargets& t) {
        for (std::size_t i = 0; i < kFilteredPixels; ++i)
            for (int c = 0; c < 3; ++c)
                sum[3 * i + std::size_t(c)] += t.rgb("sceneColor", i)[c] / kFrames;
    });
    const Rendered mean = renderScene(scene, filterOptions({"picture=mean"}, kFrames));
    const Rendered settled = renderScene(scene, filterOptions({"settleError=1"}, kFrames));
    const Rendered filtered = renderScene(scene, filterOptions({"settleError=0"}, kFrames));
    const Rendered denoised = renderScene(scene, filterOptions({"picture=denoised"}, kFrames));
    for (std::size_t i = 0; i < kFilteredPixels; ++i) {
        for (int c = 0; c < 3; ++c) {
            const double value = mean.targets.rgb("meanColor", i)[c];
            ASSERT_NEAR(value, sum[3 * i + std::size_t(c)], 1e-4 * (1.0 + value)) << i;
        }
    }
    double off = 0.0, all = 0.0, offFiltered = 0.0;
    for (std::size_t i = 0; i < mean.picture.rgb.size(); ++i) {
        off += std::abs(double(mean.picture.rgb[i] - settled.picture.rgb[i]));
        offFiltered += std::abs(double(denoised.picture.rgb[i] - filtered.picture.rgb[i]));
        all += double(mean.picture.rgb[i]);
    }
    EXPECT_LT(off, 0.01 * all);
    EXPECT_LT(offFiltered, 1e-3 * all);
}

// How much of the mean the viewport shows, with a mean far too noisy to be shown for its own sake.
double shareOfTheMean(const std::vector<std::string>& settings, float laterLight) {
    constexpr int kFrames = 50;
    std::vector<std::string> all = {"jitter=false", "settleError=0.001"};
    all.insert(all.end(), settings.begin(), settings.end());
    RenderOptions options = filterOptions(all, kFrames);
    options.replaceLit = [&](int frame) {
        LitTexels lit = evenLight(0.0f);
        std::mt19937 random(std::uint32_t(frame) + 1u);
        for (std::size_t i = 0; i < kFilteredPixels; ++i) {
            const float light = (random() & 1u) != 0u ? 2.0f : 0.0f;
            for (std::size_t c = 0; c < 3; ++c)
                lit.diffuse[4 * i + c] = light + (frame < kFrames / 2 ? 0.0f : laterLight);
        }
        return lit;
    };
    double sum = 0.0, count = 0.0;
    renderScene(litStage(), options, [&](int frame, const FrameTargets& t) {
        for (std::size_t i = 0; i < t.pixels() && frame == kFrames - 1; ++i) {
            if (!t.surface(i).seen) continue;
            sum += double(t.floats("viewportColor").pixels[4 * i + 3]);
            count += 1.0;
        }
    });
    return sum / count;
}

// A noisy mean gives way to filters that take its noise away and keep its light: not to those that take no
// noise away, nor to a picture that its noise does not explain.
TEST(PictureChoices, UselessAndFaultyFiltersGiveWayToTheMean) {
    EXPECT_LT(shareOfTheMean({}, 0.0f), 0.5);
    EXPECT_GT(shareOfTheMean({"denoise=off"}, 0.0f), 0.8) << "no noise taken away";
    EXPECT_GT(shareOfTheMean({}, 4.0f), 0.8) << "another light than the mean's";
    EXPECT_GT(shareOfTheMean({}, 0.5f), 0.8) << "another one by less than a pixel's noise";
}

// A still picture's edges become those of the supersampled one.
TEST(AntiAlias, StillEdgesConverge) {
    Scene scene = litStage();
    scene.materials[0].emissiveNit = {40, 60, 90}; // edges without noise
    constexpr int kFrames = 48;
    const auto shown = [&](const std::vector<std::string>& settings) {
        RenderOptions options = filterOptions(settings, kFrames);
        options.settings.jitter = true;
        options.replaceLit = [](int) { return evenLight(0.0f); };
        return renderScene(scene, options).picture.srgb8;
    };
    const auto truth = shown({"picture=mean", "exposureEv100=6"}),
               filtered = shown({"picture=denoised", "exposureEv100=6"}),
               aliased = shown({"picture=denoised", "antiAlias=off", "exposureEv100=6"});
    double off = 0.0, offAliased = 0.0;
    int worst = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        off += std::abs(int(truth[i]) - int(filtered[i]));
        offAliased += std::abs(int(truth[i]) - int(aliased[i]));
        worst = std::max(worst, std::abs(int(truth[i]) - int(filtered[i])));
    }
    EXPECT_LT(off, 0.1 * offAliased);
    EXPECT_LE(worst, 26) << "a tenth of the display's range";
}

} // namespace
} // namespace kilolux::test
