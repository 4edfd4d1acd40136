// shaders/math and shaders/lights as C++ in double: the same source without its rounding. lightIrradiance and
// makeLtcLobe need a table bound by useLtcTable (ltc_table.h), lights with a LightShaping one in
// light_tables.h.
#pragma once

#include "shaders/shared/gpu_light.h"
#include "shaders/shared/noise.h"

#include <glm/glm.hpp>

namespace kilolux::f64 {

using uint = std::uint32_t;
using vec2 = glm::dvec2;
using vec3 = glm::dvec3;
using vec4 = glm::dvec4;
using uvec2 = glm::uvec2;
using uvec3 = glm::uvec3;
using uvec4 = glm::uvec4;
using mat3 = glm::dmat3;

#define float double
#include "shaders/lights/light_types.glsl"
#include "shaders/math/selection_types.glsl"
#include "shaders/shared/light_hot.inl"
#include "shaders/shared/light_shaping.inl"
#undef KILOLUX_LIGHTS_LIGHT_TYPES_GLSL // lights_f32.h reads these again
#undef KILOLUX_MATH_SELECTION_TYPES_GLSL

#include "renderer/lights_cpp/lights_api.inl"
#undef float

// The values of a float record, its direction made unit in double.
LightHot fromF32(const shared::LightHot& light);
LightShaping fromF32(const shared::LightShaping& shaping);

} // namespace kilolux::f64
