// The pointer and keys that move the viewport's camera.
#pragma once

#include "ui/desk.h"

namespace kilolux {

// Once per UI frame: right mouse + WASD flies (Q and E down and up, Shift faster, wheel sets the speed), Alt
// + left orbits, the middle button pans, the wheel dollies.
void controlCamera(Desk& desk, const ViewportRect& rect);

} // namespace kilolux
