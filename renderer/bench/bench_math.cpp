#include "renderer/bench/bench_math.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

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

namespace {

// `ratios`: of other over first, a scene each, a repetition each.
OverScenes meanOf(std::string at, const std::vector<std::vector<double>>& ratios) {
    OverScenes result;
    result.at = std::move(at);
    std::vector<double> medians;
    std::size_t repetitions = ratios.empty() ? 0 : ratios.front().size();
    for (const std::vector<double>& scene : ratios) {
        medians.push_back(1.0 / medianOf(scene));
        repetitions = std::min(repetitions, scene.size());
    }
    result.scenes = ratios.size();
    result.firstOverOther = {geometricMean(medians), geometricMean(medians), geometricMean(medians)};
    for (std::size_t r = 0; r < repetitions; ++r) {
        std::vector<double> single;
        for (const std::vector<double>& scene : ratios)
            single.push_back(1.0 / scene[r]);
        const double mean = geometricMean(single);
        result.firstOverOther.least = std::min(result.firstOverOther.least, mean);
        result.firstOverOther.largest = std::max(result.firstOverOther.largest, mean);
    }
    return result;
}

} // namespace

std::vector<OverScenes> meansOverScenes(const BenchResult& result, std::size_t method) {
    std::vector<OverScenes> means;
    const std::size_t times = result.scenes.empty() ? 0 : result.scenes.front().budgetsMs.size();
    for (std::size_t budget = 0; budget < times; ++budget) {
        std::vector<std::vector<double>> ratios;
        for (const SceneResult& scene : result.scenes) {
            ratios.push_back(
                ratiosAtEqualTime(scene.methods.front(), scene.methods[method], scene.budgetsMs[budget]));
            if (ratios.back().empty()) ratios.pop_back();
        }
        // Without given budgets each scene has its own: so many frames of the first method.
        constexpr std::array kFrames = {1, 4, 16};
        means.push_back(
            meanOf(result.plan.budgetsMs.empty()
                       ? fmt::format("denoised, in {} times the first's time per frame", kFrames.at(budget))
                       : fmt::format("denoised, after {:g} ms", result.plan.budgetsMs[budget]),
                   ratios));
    }
    for (const double rays : result.plan.budgetsRays) {
        std::vector<std::vector<double>> ratios;
        for (const SceneResult& scene : result.scenes) {
            ratios.push_back(ratiosAtEqualRays(scene.methods.front(), scene.methods[method], rays));
            if (ratios.back().empty()) ratios.pop_back();
        }
        means.push_back(meanOf(fmt::format("raw, {:g} rays a pixel", rays), ratios));
    }
    return means;
}

} // namespace kilolux::bench
