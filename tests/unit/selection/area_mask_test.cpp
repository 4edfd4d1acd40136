// The area mask of 4 x 4 cells: shares, density, inverse, continuity, stratification, ends of the range in
// float.
#include "tests/unit/selection/selection_kit.h"

#include <bit>
#include <cmath>
#include <gtest/gtest.h>

namespace kilolux::test {
namespace {

constexpr double kHiddenShare = 0.1;

// The cells of some quarters: bit column + 2 * row.
uint ofQuarters(uint quarters) {
    uint mask = 0;
    for (uint quarter = 0; quarter < 4; ++quarter)
        if ((quarters >> quarter & 1u) != 0) mask |= 0x33u << (quarter % 2 * 2 + quarter / 2 * 8);
    return mask;
}

// All masks of quarters, all of columns, and some others.
std::vector<uint> someMasks() {
    std::vector<uint> masks;
    for (uint bits = 0; bits < 16; ++bits) {
        masks.push_back(ofQuarters(bits));
        masks.push_back(bits * 0x1111u);
    }
    std::mt19937 random(4);
    for (int i = 0; i < 32; ++i)
        masks.push_back(static_cast<uint>(random() & random() & 0xffffu));
    return masks;
}

double shareOf(uint mask, uint cell, double hiddenShare) {
    const f64::vec2 shares = f64::areaMaskShares(mask, hiddenShare);
    return (mask >> cell & 1u) != 0 ? shares.y : shares.x;
}

TEST(AreaMask, SharesAreTheRule) {
    const double visibleByCount[] = {0.25, 0.7, 0.4, 0.3, 0.25};
    for (uint quarters = 0; quarters < 16; ++quarters) {
        const uint count = static_cast<uint>(std::popcount(quarters));
        for (uint cell = 0; cell < 16; ++cell) {
            const bool visible = (ofQuarters(quarters) >> cell & 1u) != 0 || count == 0;
            EXPECT_NEAR(4.0 * shareOf(ofQuarters(quarters), cell, kHiddenShare),
                        visible ? visibleByCount[count] : 0.1, 1e-12)
                << quarters << ", " << cell;
        }
    }
    for (const uint mask : someMasks()) {
        double sum = 0.0;
        for (uint cell = 0; cell < 16; ++cell)
            sum += shareOf(mask, cell, kHiddenShare);
        EXPECT_NEAR(sum, 1.0, 1e-12);
        EXPECT_EQ(f64::areaMaskCount(mask), double(std::popcount(mask)));
        for (const double share : {-1.0, 0.0, 0.001, 0.25, 0.9})
            EXPECT_GT(f64::areaMaskShares(mask, share).x, 0.0002);
    }
}

TEST(AreaMask, QuartersAndColumnsAreThoseOfTheCells) {
    for (uint cell = 0; cell < 16; ++cell) {
        const uint column = cell % 4, row = cell / 4;
        EXPECT_EQ(f64::areaMaskCell({(column + 0.5) / 4, (row + 0.5) / 4}), cell);
        EXPECT_EQ(f64::areaMaskQuarters(1u << cell), ofQuarters(1u << (column / 2 + row / 2 * 2)));
        EXPECT_EQ(f64::areaMaskColumns(1u << cell), 0x1111u << column);
    }
    for (const uint mask : someMasks()) {
        uint quarters = 0, columns = 0;
        for (uint cell = 0; cell < 16; ++cell) {
            quarters |= (mask >> cell & 1u) != 0 ? f64::areaMaskQuarters(1u << cell) : 0u;
            columns |= (mask >> cell & 1u) != 0 ? f64::areaMaskColumns(1u << cell) : 0u;
        }
        EXPECT_EQ(f64::areaMaskQuarters(mask), quarters);
        EXPECT_EQ(f64::areaMaskColumns(mask), columns);
    }
}

// Each cell gets its share of the square, at the reported density, with no pattern left out or doubled.
TEST(AreaMask, CellsGetTheirShareAtTheirDensity) {
    const int grid = 400;
    for (const uint mask : someMasks()) {
        double counts[16] = {};
        double inverseDensity = 0.0;
        double moment = 0.0; // of x + 2 y^2 over the square: 1/2 + 2/3
        for (int y = 0; y < grid; ++y)
            for (int x = 0; x < grid; ++x) {
                const f64::vec2 number((x + 0.5) / grid, (y + 0.5) / grid);
                const f64::MaskedPoint p = f64::areaMaskWarp(number, mask, kHiddenShare);
                const uint cell = f64::areaMaskCell(p.uv);
                counts[cell] += 1.0 / (grid * grid);
                EXPECT_NEAR(p.pdf, 16.0 * shareOf(mask, cell, kHiddenShare), 1e-12);
                EXPECT_EQ(p.pdf, f64::areaMaskPdf(p.uv, mask, kHiddenShare));
                inverseDensity += 1.0 / p.pdf / (grid * grid);
                moment += (p.uv.x + 2.0 * p.uv.y * p.uv.y) / p.pdf / (grid * grid);
            }
        for (uint cell = 0; cell < 16; ++cell)
            EXPECT_NEAR(counts[cell], shareOf(mask, cell, kHiddenShare), 2.0 / grid) << mask;
        EXPECT_NEAR(inverseDensity, 1.0, 0.01) << mask;
        EXPECT_NEAR(moment, 0.5 + 2.0 / 3.0, 0.01) << mask;
    }
}

// The map is continuous in a cell and its Jacobian is 1 / density.
TEST(AreaMask, ContinuousWithTheDensityAsJacobian) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    const double step = 1e-6;
    const std::vector<uint> masks = someMasks();
    for (std::size_t i = 0; i < 20000; ++i) {
        const uint mask = masks[i % masks.size()];
        const f64::vec2 number(uniform(random) * 0.999, uniform(random) * 0.999);
        const f64::MaskedPoint p = f64::areaMaskWarp(number, mask, kHiddenShare);
        const f64::MaskedPoint px = f64::areaMaskWarp(number + f64::vec2(step, 0.0), mask, kHiddenShare);
        const f64::MaskedPoint py = f64::areaMaskWarp(number + f64::vec2(0.0, step), mask, kHiddenShare);
        const uint cell = f64::areaMaskCell(p.uv);
        if (f64::areaMaskCell(px.uv) != cell || f64::areaMaskCell(py.uv) != cell) continue;
        const f64::vec2 dx = (px.uv - p.uv) / step;
        const f64::vec2 dy = (py.uv - p.uv) / step;
        EXPECT_NEAR((dx.x * dy.y - dx.y * dy.x) * p.pdf, 1.0, 1e-5);
        EXPECT_LT(std::abs(dx.x) + std::abs(dy.y), 11.0);
        EXPECT_GT(dx.x, 0.0);
        EXPECT_GT(dy.y, 0.0);
    }
}

TEST(AreaMask, InverseOfTheWarp) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> uniform(0.0, 0.9999);
    const std::vector<uint> masks = someMasks();
    for (std::size_t i = 0; i < 20000; ++i) {
        const uint mask = masks[i % masks.size()];
        const f64::vec2 number(uniform(random), uniform(random));
        const f64::MaskedPoint p = f64::areaMaskWarp(number, mask, kHiddenShare);
        const f64::vec2 back = f64::areaMaskUnwarp(p.uv, mask, kHiddenShare);
        EXPECT_NEAR(back.x, number.x, 2e-7); // the halves end a float's width early
        EXPECT_NEAR(back.y, number.y, 2e-7);
        const f64::vec2 forth =
            f64::areaMaskWarp(f64::areaMaskUnwarp(number, mask, kHiddenShare), mask, kHiddenShare).uv;
        EXPECT_NEAR(forth.x, number.x, 1e-6);
        EXPECT_NEAR(forth.y, number.y, 1e-6);
    }
}

// 64 x 64 stratified numbers: any box inside a cell holds its expected count but for the strata its edges
// cut, which independent points would miss by the square root of the count.
TEST(AreaMask, StratificationIsKept) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    const int strata = 64;
    for (const uint mask : someMasks()) {
        std::vector<f64::vec2> points;
        for (int y = 0; y < strata; ++y)
            for (int x = 0; x < strata; ++x)
                points.push_back(
                    f64::areaMaskWarp({(x + uniform(random)) / strata, (y + uniform(random)) / strata}, mask,
                                      kHiddenShare)
                        .uv);
        for (int box = 0; box < 16; ++box) {
            const f64::vec2 low(box % 4 * 0.25, box / 4 * 0.25);
            const double expected =
                f64::areaMaskPdf(low + 0.125, mask, kHiddenShare) / 16.0 * strata * strata;
            double count = 0.0;
            for (const f64::vec2& p : points)
                count += p.x >= low.x && p.x < low.x + 0.25 && p.y >= low.y && p.y < low.y + 0.25 ? 1.0 : 0.0;
            // Edges of a box cut at most 4 sqrt(expected) strata of variance 1/4 each.
            EXPECT_LT(std::abs(count - expected), 4.0 * std::sqrt(std::sqrt(expected)))
                << mask << ", " << box;
        }
    }
}

TEST(AreaMask, EndsOfTheRangeInFloat) {
    for (const uint mask : someMasks())
        for (const float hidden : {0.0f, 0.1f, 0.2f, 0.25f}) {
            const f32::vec2 shares = f32::areaMaskShares(mask, hidden);
            const float lower = f32::areaMaskCount(mask & 255u) * (shares.y - shares.x) + 8.0f * shares.x;
            std::vector<float> edges = {0.0f,
                                        0.1f,
                                        0.25f,
                                        0.3f,
                                        0.5f,
                                        0.7f,
                                        0.8f,
                                        1.0f,
                                        lower,
                                        shares.x / (shares.x + shares.y),
                                        shares.y / (shares.x + shares.y)};
            std::vector<float> values;
            for (const float edge : edges)
                for (const float value : {std::nextafter(edge, 0.0f), edge, std::nextafter(edge, 1.0f)})
                    if (value >= 0.0f && value < 1.0f) values.push_back(value);
            for (const float y : values)
                for (const float x : values) {
                    const f32::MaskedPoint p = f32::areaMaskWarp({x, y}, mask, hidden);
                    ASSERT_TRUE(p.uv.x >= 0.0f && p.uv.x < 1.0f && p.uv.y >= 0.0f && p.uv.y < 1.0f);
                    const bool visible = (mask >> f32::areaMaskCell(p.uv) & 1u) != 0;
                    ASSERT_EQ(p.pdf, 16.0f * (visible ? shares.y : shares.x));
                    ASSERT_EQ(p.pdf, f32::areaMaskPdf(p.uv, mask, hidden));
                    const f32::vec2 back = f32::areaMaskUnwarp(p.uv, mask, hidden);
                    ASSERT_TRUE(back.x >= 0.0f && back.x < 1.0f && back.y >= 0.0f && back.y < 1.0f);
                    ASSERT_NEAR(back.x, x, 4e-7f);
                    ASSERT_NEAR(back.y, y, 4e-7f);
                }
        }
}

} // namespace
} // namespace kilolux::test
