// Fits linearly transformed cosines to GGX (shaders/math/ltc.glsl says which, in which parameters).
#pragma once

#include "renderer/lights_cpp/ltc_table.h"

#include <glm/glm.hpp>

namespace kilolux {

// One node of the table, in double.
struct LtcFit {
    glm::dvec4 parameters{1.0, 1.0, 0.0, 0.0};
    glm::dvec4 scales{1.0, 0.0, 0.0, 0.0};
    double error =
        0.0; // of the shape: integral of (GGX - LTC)^2 / (GGX + 2 % of the peak), over GGX's integral
};

// `start` is where the search begins: a neighbour's parameters, or {1, 1, 0, 0} for the smoothest surfaces.
LtcFit fitLtc(double noV, double roughness, glm::dvec4 start);

// Fits the nodes of a width x height table on `threads` threads. The same sizes give the same table whatever
// the thread count. Nodes are those of ltcInputsFromNode, spread evenly over 0 to 1.
LtcTable fitLtcTable(int width, int height, int threads);

} // namespace kilolux
