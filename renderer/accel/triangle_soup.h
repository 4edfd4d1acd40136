// Flattens instances into triangles for the BVH builder: static ones in anchor-relative world space, moving
// ones in their own space.
#pragma once

#include "renderer/accel/instances.h"

#include <glm/glm.hpp>
#include <vector>

namespace kilolux {

struct SoupTriangle {
    glm::vec3 position[3]; // metres; counter-clockwise seen from the front
    std::uint32_t id = 0; // of the triangle within its primitive, plus Instance::firstTriangle in world space
    bool swapped = false; // position[1] and [2] were exchanged, because the transform mirrors
    bool alphaTested = false;
};

// Triangles of one instance in world space minus `anchor`; the sum is made in double and rounded once. Those
// with a coordinate that is not finite are left out.
void appendWorldTriangles(const Scene& scene, const Instance& instance, const glm::dvec3& anchor,
                          std::vector<SoupTriangle>& triangles);

// Triangles of one instance in the space of its mesh; ids count from 0.
void appendLocalTriangles(const Scene& scene, const Instance& instance, std::vector<SoupTriangle>& triangles);

} // namespace kilolux
