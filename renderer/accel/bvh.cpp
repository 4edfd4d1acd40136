// Build by Embree (rtcBuildBVH), flatten, quantize.
#include "renderer/accel/bvh.h"

#include "renderer/accel/pairing.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace kilolux {

namespace {

using namespace shared;

// Depth at which Embree stops splitting by cost and halves: bounds the traversal stack whatever the input.
constexpr unsigned kMaxDepth = 40;
constexpr unsigned kLeafPairs = 4;
// A pair costs the shader about this much of a node visit.
constexpr float kPairCost = 1.0f;
// Boxes of pairs are some cells wide on a grid that fits. Where a subtree has so many pairs that one is left
// with fewer cells of its surface than this, rays would visit most of it: it gets a grid of its own, if that
// is finer by kSubGridGain. So a detailed thing of a centimetre stays cheap in a world of 10 km.
constexpr double kSubGridCellsPerPair = 16.0;
constexpr double kSubGridGain = 16.0;
constexpr std::uint32_t kSubGridPairs = 32;
constexpr std::uint32_t kMaxSubGridNesting = 3; // each level takes a place on the traversal stack

Box boxOf(const RTCBounds& b) {
    return {{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}};
}

Box unionOf(const Box& a, const Box& b) {
    return {glm::min(a.lower, b.lower), glm::max(a.upper, b.upper)};
}

double halfAreaOf(const Box& box) {
    const glm::dvec3 size = glm::dvec3(box.upper) - glm::dvec3(box.lower);
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

// What the callbacks hand to Embree; leaves have no children.
struct BuildNode {
    BuildNode* child[2] = {nullptr, nullptr};
    Box childBox[2];
    std::uint32_t pairsUnder = 0;
    std::uint32_t pairCount = 0; // of a leaf
    std::uint32_t pair[BVH_MAX_LEAF_PAIRS];
};

void* createNode(RTCThreadLocalAllocator allocator, unsigned, void*) {
    return new (rtcThreadLocalAlloc(allocator, sizeof(BuildNode), 16)) BuildNode;
}
void setChildren(void* node, void** children, unsigned count, void*) {
    for (unsigned i = 0; i < count; ++i)
        static_cast<BuildNode*>(node)->child[i] = static_cast<BuildNode*>(children[i]);
}
void setBounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
    for (unsigned i = 0; i < count; ++i)
        static_cast<BuildNode*>(node)->childBox[i] = boxOf(*bounds[i]);
}
void* createLeaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, size_t count,
                 void*) {
    BuildNode* leaf = new (rtcThreadLocalAlloc(allocator, sizeof(BuildNode), 16)) BuildNode;
    leaf->pairCount = std::uint32_t(count);
    for (size_t i = 0; i < count; ++i)
        leaf->pair[i] = primitives[i].primID;
    return leaf;
}

std::vector<RTCBuildPrimitive> buildPrimitives(const std::vector<BvhPair>& pairs) {
    std::vector<RTCBuildPrimitive> primitives(pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const BvhPair& p = pairs[i];
        const glm::vec3 lower = glm::min(glm::min(p.a, p.b), glm::min(p.c, p.d));
        const glm::vec3 upper = glm::max(glm::max(p.a, p.b), glm::max(p.c, p.d));
        primitives[i] = {lower.x, lower.y, lower.z, 0, upper.x, upper.y, upper.z, unsigned(i)};
    }
    return primitives;
}

Box boundsOf(const std::vector<RTCBuildPrimitive>& primitives) {
    Box bounds{glm::vec3(INFINITY), glm::vec3(-INFINITY)};
    for (const RTCBuildPrimitive& p : primitives)
        bounds = unionOf(bounds, {{p.lower_x, p.lower_y, p.lower_z}, {p.upper_x, p.upper_y, p.upper_z}});
    return bounds;
}

void onEmbreeError(void*, RTCError code, const char* message) {
    std::fprintf(stderr, "Embree failed with code %d: '%s'\n", int(code), message);
    std::abort();
}

std::uint32_t countPairs(BuildNode& node) {
    node.pairsUnder =
        node.pairCount > 0 ? node.pairCount : countPairs(*node.child[0]) + countPairs(*node.child[1]);
    return node.pairsUnder;
}

// Writes the tree depth first: a node's first child follows it, pairs lie in leaf order.
class Flattener {
  public:
    Flattener(const TrianglePairs& source, Bvh& target, SubGrids subGrids)
        : source_(source), target_(target), subGrids_(subGrids) {}

    std::uint32_t flatten(const BuildNode& node, const Box& box, const BoxGrid& grid, std::uint32_t depth) {
        target_.depth = std::max(target_.depth, depth);
        if (node.pairCount > 0) return flattenLeaf(node, box);
        if (wantsSubGrid(node, box, grid)) {
            const std::uint32_t index = std::uint32_t(target_.subGrids.size());
            const BoxGrid own = gridOver(box);
            target_.subGrids.push_back({own, BVH_REF_DONE});
            ++nesting_;
            const std::uint32_t rootRef = flattenInner(node, box, own, depth + 1);
            --nesting_;
            target_.subGrids[index].rootRef = rootRef;
            return BVH_REF_ENTER | index;
        }
        return flattenInner(node, box, grid, depth);
    }

  private:
    std::uint32_t flattenInner(const BuildNode& node, const Box& box, const BoxGrid& grid,
                               std::uint32_t depth) {
        target_.sahCost += halfAreaOf(box);
        const std::uint32_t index = std::uint32_t(target_.nodes.size());
        target_.nodes.emplace_back();
        const std::uint32_t ref0 = flatten(*node.child[0], node.childBox[0], grid, depth + 1);
        const std::uint32_t ref1 = flatten(*node.child[1], node.childBox[1], grid, depth + 1);
        target_.nodes[index] = {quantizeBox(node.childBox[0], grid), ref0,
                                quantizeBox(node.childBox[1], grid), ref1};
        return index;
    }

    bool wantsSubGrid(const BuildNode& node, const Box& box, const BoxGrid& grid) const {
        if (subGrids_ == SubGrids::None || nesting_ == kMaxSubGridNesting || node.pairsUnder < kSubGridPairs)
            return false;
        const glm::dvec3 cells =
            (glm::dvec3(box.upper) - glm::dvec3(box.lower)) / glm::dvec3(grid.step) + 2.0;
        const double widest = std::max({cells.x, cells.y, cells.z});
        const double surface = cells.x * cells.y + cells.y * cells.z + cells.z * cells.x;
        return widest * kSubGridGain <= 65535.0 && double(node.pairsUnder) * kSubGridCellsPerPair > surface;
    }

    std::uint32_t flattenLeaf(const BuildNode& leaf, const Box& box) {
        target_.sahCost += halfAreaOf(box) * leaf.pairCount;
        const std::uint32_t first = std::uint32_t(target_.pairs.size());
        for (std::uint32_t i = 0; i < leaf.pairCount; ++i) {
            target_.pairs.push_back(source_.pairs[leaf.pair[i]]);
            target_.pairIds.push_back(source_.ids[leaf.pair[i]]);
        }
        return BVH_REF_LEAF | (leaf.pairCount - 1u) << BVH_LEAF_COUNT_SHIFT | first;
    }

    const TrianglePairs& source_;
    Bvh& target_;
    SubGrids subGrids_;
    std::uint32_t nesting_ = 0;
};

RTCBuildArguments buildArguments(RTCBVH bvh, std::vector<RTCBuildPrimitive>& primitives) {
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
    arguments.maxBranchingFactor = 2;
    arguments.maxDepth = kMaxDepth;
    arguments.sahBlockSize = 1;
    arguments.minLeafSize = 1;
    arguments.maxLeafSize = kLeafPairs;
    arguments.traversalCost = 1.0f;
    arguments.intersectionCost = kPairCost;
    arguments.bvh = bvh;
    arguments.primitives = primitives.data();
    arguments.primitiveCount = primitives.size();
    arguments.primitiveArrayCapacity = primitives.size();
    arguments.createNode = createNode;
    arguments.setNodeChildren = setChildren;
    arguments.setNodeBounds = setBounds;
    arguments.createLeaf = createLeaf;
    return arguments;
}

double msSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

} // namespace

BoxGrid gridOver(const Box& bounds) {
    BoxGrid grid;
    for (int axis = 0; axis < 3; ++axis) {
        const double lower = bounds.lower[axis], upper = bounds.upper[axis];
        // Not finer than the floats that it has to separate, nor than a normal number.
        const double finest = std::max({std::abs(lower), std::abs(upper), 1e-20}) * 0x1p-24;
        // Four steps to spare on either side for rounding of the step, the minimum and the kept sixteenth.
        grid.step[axis] = float(std::max((upper - lower) / 65527.0, finest));
        grid.min[axis] = float(lower - 4.0 * double(grid.step[axis]));
    }
    return grid;
}

glm::uvec3 quantizeBox(const Box& box, const BoxGrid& grid) {
    constexpr double kKeep = 1.0 / 16.0;
    glm::uvec3 packed;
    for (int axis = 0; axis < 3; ++axis) {
        const double min = grid.min[axis], step = grid.step[axis];
        const double low = std::floor((double(box.lower[axis]) - min) / step - kKeep);
        const double high = std::ceil((double(box.upper[axis]) - min) / step + kKeep);
        assert(low >= 0.0 && high <= 65535.0 && "the box lies within the grid");
        packed[axis] = std::uint32_t(low) | std::uint32_t(high) << 16;
    }
    return packed;
}

std::uint32_t rebasedRef(std::uint32_t ref, const BvhPlace& place) {
    if (ref == BVH_REF_DONE) return ref;
    if (ref >= BVH_REF_ENTER) return ref + place.firstEntry;
    return ref + (ref >= BVH_REF_LEAF ? place.firstPair : place.firstNode);
}

Bvh buildBvh(const std::vector<SoupTriangle>& triangles, SubGrids subGrids) {
    Bvh result;
    result.triangleCount = std::uint32_t(triangles.size());
    if (triangles.empty()) return result;
    auto start = std::chrono::steady_clock::now();
    const TrianglePairs pairs = pairTriangles(triangles);
    std::vector<RTCBuildPrimitive> primitives = buildPrimitives(pairs.pairs);
    result.bounds = boundsOf(primitives);
    result.grid = gridOver(result.bounds);
    result.pairMs = msSince(start);

    start = std::chrono::steady_clock::now();
    RTCDevice device = rtcNewDevice(nullptr);
    rtcSetDeviceErrorFunction(device, onEmbreeError, nullptr);
    RTCBVH bvh = rtcNewBVH(device);
    const RTCBuildArguments arguments = buildArguments(bvh, primitives);
    BuildNode* root = static_cast<BuildNode*>(rtcBuildBVH(&arguments));
    assert(root && "Embree built a tree");
    countPairs(*root);
    result.buildMs = msSince(start);

    start = std::chrono::steady_clock::now();
    result.pairs.reserve(pairs.pairs.size());
    result.pairIds.reserve(pairs.pairs.size());
    result.nodes.reserve(pairs.pairs.size() / 2);
    result.rootRef = Flattener(pairs, result, subGrids).flatten(*root, result.bounds, result.grid, 0);
    result.nodes.shrink_to_fit();
    const double rootArea = halfAreaOf(result.bounds);
    result.sahCost = rootArea > 0.0 ? result.sahCost / rootArea : 0.0;
    assert(result.depth <= kMaxDepth + kMaxSubGridNesting);
    rtcReleaseBVH(bvh);
    rtcReleaseDevice(device);
    result.flattenMs = msSince(start);
    return result;
}

} // namespace kilolux
