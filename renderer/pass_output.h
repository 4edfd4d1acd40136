// What one pass of a frame had written right after it ran, as a picture that a person can read: the view
// "pass:NAME", or "pass:NAME/OUTPUT" with the output's GLSL name, with or without its "Out".
#pragma once

#include "renderer/gpu/commands.h"
#include "renderer/legend.h"
#include "renderer/renderer.h"

#include <glm/glm.hpp>
#include <optional>
#include <string_view>

namespace kilolux {

struct PassOutputName {
    std::string pass;
    std::string output; // empty: the first image
};
std::optional<PassOutputName> passOutputName(std::string_view view); // nothing for other views

struct PassOutput {
    std::vector<std::string> names; // of all images that the pass writes
    std::string name;               // of the one that is shown
    Picture picture;                // rgb: its first three channels as they are; integers as their number
    Legend legend;
};

// Texels of the captured images belong to `allocatedPx` rendered pixels, of which the frame used
// `renderedPx`. Light is shown as the display would; single numbers between their 1st and 99th percentile;
// integers get a colour each. Errors: the pass did not run, or writes no such image.
Result<PassOutput> showPassOutput(const PassOutputName& wanted, const std::vector<gpu::Captured>& captured,
                                  glm::ivec2 allocatedPx, glm::ivec2 renderedPx, glm::ivec2 outputPx);

} // namespace kilolux
