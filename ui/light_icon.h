// A small drawing for each light type, in the light's colour.
#pragma once

#include "renderer/document/scene.h"

#include <imgui.h>

namespace kilolux {

// About `center`, within `radius` pixels.
void drawLightIcon(ImDrawList& canvas, LightType type, ImVec2 center, float radius, ImU32 color);

} // namespace kilolux
