// The place of a panel that its own change fills.
#include "ui/panels.h"

namespace kilolux {

void drawProbePanel(Desk&) {}
void drawProbeOverlay(Desk&, ImDrawList&) {}

} // namespace kilolux
