// Rows of the properties panel about meshes: which lighting channels each is in, and how many of them the
// selected lights reach.
#pragma once

#include "ui/properties_state.h"

namespace kilolux {

// Fills in what PropertiesState holds of meshes; called when the document or the selection has changed.
void countMeshes(Desk& desk);

void drawMeshRows(Desk& desk); // a search, and a row of channels for each mesh
void drawReach(Desk& desk);    // of the selected lights

} // namespace kilolux
