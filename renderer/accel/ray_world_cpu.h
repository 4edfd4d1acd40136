// The shaders' own traversal (shaders/lib/trace_core.glsl), compiled as C++ over a RayWorld: what a GPU
// answers, without one. For tests and for tools that need a few rays.
#pragma once

#include "renderer/accel/ray_world.h"

#include <cstdint>

namespace kilolux {

struct CpuHit {
    float tM;
    std::uint32_t instance; // 0xFFFFFFFF: none
    std::uint32_t primitive;
    glm::vec2 barycentrics;
    bool backFace; // as glTF has it: a mirroring transform turns the winding round
};

// `dir` is unit length; hits count in [tMinM, tMaxM). Coordinates are world minus anchor. `channels` of the
// meshes that stop the ray (shaders/shared/channels.h).
bool occluded(const RayWorld& world, const glm::vec3& origin, const glm::vec3& dir, float tMinM, float tMaxM,
              std::uint32_t channels = shared::CHANNELS_ALL);
CpuHit nearest(const RayWorld& world, const glm::vec3& origin, const glm::vec3& dir, float tMinM,
               float tMaxM);
bool alphaPasses(const RayWorld& world, std::uint32_t instance, std::uint32_t primitive,
                 const glm::vec2& barycentrics);

// ray.glsl
float positionErrorM(const glm::vec3& position);
glm::vec3 offsetRayOrigin(const glm::vec3& position, const glm::vec3& ng, const glm::vec3& dir, float errorM);

// tile_order.glsl
glm::uvec2 interleavedTile(std::uint32_t group, const glm::uvec2& tileCount, std::uint32_t chunks);

} // namespace kilolux
