// The denoiser: energy, repair, exposure, speed of answer. Most tests replace what was sampled by light that
// they know.
#include "tests/image/filter_kit.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace kilolux::test {
namespace {

constexpr int kRegionPx = 16;

// Diffuse light of another value at some pixels.
LitTexels evenLightBut(float value, float other, const std::function<bool(std::size_t)>& isOther) {
    LitTexels lit = evenLight(value);
    for (std::size_t i = 0; i < kFilteredPixels; ++i) {
        for (std::size_t c = 0; c < 3 && isOther(i); ++c)
            lit.diffuse[4 * i + c] = other;
    }
    return lit;
}

bool isDot(std::size_t i) {
    return i % kFilteredWidth % 9 == 4 && i / kFilteredWidth % 9 == 4;
}

// Luminance per region of the picture, surfaces only.
std::vector<double> regionSums(const std::function<double(std::size_t)>& value) {
    std::vector<double> sums(kFilteredWidth / kRegionPx * kFilteredHeight / kRegionPx, 0.0);
    for (std::size_t i = 0; i < kFilteredPixels; ++i) {
        const std::size_t x = i % kFilteredWidth / kRegionPx, y = i / kFilteredWidth / kRegionPx;
        sums[y * (kFilteredWidth / kRegionPx) + x] += value(i);
    }
    return sums;
}

double total(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

constexpr int kPeriod = 8;

// Real noise of one ray per pixel, eight frames of it. Fireflies add a fifth to each region's light, at
// another pixel every frame.
std::vector<LitTexels> noiseWithFireflies(const Scene& scene) {
    constexpr int kFirst = 8;
    std::vector<LitTexels> cycle(kPeriod);
    renderScene(scene, filterOptions({"picture=raw"}, kFirst + kPeriod),
                [&](int frame, const FrameTargets& t) {
                    if (frame < kFirst) return;
                    cycle[std::size_t(frame % kPeriod)] = {t.floats("litDiffuse").pixels,
                                                           t.floats("litSpecular").pixels};
                });
    for (int frame = 0; frame < kPeriod; ++frame) {
        LitTexels& lit = cycle[std::size_t(frame)];
        const std::vector<double> light = regionSums([&](std::size_t i) { return lit.diffuse[4 * i + 1]; });
        for (std::size_t r = 0; r < light.size(); ++r) {
            const std::size_t at = std::size_t(frame * 37 + 11) % (kRegionPx * kRegionPx);
            const std::size_t x = r % (kFilteredWidth / kRegionPx) * kRegionPx + at % kRegionPx,
                              y = r / (kFilteredWidth / kRegionPx) * kRegionPx + at / kRegionPx;
            float* texel = &lit.diffuse[4 * (y * kFilteredWidth + x)];
            if (texel[3] <= 0.0f) continue; // sky
            for (int c = 0; c < 3; ++c)
                texel[c] += float(0.2 * light[r]);
        }
    }

    return cycle;
}

// That noise repeated: its mean is known, and what a linear filter makes of a period has the same.
TEST(Denoiser, KeepsTheEnergyOfEveryRegionWithFireflies) {
    const Scene scene = litStage();
    const std::vector<LitTexels> cycle = noiseWithFireflies(scene);
    withFiltersOfAllDevices([&](bool cpuFilters) {
        std::vector<double> given(12, 0.0), kept = given, keptSpecular = given, givenSpecular = given,
                                            shown = given;
        RenderOptions options = filterOptions({"picture=denoised", "antiAlias=off"}, 12 * kPeriod);
        options.cpuFilters = cpuFilters;
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
        // The spatial filter carries light over borders of regions, which are only twice its radius wide, and
        // loses none: 1 % holds for the sum of them. With all 25 neighbours more pixels know of a firefly's
        // deviation and mix with it, so more of it crosses.
        const double carried = cpuFilters ? 0.04 : 0.09;
        EXPECT_NEAR(total(shown), total(kept), 0.01 * total(kept));
        for (std::size_t r = 0; r < given.size(); ++r) {
            EXPECT_NEAR(kept[r], given[r], 0.01 * given[r]) << "diffuse, region " << r;
            EXPECT_NEAR(shown[r], kept[r], carried * kept[r]) << "filtered in space, region " << r;
            EXPECT_NEAR(keptSpecular[r], givenSpecular[r], 0.01 * givenSpecular[r])
                << "specular, region " << r;
        }
    });
}

// NaN and infinity never reach the history: the frame after them is that of light which never had them.
TEST(Denoiser, PlantedNaNsAreGoneAfterOneFrame) {
    RenderOptions options = filterOptions({"picture=denoised"}, 6);
    const float bad[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                         1e30f};
    options.replaceLit = [&](int frame) {
        LitTexels lit = evenLight(0.5f);
        if (frame == 3)
            for (std::size_t i = 0; i < kFilteredPixels; i += 97)
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
        RenderOptions options = filterOptions(
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
    withFiltersOfAllDevices([](bool cpuFilters) {
        for (const float after : {0.05f, 4.0f}) {
            RenderOptions options = filterOptions({"picture=denoised"}, 30);
            options.cpuFilters = cpuFilters;
            options.replaceLit = [&](int frame) { return evenLight(frame < 20 ? 1.0f : after); };
            std::vector<double> seen;
            renderScene(litStage(), options,
                        [&](int, const FrameTargets& t) { seen.push_back(meanOf(t, "denoisedDiffuse")); });
            EXPECT_NEAR(seen[19], 1.0, 0.01);
            EXPECT_NEAR(seen[25], double(after), 0.05 * std::abs(1.0 - double(after))) << "five frames later";
        }
    });
}

TEST(Denoiser, HistoryGrowsToItsLimit) {
    withFiltersOfAllDevices([](bool cpuFilters) {
        RenderOptions options =
            filterOptions({"picture=denoised", "diffuseFrames=6", "specularFrames=3"}, 11);
        options.cpuFilters = cpuFilters;
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
    });
}

// What only the first frames met stands out of none of the next: a dot in the first is spread, one in the
// second limited.
TEST(Denoiser, DotsOfTheFirstFramesAreNotSeen) {
    withFiltersOfAllDevices([](bool cpuFilters) {
        constexpr float kDot = 100.0f;
        for (const int dotFrame : {0, 1}) {
            RenderOptions options = filterOptions({"picture=denoised", "antiAlias=off", "jitter=false"}, 12);
            options.cpuFilters = cpuFilters;
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
    });
}

// What stands out of a young history goes to the pixels around, and none of it is lost; those whose history
// an edit holds short neither give nor take.
TEST(Denoiser, YoungHistoriesShareDotsWithoutLoss) {
    constexpr int kDotFrame = 4; // whose sample is a third of the sum
    for (const bool nextToEdits : {false, true}) {
        RenderOptions options =
            filterOptions({"picture=denoised", "antiAlias=off", "jitter=false"}, kDotFrame + 1);
        options.replaceLit = [&](int frame) {
            LitTexels lit = evenLightBut(1.0f, frame == kDotFrame ? 30.0f : 1.0f, isDot);
            for (std::size_t i = 0; i < kFilteredPixels && nextToEdits; ++i) {
                if (i % kFilteredWidth % 9 == 5 || i % kFilteredWidth % 9 == 6)
                    lit.specular[4 * i + 3] = 6.0f;
            }
            return lit;
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
            EXPECT_LT(sum / count, nextToEdits ? 10.0 : 8.0) << "11 unshared";
        });
    }
}

// The edge of a shadow stands from the fourth frame on: light does not cross it by the filter's radius.
TEST(Denoiser, YoungHistoriesKeepTheEdgesOfShadows) {
    constexpr std::size_t kEdgePx = kFilteredWidth / 2;
    RenderOptions options = filterOptions({"picture=denoised", "antiAlias=off", "jitter=false"}, 4);
    options.replaceLit = [&](int) {
        return evenLightBut(10.0f, 0.1f, [](std::size_t i) { return i % kFilteredWidth >= kEdgePx; });
    };
    renderScene(litStage(), options, [&](int frame, const FrameTargets& t) {
        if (frame < 3) return;
        double sum = 0.0, count = 0.0;
        for (std::size_t i = 0; i < t.pixels(); ++i) {
            // Nearer by, first histories hold the light across the edge.
            if (!t.surface(i).seen || i % kFilteredWidth < kEdgePx + 3 || i % kFilteredWidth >= kEdgePx + 7)
                continue;
            sum += t.rgb("denoisedDiffuse", i).y;
            count += 1.0;
        }
        EXPECT_LT(sum / count, 0.15) << "of 0.1 in the shadow";
    });
}

// Below one ray per pixel most pixels have no sample in a frame: none stays black.
TEST(Denoiser, PixelsWithoutASampleKeepOrBorrow) {
    withFiltersOfAllDevices([](bool cpuFilters) {
        RenderOptions options = filterOptions({"picture=denoised", "raysPerPixel=0.25", "antiAlias=off"}, 3);
        options.cpuFilters = cpuFilters;
        options.replaceLit = [&](int frame) {
            LitTexels lit = evenLight(1.0f);
            for (std::size_t i = 0; i < kFilteredPixels; ++i) {
                const bool sampled =
                    i % kFilteredWidth % 2 == std::size_t(frame) % 2 && i / kFilteredWidth % 2 == 0;
                for (int c = 0; c < 4 && !sampled; ++c)
                    lit.diffuse[4 * i + std::size_t(c)] = 0.0f;
            }
            return lit;
        };
        renderScene(litStage(), options, [&](int frame, const FrameTargets& t) {
            for (std::size_t i = 0; i < t.pixels(); ++i) {
                if (t.surface(i).seen)
                    ASSERT_NEAR(t.rgb("denoisedDiffuse", i).y, 1.0, 0.01)
                        << "frame " << frame << ", pixel " << i;
            }
        });
    });
}

// Where upsampling found no neighbour that fits, light is averaged as it comes: nothing around the pixel says
// whether its history still holds.
TEST(Denoiser, HistoryWithoutValidNeighboursIsNotRectified) {
    withFiltersOfAllDevices([](bool cpuFilters) {
        RenderOptions options = filterOptions({"picture=denoised", "antiAlias=off"}, 14);
        options.cpuFilters = cpuFilters;
        options.replaceLit = [&](int frame) {
            return frame < 12 ? evenLight(1.0f) : evenLight(4.0f, frame == 12 ? 0.5f : 1.0f);
        };
        renderScene(litStage(), options, [&](int frame, const FrameTargets& t) {
            for (std::size_t i = 0; i < t.pixels() && frame >= 12; ++i) {
                if (!t.surface(i).seen) continue;
                for (const char* name : {"historyDiffuse", "historySpecular"}) {
                    const double light = luminanceOf(t.rgb(name, i));
                    if (frame == 13) {
                        ASSERT_GT(light, 3.0) << name << ": moved by samples that have neighbours";
                        continue;
                    }
                    ASSERT_NEAR(light, 1.0 + 3.0 / 11.0, 0.01) << name << ": the mean of 11 frames";
                    ASSERT_EQ(t.floats(name).pixels[4 * i + 3], 11.0f) << name;
                }
            }
        });
    });
}

} // namespace
} // namespace kilolux::test
