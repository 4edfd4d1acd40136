// Adaptive quadrature over light surfaces in double precision: the truth that analytic irradiance is held
// against. Written from the light model's definition, without shaders/lights; only the BRDF is written again
// here.
#pragma once

#include "renderer/lights_cpp/lights_f64.h"

#include <functional>
#include <string>

namespace kilolux::test {

using glm::dvec2;
using glm::dvec3;

inline constexpr double kPi = 3.14159265358979323846;

// A light in double with its frame; sizes as in LightHot.
struct Emitter {
    shared::uint type = shared::LIGHT_SPHERE;
    dvec3 center{0.0};
    dvec3 x{1.0, 0.0, 0.0}; // local axes; it looks along -z
    dvec3 y{0.0, 1.0, 0.0};
    dvec3 z{0.0, 0.0, 1.0};
    dvec2 size{0.0};
};

struct Surface {
    dvec3 position{0.0};
    dvec3 normal{0.0, 0.0, 1.0};
    dvec3 view{0.0, 0.0, 1.0};
    double roughness = 0.5;
};

// Of unit radiance: irradiance, and GGX radiance for F0 = 1 - weight and weight (Schlick).
struct Reflected {
    double diffuse = 0.0;
    dvec2 specular{0.0};
};

// D V cosine of GGX and Schlick's weight, written straight from the formulas.
dvec2 referenceGgx(const Surface& surface, const dvec3& lightDir);

// Integrates over the emitter's visible surface to about 1e-4 of the largest of value and 0.1 % of a full
// lobe.
Reflected integrate(const Emitter& emitter, const Surface& surface);

// The largest D V cosine (F0 + (1 - F0) weight) over all light directions.
double lobePeak(const Surface& surface, double f0);

// The record that the renderer would upload for this emitter, with the given intensity.
shared::LightHot hotRecord(const Emitter& emitter, const glm::vec3& intensity);

// The emitter that a record describes after its fields were rounded to float and its tangent packed.
Emitter emitterOf(const f64::LightHot& light);

std::string describe(const Emitter& emitter, const Surface& surface);

} // namespace kilolux::test
