// The optimizer on tiny masks: same seed, same bytes; its sums are those of the definition; and what it
// lowers is the filtered error.
#include "content/make/noise/optimize.h"

#include <cmath>
#include <gtest/gtest.h>
#include <set>

namespace kilolux::test {
namespace {

constexpr NoiseSize kTiny{.width = 16, .height = 16, .layers = 4};

// The energy by its definition, over all pairs: minus half the sum of kernel times distance.
template<typename Value, typename Distance>
double energyOf(const std::vector<Value>& mask, NoiseSize size, const Distance& distance) {
    const NoiseKernel kernel = makeNoiseKernel(renderingFilters(), size.layers);
    double sum = 0.0;
    const auto at = [&](int x, int y, int layer) {
        return mask[layer * size.area() + (y & (size.height - 1)) * size.width + (x & (size.width - 1))];
    };
    for (int layer = 0; layer < size.layers; ++layer)
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                for (int other = 0; other < size.layers; ++other)
                    for (int dy = -4; dy <= 4; ++dy)
                        for (int dx = -4; dx <= 4; ++dx)
                            sum -= 0.5 * kernel.at(dx, dy, (other - layer + size.layers) % size.layers) *
                                   distance(at(x, y, layer), at(x + dx, y + dy, other));
    return sum;
}

double scalarDistance(std::uint16_t a, std::uint16_t b) {
    return std::abs(a - b) / 65536.0;
}

double pointDistance(std::array<std::uint16_t, 2> a, std::array<std::uint16_t, 2> b) {
    return std::hypot(a[0] - b[0], a[1] - b[1]) / 65536.0;
}

TEST(Optimizer, SameSeedSameBytes) {
    const NoiseEffort effort{.proposalsPerPixel = 30, .seed = 7};
    const auto numbers = optimizeScalarMask(kTiny, renderingFilters(), effort);
    EXPECT_EQ(numbers, optimizeScalarMask(kTiny, renderingFilters(), effort));
    const auto points = optimizePointMask(kTiny, renderingFilters(), effort);
    EXPECT_EQ(points, optimizePointMask(kTiny, renderingFilters(), effort));
    const NoiseEffort otherSeed{.proposalsPerPixel = 30, .seed = 8};
    EXPECT_NE(numbers, optimizeScalarMask(kTiny, renderingFilters(), otherSeed));
    EXPECT_NE(points, optimizePointMask(kTiny, renderingFilters(), otherSeed));
}

TEST(Optimizer, LowersTheEnergyByDefinition) {
    const auto numbers = [&](int proposals) {
        return energyOf(optimizeScalarMask(kTiny, renderingFilters(), {proposals, 1}), kTiny, scalarDistance);
    };
    const auto points = [&](int proposals) {
        return energyOf(optimizePointMask(kTiny, renderingFilters(), {proposals, 1}), kTiny, pointDistance);
    };
    // The same bytes on every machine, so the bounds stand close: measured 522 and 58, 628 and 104.
    EXPECT_LT(numbers(10), numbers(0) - 510.0);
    EXPECT_LT(numbers(100), numbers(10) - 54.0);
    EXPECT_LT(points(10), points(0) - 610.0);
    EXPECT_LT(points(100), points(10) - 95.0);
    std::printf("energy after 0, 10, 100 proposals: numbers %.1f %.1f %.1f, points %.1f %.1f %.1f\n",
                numbers(0), numbers(10), numbers(100), points(0), points(10), points(100));
}

TEST(Optimizer, OnlyMovesValuesWithinALayer) {
    const auto before = optimizeScalarMask(kTiny, renderingFilters(), {0, 3});
    const auto after = optimizeScalarMask(kTiny, renderingFilters(), {50, 3});
    const auto pointsBefore = optimizePointMask(kTiny, renderingFilters(), {0, 3});
    const auto pointsAfter = optimizePointMask(kTiny, renderingFilters(), {50, 3});
    for (int layer = 0; layer < kTiny.layers; ++layer) {
        const auto valuesOf = [&](const auto& mask) {
            return std::multiset(mask.begin() + layer * kTiny.area(),
                                 mask.begin() + (layer + 1) * kTiny.area());
        };
        EXPECT_EQ(valuesOf(before), valuesOf(after));
        EXPECT_EQ(valuesOf(pointsBefore), valuesOf(pointsAfter));
    }
}

// White noise has each filter's weight as its error: the kernel at the origin.
TEST(FilterKernel, IsTheAutocorrelationOfTheFilters) {
    const int layers = 8;
    const NoiseFilter filter{.weight = 2.0, .blurs = true, .alpha = 0.25};
    const NoiseKernel kernel = makeNoiseKernel({filter}, layers);
    const double binomial[5] = {1, 4, 6, 4, 1};
    const auto spatial = [&](int d) {
        double sum = 0.0;
        for (int i = 0; i < 5; ++i)
            if (i + d >= 0 && i + d < 5) sum += binomial[i] * binomial[i + d];
        return sum / 70.0;
    };
    // The exponential mean's response to one frame, every period of the cycle added up.
    const auto response = [&](int age) {
        double sum = 0.0;
        for (int i = age; i < 400; i += layers)
            sum += 0.25 * std::pow(0.75, i);
        return sum;
    };
    const auto temporal = [&](int d) {
        double sum = 0.0, own = 0.0;
        for (int i = 0; i < layers; ++i) {
            sum += response(i) * response((i + d) % layers);
            own += response(i) * response(i);
        }
        return sum / own;
    };
    for (int dy = -4; dy <= 4; ++dy)
        for (int dx = -4; dx <= 4; ++dx)
            for (int d = 0; d < layers; ++d)
                EXPECT_NEAR(kernel.at(dx, dy, d), 2.0 * spatial(dx) * spatial(dy) * temporal(d), 1e-6);
    for (int d = 0; d < layers; ++d)
        EXPECT_EQ(kernel.row(1, 2, 3)[d], kernel.at(1, 2, (d + layers - 3) % layers));
}

} // namespace
} // namespace kilolux::test
