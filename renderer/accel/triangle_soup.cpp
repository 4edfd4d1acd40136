// Flattens instances into triangles.
#include "renderer/accel/triangle_soup.h"

#include <utility>

namespace kilolux {

namespace {

bool isFinite(const glm::vec3& v) {
    // NaN and infinity both fail: x - x is then NaN.
    return v.x - v.x == 0.0f && v.y - v.y == 0.0f && v.z - v.z == 0.0f;
}

template<typename Transform>
void append(const Scene& scene, const Instance& instance, std::uint32_t firstId, bool mirrored,
            const Transform& transform, std::vector<SoupTriangle>& triangles) {
    const Primitive& primitive = primitiveOf(scene, instance);
    for (std::uint32_t t = 0; t < instance.triangleCount; ++t) {
        SoupTriangle triangle;
        bool finite = true;
        for (int corner = 0; corner < 3; ++corner) {
            triangle.position[corner] = transform(primitive.positions[primitive.indices[t * 3 + corner]]);
            finite = finite && isFinite(triangle.position[corner]);
        }
        if (!finite) continue;
        triangle.id = firstId + t;
        triangle.alphaTested = instance.role == SurfaceRole::AlphaTested;
        triangle.swapped = mirrored;
        if (mirrored) std::swap(triangle.position[1], triangle.position[2]);
        triangles.push_back(triangle);
    }
}

} // namespace

void appendWorldTriangles(const Scene& scene, const Instance& instance, const glm::dvec3& anchor,
                          std::vector<SoupTriangle>& triangles) {
    glm::dmat4 anchoredFromLocal = instance.worldFromLocal;
    anchoredFromLocal[3] -= glm::dvec4(anchor, 0.0);
    const bool mirrored = glm::determinant(glm::dmat3(anchoredFromLocal)) < 0.0;
    append(
        scene, instance, instance.firstTriangle, mirrored,
        [&](const glm::vec3& p) { return glm::vec3(anchoredFromLocal * glm::dvec4(glm::dvec3(p), 1.0)); },
        triangles);
}

void appendLocalTriangles(const Scene& scene, const Instance& instance,
                          std::vector<SoupTriangle>& triangles) {
    append(
        scene, instance, 0, false, [](const glm::vec3& p) { return p; }, triangles);
}

} // namespace kilolux
