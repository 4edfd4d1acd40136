// Where lights stand and how they are turned, in world space: reading it, typing it, and moving several
// together. Edits set the nodes' local transforms, whatever their parents do.
#pragma once

#include "renderer/document/edit_build.h"
#include "ui/value_entry.h"

#include <span>

namespace kilolux {

// A light by its id, which must be there; its definition; its node.
const LightNode& lightOf(const Scene& scene, std::uint64_t light);
const LightDef& defOf(const Scene& scene, std::uint64_t light);
const Node& nodeOf(const Scene& scene, std::uint64_t light);
glm::dvec3 positionOf(const Scene& scene, std::uint64_t light);

// The light's own axes without scale: it looks down -Z.
glm::dmat3 axesOf(const Scene& scene, std::uint64_t light);

// Turns about X first, then Y, then Z of the world, radians. Of the many ways to write a rotation that next
// to `near`.
glm::dvec3 eulerFrom(const glm::dquat& rotation, const glm::dvec3& near = glm::dvec3(0.0));
glm::dquat quatFrom(const glm::dvec3& eulerRad);
glm::dquat rotationOf(const Scene& scene, std::uint64_t light);

// A rigid motion: turned about the pivot, then moved.
struct RigidMotion {
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0}; // w, x, y, z
    glm::dvec3 pivotWs{0.0};
    glm::dvec3 translationWs{0.0};
};

// Lights among `lights` that no other one of them carries along: those that have to be moved.
std::vector<std::uint64_t> carriers(const Scene& scene, std::span<const std::uint64_t> lights);

// Moves lights from where `from` has them, for drags the document at their start.
Result<Edits> editsForMotion(const Scene& scene, const Scene& from, std::span<const std::uint64_t> lights,
                             const RigidMotion& motion);
// Each light turns about its own place.
Result<Edits> editsForTurns(const Scene& scene, const Scene& from, std::span<const std::uint64_t> lights,
                            const glm::dquat& rotation);

// One coordinate (0 to 2) of the position, or one Euler angle, by a typed entry.
Result<Edits> editsForPosition(const Scene& scene, const Scene& from, std::span<const std::uint64_t> lights,
                               int axis, const ValueEntry& entry);
Result<Edits> editsForAngle(const Scene& scene, const Scene& from, std::span<const std::uint64_t> lights,
                            int axis, const ValueEntry& entry, const glm::dvec3& nearRad);

} // namespace kilolux
