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

// A part of a BVH that is small and dense against the grid of the whole, and so has its own.
struct SubGrid {
    BoxGrid grid;
    std::uint32_t rootRef = shared::BVH_REF_DONE;
};

enum class SubGrids { Allowed, None };

struct Bvh {
    std::vector<shared::BvhNode> nodes;
    std::vector<shared::BvhPair> pairs;
    std::vector<glm::uvec2> pairIds;
    std::uint32_t rootRef = shared::BVH_REF_DONE; // references count from the first node and pair of this BVH
    std::vector<SubGrid> subGrids;                // an enter reference counts from the first of these
    BoxGrid grid;
    Box bounds;
    std::uint32_t triangleCount = 0;
    std::uint32_t depth = 0; // inner nodes and sub-grids on the longest path
    double sahCost = 0.0;    // expected node visits + pair tests of a ray through the root
    double pairMs = 0.0;
    double buildMs = 0.0; // Embree's builder
    double flattenMs = 0.0;
};

Bvh buildBvh(const std::vector<SoupTriangle>& triangles, SubGrids subGrids = SubGrids::None);

// Where the parts of a BVH begin when several share one set of buffers.
struct BvhPlace {
    std::uint32_t firstNode = 0;
    std::uint32_t firstPair = 0;
    std::uint32_t firstEntry = 0; // of its sub-grids
};
std::uint32_t rebasedRef(std::uint32_t ref, const BvhPlace& place);

} // namespace kilolux
