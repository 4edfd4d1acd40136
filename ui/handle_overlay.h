// The handles of the selected lights on the picture, and the drag of one, which changes them all.
#pragma once

#include "ui/desk.h"
#include "ui/light_handles.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace kilolux {

struct HandleState {
    std::vector<LightHandle> handles; // of the frame being drawn
    int hot = -1;                     // under the pointer
    std::optional<HandleDrag> drag;
    Scene dragStart;                    // the document when the drag began
    std::vector<std::uint64_t> dragged; // lights that the drag changes
    std::string key, label;
    glm::dvec2 px{-1e9}; // where the pointer was when the document was changed last
    bool snaps = false;
    bool hasDragged = false;
    std::uint64_t drags = 0;
};

// Gives the drag of a handle up; false: there is none.
bool cancelHandleDrag(Desk& desk);

// For tests: where each dot is, '<field>' of one light or '<light>.<field>' of several, and the label while
// one is dragged.
nlohmann::json handleOverlayState(const Desk& desk);

} // namespace kilolux
