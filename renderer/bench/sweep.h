// Scaling: the same scene with more and fewer lights, pixels, triangles or rays. Pictures of a sweep over
// triangles and rays stay the same, those over lights and resolution have references of their own.
#pragma once

#include "renderer/bench/bench.h"

#include <span>

namespace kilolux::bench {

// "lights", ...; empty for None.
std::string_view sweepName(Sweep sweep);
std::optional<Sweep> sweepFromName(std::string_view name);

// The steps, ascending; 1 is the scene as it is. None has that one.
std::span<const double> sweepFactors(Sweep sweep);

// Lights: of a factor below 1 the share that a fixed shuffle keeps; above, copies of all of them moved by up
// to half a metre, all with 1 / factor of their intensity, so that the scene stays about as bright.
void scaleLights(Scene& scene, double factor);

// Triangles: every one becomes four by its edges' middles, as often as the factor holds fours. The surface
// stays.
void scaleTriangles(Scene& scene, double factor);

// What a step does to the scene, the size of the picture and the settings of a method.
void applySweep(Sweep sweep, double factor, Scene& scene, int& width, int& height);
void applySweep(Sweep sweep, double factor, Settings& settings);

} // namespace kilolux::bench
