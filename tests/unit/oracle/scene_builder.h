// Small scenes made in code for the oracle's tests.
#pragma once

#include "renderer/document/scene.h"
#include "renderer/reference/oracle.h"
#include "renderer/reference/oracle_light.h"

#include <glm/gtc/matrix_transform.hpp>

namespace kilolux::oracle {

class SceneBuilder {
  public:
    Scene scene;

    int material(const glm::dvec3& baseColor, double metallic = 0.0, double roughness = 1.0) {
        Material m;
        m.baseColorFactor = glm::dvec4(baseColor, 1.0);
        m.metallicFactor = metallic;
        m.roughnessFactor = roughness;
        scene.materials.push_back(m);
        return static_cast<int>(scene.materials.size()) - 1;
    }

    int node(const glm::dmat4& worldFromNode) {
        Node n;
        n.localFromNode = n.worldFromNode = worldFromNode;
        scene.nodes.push_back(n);
        return static_cast<int>(scene.nodes.size()) - 1;
    }

    // A rectangle in the local XY plane, front side to +Z, uv (0,0) at its upper left corner.
    int quad(const glm::dmat4& worldFromNode, double width, double height, int materialIndex) {
        Primitive p;
        const float x = static_cast<float>(0.5 * width);
        const float y = static_cast<float>(0.5 * height);
        p.positions = {{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}};
        p.normals.assign(4, {0, 0, 1});
        p.tangents.assign(4, {1, 0, 0, 1});
        p.uv0 = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
        p.indices = {0, 1, 2, 0, 2, 3};
        p.material = materialIndex;
        p.boundsMin = {-x, -y, 0};
        p.boundsMax = {x, y, 0};
        Mesh mesh;
        mesh.primitives.push_back(p);
        scene.meshes.push_back(std::make_shared<Mesh>(mesh));
        const int index = node(worldFromNode);
        scene.nodes[index].mesh = static_cast<int>(scene.meshes.size()) - 1;
        return index;
    }

    int light(const LightDef& def, const glm::dmat4& worldFromNode) {
        scene.lightDefs.push_back(def);
        const int at = node(worldFromNode);
        scene.lights.push_back({.node = at, .def = static_cast<int>(scene.lightDefs.size()) - 1});
        return static_cast<int>(scene.lights.size()) - 1;
    }
};

// A node at `position` whose local -Z looks along `direction`.
inline glm::dmat4 lookingAlong(const glm::dvec3& position, const glm::dvec3& direction) {
    const glm::dvec3 z = -glm::normalize(direction);
    const glm::dvec3 up = std::abs(z.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 x = glm::normalize(glm::cross(up, z));
    glm::dmat4 m(1.0);
    m[0] = glm::dvec4(x, 0.0);
    m[1] = glm::dvec4(glm::cross(z, x), 0.0);
    m[2] = glm::dvec4(z, 0.0);
    m[3] = glm::dvec4(position, 1.0);
    return m;
}

inline LightDef lightDef(LightType type, double intensity, LightUnit unit) {
    LightDef def;
    def.type = type;
    def.intensity = intensity;
    def.unit = unit;
    return def;
}

inline OraclePoint pointAt(const glm::dvec3& position, const glm::dvec3& normal) {
    OraclePoint point;
    point.positionWs = position;
    point.geometricNormalWs = point.shadingNormalWs = point.viewDirWs = glm::normalize(normal);
    return point;
}

} // namespace kilolux::oracle
