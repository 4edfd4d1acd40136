// The parts of bench_loop. Each prints its table and returns the same numbers.
#pragma once

#include "tests/bench/loop_kit.h"

namespace kilolux::test {

// loop_cost.cpp
nlohmann::ordered_json benchCost(const LoopOptions& options);    // all-lights against stochastic
nlohmann::ordered_json benchLists(const LoopOptions& options);   // visible_list against a copy
nlohmann::ordered_json benchScaling(const LoopOptions& options); // over every k-th light

// loop_quality.cpp
nlohmann::ordered_json benchQuality(const LoopOptions& options); // still pictures against the references
nlohmann::ordered_json benchGuiding(const LoopOptions& options); // lists and masks, on against off
nlohmann::ordered_json benchRays(const LoopOptions& options);    // what becomes of the rays
nlohmann::ordered_json benchNoise(const LoopOptions& options);   // blue against white

// loop_half.cpp
nlohmann::ordered_json benchHalf(const LoopOptions& options); // lights chosen at half resolution against full

} // namespace kilolux::test
