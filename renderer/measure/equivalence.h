// Means over replicas with their own seeds: standard error, confidence interval, and the test that two means
// are equal within a bound. Not rejecting a difference proves nothing; equivalence must be shown (two
// one-sided t tests: Schuirmann 1987).
#pragma once

#include <span>

namespace kilolux::measure {

inline constexpr int kMinReplicas = 32; // fewer show nothing that a test should rely on

struct ReplicaMean {
    int count = 0;
    double mean = 0.0;
    double standardError = 0.0; // of the mean
};
ReplicaMean replicaMean(std::span<const double> values);

struct Equivalence {
    double relativeDifference = 0.0; // mean / reference - 1
    double lower = 0.0, upper = 0.0; // its confidence interval at 1 - 2 x significance
    bool equivalent = false;         // the interval lies within +- bound
    bool different = false;          // the interval excludes 0: a bias is seen, however small
};

// Each value is one replica's estimate of the same number, `reference` the truth (not 0), `relativeBound` for
// instance 0.005, `significance` of each one-sided test. Fewer than kMinReplicas or a value that is not
// finite: never equivalent.
Equivalence testEquivalence(std::span<const double> values, double reference, double relativeBound,
                            double significance = 0.05);

// The same with an uncertain reference: independent replicas of it (Welch's degrees of freedom).
Equivalence testEquivalence(std::span<const double> values, std::span<const double> referenceValues,
                            double relativeBound, double significance = 0.05);

// Quantile of Student's t distribution: P(T <= result) = p.
double studentQuantile(double p, double degreesOfFreedom);

} // namespace kilolux::measure
