// One light at one point: the unshadowed integrals, the two estimators of its shadow, and points drawn
// uniformly from its surface.
#pragma once

#include "renderer/reference/oracle.h"
#include "renderer/reference/oracle_light.h"

#include <functional>

namespace kilolux::oracle {

// occluded(directionWs, lengthM) from the point in question; lengthM may be infinite.
using Occlusion = std::function<bool(const glm::dvec3&, double)>;

// `seed` must differ between points for independent noise. Without `occlusion` nothing hides the light except
// the horizon of the geometric normal.
OraclePointResult estimateLight(const OracleLight& light, const OraclePoint& point,
                                const Occlusion& occlusion, Estimator estimator, int samples,
                                std::uint64_t seed);

// A point drawn uniformly from the part of the light's surface that can face the receiver (rectangle, disk,
// sphere: exactly that part; tube: all of it, so a point may face away). Directional: a direction.
struct SourcePoint {
    glm::dvec3 directionWs; // unit, from the receiver
    double distanceM;       // infinite for directional lights
    bool faces;             // the point emits towards the receiver
};
SourcePoint sampleSource(const OracleLight& light, const glm::dvec3& receiverWs, double u, double v);

} // namespace kilolux::oracle
