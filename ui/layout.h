// Where the panels stand: a bar above, a line below, a column left and right, the viewport between them.
#pragma once

#include "ui/desk.h"

namespace kilolux {

struct Layout {
    ViewportRect top, bottom, left, right, viewport; // pixels; a column without width is hidden
};

// Columns give way when the window is too narrow for them and a viewport.
Layout makeLayout(const Desk& desk, glm::ivec2 windowPx);

// Draws everything but the picture, and moves the column's edges as they are dragged.
void drawLayout(Desk& desk, const Layout& layout);

} // namespace kilolux
