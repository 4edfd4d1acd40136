// Perceptual weights, the threshold for dim ones, strides through a cell.
#include "tests/unit/selection/selection_kit.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace kilolux::test {
namespace {

TEST(PerceptualWeight, IsLog2Of1PlusXEverywhere) {
    for (double exponent = -19.9; exponent < 30.0; exponent += 0.013) {
        const float x = static_cast<float>(std::pow(10.0, exponent));
        const double expected = std::log1p(static_cast<double>(x)) / std::log(2.0);
        EXPECT_NEAR(f32::perceptualWeight(x, 1.0f) / expected, 1.0, 1e-5) << x;
        EXPECT_NEAR(f32::luminanceFromWeight(f32::perceptualWeight(x, 1.0f)) / x, 1.0, 2e-5) << x;
    }
}

TEST(PerceptualWeight, PositiveForAllThatShines) {
    EXPECT_GT(f32::perceptualWeight(1e-38f, 1.0f), 0.0f);
    EXPECT_GT(f32::perceptualWeight(1e-10f, 1e-5f), 0.0f);
    EXPECT_EQ(f32::perceptualWeight(0.0f, 1.0f), 0.0f);
    EXPECT_EQ(f32::perceptualWeight(-1.0f, 1.0f), 0.0f);
    EXPECT_EQ(f32::perceptualWeight(std::nanf(""), 1.0f), 0.0f);
    const float infinite = f32::perceptualWeight(std::numeric_limits<float>::infinity(), 1.0f);
    EXPECT_NEAR(infinite, 99.66f, 0.01f);
}

TEST(PerceptualWeight, IsPreExposed) {
    EXPECT_NEAR(f64::perceptualWeight(3000.0, 1e-3), 2.0, 1e-12);
    EXPECT_EQ(f64::perceptualWeight(12.0, 0.25), f64::perceptualWeight(3.0, 1.0));
}

TEST(PerceptualWeight, GrowsWithoutAStep) {
    float last = 0.0f;
    for (float x = 0.05f; x < 0.08f; x += 1e-6f) {
        const float weight = f32::perceptualWeight(x, 1.0f);
        ASSERT_GE(weight, last - 2e-7f) << x;
        last = weight;
    }
}

// Over the roulette's number the mean of weight x factor is the weight, so light and selection are unbiased.
TEST(Threshold, RouletteKeepsTheMean) {
    const double threshold = 0.01;
    for (const uint list : {f64::LIST_VISIBLE, f64::LIST_HIDDEN, f64::LIST_DIRECTIONAL})
        for (const double weight : {1e-9, 0.0001, 0.003, 0.009, 0.01, 0.5}) {
            double meanFactor = 0.0;
            double meanWeight = 0.0;
            const uint steps = 100000;
            for (uint i = 0; i < steps; ++i) {
                const f64::Candidate c =
                    f64::makeCandidate(7, list, weight, 3, threshold, f64::DIM_ROULETTE, (i + 0.5) / steps);
                EXPECT_TRUE(c.weight == 0.0 || c.weight >= threshold);
                EXPECT_EQ(c.weight == 0.0, c.factor == 0.0);
                meanFactor += c.factor / steps;
                meanWeight += c.weight / steps;
            }
            const double stride = list == f64::LIST_HIDDEN ? 3.0 : 1.0;
            const double resolution = stride * std::max(threshold / weight, 1.0) / steps;
            EXPECT_NEAR(meanFactor, stride, resolution) << weight;
            EXPECT_NEAR(meanWeight, weight * stride, resolution * weight + 1e-12) << weight;
        }
}

TEST(Threshold, DropLosesWhatItSays) {
    const double threshold = 0.01;
    double given = 0.0, left = 0.0, lost = 0.0;
    for (uint i = 0; i < 100; ++i) {
        const double light = 2e-4 * i;
        const double weight = f64::perceptualWeight(light, 1.0);
        const f64::Candidate c =
            f64::makeCandidate(i, f64::LIST_VISIBLE, weight, 1, threshold, f64::DIM_DROP, 0.0);
        EXPECT_EQ(c.weight, weight < threshold ? 0.0 : weight);
        given += light;
        left += light * c.factor;
        lost += f64::hardDropLoss(light, weight, threshold);
    }
    EXPECT_NEAR(left + lost, given, 1e-12);
    EXPECT_GT(lost, 0.0);
    const f64::Candidate kept =
        f64::makeCandidate(0, f64::LIST_VISIBLE, 1e-6, 1, threshold, f64::DIM_KEEP, 0.9);
    EXPECT_EQ(kept.weight, 1e-6);
    EXPECT_EQ(kept.factor, 1.0);
}

// 1,000 lights at 0.9 of the threshold: the roulette keeps their energy, in the float build as well.
TEST(Threshold, DimCrowdKeepsItsEnergy) {
    double energy = 0.0;
    const uint pixels = 200;
    for (uint pixel = 0; pixel < pixels; ++pixel)
        for (uint light = 0; light < 1000; ++light)
            energy += f32::makeCandidate(light, f32::LIST_HIDDEN, 0.009f, 1, 0.01f, f32::DIM_ROULETTE,
                                         f32::whiteNoise1(f32::hashUint(pixel), light))
                          .factor;
    EXPECT_NEAR(energy / (1000.0 * pixels), 1.0, 0.005);
}

TEST(Stride, FitsTheBudgetAndReachesEveryLight) {
    EXPECT_EQ(f64::cellStride(0, 16), 1u);
    EXPECT_EQ(f64::cellStride(16, 16), 1u);
    EXPECT_EQ(f64::cellStride(17, 16), 2u);
    EXPECT_EQ(f64::cellStride(200, 16), 13u);
    EXPECT_EQ(f64::cellStride(200, 0), 200u);
    for (uint stride = 1; stride < 20; ++stride) {
        std::vector<uint> counts(stride);
        for (uint i = 0; i < 5000 * stride; ++i)
            ++counts[f64::cellOffset((i + 0.5) / (5000.0 * stride), stride)];
        for (const uint count : counts)
            EXPECT_NEAR(count, 5000, 1);
        EXPECT_EQ(f32::cellOffset(std::nextafter(1.0f, 0.0f), stride), stride - 1);
    }
}

} // namespace
} // namespace kilolux::test
