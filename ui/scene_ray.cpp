// Triangles after Möller and Trumbore, Fast, Minimum Storage Ray/Triangle Intersection (1997), in the mesh's
// own space.
#include "ui/scene_ray.h"

#include <algorithm>
#include <cmath>

namespace kilolux {

namespace {

bool meetsBox(const ViewRay& ray, const glm::dvec3& low, const glm::dvec3& high, double most) {
    double enter = 0.0, leave = most;
    for (int axis = 0; axis < 3; ++axis) {
        const double inverse = 1.0 / ray.dirWs[axis]; // infinite ones compare as they should
        double a = (low[axis] - ray.originWs[axis]) * inverse,
               b = (high[axis] - ray.originWs[axis]) * inverse;
        if (a > b) std::swap(a, b);
        if (a > enter) enter = a; // not for NaN
        if (b < leave) leave = b;
    }
    return enter <= leave;
}

// The nearest triangle of a primitive before `most`; both in units of the ray's direction.
bool meetsPrimitive(const Primitive& primitive, const ViewRay& ray, double& most, glm::dvec3& normal) {
    if (!meetsBox(ray, primitive.boundsMin, primitive.boundsMax, most)) return false;
    bool found = false;
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const glm::dvec3 a(primitive.positions[primitive.indices[i]]);
        const glm::dvec3 ab = glm::dvec3(primitive.positions[primitive.indices[i + 1]]) - a;
        const glm::dvec3 ac = glm::dvec3(primitive.positions[primitive.indices[i + 2]]) - a;
        const glm::dvec3 p = glm::cross(ray.dirWs, ac);
        const double determinant = glm::dot(ab, p);
        if (determinant == 0.0) continue;
        const glm::dvec3 s = ray.originWs - a;
        const double u = glm::dot(s, p) / determinant;
        if (!(u >= 0.0 && u <= 1.0)) continue;
        const glm::dvec3 q = glm::cross(s, ab);
        const double v = glm::dot(ray.dirWs, q) / determinant;
        if (!(v >= 0.0 && u + v <= 1.0)) continue;
        const double t = glm::dot(ac, q) / determinant;
        if (!(t > 0.0 && t < most)) continue;
        most = t;
        normal = glm::cross(ab, ac);
        found = true;
    }
    return found;
}

} // namespace

std::optional<SurfaceHit> nearestSurface(const Scene& scene, const ViewRay& ray) {
    std::optional<SurfaceHit> hit;
    double most = std::numeric_limits<double>::infinity();
    for (const Node& node : scene.nodes) {
        if (!node.visible || node.mesh < 0) continue;
        const glm::dmat4 inverse = glm::inverse(node.worldFromNode);
        // Not normalized: distances stay those of the world.
        const ViewRay local{glm::dvec3(inverse * glm::dvec4(ray.originWs, 1.0)),
                            glm::dvec3(inverse * glm::dvec4(ray.dirWs, 0.0))};
        for (const Primitive& primitive : scene.meshes[std::size_t(node.mesh)]->primitives) {
            glm::dvec3 normal(0.0);
            if (!meetsPrimitive(primitive, local, most, normal)) continue;
            hit.emplace();
            hit->distanceM = most;
            hit->pointWs = ray.originWs + most * ray.dirWs;
            normal = glm::transpose(glm::dmat3(inverse)) * normal;
            hit->normalWs = glm::normalize(glm::dot(normal, ray.dirWs) > 0.0 ? -normal : normal);
        }
    }
    return hit;
}

} // namespace kilolux
