// The filters between sampled light and the picture: energy, repair, exposure, speed of answer, and that a
// still picture converges. Most tests replace what was sampled by light that they know.
#include "tests/image/image_kit.h"
#include "tests/image/image_scenes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>

namespace kilolux::test {
namespace {

constexpr int kWidth = 64, kHeight = 48, kRegionPx = 16;
constexpr std::size_t kPixels = std::size_t(kWidth) * std::size_t(kHeight);

RenderOptions stochastic(const std::vector<std::string>& settings, int frames) {
    RenderOptions options = smallOptions(kWidth, kHeight, settings);
    options.method = "stochastic";
    options.frames = frames;
    return options;
}

Scene litStage() {
    return stageScene({lightCases()[0], lightCases()[2]});
}

// The same light at every pixel and frame, all of it sampled.
LitTexels evenLight(float value) {
    LitTexels lit;
    for (std::size_t i = 0; i < kPixels; ++i) {
        lit.diffuse.insert(lit.diffuse.end(), {value, value, value, 1.0f});
        lit.specular.insert(lit.specular.end(), {value, value, value, 255.0f});
    }
    return lit;
}

// Diffuse light of another value at some pixels.
LitTexels evenLightBut(float value, float other, const std::function<bool(std::size_t)>& isOther) {
    LitTexels lit = evenLight(value);
    for (std::size_t i = 0; i < kPixels; ++i) {
        for (std::size_t c = 0; c < 3 && isOther(i); ++c)
            lit.diffuse[4 * i + c] = other;
    }
    return lit;
}

bool isDot(std::size_t i) {
    return i % kWidth % 9 == 4 && i / kWidth % 9 == 4;
}

double meanOf(const FrameTargets& targets, const std::string& name) {
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < targets.pixels(); ++i) {
        if (!targets.surface(i).seen) continue;
        sum += luminanceOf(targets.rgb(name, i));
        count += 1.0;
    }
    return sum / count;
}

// Luminance per region of the picture, surfaces only.
std::vector<double> regionSums(const std::function<double(std::size_t)>& value) {
    std::vector<double> sums(kWidth / kRegionPx * kHeight / kRegionPx, 0.0);
    for (std::size_t i = 0; i < kPixels; ++i) {
        const std::size_t x = i % kWidth / kRegionPx, y = i / kWidth / kRegionPx;
        sums[y * (kWidth / kRegionPx) + x] += value(i);
    }
    return sums;
}

double total(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

// Real noise of one ray per pixel, eight frames of it repeated: their mean is known, and what a linear filter
// makes of a period has the same. Fireflies add a fifth to each region's light, at another pixel every frame.
TEST(Denoiser, KeepsTheEnergyOfEveryRegionWithFireflies) {
    constexpr int kPeriod = 8, kFirst = 8;
    std::vector<LitTexels> cycle(kPeriod);
    const Scene scene = litStage();
    renderScene(scene, stochastic({"picture=raw"}, kFirst + kPeriod), [&](int frame, const FrameTargets& t) {
        if (frame < kFirst) return;
        cycle[std::size_t(frame % kPeriod)] = {t.floats("litDiffuse").pixels, t.floats("litSpecular").pixels};
    });
    for (int frame = 0; frame < kPeriod; ++frame) {
        LitTexels& lit = cycle[std::size_t(frame)];
        const std::vector<double> light = regionSums([&](std::size_t i) { return lit.diffuse[4 * i + 1]; });
        for (std::size_t r = 0; r < light.size(); ++r) {
            const std::size_t at = std::size_t(frame * 37 + 11) % (kRegionPx * kRegionPx);
            const std::size_t x = r % (kWidth / kRegionPx) * kRegionPx + at % kRegionPx,
                              y = r / (kWidth / kRegionPx) * kRegionPx + at / kRegionPx;
            float* texel = &lit.diffuse[4 * (y * kWidth + x)];
            if (texel[3] <= 0.0f) continue; // sky
            for (int c = 0; c < 3; ++c)
                texel[c] += float(0.2 * light[r]);
        }
    }
    std::vector<double> given(12, 0.0), kept = given, keptSpecular = given, givenSpecular = given,
                                        shown = given;
    RenderOptions options = stochastic({"picture=denoised", "antiAlias=off"}, 12 * kPeriod);
    options.replaceLit = [&](int frame) { return cycle[std::size_t(frame % kPeriod)]; };
    renderScene(scene, options, [&](int frame, const FrameTargets& t) {
        if (frame < 11 * kPeriod) return;
        const auto add = [&](std::vector<double>& sums, const std::string& name) {
            const std::vector<double> now =
                regionSums([&](std::size_t i) { return luminanceOf(t.rgb(name, i)); });
            for (std::size_t r = 0; r < sums.size(); ++r)
                sums[r] += now[r];
        };
        add(given, "litDiffuse");
        add(kept, "historyDiffuse");
        add(givenSpecular, "litSpecular");
        add(keptSpecular, "historySpecular");
        add(shown, "denoisedDiffuse");
    });
    // The spatial filter carries light over borders of regions, and loses none.
    EXPECT_NEAR(total(shown), total(kept), 0.01 * total(kept));
    for (std::size_t r = 0; r < given.size(); ++r) {
        EXPECT_NEAR(kept[r], given[r], 0.01 * given[r]) << "diffuse, region " << r;
        EXPECT_NEAR(shown[r], kept[r], 0.04 * kept[r]) << "filtered in space, region " << r;
        EXPECT_NEAR(keptSpecular[r], givenSpecular[r], 0.01 * givenSpecular[r]) << "specular, region " << r;
    }
}

// NaN and infinity never reach the history: the frame after them is that of light which never had them.
TEST(Denoiser, PlantedNaNsAreGoneAfterOneFrame) {
    RenderOptions options = stochastic({"picture=denoised"}, 6);
    const float bad[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                         1e30f};
    options.replaceLit = [&](int frame) {
        LitTexels lit = evenLight(0.5f);
        if (frame == 3)
            for (std::size_t i = 0; i < kPixels; i += 97)
                lit.diffuse[4 * i + i % 3] = lit.specular[4 * i + i % 3] = bad[i / 97 % 2];
        return lit;
    };
    renderScene(litStage(), options, [&](int frame, const FrameTargets& t) {
        for (const char* name : {"historyDiffuse", "historySpecular", "historyMoments", "denoisedDiffuse",
                                 "denoisedSpecular", "antiAliased", "pixelMoments"}) {
            for (const float value : t.floats(name).pixels)
                ASSERT_TRUE(std::isfinite(value) && value >= 0.0f) << name << ", frame " << frame;
        }
        if (frame < 4) return;
        EXPECT_NEAR(meanOf(t, "denoisedDiffuse"), 0.5, 0.005) << "frame " << frame;
        EXPECT_NEAR(meanOf(t, "denoisedSpecular"), 0.5, 0.005) << "frame " << frame;
    });
}

// Histories are rescaled when the exposure changes: the scene looks the same in nit. All lights stay
// candidates: what counts as dim goes by the display. From bright pictures down: half floats end at 6e-5 of
// display white.
TEST(Denoiser, ExposureStepsKeepTheBrightness) {
    for (const double stepEv : {10.0, -10.0}) {
        RenderOptions options = stochastic(
            {stepEv > 0 ? "exposureEv100=0" : "exposureEv100=6", "picture=denoised", "dimLights=keep"}, 1);
        Result<std::unique_ptr<Renderer>> renderer = Renderer::create(litStage(), options);
        ASSERT_TRUE(renderer) << renderer.error();
        const auto mean = [&] {
            double sum = 0.0;
            for (const float value : renderer.value()->picture().rgb)
                sum += double(value);
            return sum;
        };
        for (int i = 0; i < 12; ++i)
            ASSERT_FALSE(renderer.value()->renderFrame());
        const double before = mean();
        renderer.value()->setExposureEv100((stepEv > 0.0 ? 0.0 : 6.0) + stepEv);
        for (int i = 0; i < 3; ++i) {
            ASSERT_FALSE(renderer.value()->renderFrame());
            EXPECT_NEAR(mean(), before, 0.03 * before) << stepEv << " EV, frame " << i;
        }
    }
}

// A light that goes out is gone after a few frames though histories hold many; one that comes is there.
TEST(Denoiser, FollowsChangesOfLight) {
    for (const float after : {0.05f, 4.0f}) {
        RenderOptions options = stochastic({"picture=denoised"}, 30);
        options.replaceLit = [&](int frame) { return evenLight(frame < 20 ? 1.0f : after); };
        std::vector<double> seen;
        renderScene(litStage(), options,
                    [&](int, const FrameTargets& t) { seen.push_back(meanOf(t, "denoisedDiffuse")); });
        EXPECT_NEAR(seen[19], 1.0, 0.01);
        EXPECT_NEAR(seen[25], double(after), 0.05 * std::abs(1.0 - double(after))) << "five frames later";
    }
}

TEST(Denoiser, HistoryGrowsToItsLimit) {
    RenderOptions options = stochastic({"picture=denoised", "diffuseFrames=6", "specularFrames=3"}, 11);
    options.replaceLit = [&](int) { return evenLight(1.0f); };
    renderScene(litStage(), options, [&](int frame, const FrameTargets& t) {
        // The first three frames count a quarter, another one, and a half.
        const float frames = frame < 3 ? 0.25f * float(1 << frame) : float(frame - 1);
        for (std::size_t i = 0; i < t.pixels(); ++i) {
            if (!t.surface(i).seen) continue;
            EXPECT_EQ(t.floats("historyDiffuse").pixels[4 * i + 3], std::min(frames, 6.0f));
            EXPECT_EQ(t.floats("historySpecular").pixels[4 * i + 3], std::min(frames, 3.0f));
        }
    });
}

// What only the first frames met stands out of none of the next: a dot in the first is spread, one in the
// second limited.
TEST(Denoiser, DotsOfTheFirstFramesAreNotSeen) {
    constexpr float kDot = 100.0f;
    for (const int dotFrame : {0, 1}) {
        RenderOptions options = stochastic({"picture=denoised", "antiAlias=off", "jitter=false"}, 12);
        options.replaceLit = [&](int frame) {
            return frame == dotFrame ? evenLightBut(1.0f, kDot, isDot) : evenLight(1.0f);
        };
        renderScene(litStage(), options, [&](int frame, const FrameTargets& t) {
            if (frame < 2) return;
            for (std::size_t i = 0; i < t.pixels(); ++i) {
                if (!t.surface(i).seen) continue;
                // As 1 / n it would be 100 / 3 then, and still 9 at the end.
                ASSERT_LT(t.rgb("historyDiffuse", i).y, frame < 4 ? 6.0 : 3.0)
                    << "dot of frame " << dotFrame << " in frame " << frame << ", pixel " << i;
            }
        });
    }
}

// What stands out of a young history goes to the pixels around, and none of it is lost.
TEST(Denoiser, YoungHistoriesShareDotsWithoutLoss) {
    constexpr int kDotFrame = 4; // whose sample is a third of the sum
    RenderOptions options = stochastic({"picture=denoised", "antiAlias=off", "jitter=false"}, kDotFrame + 1);
    options.replaceLit = [&](int frame) {
        return frame == kDotFrame ? evenLightBut(1.0f, 30.0f, isDot) : evenLight(1.0f);
    };
    renderScene(litStage(), options, [&](int frame, const FrameTargets& t) {
        if (frame < kDotFrame) return;
        EXPECT_NEAR(meanOf(t, "historyDiffuse"), (2.0 + meanOf(t, "litDiffuse")) / 3.0, 0.005);
        double sum = 0.0, count = 0.0;
        for (std::size_t i = 0; i < t.pixels(); ++i) {
            if (!t.surface(i).seen || !isDot(i)) continue;
            sum += t.rgb("historyDiffuse", i).y;
            count += 1.0;
        }
        EXPECT_LT(sum / count, 8.0) << "11 unshared";
    });
}

// The edge of a shadow stands from the fourth frame on: light does not cross it by the filter's radius.
TEST(Denoiser, YoungHistoriesKeepTheEdgesOfShadows) {
    constexpr std::size_t kEdgePx = kWidth / 2;
    RenderOptions options = stochastic({"picture=denoised", "antiAlias=off", "jitter=false"}, 4);
    options.replaceLit = [&](int) {
        return evenLightBut(10.0f, 0.1f, [](std::size_t i) { return i % kWidth >= kEdgePx; });
    };
    renderScene(litStage(), options, [&](int frame, const FrameTargets& t) {
        if (frame < 3) return;
        double sum = 0.0, count = 0.0;
        for (std::size_t i = 0; i < t.pixels(); ++i) {
            // Nearer by, first histories hold the light across the edge.
            if (!t.surface(i).seen || i % kWidth < kEdgePx + 3 || i % kWidth >= kEdgePx + 7) continue;
            sum += t.rgb("denoisedDiffuse", i).y;
            count += 1.0;
        }
        EXPECT_LT(sum / count, 0.15) << "of 0.1 in the shadow";
    });
}

// Below one ray per pixel most pixels have no sample in a frame: none stays black.
TEST(Denoiser, PixelsWithoutASampleKeepOrBorrow) {
    RenderOptions options = stochastic({"picture=denoised", "raysPerPixel=0.25", "antiAlias=off"}, 3);
    options.replaceLit = [&](int frame) {
        LitTexels lit = evenLight(1.0f);
        for (std::size_t i = 0; i < kPixels; ++i) {
            const bool sampled = i % kWidth % 2 == std::size_t(frame) % 2 && i / kWidth % 2 == 0;
            for (int c = 0; c < 4 && !sampled; ++c)
                lit.diffuse[4 * i + std::size_t(c)] = 0.0f;
        }
        return lit;
    };
    renderScene(litStage(), options, [&](int frame, const FrameTargets& t) {
        for (std::size_t i = 0; i < t.pixels(); ++i) {
            if (t.surface(i).seen)
                ASSERT_NEAR(t.rgb("denoisedDiffuse", i).y, 1.0, 0.01) << "frame " << frame << ", pixel " << i;
        }
    });
}

// Where no neighbour fitted at half resolution the sample may be another surface's: history gives way to it
// less.
TEST(Denoiser, ReconstructedPixelsKeepMoreOfTheirHistory) {
    constexpr int kStep = 12;
    const auto lightAfterStep = [&](float valid) {
        RenderOptions options = stochastic({"picture=denoised", "antiAlias=off"}, kStep + 1);
        options.replaceLit = [&](int frame) {
            std::mt19937 random{std::uint32_t(frame)};
            LitTexels lit = evenLight(1.0f);
            for (std::size_t i = 0; i < kPixels; ++i) {
                const float value = (frame < kStep ? 1.0f : 2.0f) * (random() & 1u ? 1.3f : 0.7f);
                std::fill_n(&lit.diffuse[4 * i], 3, value);
                lit.diffuse[4 * i + 3] = frame < kStep ? 1.0f : valid;
            }
            return lit;
        };
        return meanOf(renderScene(litStage(), options).targets, "historyDiffuse");
    };
    const double sampled = lightAfterStep(1.0f), reconstructed = lightAfterStep(0.5f);
    std::printf("after a step from 1 to 2: %.3f, where reconstructed %.3f\n", sampled, reconstructed);
    EXPECT_GT(sampled, 1.1);
    EXPECT_LT(reconstructed - 1.0, 0.9 * (sampled - 1.0));
}

// One bright pixel among dark ones stands outside its neighbours' spread in every frame, and is no change.
TEST(AntiAlias, SmallHighlightsKeepTheirLight) {
    RenderOptions options = stochastic({"picture=denoised", "denoise=off", "jitter=false"}, 24);
    options.replaceLit = [&](int) {
        LitTexels lit = evenLight(0.1f);
        for (std::size_t i = 0; i < kPixels; ++i) {
            const bool bright = i % kWidth % 7 == 3 && i / kWidth % 7 == 3;
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

TEST(PictureChoices, DisabledFiltersGiveTheRawFrame) {
    const Scene scene = litStage();
    const Rendered raw = renderScene(scene, stochastic({"picture=raw"}, 4));
    const Rendered off =
        renderScene(scene, stochastic({"picture=denoised", "denoise=off", "antiAlias=off"}, 4));
    const Rendered on = renderScene(scene, stochastic({"picture=denoised"}, 4));
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
    std::vector<double> sum(3 * kPixels, 0.0);
    renderScene(scene, stochastic({"picture=raw"}, kFrames), [&](int, const FrameTargets& t) {
        for (std::size_t i = 0; i < kPixels; ++i)
            for (int c = 0; c < 3; ++c)
                sum[3 * i + std::size_t(c)] += t.rgb("sceneColor", i)[c] / kFrames;
    });
    const Rendered mean = renderScene(scene, stochastic({"picture=mean"}, kFrames));
    const Rendered settled = renderScene(scene, stochastic({"settleError=1"}, kFrames));
    const Rendered filtered = renderScene(scene, stochastic({"settleError=0"}, kFrames));
    const Rendered denoised = renderScene(scene, stochastic({"picture=denoised"}, kFrames));
    for (std::size_t i = 0; i < kPixels; ++i) {
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
    RenderOptions options = stochastic(all, kFrames);
    options.replaceLit = [&](int frame) {
        LitTexels lit = evenLight(0.0f);
        std::mt19937 random(std::uint32_t(frame) + 1u);
        for (std::size_t i = 0; i < kPixels; ++i) {
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
        RenderOptions options = stochastic(settings, kFrames);
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
