// Student's t against its table, and the equivalence test on replicas whose mean is known.
#include "renderer/measure/equivalence.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <vector>

namespace kilolux::measure {
namespace {

std::vector<double> replicas(double mean, double deviation, int count, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(mean, deviation);
    std::vector<double> values;
    for (int i = 0; i < count; ++i)
        values.push_back(normal(random));
    return values;
}

TEST(Student, MatchesTheTable) {
    EXPECT_NEAR(studentQuantile(0.95, 1), 6.313751515, 1e-8);
    EXPECT_NEAR(studentQuantile(0.975, 5), 2.570581836, 1e-8);
    EXPECT_NEAR(studentQuantile(0.95, 31), 1.695518783, 1e-8);
    EXPECT_NEAR(studentQuantile(0.995, 100), 2.625890521, 1e-8);
    EXPECT_NEAR(studentQuantile(0.05, 31), -1.695518783, 1e-8);
    EXPECT_NEAR(studentQuantile(0.5, 7), 0.0, 1e-6);
    EXPECT_NEAR(studentQuantile(0.975, 1e7), 1.959964, 1e-5);
}

TEST(Equivalence, MeanAndErrorByHand) {
    const std::vector<double> values = {1.0, 2.0, 3.0, 6.0};
    const ReplicaMean mean = replicaMean(values);
    EXPECT_EQ(mean.count, 4);
    EXPECT_DOUBLE_EQ(mean.mean, 3.0);
    EXPECT_NEAR(mean.standardError, std::sqrt(14.0 / 3.0 / 4.0), 1e-12);
    EXPECT_EQ(replicaMean({}).count, 0);
}

TEST(Equivalence, AcceptsTheTruthAndSeesOnePercent) {
    const auto good = replicas(5.0, 0.03, 64, 1);
    const Equivalence accepted = testEquivalence(good, 5.0, 0.005);
    EXPECT_TRUE(accepted.equivalent);
    EXPECT_LT(std::abs(accepted.relativeDifference), 0.005);
    const auto biased = replicas(5.05, 0.03, 64, 2);
    const Equivalence refused = testEquivalence(biased, 5.0, 0.005);
    EXPECT_FALSE(refused.equivalent);
    EXPECT_TRUE(refused.different);
    EXPECT_NEAR(refused.relativeDifference, 0.01, 0.003);
}

TEST(Equivalence, NoiseProvesNothing) {
    const Equivalence noisy = testEquivalence(replicas(5.0, 2.0, 64, 3), 5.0, 0.005);
    EXPECT_FALSE(noisy.equivalent);
    EXPECT_FALSE(testEquivalence(replicas(5.0, 1e-6, 31, 4), 5.0, 0.005).equivalent)
        << "fewer than 32 replicas";
    auto broken = replicas(5.0, 1e-6, 64, 5);
    broken[10] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(testEquivalence(broken, 5.0, 0.005).equivalent);
    EXPECT_FALSE(testEquivalence(replicas(0.0, 1e-6, 64, 6), 0.0, 0.005).equivalent)
        << "nothing is relative to 0";
}

// At a true difference of exactly the bound the test may accept in 5 % of cases, no more.
TEST(Equivalence, KeepsItsSignificance) {
    int accepted = 0;
    int uncertain = 0;
    for (unsigned i = 0; i < 2000; ++i) {
        accepted += testEquivalence(replicas(1.005, 0.004, 32, 1000 + i), 1.0, 0.005).equivalent;
        uncertain +=
            testEquivalence(replicas(1.005, 0.003, 32, 5000 + i), replicas(1.0, 0.003, 40, 9000 + i), 0.005)
                .equivalent;
    }
    EXPECT_NEAR(accepted / 2000.0, 0.05, 0.016);
    EXPECT_NEAR(uncertain / 2000.0, 0.05, 0.016);
}

TEST(Equivalence, ConstantReplicasAreExact) {
    const std::vector<double> values(32, 2.0);
    EXPECT_TRUE(testEquivalence(values, 2.0, 0.005).equivalent);
    EXPECT_FALSE(testEquivalence(values, 2.0, 0.005).different);
    EXPECT_FALSE(testEquivalence(values, 2.02, 0.005).equivalent);
}

} // namespace
} // namespace kilolux::measure
