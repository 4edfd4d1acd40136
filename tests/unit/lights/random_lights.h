// Random lights and surfaces for the tests of the light functions.
#pragma once

#include "tests/unit/lights/quadrature.h"

#include <random>

namespace kilolux::test {

inline constexpr const char* kTypeNames[] = {"directional", "sphere", "spot", "tube", "rect", "disk"};
inline constexpr shared::uint kAllTypes[] = {shared::LIGHT_DIRECTIONAL, shared::LIGHT_SPHERE,
                                             shared::LIGHT_SPOT,        shared::LIGHT_TUBE,
                                             shared::LIGHT_RECT,        shared::LIGHT_DISK};

struct Random {
    std::mt19937 engine;
    double uniform(double low, double high);
    double logUniform(double low, double high);
    dvec3 direction();
};

struct Configuration {
    Emitter emitter;
    Surface surface;
};

// Half of the lights are aimed at the lobe (within a few of its widths), the others anywhere above the
// surface; sizes from 1/1000 of the distance to wider than it; roughness and viewing angle even over their
// ranges. The surface lies at 0 and looks up +z.
Configuration randomConfiguration(Random& random, shared::uint type);

// Sine of the half angle of a cone about the centre that holds the emitter, seen from 0; above 1 from inside
// it.
double sineOf(const Emitter& emitter);

// Unit, from 0.
dvec3 directionTo(const Emitter& emitter);

// Loads and binds the committed table.
void bindCommittedTable();

} // namespace kilolux::test
