// How fast the filtered picture follows a change: lights switched off and on, moved, added, a cut and an
// exposure step, each followed frame by frame and compared with what a still picture converges to.
#pragma once

#include "renderer/renderer.h"

#include <optional>
#include <string>
#include <vector>

namespace kilolux::test {

struct StepResponse {
    std::string name;
    double region = 0.0; // share of the pixels that the change affects
    // By frame since the change, over the pixels that became brighter or darker by a tenth, whichever is
    // worse: error of the mean, relative to the new still picture.
    std::vector<double> error;
    // What is left of the change: 1 shows the old picture, 0 the new one; empty where nothing changes.
    std::vector<double> rest;

    int framesWithin(double bound) const; // first frame from which on the error stays within; -1: never
};

struct StepOptions {
    int width = 64, height = 44; // pixels
    int framesBefore = 40, framesAfter = 24;
    int referenceFrames = 24;
    std::uint32_t seed = 1;
    std::optional<bool> cpuFilters; // as RenderOptions has it
};

// Renders the stage of tests/image/image_scenes.h. Throws what the renderer refuses.
std::vector<StepResponse> measureStepResponses(const StepOptions& options);

std::string stepTable(const std::vector<StepResponse>& responses);

} // namespace kilolux::test
