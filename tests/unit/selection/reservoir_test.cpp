// One reservoir with one number: frequencies, what is left of the number, stratification, several samples.
#include "tests/unit/selection/selection_kit.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

namespace kilolux::test {
namespace {

f64::Reservoir choose(const std::vector<double>& weights, double number) {
    f64::Reservoir r = f64::emptyReservoir(number);
    double sum = 0.0;
    for (uint i = 0; i < weights.size(); ++i) {
        f64::reservoirAdd(r, sum, i, weights[i], 1.0);
        sum += weights[i];
    }
    return r;
}

std::vector<double> randomWeights(std::mt19937& random, uint count) {
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::vector<double> weights(count);
    for (double& weight : weights)
        weight = std::pow(uniform(random), 2.0) + 0.02;
    return weights;
}

void expectFrequencies(const std::vector<double>& weights, double tolerance) {
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::map<uint, double> measure = measureByKey([&](double u) { return choose(weights, u).item; }, 16384);
    double total = 0.0;
    for (uint i = 0; i < weights.size(); ++i) {
        EXPECT_NEAR(measure[i], weights[i] / sum, tolerance) << "item " << i << " of " << weights.size();
        total += measure[i];
    }
    EXPECT_NEAR(total, 1.0, 1e-12) << "something that was not offered was chosen";
}

TEST(Reservoir, FrequencyIsWeightOverSum) {
    expectFrequencies({3.0}, 1e-12);
    expectFrequencies({1.0, 3.0}, 1e-9);
    expectFrequencies({3.0, 1.0}, 1e-9);
    expectFrequencies({0.0, 2.0, 0.0, 0.0, 5.0, 0.0}, 1e-9);
    expectFrequencies({1e-9, 1e5, 1e-9}, 1e-9);
    expectFrequencies({1e5, 1e-9, 1e5}, 1e-9);
    expectFrequencies({1.0, 1.0, 1.0, 1.0}, 1e-9);
    std::mt19937 random(1);
    for (uint count = 3; count < 12; ++count)
        expectFrequencies(randomWeights(random, count), 4e-4);
    expectFrequencies(randomWeights(random, 100), 2e-3);
}

TEST(Reservoir, KeepsWhatItHolds) {
    const std::vector<double> weights = {1.0, 4.0, 2.0};
    for (uint i = 0; i < 1000; ++i) {
        const f64::Reservoir r = choose(weights, (i + 0.5) / 1000);
        EXPECT_EQ(r.weight, weights[r.item]);
        EXPECT_EQ(r.before, std::accumulate(weights.begin(), weights.begin() + r.item, 0.0));
    }
}

TEST(Reservoir, NothingToChooseFrom) {
    for (const double weight : {0.0, -1.0, std::nan(""), 1e-21}) {
        const f64::Reservoir r = choose({weight, weight}, 0.25);
        EXPECT_EQ(r.item, f64::KX_NO_ITEM) << weight;
        EXPECT_EQ(r.number, 0.25) << weight;
    }
}

// Over stratified inputs the rest of the number must be as even for each item, and at any place in the list:
// its discrepancy is bounded by the pieces of the item's range, of which there are at most as many as items.
TEST(Reservoir, RestOfTheNumberIsUniform) {
    std::mt19937 random(2);
    for (const uint count : {1u, 2u, 3u, 8u, 16u, 40u}) {
        const std::vector<double> weights = randomWeights(random, count);
        std::vector<std::vector<double>> rests(count);
        const uint inputs = 65536;
        for (uint i = 0; i < inputs; ++i) {
            const f64::Reservoir r = choose(weights, (i + 0.5) / inputs);
            ASSERT_GE(r.number, 0.0);
            ASSERT_LT(r.number, 1.0);
            rests[r.item].push_back(r.number);
        }
        for (std::vector<double>& rest : rests) {
            std::sort(rest.begin(), rest.end());
            double discrepancy = 0.0; // in counts
            for (uint i = 0; i < rest.size(); ++i)
                discrepancy = std::max(discrepancy, std::abs(i + 0.5 - rest[i] * double(rest.size())));
            EXPECT_LT(discrepancy, 1.0 + 0.5 * count) << count << " items, " << rest.size() << " rests";
        }
    }
}

// The range of each item in at most as many pieces as there are items; the plain method has 2^(n - 1) in all.
TEST(Reservoir, RangesStayWhole) {
    const std::vector<double> weights(16, 1.0);
    std::vector<uint> pieces(weights.size());
    uint last = f64::KX_NO_ITEM;
    for (uint i = 0; i < 1u << 20; ++i) {
        const uint item = choose(weights, (i + 0.5) / (1u << 20)).item;
        if (item != last) ++pieces[item];
        last = item;
    }
    EXPECT_LE(*std::max_element(pieces.begin(), pieces.end()), weights.size());
}

// 64 stratified numbers over 4, 8 and 16 items: counts nearer to their expectation than independent numbers
// would bring them. The plain method has 0.07, 0.30 and 0.67; independent numbers have 1.
TEST(Reservoir, StratifiedNumbersGiveEvenCounts) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    const std::map<uint, double> bounds = {{4, 0.08}, {8, 0.22}, {16, 0.47}};
    for (const auto& [count, bound] : bounds) {
        double chiSquare = 0.0;
        const uint trials = 400;
        for (uint trial = 0; trial < trials; ++trial) {
            const std::vector<double> weights = randomWeights(random, count);
            const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
            const double shift = uniform(random);
            std::vector<double> counts(count);
            for (uint i = 0; i < 64; ++i)
                counts[choose(weights, (i + shift) / 64).item] += 1.0;
            for (uint i = 0; i < count; ++i) {
                const double expected = 64.0 * weights[i] / sum;
                chiSquare += (counts[i] - expected) * (counts[i] - expected) / expected;
            }
        }
        const double perDegree = chiSquare / (trials * (count - 1.0));
        RecordProperty("chiSquarePerDegree" + std::to_string(count), std::to_string(perDegree));
        EXPECT_LT(perDegree, bound) << count << " items";
    }
}

TEST(Reservoir, DitheredNumbersTakeOneRangeEach) {
    for (const uint count : {1u, 2u, 3u, 4u, 7u, 16u}) {
        for (uint i = 0; i < 4096; ++i) {
            const double number = (i + 0.5) / 4096;
            std::vector<bool> taken(count);
            for (uint k = 0; k < count; ++k) {
                EXPECT_EQ(std::floor(f64::ditheredNumber(number, k, count) * count), k);
                taken[static_cast<uint>(f64::rotatedNumber(number, k, count) * count)] = true;
            }
            EXPECT_EQ(std::count(taken.begin(), taken.end(), true), count);
        }
        for (uint k = 0; k < count; ++k) {
            EXPECT_LT(f32::ditheredNumber(std::nextafter(1.0f, 0.0f), k, count), 1.0f);
            for (const float number : {0.0f, 0.5f, std::nextafter(1.0f, 0.0f)}) {
                EXPECT_LT(f32::rotatedNumber(number, k, count), 1.0f);
                EXPECT_GE(f32::rotatedNumber(number, k, count), 0.0f);
            }
        }
    }
}

// Points of one pixel are spread in both dimensions, and each of them is uniform by itself.
TEST(Reservoir, RotatedPointsAreSpreadAndUniform) {
    const uint count = 8;
    for (uint i = 0; i < 256; ++i) {
        std::vector<double> xs, ys;
        for (uint k = 0; k < count; ++k) {
            const f64::vec2 point = f64::rotatedPoint({0.37, (i + 0.5) / 256}, k, count);
            xs.push_back(point.x);
            ys.push_back(point.y);
        }
        std::sort(xs.begin(), xs.end());
        std::sort(ys.begin(), ys.end());
        for (uint k = 1; k < count; ++k) {
            EXPECT_NEAR(xs[k] - xs[k - 1], 1.0 / count, 1e-9);
            EXPECT_GT(ys[k] - ys[k - 1], 0.4 / count);
        }
    }
    for (uint k = 0; k < count; ++k) {
        std::vector<uint> binsX(16), binsY(16);
        for (uint i = 0; i < 4096; ++i) {
            const f64::vec2 point = f64::rotatedPoint({(i + 0.5) / 4096, (i + 0.5) / 4096}, k, count);
            ++binsX[static_cast<uint>(point.x * 16.0)];
            ++binsY[static_cast<uint>(point.y * 16.0)];
        }
        for (uint bin = 0; bin < 16; ++bin) {
            EXPECT_NEAR(binsX[bin], 256, 1);
            EXPECT_NEAR(binsY[bin], 256, 1);
        }
    }
}

TEST(Reservoir, SixteenBitsAreContinuedByWhiteOnes) {
    EXPECT_EQ(f32::numberFromNoise16(0, 0), 0.0f);
    EXPECT_LT(f32::numberFromNoise16(0xffff, 0xffffffffu), 1.0f);
    for (const uint noise : {0u, 1u, 12345u, 65535u})
        for (const uint white : {0u, 1u << 24, 0x80000000u, 0xffffffffu}) {
            const double number = f64::numberFromNoise16(noise, white);
            EXPECT_EQ(std::floor(number * 65536.0), noise);
            EXPECT_EQ(std::floor((number * 65536.0 - noise) * 256.0), white >> 24);
        }
}

} // namespace
} // namespace kilolux::test
