// One light at one point: the unshadowed integrals and the two estimators of its shadow.
#pragma once

#include "renderer/reference/oracle.h"
#include "renderer/reference/oracle_light.h"
#include "renderer/reference/oracle_shape.h"

#include <functional>

namespace kilolux::oracle {

// occluded(directionWs, lengthM) from the point in question; lengthM may be infinite.
using Occlusion = std::function<bool(const glm::dvec3&, double)>;

// `seed` must differ between points for independent noise. Without `occlusion` nothing hides the light except
// the horizon of the geometric normal.
OraclePointResult estimateLight(const OracleLight& light, const OraclePoint& point,
                                const Occlusion& occlusion, Estimator estimator, int samples,
                                std::uint64_t seed);

} // namespace kilolux::oracle
