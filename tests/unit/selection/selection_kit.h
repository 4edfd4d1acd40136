// Small sets of lights, and enumeration of the selection's random numbers, for the tests of light selection.
#pragma once

#include "renderer/lights_cpp/lights_f32.h"
#include "renderer/lights_cpp/lights_f64.h"

#include <functional>
#include <map>
#include <random>
#include <vector>

namespace kilolux::test {

using uint = std::uint32_t;

// Candidates by list; their items are 0 .. n - 1 over all of them in this order.
struct Lights {
    std::vector<double> visible;
    std::vector<double> hidden;
    std::vector<double> directional;
    double dome = -1.0; // its weight; none below 0

    uint count() const {
        return static_cast<uint>(visible.size() + hidden.size() + directional.size() + (dome >= 0.0 ? 1 : 0));
    }
    std::vector<f64::Candidate> candidates() const;
};

// The talk's 20 and 50 %, both relaxed below 0.1; the dome's 50 %.
f64::SelectionBudget defaultBudget();

f64::LightSelection select(const std::vector<f64::Candidate>& candidates, const f64::vec3& numbers,
                           uint sampleCount = 1);

// Measure of [0, 1) on which `key` takes each value: on a grid, with the ends of every run found by
// bisection. Wrong by at most two grid steps for each run that is shorter than one.
std::map<uint, double> measureByKey(const std::function<uint(double)>& key, uint gridSize);

// Every light that can be chosen, as reported when it is: found by scanning the three numbers one at a time,
// finely enough for probabilities over 1/1000 within a list.
std::map<uint, f64::LightChoice> outcomes(const std::vector<f64::Candidate>& candidates,
                                          const f64::SelectionBudget& budget);

} // namespace kilolux::test
