// Lets one header be read by C++ and GLSL. Structs use scalar block layout: what C++ packs with these types
// is what GLSL reads, without padding members.
#ifndef KILOLUX_SHARED_BASE_H
#define KILOLUX_SHARED_BASE_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>
#define KX_SHARED_BEGIN namespace kilolux::shared {
#define KX_SHARED_END }
namespace kilolux::shared {
using uint = std::uint32_t;
using vec2 = glm::vec2;
using vec3 = glm::vec3;
using vec4 = glm::vec4;
using ivec2 = glm::ivec2;
using uvec2 = glm::uvec2;
using uvec3 = glm::uvec3;
using uvec4 = glm::uvec4;
using mat4 = glm::mat4;
} // namespace kilolux::shared
#define KX_CONST constexpr
#else
#extension GL_EXT_scalar_block_layout : require
#define KX_SHARED_BEGIN
#define KX_SHARED_END
#define KX_CONST const
#endif

#endif
