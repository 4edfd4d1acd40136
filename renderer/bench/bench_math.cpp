#include "renderer/bench/bench_math.h"

#include <algorithm>
#include <cmath>

namespace kilolux::bench {

double medianOf(std::vector<double> values) {
    if (values.empty()) return 0.0;
    const std::size_t middle = values.size() / 2;
    std::sort(values.begin(), values.end());
    return values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

Interval intervalOf(const std::vector<double>& values) {
    if (values.empty()) return {};
    const auto [least, largest] = std::minmax_element(values.begin(), values.end());
    return {medianOf(values), *least, *largest};
}

double geometricMean(std::span<const double> values) {
    double sum = 0.0;
    for (const double value : values)
        sum += std::log(value);
    return values.empty() ? 0.0 : std::exp(sum / double(values.size()));
}

std::optional<double> errorAt(const BenchRun& run, double perFrame, double budget) {
    if (run.points.empty() || !(perFrame > 0.0)) return std::nullopt;
    const double frames = budget / perFrame;
    if (frames < double(run.points.front().frame) * (1.0 - 1e-9)) return std::nullopt;
    for (std::size_t i = 1; i < run.points.size(); ++i) {
        const BenchPoint &a = run.points[i - 1], &b = run.points[i];
        if (frames > double(b.frame)) continue;
        if (a.relativeMse <= 0.0 || b.relativeMse <= 0.0) return b.relativeMse;
        const double t =
            std::log(std::max(frames, double(a.frame)) / a.frame) / std::log(double(b.frame) / a.frame);
        return std::exp(std::lerp(std::log(a.relativeMse), std::log(b.relativeMse), t));
    }
    return run.points.back().relativeMse;
}

namespace {

using PerFrame = double BenchRun::*;

std::vector<double> ratios(const std::vector<BenchRun>& first, const std::vector<BenchRun>& other,
                           PerFrame perFrame, double budget) {
    std::vector<double> result;
    for (std::size_t i = 0; i < std::min(first.size(), other.size()); ++i) {
        const auto a = errorAt(first[i], first[i].*perFrame, budget);
        const auto b = errorAt(other[i], other[i].*perFrame, budget);
        if (a && b && *a > 0.0) result.push_back(*b / *a);
    }
    return result;
}

} // namespace

std::vector<double> ratiosAtEqualTime(const MethodResult& first, const MethodResult& other, double budgetMs) {
    return ratios(first.filtered, other.filtered, &BenchRun::lightingMs, budgetMs);
}

std::vector<double> ratiosAtEqualRays(const MethodResult& first, const MethodResult& other,
                                      double raysPerPixel) {
    return ratios(first.raw, other.raw, &BenchRun::raysPerPixel, raysPerPixel);
}

} // namespace kilolux::bench
