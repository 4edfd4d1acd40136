#include "ui/light_place.h"

#include "ui/change_builder.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace kilolux {

namespace {

glm::dmat4 worldFromParent(const Scene& scene, const Node& node) {
    return node.parent >= 0 ? scene.nodes[std::size_t(node.parent)].worldFromNode : glm::dmat4(1.0);
}

// The node's local transform after a rigid motion in the world.
EditValue movedValue(const Scene& from, std::uint64_t light, const RigidMotion& motion) {
    const Node& node = nodeOf(from, light);
    const glm::dmat4 parent = worldFromParent(from, node);
    const bool isRoot = node.parent < 0;
    const glm::dmat4 parentInverse = isRoot ? glm::dmat4(1.0) : glm::inverse(parent);
    const glm::dvec3 before(node.worldFromNode[3]);
    const glm::dvec3 after =
        motion.pivotWs + motion.rotation * (before - motion.pivotWs) + motion.translationWs;
    const bool turns = motion.rotation != glm::dquat(1.0, 0.0, 0.0, 0.0);
    if (!node.restTrs) {
        glm::dmat4 local = node.localFromNode;
        if (turns) local = parentInverse * glm::mat4_cast(motion.rotation) * parent * local;
        local[3] = parentInverse * glm::dvec4(after, 1.0);
        return local;
    }
    Trs trs = *node.restTrs;
    trs.translation = glm::dvec3(parentInverse * glm::dvec4(after, 1.0));
    if (turns) {
        const glm::dquat parentTurn =
            isRoot ? glm::dquat(1.0, 0.0, 0.0, 0.0) : glm::quat_cast(glm::dmat3(rigidFrame(parent)));
        trs.rotation = glm::normalize(glm::inverse(parentTurn) * motion.rotation * parentTurn * trs.rotation);
    }
    return trs;
}

// Edits against `scene` that bring each light to where `motionOf` takes it from `from`.
template<typename MotionOf>
Result<Edits> moved(const Scene& scene, const Scene& from, std::span<const std::uint64_t> lights,
                    MotionOf&& motionOf) {
    const EditField& field = *findEditField(EditTarget::Light, "transform");
    Edits edits;
    for (const std::uint64_t light : carriers(from, lights)) {
        Result<Edits> each =
            setField(scene, EditTarget::Light, light, field, movedValue(from, light, motionOf(light)));
        if (!each) return each;
        edits.insert(edits.end(), each.value().begin(), each.value().end());
    }
    return edits;
}

double wrapped(double angle, double near) {
    return angle - glm::two_pi<double>() * std::round((angle - near) / glm::two_pi<double>());
}

} // namespace

const LightNode& lightOf(const Scene& scene, std::uint64_t light) {
    return scene.lights[std::size_t(findLight(scene, light))];
}

const LightDef& defOf(const Scene& scene, std::uint64_t light) {
    return scene.lightDefs[std::size_t(lightOf(scene, light).def)];
}

const Node& nodeOf(const Scene& scene, std::uint64_t light) {
    return scene.nodes[std::size_t(lightOf(scene, light).node)];
}

glm::dvec3 positionOf(const Scene& scene, std::uint64_t light) {
    return glm::dvec3(nodeOf(scene, light).worldFromNode[3]);
}

glm::dmat3 axesOf(const Scene& scene, std::uint64_t light) {
    return glm::dmat3(rigidFrame(nodeOf(scene, light).worldFromNode));
}

glm::dquat rotationOf(const Scene& scene, std::uint64_t light) {
    return glm::normalize(glm::quat_cast(axesOf(scene, light)));
}

glm::dquat quatFrom(const glm::dvec3& eulerRad) {
    return glm::angleAxis(eulerRad.z, glm::dvec3(0, 0, 1)) * glm::angleAxis(eulerRad.y, glm::dvec3(0, 1, 0)) *
           glm::angleAxis(eulerRad.x, glm::dvec3(1, 0, 0));
}

glm::dvec3 eulerFrom(const glm::dquat& rotation, const glm::dvec3& near) {
    const glm::dmat3 m = glm::mat3_cast(rotation);
    const double sinY = std::clamp(-m[0].z, -1.0, 1.0);
    if (std::abs(sinY) > 1.0 - 1e-12) {
        // Looking along the pole X and Z turn about one axis: X stays where it was.
        const double x = near.x, y = std::asin(sinY);
        const double sum = std::atan2(-m[1].x, m[1].y); // of z and x, with the sign of the pole
        return {x, wrapped(y, near.y), wrapped(sum + (sinY > 0.0 ? x : -x), near.z)};
    }
    const glm::dvec3 first(std::atan2(m[1].z, m[2].z), std::asin(sinY), std::atan2(m[0].y, m[0].x));
    const glm::dvec3 second(first.x + glm::pi<double>(), glm::pi<double>() - first.y,
                            first.z + glm::pi<double>());
    const auto nearest = [&](const glm::dvec3& angles) {
        return glm::dvec3(wrapped(angles.x, near.x), wrapped(angles.y, near.y), wrapped(angles.z, near.z));
    };
    const glm::dvec3 a = nearest(first), b = nearest(second);
    return glm::distance(a, near) <= glm::distance(b, near) + 1e-9 ? a : b;
}

std::vector<std::uint64_t> carriers(const Scene& scene, std::span<const std::uint64_t> lights) {
    std::vector<bool> selected(scene.nodes.size(), false);
    for (const std::uint64_t light : lights)
        selected[std::size_t(lightOf(scene, light).node)] = true;
    std::vector<std::uint64_t> result;
    for (const std::uint64_t light : lights) {
        int parent = nodeOf(scene, light).parent;
        while (parent >= 0 && !selected[std::size_t(parent)])
            parent = scene.nodes[std::size_t(parent)].parent;
        if (parent < 0) result.push_back(light);
    }
    return result;
}

Result<Edits> editsForMotion(const Scene& scene, const Scene& from, std::span<const std::uint64_t> lights,
                             const RigidMotion& motion) {
    return moved(scene, from, lights, [&](std::uint64_t) { return motion; });
}

Result<Edits> editsForTurns(const Scene& scene, const Scene& from, std::span<const std::uint64_t> lights,
                            const glm::dquat& rotation) {
    return moved(scene, from, lights, [&](std::uint64_t light) {
        return RigidMotion{rotation, positionOf(from, light), glm::dvec3(0.0)};
    });
}

Result<Edits> editsForPosition(const Scene& scene, const Scene& from, std::span<const std::uint64_t> lights,
                               int axis, const ValueEntry& entry) {
    if (entry.how == ValueEntry::How::Clear) return Error{"expected a number: a position cannot be left out"};
    const EditField& field = *findEditField(EditTarget::Light, "transform");
    Edits edits;
    for (const std::uint64_t light : carriers(from, lights)) {
        const Node& node = nodeOf(from, light);
        glm::dvec3 position = positionOf(from, light);
        position[axis] = changed(position[axis], entry);
        // Not by a difference: what was typed is what the file gets.
        const glm::dvec3 local =
            node.parent < 0
                ? position
                : glm::dvec3(glm::inverse(worldFromParent(from, node)) * glm::dvec4(position, 1.0));
        EditValue value;
        if (node.restTrs) {
            Trs trs = *node.restTrs;
            trs.translation = local;
            value = trs;
        } else {
            glm::dmat4 matrix = node.localFromNode;
            matrix[3] = glm::dvec4(local, 1.0);
            value = matrix;
        }
        Result<Edits> each = setField(scene, EditTarget::Light, light, field, std::move(value));
        if (!each) return each;
        edits.insert(edits.end(), each.value().begin(), each.value().end());
    }
    return edits;
}

Result<Edits> editsForAngle(const Scene& scene, const Scene& from, std::span<const std::uint64_t> lights,
                            int axis, const ValueEntry& entry, const glm::dvec3& nearRad) {
    if (entry.how == ValueEntry::How::Clear) return Error{"expected a number: an angle cannot be left out"};
    return moved(scene, from, lights, [&](std::uint64_t light) {
        const glm::dquat before = rotationOf(from, light);
        glm::dvec3 angles = eulerFrom(before, nearRad);
        angles[axis] = changed(angles[axis], entry);
        return RigidMotion{glm::normalize(quatFrom(angles) * glm::inverse(before)), positionOf(from, light),
                           glm::dvec3(0.0)};
    });
}

} // namespace kilolux
