// Builds one bounding volume hierarchy over triangles and lays it out as the shaders read it
// (shaders/shared/bvh.h). Embree's builder chooses the tree by the surface area heuristic; the boxes are then
// rounded outwards onto a grid of 16 bits per axis, so that no hit is ever lost.
#pragma once

#include "renderer/accel/triangle_soup.h"
#include "shaders/shared/bvh.h"

#include <cstddef>
#include <vector>

namespace kilolux {

struct Box {
    glm::vec3 lower{0.0f};
    glm::vec3 upper{0.0f};
};

// Planes at min + step * q, q of 0 to 65535. Boxes keep 1/16 of a step to the planes: more than the rounding
// error of the plane distances for rays that start within ten extents of the grid; farther ones are covered
// by the relative slack of the slab test (shaders/lib/trace_core.glsl).
struct BoxGrid {
    glm::vec3 min{0.0f};
    glm::vec3 step{1.0f};
};
BoxGrid gridOver(const Box& bounds);
glm::uvec3 quantizeBox(const Box& box, const BoxGrid& grid); // low plane in the low half word

struct Bvh {
    std::vector<shared::BvhNode> nodes;
    std::vector<shared::BvhPair> pairs;
    std::vector<glm::uvec2> pairIds;
    std::uint32_t rootRef = shared::BVH_REF_DONE; // references count from the first node and pair of this BVH
    BoxGrid grid;
    Box bounds;
    std::uint32_t triangleCount = 0;
    std::uint32_t depth = 0;   // inner nodes on the longest path
    double sahCost = 0.0;      // expected node visits + pair tests of a ray through the root
    double pairMs = 0.0;
    double buildMs = 0.0;      // Embree's builder
    double flattenMs = 0.0;
};

Bvh buildBvh(const std::vector<SoupTriangle>& triangles);

// Shifts the node and pair indices of a reference, for several BVHs in one buffer.
std::uint32_t rebasedRef(std::uint32_t ref, std::uint32_t firstNode, std::uint32_t firstPair);

} // namespace kilolux
