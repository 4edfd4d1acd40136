// The place of a panel that its own change fills.
#include "ui/panels.h"

namespace kilolux {

void drawGizmos(Desk&, ImDrawList&) {}
std::string gizmoState(const Desk&) {
    return "{}";
}

} // namespace kilolux
