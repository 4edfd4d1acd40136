// White noise by hash, as the references draw points on lights: over a region of the picture and many frames
// its errors are those of independent numbers. Neighbours, frames and lights only differ in a few bits of the
// seed.
#include "renderer/lights_cpp/lights_f32.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>

namespace kilolux::test {
namespace {

using uint = std::uint32_t;

constexpr int kStatistics = 4;

// Sums over 16 x 16 pixels and 64 frames, each of numbers with mean 0 and deviation 1: both coordinates,
// their product, and a corner of the square.
std::array<double, kStatistics> regionSums(uint left, uint top, uint slot, uint seed) {
    std::array<double, kStatistics> sums{};
    for (uint i = 0; i < 16u * 16u * 64u; ++i) {
        const uint x = left + i % 16u, y = top + i / 16u % 16u, frame = i / 256u;
        const uint light = f32::hashCombine(f32::pixelSeed({x, y}, frame, seed), slot * 16u);
        const auto point = f32::whiteNoise2(light, 0u);
        const double u = std::sqrt(12.0) * (double(point.x) - 0.5),
                     v = std::sqrt(12.0) * (double(point.y) - 0.5);
        const bool corner = point.x < 0.25f && point.y < 0.25f;
        const std::array<double, kStatistics> values{
            u, v, u * v, ((corner ? 1.0 : 0.0) - 0.0625) / std::sqrt(0.0625 * 0.9375)};
        for (std::size_t k = 0; k < kStatistics; ++k)
            sums[k] += values[k];
    }
    return sums;
}

TEST(WhiteNoise, RegionsOverFramesAreIndependent) {
    constexpr uint kColumns = 20, kRows = 12;
    std::array<double, kStatistics> square{}, worst{};
    double regions = 0.0;
    for (uint i = 0; i < kColumns * kRows; ++i, regions += 1.0) {
        const auto sums = regionSums(i % kColumns * 16u, i / kColumns * 16u, i % 7u, i % 3u);
        for (std::size_t k = 0; k < kStatistics; ++k) {
            const double deviations = sums[k] / std::sqrt(16.0 * 16.0 * 64.0);
            square[k] += deviations * deviations;
            worst[k] = std::max(worst[k], std::abs(deviations));
        }
    }
    for (std::size_t k = 0; k < kStatistics; ++k) {
        // The mean of 240 squares is 1 within 0.09 (one sigma); the worst of them is about 2.9.
        EXPECT_NEAR(square[k] / regions, 1.0, 0.3) << "statistic " << k;
        EXPECT_LT(worst[k], 4.5) << "statistic " << k;
    }
}

} // namespace
} // namespace kilolux::test
