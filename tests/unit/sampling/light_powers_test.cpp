// Drawing lights by power: the alias table gives each its share, exactly.
#include "renderer/light_powers.h"

#include <gtest/gtest.h>

namespace kilolux {
namespace {

// What an even choice of an entry, then keep or other, gives each slot.
std::vector<double> sharesOf(const std::vector<shared::LightPower>& table) {
    std::vector<double> shares(table.size());
    for (std::size_t i = 0; i < table.size(); ++i) {
        shares[i] += double(table[i].keep) / double(table.size());
        shares.at(table[i].other) += (1.0 - double(table[i].keep)) / double(table.size());
    }
    return shares;
}

void expectShares(const std::vector<double>& weights) {
    const std::vector<shared::LightPower> table = aliasTable(weights);
    ASSERT_EQ(table.size(), weights.size());
    double sum = 0.0;
    for (const double w : weights)
        sum += w;
    const std::vector<double> shares = sharesOf(table);
    for (std::size_t i = 0; i < weights.size(); ++i) {
        EXPECT_NEAR(shares[i], weights[i] / sum, 1e-6) << i;
        EXPECT_NEAR(double(table[i].probability), weights[i] / sum, 1e-6) << i;
    }
}

TEST(AliasTable, GivesEachItsShare) {
    expectShares({1.0});
    expectShares({1.0, 1.0, 1.0});
    expectShares({0.0, 5.0, 0.0, 1.0});
    expectShares({1e-9, 1e9, 3.0, 7e8, 0.0, 1e-30});
    std::vector<double> many;
    for (int i = 0; i < 1000; ++i)
        many.push_back(double((i * 7919) % 104729));
    expectShares(many);
}

TEST(AliasTable, WithoutPowerAllAreEquallyLikely) {
    for (const shared::LightPower& entry : aliasTable(std::vector<double>(5, 0.0)))
        EXPECT_FLOAT_EQ(entry.probability, 0.2f);
    EXPECT_TRUE(aliasTable({}).empty());
}

TEST(LightPowers, DeadAndMutedOnesHaveNone) {
    using namespace shared;
    std::vector<LightHot> hot(3);
    std::vector<LightCold> cold(3);
    hot[0].typeFlags = LIGHT_SPHERE;
    hot[1].typeFlags = LIGHT_RECT | LIGHT_FLAG_MUTED;
    hot[2].typeFlags = LIGHT_DIRECTIONAL;
    hot[2].intensity = glm::vec3(2.0f);
    cold[0].fluxLm = cold[1].fluxLm = 100.0f;
    const std::vector<double> powers = lightPowers(hot, cold, 4.0);
    EXPECT_DOUBLE_EQ(powers[0], 100.0);
    EXPECT_EQ(powers[1], 0.0);
    EXPECT_NEAR(powers[2], 2.0 * 3.14159265 * 4.0, 1e-4); // 2 lux on a disk of 2 m radius
}

} // namespace
} // namespace kilolux
