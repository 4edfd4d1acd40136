// Everything that rays can hit, in the form that shaders/lib/trace.glsl binds: one BVH over all static
// geometry, one per mesh primitive that moves, and a small top level over the moving instances that is
// rewritten whenever one of them has moved.
#pragma once

#include "renderer/accel/alpha_masks.h"
#include "renderer/accel/bvh.h"
#include "renderer/accel/instances.h"

#include <cstddef>
#include <vector>

namespace kilolux {

struct BvhStats {
    std::size_t staticTriangles = 0;
    std::size_t movingTriangles = 0; // of the BVHs: shared meshes counted once
    std::size_t pairs = 0;
    std::size_t nodes = 0;
    std::uint32_t depth = 0;
    double sahCost = 0.0; // static BVH: expected node visits + pair tests per ray
    double flattenSceneMs = 0.0;
    double pairMs = 0.0;
    double buildMs = 0.0;
    double flattenMs = 0.0;
    std::size_t nodeBytes = 0;
    std::size_t triangleBytes = 0; // pairs and their ids
    std::size_t alphaBytes = 0;
    std::size_t otherBytes = 0;
    double bytesPerTriangle = 0.0; // nodes and triangles together, per triangle in the BVHs
};

struct RayWorld {
    // Buffers, one for each texel buffer of shaders/lib/trace.glsl.
    std::vector<shared::BvhNode> nodes; // the first topNodeCapacity are the top level's
    std::vector<shared::BvhPair> pairs;
    std::vector<glm::uvec2> pairIds;
    std::vector<shared::BvhEntry> entries; // [0] the world, where every ray starts
    std::vector<shared::TraceInstance> instances;
    AlphaMasks alpha;

    std::uint32_t topNodeCapacity = 0;
    BvhStats stats;

    bool hasAlpha() const { return !alpha.records.empty(); }

    // The pairs of one BVH.
    struct PairRange {
        std::uint32_t first = 0;
        std::uint32_t count = 0;
    };

    // One placed BVH of a moving instance; its entry is kFirstMovingEntry + its index here.
    static constexpr std::uint32_t kStaticEntry = 1;
    static constexpr std::uint32_t kFirstMovingEntry = 2;
    struct Moving {
        std::uint32_t instance = 0;
        PairRange pairRange;
        glm::dmat4 anchoredFromLocal{1.0}; // as of the last updateInstances()
        bool placed = false;               // false: its transform squashes it to nothing
        Box localBounds;
        BoxGrid grid;
        std::uint32_t rootRef = shared::BVH_REF_DONE;
    };
    std::vector<Moving> moving;
    PairRange staticPairs;
    Box staticBounds; // relative to `staticAnchor`
    BoxGrid staticGrid;
    std::vector<SubGrid> staticSubGrids; // their entries come behind those of the moving instances
    std::uint32_t firstSubGridEntry = 0;
    std::uint32_t staticRootRef = shared::BVH_REF_DONE;
    glm::dvec3 staticAnchor{0.0}; // what was subtracted from the static triangles
    glm::vec3 staticPivot{0.0f};  // staticAnchor minus the present anchor
};

// `moving[i]` says that instance i shall be movable: its BVH is per mesh primitive and placed by a transform.
// An empty vector means that all are static. Coordinates on the GPU are world minus `anchor`.
RayWorld buildWorld(const Scene& scene, const std::vector<Instance>& instances,
                    const std::vector<bool>& moving, const glm::dvec3& anchor);

// Takes over the transforms of the moving instances, and a new anchor if it has changed: rewrites `entries`
// and the first topNodeCapacity `nodes`, nothing else. O(moving instances).
void updateInstances(RayWorld& world, const std::vector<Instance>& instances, const glm::dvec3& anchor);

// Takes over the lighting channels of the instances' meshes: rewrites `instances` of the world.
void updateChannels(RayWorld& world, const Scene& scene, const std::vector<Instance>& instances);

} // namespace kilolux
