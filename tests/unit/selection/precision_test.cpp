// What rounding and long lists cost: the float build over every 16-bit number and over 24-bit ones, against
// the definition, for up to 256 lights. Bits lost: log2 of how many numbers fewer than the ideal an item is
// told apart by afterwards.
#include "tests/unit/selection/selection_kit.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <set>

namespace kilolux::test {
namespace {

std::vector<float> weightsOf(uint count, bool equal) {
    std::mt19937 random(count);
    std::uniform_real_distribution<float> exponent(-3.0f, 1.0f);
    std::vector<float> weights(count, 1.0f);
    for (float& weight : weights)
        weight = equal ? 1.0f : std::pow(10.0f, exponent(random));
    return weights;
}

struct Statistics {
    double worstCountError = 0.0; // of an item, in numbers
    double worstShareError = 0.0; // relative, among items of probability 1/1024 and more
    double worstBitsLost = 0.0;   // beyond log2(1 / probability), among the same
    uint outside = 0;             // rests out of [0, 1)
};

// Inputs are the multiples of 2^-bits, every `step`-th.
Statistics measure(const std::vector<float>& weights, uint bits, uint step) {
    std::vector<double> counts(weights.size());
    std::vector<std::vector<float>> rests(weights.size());
    const uint inputs = (1u << bits) / step;
    Statistics result;
    for (uint i = 0; i < inputs; ++i) {
        f32::Reservoir r = f32::emptyReservoir(static_cast<float>(i * step) / static_cast<float>(1u << bits));
        float sum = 0.0f;
        for (uint item = 0; item < weights.size(); ++item) {
            f32::reservoirAdd(r, sum, item, weights[item], 1.0f);
            sum += weights[item];
        }
        counts[r.item] += 1.0;
        rests[r.item].push_back(r.number);
        result.outside += r.number >= 0.0f && r.number < 1.0f ? 0 : 1;
    }
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (uint item = 0; item < weights.size(); ++item) {
        const double ideal = weights[item] / sum * inputs;
        result.worstCountError = std::max(result.worstCountError, std::abs(counts[item] - ideal));
        if (weights[item] / sum < 1.0 / 1024.0) continue;
        result.worstShareError = std::max(result.worstShareError, std::abs(counts[item] / ideal - 1.0));
        std::sort(rests[item].begin(), rests[item].end());
        const auto distinct = std::unique(rests[item].begin(), rests[item].end()) - rests[item].begin();
        result.worstBitsLost = std::max(result.worstBitsLost, std::log2(ideal / double(distinct)));
    }
    return result;
}

void report(const char* name, const Statistics& s) {
    testing::Test::RecordProperty(name, "counts off by " + std::to_string(s.worstCountError) +
                                            ", shares by " + std::to_string(s.worstShareError) +
                                            ", bits lost " + std::to_string(s.worstBitsLost));
}

TEST(Precision, SixteenBitNumbers) {
    for (const uint count : {4u, 16u, 64u, 256u})
        for (const bool equal : {true, false}) {
            const Statistics s = measure(weightsOf(count, equal), 16, 1);
            report((std::to_string(count) + (equal ? " equal, 16 bits" : " random, 16 bits")).c_str(), s);
            EXPECT_EQ(s.outside, 0u);
            EXPECT_LT(s.worstCountError, 2.0 + count / 12.0) << count;
            EXPECT_LT(s.worstBitsLost, 0.2) << count;
        }
}

TEST(Precision, TwentyFourBitNumbers) {
    for (const uint count : {16u, 256u})
        for (const bool equal : {true, false}) {
            const Statistics s = measure(weightsOf(count, equal), 24, 37);
            report((std::to_string(count) + (equal ? " equal, 24 bits" : " random, 24 bits")).c_str(), s);
            EXPECT_EQ(s.outside, 0u);
            EXPECT_LT(s.worstCountError, 2.0 + count / 12.0) << count;
            EXPECT_LT(s.worstBitsLost, 0.03) << count;
            EXPECT_LT(s.worstShareError, 0.02) << count;
        }
}

// The choice that the reports' probabilities belong to is the one that double arithmetic makes.
TEST(Precision, FloatChoosesAsDouble) {
    const std::vector<float> weights = weightsOf(256, false);
    uint different = 0;
    const uint inputs = 40000;
    for (uint i = 0; i < inputs; ++i) {
        const float number = static_cast<float>((i + 0.5) / inputs);
        f32::Reservoir r = f32::emptyReservoir(number);
        f64::Reservoir exact = f64::emptyReservoir(number);
        float sum = 0.0f;
        double exactSum = 0.0;
        for (uint item = 0; item < weights.size(); ++item) {
            f32::reservoirAdd(r, sum, item, weights[item], 1.0f);
            f64::reservoirAdd(exact, exactSum, item, weights[item], 1.0);
            sum += weights[item];
            exactSum += weights[item];
        }
        different += r.item == exact.item ? 0 : 1;
    }
    EXPECT_LT(different, inputs / 500);
}

// No rounding, however hard the weights, may lead to an infinite or missing contribution.
TEST(Precision, HardWeightsStayFinite) {
    const float hard[] = {0.0f, 1e-45f, 1e-38f, 1e-20f, 1e-12f, 1e-6f, 1.0f, 1e3f, 1e6f, 1e38f};
    std::mt19937 random(9);
    const f32::SelectionBudget budget = {0.2f, 0.0f, 0.8f, 0.05f, 0.5f, 0.05f, 0.5f};
    for (int round = 0; round < 20000; ++round) {
        const float edge = round % 3 == 0 ? 0.0f : 0.99999994f;
        const f32::vec3 numbers =
            round % 2 ? f32::vec3(edge) : f32::vec3(f32::whiteNoise1(uint(round), 1), edge, edge);
        f32::LightSelection s = f32::beginSelection(numbers, 2);
        bool any = false;
        for (uint i = 0; i < 12; ++i) {
            const f32::Candidate c =
                f32::makeCandidate(i, uint(random() % 3), hard[random() % 10], 4, 0.0f, f32::DIM_KEEP, 0.5f);
            any = any || c.weight >= 1e-20f;
            f32::selectionAdd(s, c);
        }
        for (uint k = 0; k < 2; ++k) {
            const f32::LightChoice c = f32::selectionSample(s, budget, k);
            ASSERT_TRUE(std::isfinite(c.contribution) && std::isfinite(c.probability));
            ASSERT_TRUE(c.probability >= 0.0f && c.probability <= 1.00001f) << c.probability;
            ASSERT_EQ(c.item != f32::KX_NO_ITEM, any);
            ASSERT_TRUE(c.number >= 0.0f && c.number < 1.0f);
        }
    }
}

} // namespace
} // namespace kilolux::test
