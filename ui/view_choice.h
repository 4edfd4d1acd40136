// Which views there are to choose from: groups for the list, keys, and how a row of the timings leads to a
// picture. Knows no ImGui.
#pragma once

#include "renderer/renderer.h"

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kilolux {

struct ViewGroup {
    std::string_view title;
    std::vector<NamedChoice> views;
};
// Every view once.
std::vector<ViewGroup> viewGroups();

// The views of the keys 1 to 9.
inline constexpr std::array<std::string_view, 9> kViewKeys{"final",       "illuminance",     "stops",
                                                           "clipping",    "lights-in-range", "chosen-light",
                                                           "list-length", "history-length",  "normal"};
// "1" to "9", or empty.
std::string viewKey(std::string_view view);

// What a click on a pass in the timings shows: an image that the pass writes; another click the next one of
// `outputs` (FrameStatistics::viewOutputs of the view that is shown). Passes that write buffers only lead to
// a view made of these.
std::string viewOfPass(std::string_view pass, std::string_view shownView,
                       const std::vector<std::string>& outputs);

// The pass that a view shows; empty for other views.
std::string_view passOfView(std::string_view view);

} // namespace kilolux
