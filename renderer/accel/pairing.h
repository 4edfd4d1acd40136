// Joins triangles that share an edge into pairs, the primitive that the tracer tests: four corners instead of
// six, so less memory and fewer projections per triangle.
#pragma once

#include "renderer/accel/triangle_soup.h"
#include "shaders/shared/bvh.h"

#include <vector>

namespace kilolux {

struct TrianglePairs {
    std::vector<shared::BvhPair> pairs;
    std::vector<glm::uvec2> ids; // BvhPair ids as shaders/shared/bvh.h packs them
};

// Every triangle lands in exactly one pair. Neighbours that wind alike, are both opaque or both alpha-tested,
// and whose common box is not much larger than their own two boxes are joined.
TrianglePairs pairTriangles(const std::vector<SoupTriangle>& triangles);

} // namespace kilolux
