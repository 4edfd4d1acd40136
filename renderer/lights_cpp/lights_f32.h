// shaders/math and shaders/lights as C++ in float: the numbers a shader gets. For GPU tests, flux and
// numerical error. lightIrradiance and makeLtcLobe need a table bound by useLtcTable (ltc_table.h), lights
// with a LightShaping one in light_tables.h.
#pragma once

#include "shaders/shared/gpu_light.h"
#include "shaders/shared/noise.h"

#include <glm/glm.hpp>

namespace kilolux::f32 {

using uint = std::uint32_t;
using vec2 = glm::vec2;
using vec3 = glm::vec3;
using vec4 = glm::vec4;
using uvec2 = glm::uvec2;
using uvec3 = glm::uvec3;
using uvec4 = glm::uvec4;
using mat3 = glm::mat3;
using shared::LightHot;
using shared::LightShaping;

#include "shaders/lights/light_types.glsl"
#include "shaders/math/selection_types.glsl"
#undef KILOLUX_LIGHTS_LIGHT_TYPES_GLSL // lights_f64.h reads these again
#undef KILOLUX_MATH_SELECTION_TYPES_GLSL

#include "renderer/lights_cpp/lights_api.inl"

} // namespace kilolux::f32
