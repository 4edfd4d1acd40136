// The questions of file work, drawn with ImGui: folder list, unsaved changes, recovery, changed on disk.
#pragma once

#include "ui/desk.h"

namespace kilolux {

void drawFileDialogs(Desk& desk);

// What the viewport shows while nothing is open: what to do first, recent scenes, the keys.
void drawFirstRun(Desk& desk, const ViewportRect& rect);

} // namespace kilolux
