// The place of a panel that its own change fills.
#include "ui/panels.h"

namespace kilolux {

void handleLightKeys(Desk&) {}

} // namespace kilolux
