// The place of a panel that its own change fills.
#include "ui/panels.h"

namespace kilolux {

void drawProperties(Desk&) {}
std::string propertiesState(const Desk&) {
    return "{}";
}

} // namespace kilolux
