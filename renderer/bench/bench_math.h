// The arithmetic of comparisons at equal time and equal rays.
#pragma once

#include "renderer/bench/bench.h"

#include <optional>
#include <span>
#include <string>

namespace kilolux::bench {

double medianOf(std::vector<double> values); // 0 without any

// Median, and the least and largest of the values.
struct Interval {
    double median = 0.0, least = 0.0, largest = 0.0;
};
Interval intervalOf(const std::vector<double>& values);

// exp of the mean of logs; of positive values only. 0 without any.
double geometricMean(std::span<const double> values);

// The relative MSE of a run when `budget` is spent at `perFrame` a frame: between two points linear in the
// logarithms of both, after the last one its error. Nothing before the first frame is done.
std::optional<double> errorAt(const BenchRun& run, double perFrame, double budget);

// Error of `other` over that of `first`, repetition by repetition, at equal time after filtering or at equal
// rays before it; fewer where one has no frame yet.
std::vector<double> ratiosAtEqualTime(const MethodResult& first, const MethodResult& other, double budgetMs);
std::vector<double> ratiosAtEqualRays(const MethodResult& first, const MethodResult& other,
                                      double raysPerPixel);

// Geometric means over the scenes of error(first) / error(method): at each budget of time, by its place among
// the budgets, and at each of rays. The interval is that of the means of single repetitions.
struct OverScenes {
    std::string at; // the budget, in words
    Interval firstOverOther;
    std::size_t scenes = 0; // in which both have a frame by then
};
std::vector<OverScenes> meansOverScenes(const BenchResult& result, std::size_t method);

} // namespace kilolux::bench
