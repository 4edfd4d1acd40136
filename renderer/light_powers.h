// Drawing lights by their power: the table for the shader.
#pragma once

#include "renderer/gpu_lights.h"
#include "shaders/shared/resampling.h"

#include <span>
#include <vector>

namespace kilolux {

// An alias table (Vose, "A Linear Algorithm for Generating Random Numbers with a Given Distribution", 1991)
// over the weights, which are finite and not negative: its entry i is slot i. Without any weight all entries
// are equally likely.
std::vector<shared::LightPower> aliasTable(std::span<const double> weights);

// What each slot emits, in lm; a directional light what falls on a disk about the scene. Dead and muted: 0.
// `sceneExtentM`: diameter of the scene.
std::vector<double> lightPowers(std::span<const shared::LightHot> hot,
                                std::span<const shared::LightCold> cold, double sceneExtentM);

} // namespace kilolux
