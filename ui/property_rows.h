// Rows of the properties panel: label to the left, field to the right.
#pragma once

#include "ui/value_field.h"

namespace kilolux {

// Draws the label and leaves the cursor at the field; the width that is left for it, pixels.
float rowLabel(Desk& desk, const char* label, const char* help);

// The selection's common value of a field, remembered until something changes.
const CommonValue& valueOf(Desk& desk, const char* field);

void drawFieldRow(Desk& desk, const LightField& field);
void drawPlaceRows(Desk& desk); // position and rotation
void drawTintRow(Desk& desk);
void drawGroupRows(Desk& desk, std::uint64_t group); // its masters
void drawDomeRows(Desk& desk);                       // of the scene, and its fill

} // namespace kilolux
