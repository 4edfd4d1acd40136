// What is slow or wrong with a picture, in words for the user. Knows no ImGui.
#pragma once

#include "renderer/statistics.h"

#include <string>
#include <vector>

namespace kilolux {

struct CostNote {
    std::string text;
    bool wrong = false; // else only slow
};

// The worst first; empty when all is well.
std::vector<CostNote> costNotes(const FrameStatistics& statistics);

} // namespace kilolux
