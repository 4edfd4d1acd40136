// A tree of lights for drawing one by about what it gives a point (Conty Estevez and Kulla, "Importance
// Sampling of Many Lights with Adaptive Tree Splitting", HPG 2018, sections 4.1 to 4.3). Built anew after
// every change of lights; how it is gone down is in shaders/lib/light_tree.glsl.
#pragma once

#include "shaders/shared/gpu_light.h"
#include "shaders/shared/resampling.h"

#include <span>
#include <vector>

namespace kilolux {

// Directions within `spreadRad` of an axis, from each of which light leaves at up to `emissionRad`
// (section 4.1).
struct LightCone {
    glm::dvec3 axis{0.0, 0.0, 1.0};
    double spreadRad = 0.0;
    double emissionRad = 0.0;
};

// The narrowest cone about both (algorithm 1).
LightCone coneAbout(const LightCone& a, const LightCone& b);

// The measure of directions that a cone emits to, in sr (equation 1).
double coneMeasure(const LightCone& cone);

// One node per light that is on and one less: children behind their parents, a leaf's `slot` its place in
// `hot`. Without such a light a single node without intensity.
std::vector<shared::LightTreeNode> makeLightTree(std::span<const shared::LightHot> hot);

} // namespace kilolux
