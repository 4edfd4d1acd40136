// From a dome's picture, or its lack, to what shaders/lights/dome.glsl looks up: the picture with blurred
// levels, a map of irradiance, and the distribution by which directions are drawn.
#pragma once

#include "renderer/document/scene.h"
#include "renderer/lights_cpp/light_tables.h"

namespace kilolux {

// Pictures wider than this are averaged down to it.
inline constexpr int kDomeWidthPx = 2048;

// Null for a picture without light. What is NaN, infinite or negative counts as black. A null image is white.
// Made once for as long as the image lives.
std::shared_ptr<const DomeMaps> domeMapsOf(const std::shared_ptr<const Image>& image);

// Whether the dome shines: it has an intensity, a colour, and a picture that is not black.
bool domeShines(const Dome& dome);

// What a texel of 1 stands for, in nit, by intensity and colour.
glm::dvec3 domeTexelNit(const Dome& dome, const DomeMaps& maps);

// Plain ambient light; 0 where its numbers are none.
glm::dvec3 fillNit(const Dome& dome);

// The record of the dome as a light; `maps` of its picture.
shared::LightHot domeRecord(const Dome& dome, const DomeMaps& maps);

} // namespace kilolux
