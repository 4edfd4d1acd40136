// The source's shape by type: its areas, what of it faces a receiver, and points on it. Closed forms of the
// oracle's own.
#pragma once

#include "renderer/reference/oracle_light.h"

namespace kilolux::oracle {

// The sizes of the definition, in the light's own terms.
void takeSize(OracleLight& light, const LightDef& def);

// Shines to one side of a plane.
bool isFlat(const OracleLight& light);

// Area that the light shows to a viewer on its axis (tube: square to its axis), m2, and the surface that
// emits.
double projectedAreaM2(const OracleLight& light);
double emittingAreaM2(const OracleLight& light);

// The point of the light, relative to its centre, that lies farthest along `n`. All lights are symmetric
// about their centre, so its negative is the farthest the other way.
glm::dvec3 supportPoint(const OracleLight& light, const glm::dvec3& n);

// Whether the receiver is on the emitting side, outside of the source.
bool receiverSeesSurface(const OracleLight& light, const glm::dvec3& toCenter);

// Distance from the receiver to the light's surface along a direction in which it is seen.
double distanceTo(const OracleLight& light, const glm::dvec3& receiverWs, const glm::dvec3& directionWs);

// A point drawn uniformly from the part of the light's surface that can face the receiver (rectangle, disk,
// sphere: exactly that part; tube: all of it, so a point may face away). Directional: a direction.
struct SourcePoint {
    glm::dvec3 directionWs; // unit, from the receiver
    double distanceM;       // infinite for directional lights
    bool faces;             // the point emits towards the receiver
};
SourcePoint sampleSource(const OracleLight& light, const glm::dvec3& receiverWs, double u, double v);

} // namespace kilolux::oracle
