// The flat list of drawn things: one instance per visible node and primitive of its mesh, in node order. Its
// index is the instance id that the G-buffer, the tracer and every view share.
#pragma once

#include "renderer/document/scene.h"

#include <cstdint>
#include <vector>

namespace kilolux {

// How a surface meets rays, and the G-buffer, which follows the same rule.
enum class SurfaceRole : std::uint8_t {
    Absent,      // not in the ray scene nor in the G-buffer: opacity below 0.5
    Opaque,      // always stops a ray
    AlphaTested, // stops a ray where alphaPasses() (shaders/lib/alpha.glsl) is true
};

struct Instance {
    int node = -1;      // into Scene::nodes
    int mesh = -1;      // into Scene::meshes
    int primitive = -1; // into Mesh::primitives
    int material = -1;  // into Scene::materials; -1 is the default material
    glm::dmat4 worldFromLocal{1.0};
    std::uint32_t triangleCount = 0;
    std::uint32_t firstTriangle = 0; // triangles of all instances before this one: gives each triangle one id
    SurfaceRole role = SurfaceRole::Opaque;
};

// False for materials that light mostly passes: BLEND with a base colour alpha, or transmission, that leaves
// less than half of the light stopped.
bool castsShadow(const Material& material);

// The alpha factor below which a texel lets light through: the material's cutoff, 0.5 for BLEND.
double alphaCutoff(const Material& material);

SurfaceRole surfaceRole(const Scene& scene, const Primitive& primitive);

std::vector<Instance> enumerateInstances(const Scene& scene);

const Primitive& primitiveOf(const Scene& scene, const Instance& instance);

} // namespace kilolux
