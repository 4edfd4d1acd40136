// Compiles the tracing shaders as C++ in float. Needs -fsingle-precision-constant: GLSL literals have no
// suffix.
#include "renderer/accel/ray_world_cpu.h"

#include "shaders/shared/bvh.h"

#include <cassert>
#include <cmath>
#include <cstring>
#include <glm/glm.hpp>

static_assert(sizeof(0.5) == sizeof(float), "compile this file with -fsingle-precision-constant");

namespace kilolux {

namespace shader {
namespace {

using namespace glm;
using namespace shared;
using uint = std::uint32_t;
using vec2 = glm::vec2;
using vec3 = glm::vec3;
using vec4 = glm::vec4;
using uvec2 = glm::uvec2;
using uvec4 = glm::uvec4;

// The world that the fetches read; set for the duration of a call.
thread_local const RayWorld* boundWorld = nullptr;

struct BoundWorld {
    explicit BoundWorld(const RayWorld& world) { boundWorld = &world; }
    ~BoundWorld() { boundWorld = nullptr; }
};

// 16-byte texel `index` of an array of structs, as a texel buffer gives it.
template<typename Texel, typename T>
Texel texelOf(const std::vector<T>& records, uint index) {
    static_assert(sizeof(T) % sizeof(Texel) == 0);
    assert(index < records.size() * sizeof(T) / sizeof(Texel));
    Texel texel;
    // GLM's types copy as bytes, though its constructors keep the compiler from knowing.
    std::memcpy(static_cast<void*>(&texel),
                reinterpret_cast<const char*>(records.data()) + index * sizeof(Texel), sizeof(Texel));
    return texel;
}

uvec4 fetchNode(uint texel) {
    return texelOf<uvec4>(boundWorld->nodes, texel);
}
vec4 fetchPair(uint texel) {
    return texelOf<vec4>(boundWorld->pairs, texel);
}
uvec2 fetchPairIds(uint pair) {
    return boundWorld->pairIds[pair];
}
uvec4 fetchEntry(uint texel) {
    return texelOf<uvec4>(boundWorld->entries, texel);
}
BvhEntry worldEntry() {
    return boundWorld->entries[0];
}
uvec2 fetchTraceInstance(uint index) {
    return texelOf<uvec2>(boundWorld->instances, index);
}
uint traceInstanceCount() {
    return uint(boundWorld->instances.size());
}
float fetchAlphaTexel(uint texel) {
    return float(boundWorld->alpha.texels[texel]) / 255.0f;
}
uvec4 fetchAlphaRecord(uint texel) {
    return texelOf<uvec4>(boundWorld->alpha.records, texel);
}
uvec4 fetchAlphaTriangle(uint texel) {
    return texelOf<uvec4>(boundWorld->alpha.triangles, texel);
}

const bool kTraceAlpha = true;
const bool kTraceChannels = true;

#include "shaders/math/prelude.glsl"

#include "shaders/lib/ray.glsl"

#include "shaders/lib/alpha_core.glsl"
#include "shaders/lib/tile_order.glsl"
#include "shaders/lib/trace_core.glsl"

Ray rayOf(const vec3& origin, const vec3& dir, float tMinM, float tMaxM, uint channels = CHANNELS_ALL) {
    return {origin, tMinM, dir, tMaxM, channels};
}

} // namespace
} // namespace shader

bool occluded(const RayWorld& world, const glm::vec3& origin, const glm::vec3& dir, float tMinM, float tMaxM,
              std::uint32_t channels) {
    const shader::BoundWorld bound(world);
    return shader::occludedByBvh(shader::rayOf(origin, dir, tMinM, tMaxM, channels));
}

CpuHit nearest(const RayWorld& world, const glm::vec3& origin, const glm::vec3& dir, float tMinM,
               float tMaxM) {
    const shader::BoundWorld bound(world);
    const shader::Hit hit = shader::nearestInBvh(shader::rayOf(origin, dir, tMinM, tMaxM));
    return {hit.tM, hit.instance, hit.primitive, hit.barycentrics, hit.backFace};
}

bool alphaPasses(const RayWorld& world, std::uint32_t instance, std::uint32_t primitive,
                 const glm::vec2& barycentrics) {
    const shader::BoundWorld bound(world);
    return shader::alphaPasses(instance, primitive, barycentrics);
}

float positionErrorM(const glm::vec3& position) {
    return shader::positionErrorM(position);
}

glm::vec3 offsetRayOrigin(const glm::vec3& position, const glm::vec3& ng, const glm::vec3& dir,
                          float errorM) {
    return shader::offsetRayOrigin(position, ng, dir, errorM);
}

glm::uvec2 interleavedTile(std::uint32_t group, const glm::uvec2& tileCount, std::uint32_t chunks) {
    return shader::interleavedTile(group, tileCount, chunks);
}

} // namespace kilolux
