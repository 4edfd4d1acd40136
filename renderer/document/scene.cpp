// World transforms and measures of the document. Nothing here recurses or trusts the node graph to be a
// forest: the editor may hold a broken one between two edits.
#include "renderer/document/scene.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

namespace kilolux {

std::array<glm::dvec3, 4> barnDoorCorners(const LightDef& def, BarnDoorSide side) {
    const BarnDoor& door = def.barnDoors[static_cast<std::size_t>(side)];
    const bool isAcross = side == BarnDoorSide::Left || side == BarnDoorSide::Right; // local X
    const double sign = side == BarnDoorSide::Right || side == BarnDoorSide::Top ? 1.0 : -1.0;
    const glm::dvec3 out = isAcross ? glm::dvec3(sign, 0, 0) : glm::dvec3(0, sign, 0);
    const glm::dvec3 along =
        isAcross ? glm::dvec3(0, 0.5 * def.heightM, 0) : glm::dvec3(0.5 * def.widthM, 0, 0);
    const glm::dvec3 hinge = out * (0.5 * (isAcross ? def.widthM : def.heightM));
    const glm::dvec3 free = hinge + door.lengthM * (std::sin(door.angleRad) * out -
                                                    std::cos(door.angleRad) * glm::dvec3(0, 0, 1));
    return {hinge - along, hinge + along, free + along, free - along};
}

void updateWorldTransforms(Scene& scene) {
    enum class State : std::uint8_t { Unknown, OnPath, Done };
    const int count = static_cast<int>(scene.nodes.size());
    std::vector<State> states(scene.nodes.size(), State::Unknown);
    std::vector<int> path; // from a node up to its first ancestor whose transform is known
    for (int start = 0; start < count; ++start) {
        int node = start;
        while (node >= 0 && node < count && states[node] == State::Unknown) {
            states[node] = State::OnPath;
            path.push_back(node);
            node = scene.nodes[node].parent;
        }
        // A parent that is on the path itself closes a cycle: its first node is treated as a root.
        const bool hasParent = node >= 0 && node < count && states[node] == State::Done;
        glm::dmat4 worldFromParent = hasParent ? scene.nodes[node].worldFromNode : glm::dmat4(1.0);
        for (; !path.empty(); path.pop_back()) {
            Node& current = scene.nodes[path.back()];
            current.worldFromNode = worldFromParent * current.localFromNode;
            worldFromParent = current.worldFromNode;
            states[path.back()] = State::Done;
        }
    }
}

glm::dmat4 matrixFrom(const Trs& trs) {
    const glm::dmat4 moved = glm::translate(glm::dmat4(1.0), trs.translation);
    return glm::scale(moved * glm::mat4_cast(trs.rotation), trs.scale);
}

bool fitsSinglePrecision(const glm::dmat4& matrix) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            if (!(std::abs(matrix[column][row]) < 1e18)) return false;
        }
    }
    return true;
}

glm::dmat4 rigidFrame(const glm::dmat4& worldFromNode) {
    const glm::dvec3 z = glm::dvec3(worldFromNode[2]), y = glm::dvec3(worldFromNode[1]);
    glm::dmat4 result(1.0);
    const glm::dvec3 x = glm::cross(y, z);
    if (glm::length(z) > 0.0 && glm::length(x) > 0.0) {
        result[2] = glm::dvec4(glm::normalize(z), 0.0);
        result[0] = glm::dvec4(glm::normalize(x), 0.0);
        result[1] = glm::dvec4(glm::cross(glm::dvec3(result[2]), glm::dvec3(result[0])), 0.0);
    }
    result[3] = glm::dvec4(glm::dvec3(worldFromNode[3]), 1.0);
    return result;
}

glm::dvec3 groupFactor(const Scene& scene, const LightNode& light) {
    if (light.group == 0) return glm::dvec3(1.0);
    for (const LightGroup& group : scene.groups) {
        if (group.id != light.group) continue;
        return group.muted ? glm::dvec3(0.0) : group.tint * group.intensity * std::exp2(group.exposureEv);
    }
    return glm::dvec3(1.0);
}

namespace {

const Mesh* visibleMesh(const Scene& scene, const Node& node) {
    if (!node.visible || node.mesh < 0 || node.mesh >= static_cast<int>(scene.meshes.size())) return nullptr;
    return scene.meshes[node.mesh].get();
}

} // namespace

Bounds worldBounds(const Scene& scene) {
    const double inf = std::numeric_limits<double>::infinity();
    Bounds bounds{glm::dvec3(inf), glm::dvec3(-inf)};
    for (const Node& node : scene.nodes) {
        const Mesh* mesh = visibleMesh(scene, node);
        if (!mesh) continue;
        for (const Primitive& primitive : mesh->primitives) {
            if (primitive.indices.empty()) continue;
            for (int corner = 0; corner < 8; ++corner) {
                const glm::dvec3 local(corner & 1 ? primitive.boundsMax.x : primitive.boundsMin.x,
                                       corner & 2 ? primitive.boundsMax.y : primitive.boundsMin.y,
                                       corner & 4 ? primitive.boundsMax.z : primitive.boundsMin.z);
                const glm::dvec3 world(node.worldFromNode * glm::dvec4(local, 1.0));
                bounds.min = glm::min(bounds.min, world);
                bounds.max = glm::max(bounds.max, world);
            }
        }
    }
    return bounds.min.x <= bounds.max.x ? bounds : Bounds{};
}

std::size_t triangleCount(const Scene& scene) {
    std::size_t count = 0;
    for (const Node& node : scene.nodes) {
        const Mesh* mesh = visibleMesh(scene, node);
        if (!mesh) continue;
        for (const Primitive& primitive : mesh->primitives)
            count += primitive.indices.size() / 3;
    }
    return count;
}

} // namespace kilolux
