// The menus of rows in the light list (right mouse button), drawn behind the row's item.
#pragma once

#include "ui/desk.h"

namespace kilolux {

void drawLightMenu(Desk& desk, std::uint64_t light);
void drawGroupMenu(Desk& desk, std::uint64_t group);

} // namespace kilolux
