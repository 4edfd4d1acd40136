// Two one-sided t tests.
#include "renderer/measure/equivalence.h"

#include <cmath>
#include <limits>

namespace kilolux::measure {

namespace {

// Regularized incomplete beta function by its continued fraction (Abramowitz and Stegun 26.5.8, evaluated by
// Lentz's method).
double incompleteBeta(double a, double b, double x) {
    if (x <= 0.0) return 0.0;
    if (x >= 1.0) return 1.0;
    if (x > (a + 1.0) / (a + b + 2.0)) // converges fast on the other side
        return 1.0 - incompleteBeta(b, a, 1.0 - x);
    constexpr double kTiny = 1e-300;
    const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) +
                                  b * std::log1p(-x)) /
                         a;
    double c = 1.0;
    double d = 1.0 - (a + b) * x / (a + 1.0);
    d = 1.0 / (std::abs(d) < kTiny ? kTiny : d);
    double fraction = d;
    for (int m = 1; m < 500; ++m) {
        const double numerators[2] = {m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m)),
                                      -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0))};
        double step = 1.0;
        for (const double numerator : numerators) {
            d = 1.0 + numerator * d;
            d = 1.0 / (std::abs(d) < kTiny ? kTiny : d);
            c = 1.0 + numerator / c;
            c = std::abs(c) < kTiny ? kTiny : c;
            step *= c * d;
        }
        fraction *= step;
        if (std::abs(step - 1.0) < 1e-15) break;
    }
    return front * fraction;
}

double studentCumulative(double t, double degreesOfFreedom) {
    const double tail =
        0.5 * incompleteBeta(0.5 * degreesOfFreedom, 0.5, degreesOfFreedom / (degreesOfFreedom + t * t));
    return t > 0.0 ? 1.0 - tail : tail;
}

Equivalence judge(double difference, double standardError, double degreesOfFreedom, double bound,
                  double significance) {
    Equivalence result;
    result.relativeDifference = difference;
    const double reach =
        standardError > 0.0 ? studentQuantile(1.0 - significance, degreesOfFreedom) * standardError : 0.0;
    result.lower = difference - reach;
    result.upper = difference + reach;
    result.equivalent = result.lower > -bound && result.upper < bound;
    result.different = result.lower > 0.0 || result.upper < 0.0;
    return result;
}

Equivalence undecided() {
    Equivalence result;
    result.relativeDifference = std::numeric_limits<double>::quiet_NaN();
    result.lower = -std::numeric_limits<double>::infinity();
    result.upper = std::numeric_limits<double>::infinity();
    return result;
}

} // namespace

ReplicaMean replicaMean(std::span<const double> values) {
    ReplicaMean result;
    result.count = static_cast<int>(values.size());
    if (values.empty()) return result;
    for (const double value : values)
        result.mean += value / result.count;
    double squares = 0.0;
    for (const double value : values)
        squares += (value - result.mean) * (value - result.mean);
    if (result.count > 1) result.standardError = std::sqrt(squares / (result.count - 1.0) / result.count);
    return result;
}

Equivalence testEquivalence(std::span<const double> values, double reference, double relativeBound,
                            double significance) {
    const ReplicaMean mean = replicaMean(values);
    if (mean.count < kMinReplicas || !std::isfinite(mean.mean) || reference == 0.0) return undecided();
    return judge(mean.mean / reference - 1.0, mean.standardError / std::abs(reference), mean.count - 1.0,
                 relativeBound, significance);
}

Equivalence testEquivalence(std::span<const double> values, std::span<const double> referenceValues,
                            double relativeBound, double significance) {
    const ReplicaMean mean = replicaMean(values);
    const ReplicaMean reference = replicaMean(referenceValues);
    if (mean.count < kMinReplicas || reference.count < 2 || !std::isfinite(mean.mean) ||
        !std::isfinite(reference.mean) || reference.mean == 0.0)
        return undecided();
    // First order in both errors: the ratio's relative variance is the sum of the relative variances.
    const double ratio = mean.mean / reference.mean;
    const double v1 = std::pow(mean.standardError / reference.mean, 2.0);
    const double v2 = std::pow(ratio * reference.standardError / reference.mean, 2.0);
    const double spread = v1 * v1 / (mean.count - 1.0) + v2 * v2 / (reference.count - 1.0);
    const double degreesOfFreedom = spread > 0.0 ? (v1 + v2) * (v1 + v2) / spread : mean.count - 1.0;
    return judge(ratio - 1.0, std::sqrt(v1 + v2), degreesOfFreedom, relativeBound, significance);
}

double studentQuantile(double p, double degreesOfFreedom) {
    double low = -1.0;
    double high = 1.0;
    while (studentCumulative(low, degreesOfFreedom) > p && low > -1e12)
        low *= 2.0;
    while (studentCumulative(high, degreesOfFreedom) < p && high < 1e12)
        high *= 2.0;
    for (int i = 0; i < 200 && high - low > 1e-12 * (1.0 + std::abs(low)); ++i) {
        const double mid = 0.5 * (low + high);
        (studentCumulative(mid, degreesOfFreedom) < p ? low : high) = mid;
    }
    return 0.5 * (low + high);
}

} // namespace kilolux::measure
