// The noise contract of the estimator: masks repeat, means do not. Frequencies of unlikely lights,
// convergence past the cycle of the mask, seeds, and the bits that long lists use up.
#include "tests/unit/noise/noise_kit.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <random>

namespace kilolux::test {
namespace {

constexpr uint kSize = NoiseMask::kWidth;

// 256 x 256 pixels in 16 frames: 1,048,576 numbers. White noise would be off by 3 % (one sigma).
TEST(NoiseContract, UnlikelyLightsGetTheirShareOfAMillionPixels) {
    constexpr double kProbability = 0.001;
    std::mt19937 random(9);
    std::uniform_real_distribution<double> uniform;
    double worst = 0.0, worstFrame = 0.0;
    for (int place = 0; place < 100; ++place) {
        const double start = place == 0   ? 0.0
                             : place == 1 ? 1.0 - kProbability
                                          : uniform(random) * (1.0 - kProbability);
        const uint firstFrame = static_cast<uint>(place) * 37u, channel = place % 2u;
        double whole = 0.0;
        for (uint frame = 0; frame < 16; ++frame) {
            uint hits = 0;
            for (uint i = 0; i < 256 * 256; ++i) {
                const float number =
                    pixelNoise(NoiseMode::Blue, i % 256, i / 256, firstFrame + frame, 3).numbers[channel];
                hits += number >= start && number < start + kProbability ? 1 : 0;
            }
            whole += hits;
            worstFrame = std::max(worstFrame, std::abs(hits / (65536.0 * kProbability) - 1.0));
        }
        worst = std::max(worst, std::abs(whole / (16 * 65536.0 * kProbability) - 1.0));
    }
    std::printf("probability 0.001: wrong by at most %.2f %% over 16 frames, %.1f %% in one\n", 100.0 * worst,
                100.0 * worstFrame);
    EXPECT_LT(worst, 0.05);
}

// The same through a list of 64 lights, the unlikely one last, first or in the middle.
TEST(NoiseContract, UnlikelyLightsOfAList) {
    for (uint rare : {0u, 31u, 63u}) {
        double hits = 0.0;
        for (uint frame = 0; frame < 32; ++frame)
            for (uint i = 0; i < 182 * 182; ++i) {
                f32::Reservoir reservoir =
                    f32::emptyReservoir(pixelNoise(NoiseMode::Blue, i % 182, i / 182, frame).numbers.x);
                float before = 0.0f;
                for (uint light = 0; light < 64; ++light) {
                    const float weight = light == rare ? 63.0f / 999.0f : 1.0f;
                    f32::reservoirAdd(reservoir, before, light, weight, 1.0f);
                    before += weight;
                }
                hits += reservoir.item == rare ? 1.0 : 0.0;
            }
        EXPECT_NEAR(hits / (182.0 * 182.0 * 32.0), 0.001, 0.00005) << "light " << rare;
    }
}

double rootMeanSquare(const std::vector<double>& means, double truth, double count) {
    double sum = 0.0;
    for (double mean : means)
        sum += (mean / count - truth) * (mean / count - truth);
    return std::sqrt(sum / static_cast<double>(means.size()));
}

// Without the shift of the tile every pixel would repeat its 32 values for ever, and its error would stay.
TEST(NoiseContract, PixelsConvergePastTheCycle) {
    const auto hit = [](const f32::PixelNoise& noise) {
        return noise.numbers.x < 0.3f && noise.point.x + noise.point.y < 1.0f ? 1.0 : 0.0;
    };
    std::vector<double> sums(32 * 32);
    std::map<uint, double> errors;
    for (uint frame = 0; frame < 256 * 32; ++frame) {
        for (uint i = 0; i < sums.size(); ++i)
            sums[i] += hit(pixelNoise(NoiseMode::Blue, i % 32, i / 32, frame));
        const uint cycles = (frame + 1) / 32;
        if ((frame + 1) % 32 == 0 && (cycles & (cycles - 1)) == 0)
            errors[cycles] = rootMeanSquare(sums, 0.15, frame + 1.0);
    }
    std::printf("error of a pixel's mean after n cycles of 32 frames:");
    for (const auto& [cycles, error] : errors)
        std::printf(" %u:%.5f", cycles, error);
    std::printf("\n");
    for (uint cycles : {4u, 16u, 64u, 256u}) {
        const double ideal = errors[1] / std::sqrt(static_cast<double>(cycles));
        EXPECT_LT(errors[cycles], 1.25 * ideal) << cycles;
        EXPECT_LT(errors[cycles], std::sqrt(0.15 * 0.85 / (32.0 * cycles))) << "white noise, " << cycles;
    }
}

// A tile holds 131,072 combinations of its four values. The mean of what depends on all of them is wrong by 1
// over the root of that, for ever, unless cycles make new combinations.
TEST(NoiseContract, CombinationsOfValuesAreNewInEveryCycle) {
    double sum = 0.0, first = 0.0, squares = 0.0;
    constexpr int kCycles = 64;
    for (int cycle = 0; cycle < kCycles; ++cycle) {
        double tile = 0.0;
        for (uint frame = 0; frame < 32; ++frame)
            for (uint i = 0; i < kSize * kSize; ++i) {
                const f32::PixelNoise noise =
                    pixelNoise(NoiseMode::Blue, i % kSize, i / kSize, cycle * 32 + frame);
                // Variance 1, and 0 on average over any single value.
                tile += 12.0 * (noise.numbers.x - 0.5) * (noise.point.x - 0.5) +
                        12.0 * (noise.numbers.y - 0.5) * (noise.point.y - 0.5);
            }
        tile /= 32.0 * kSize * kSize;
        if (cycle == 0) first = tile;
        sum += tile / kCycles;
        squares += tile * tile / kCycles;
    }
    std::printf("mean of products: %.6f in the first cycle, %.6f over %d, which differ by %.6f\n", first, sum,
                kCycles, std::sqrt(squares - sum * sum));
    EXPECT_LT(std::abs(sum), 0.4 * std::sqrt(squares));
}

TEST(NoiseContract, SeedsGiveOtherNumbers) {
    const uint seeds = 12;
    for (uint a = 0; a < seeds; ++a)
        for (uint b = a + 1; b < seeds; ++b)
            for (uint frame : {0u, 40u}) {
                double product = 0.0;
                for (uint i = 0; i < kSize * kSize; ++i)
                    product += 12.0 *
                               (pixelNoise(NoiseMode::Blue, i % kSize, i / kSize, frame, a).numbers.x - 0.5) *
                               (pixelNoise(NoiseMode::Blue, i % kSize, i / kSize, frame, b).numbers.x - 0.5);
                EXPECT_LT(std::abs(product / (kSize * kSize)), 0.08) << "seeds " << a << ", " << b;
            }
}

TEST(NoiseContract, SameFrameAndSeedGiveTheSame) {
    for (NoiseMode mode : {NoiseMode::Blue, NoiseMode::White}) {
        const f32::PixelNoise a = pixelNoise(mode, 100, 50, 7, 3), b = pixelNoise(mode, 100, 50, 7, 3);
        EXPECT_EQ(a.numbers, b.numbers);
        EXPECT_EQ(a.point, b.point);
        const f32::PixelNoise other = pixelNoise(mode, 100, 50, 7, 4);
        EXPECT_NE(a.numbers, other.numbers);
        EXPECT_NE(a.point, other.point);
    }
}

TEST(NoiseContract, NumbersStayBelowOne) {
    for (uint frame = 0; frame < 64; ++frame)
        for (uint i = 0; i < kSize * kSize; ++i)
            for (NoiseMode mode : {NoiseMode::Blue, NoiseMode::White}) {
                const f32::PixelNoise noise = pixelNoise(mode, i % kSize, i / kSize, frame);
                for (float number :
                     {noise.numbers.x, noise.numbers.y, noise.numbers.z, noise.point.x, noise.point.y})
                    ASSERT_TRUE(number >= 0.0f && number < 1.0f);
            }
}

// Bits lost: log2 of how many fewer rests tell an item's pixels apart than it has pixels. Over one cycle of
// the mask, lists of equal and of unlike weights.
TEST(NoiseContract, BitsLostUpToTheLongestList) {
    for (bool equal : {true, false})
        for (uint count : {4u, 16u, 64u, 256u}) {
            std::mt19937 random(count);
            std::uniform_real_distribution<float> exponent(-3.0f, 1.0f);
            std::vector<float> weights(count, 1.0f);
            for (float& weight : weights)
                weight = equal ? 1.0f : std::pow(10.0f, exponent(random));
            std::map<uint, std::vector<float>> rests;
            for (uint frame = 0; frame < 32; ++frame)
                for (uint i = 0; i < kSize * kSize; ++i) {
                    f32::Reservoir reservoir = f32::emptyReservoir(
                        pixelNoise(NoiseMode::Blue, i % kSize, i / kSize, frame).numbers.x);
                    float before = 0.0f;
                    for (uint light = 0; light < count; ++light) {
                        f32::reservoirAdd(reservoir, before, light, weights[light], 1.0f);
                        before += weights[light];
                    }
                    rests[reservoir.item].push_back(reservoir.number);
                }
            double lost = 0.0;
            for (auto& [light, numbers] : rests) {
                std::sort(numbers.begin(), numbers.end());
                const auto distinct = std::unique(numbers.begin(), numbers.end()) - numbers.begin();
                if (numbers.size() >= 128)
                    lost = std::max(
                        lost, std::log2(static_cast<double>(numbers.size()) / static_cast<double>(distinct)));
            }
            std::printf("%u %s lights: at most %.4f bits lost of a rest\n", count, equal ? "equal" : "unlike",
                        lost);
            EXPECT_LT(lost, 0.05);
        }
}

} // namespace
} // namespace kilolux::test
