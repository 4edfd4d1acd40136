// Assembles the BVHs of a scene and keeps the top level over moving instances.
#include "renderer/accel/ray_world.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <map>

namespace kilolux {

namespace {

using namespace shared;

constexpr std::uint32_t kWorldEntry = 0;
constexpr std::uint32_t kStaticEntry = RayWorld::kStaticEntry;
constexpr std::uint32_t kFirstMovingEntry = RayWorld::kFirstMovingEntry;

double msSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

template<typename T>
void appendTo(std::vector<T>& target, const std::vector<T>& source) {
    target.insert(target.end(), source.begin(), source.end());
}

// Copies a BVH behind those already there and returns its root reference.
std::uint32_t appendBvh(RayWorld& world, const Bvh& bvh, std::uint32_t firstEntry) {
    const BvhPlace place{std::uint32_t(world.nodes.size()), std::uint32_t(world.pairs.size()), firstEntry};
    assert(place.firstPair + bvh.pairs.size() <= BVH_LEAF_FIRST_MASK && "pair indices fit their bits");
    for (BvhNode node : bvh.nodes) {
        node.ref0 = rebasedRef(node.ref0, place);
        node.ref1 = rebasedRef(node.ref1, place);
        world.nodes.push_back(node);
    }
    for (const SubGrid& part : bvh.subGrids)
        world.staticSubGrids.push_back({part.grid, rebasedRef(part.rootRef, place)});
    appendTo(world.pairs, bvh.pairs);
    appendTo(world.pairIds, bvh.pairIds);
    world.stats.depth = std::max(world.stats.depth, bvh.depth);
    world.stats.pairMs += bvh.pairMs;
    world.stats.buildMs += bvh.buildMs;
    world.stats.flattenMs += bvh.flattenMs;
    return rebasedRef(bvh.rootRef, place);
}

void buildStatic(RayWorld& world, const Scene& scene, const std::vector<Instance>& instances,
                 const std::vector<bool>& moving, std::uint32_t firstSubGridEntry, const glm::dvec3& anchor) {
    const auto start = std::chrono::steady_clock::now();
    std::vector<SoupTriangle> triangles;
    for (std::size_t i = 0; i < instances.size(); ++i)
        if (instances[i].role != SurfaceRole::Absent && !moving[i])
            appendWorldTriangles(scene, instances[i], anchor, triangles);
    world.stats.flattenSceneMs = msSince(start);
    world.stats.staticTriangles = triangles.size();
    const Bvh bvh = buildBvh(triangles, SubGrids::Allowed);
    world.staticAnchor = anchor;
    world.staticBounds = bvh.bounds;
    world.staticGrid = bvh.grid;
    world.stats.sahCost = bvh.sahCost;
    world.staticPairs = {std::uint32_t(world.pairs.size()), std::uint32_t(bvh.pairs.size())};
    world.staticRootRef = appendBvh(world, bvh, firstSubGridEntry);
}

void buildMoving(RayWorld& world, const Scene& scene, const std::vector<Instance>& instances,
                 const std::vector<bool>& moving) {
    std::map<std::pair<int, int>, RayWorld::Moving> shared; // by mesh and primitive
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const Instance& instance = instances[i];
        if (instance.role == SurfaceRole::Absent || !moving[i]) continue;
        const auto key = std::make_pair(instance.mesh, instance.primitive);
        auto known = shared.find(key);
        if (known == shared.end()) {
            std::vector<SoupTriangle> triangles;
            appendLocalTriangles(scene, instance, triangles);
            const Bvh bvh = buildBvh(triangles);
            world.stats.movingTriangles += triangles.size();
            RayWorld::Moving placed;
            placed.localBounds = bvh.bounds;
            placed.grid = bvh.grid;
            placed.pairRange = {std::uint32_t(world.pairs.size()), std::uint32_t(bvh.pairs.size())};
            placed.rootRef = appendBvh(world, bvh, 0);
            known = shared.emplace(key, placed).first;
        }
        if (known->second.rootRef == BVH_REF_DONE) continue; // no triangles
        known->second.instance = std::uint32_t(i);
        world.moving.push_back(known->second);
    }
}

// World bounds of a transformed box, rounded outwards.
Box placedBounds(const Box& local, const glm::dmat4& anchoredFromLocal) {
    glm::dvec3 lower(INFINITY), upper(-INFINITY);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p(corner & 1 ? local.upper.x : local.lower.x,
                           corner & 2 ? local.upper.y : local.lower.y,
                           corner & 4 ? local.upper.z : local.lower.z);
        const glm::dvec3 q(anchoredFromLocal * glm::dvec4(p, 1.0));
        lower = glm::min(lower, q);
        upper = glm::max(upper, q);
    }
    // The entry's float transform is off by a few roundings of the coordinates it handles.
    const glm::dvec3 slack = glm::max(glm::abs(lower), glm::abs(upper)) * 0x1p-20 + (upper - lower) * 0x1p-18;
    return {glm::vec3(lower - slack), glm::vec3(upper + slack)};
}

BvhEntry identityEntry(const BoxGrid& grid, std::uint32_t rootRef, const glm::vec3& pivotWs) {
    BvhEntry entry{};
    entry.linear0 = {1.0f, 0.0f, 0.0f};
    entry.linear1 = {0.0f, 1.0f, 0.0f};
    entry.linear2 = {0.0f, 0.0f, 1.0f};
    entry.pivotWs = pivotWs;
    entry.gridMin = grid.min;
    entry.gridStep = grid.step;
    entry.rootRef = rootRef;
    return entry;
}

BvhEntry movingEntry(const RayWorld::Moving& placed, const glm::dmat4& anchoredFromLocal,
                     std::uint32_t firstTriangle) {
    BvhEntry entry = identityEntry(placed.grid, placed.rootRef, glm::vec3(0.0f));
    const glm::dmat4 localFromAnchored = glm::inverse(anchoredFromLocal);
    const glm::dmat3 linear = glm::transpose(glm::dmat3(localFromAnchored)); // its columns are the rows
    entry.linear0 = glm::vec3(linear[0]);
    entry.linear1 = glm::vec3(linear[1]);
    entry.linear2 = glm::vec3(linear[2]);
    const glm::dvec3 centre =
        (glm::dvec3(placed.localBounds.lower) + glm::dvec3(placed.localBounds.upper)) * 0.5;
    entry.pivotWs = glm::vec3(glm::dvec3(anchoredFromLocal * glm::dvec4(centre, 1.0)));
    entry.pivotLs = glm::vec3(glm::dvec3(localFromAnchored * glm::dvec4(glm::dvec3(entry.pivotWs), 1.0)));
    entry.firstTriangle = firstTriangle;
    return entry;
}

// What the top level holds: a box in anchored space and the entry that it leads to.
struct TopItem {
    Box box;
    std::uint32_t ref;
};

Box boundsOf(const TopItem* items, std::size_t count) {
    Box box = items[0].box;
    for (std::size_t i = 1; i < count; ++i)
        box = {glm::min(box.lower, items[i].box.lower), glm::max(box.upper, items[i].box.upper)};
    return box;
}

// Median split over the longest axis of the centroids: balanced, so the stack bound holds for any placement.
class TopLevel {
  public:
    TopLevel(RayWorld& world, const BoxGrid& grid) : world_(world), grid_(grid) {}

    std::uint32_t build(TopItem* items, std::size_t count) {
        if (count == 1) return items[0].ref;
        const std::size_t half = count / 2;
        const int axis = longestAxis(items, count);
        std::nth_element(items, items + half, items + count, [axis](const TopItem& a, const TopItem& b) {
            return a.box.lower[axis] + a.box.upper[axis] < b.box.lower[axis] + b.box.upper[axis];
        });
        return join(items, half, count);
    }

    // A node over items [0, half) and [half, count).
    std::uint32_t join(TopItem* items, std::size_t half, std::size_t count) {
        const std::uint32_t index = next_++;
        assert(index < world_.topNodeCapacity);
        BvhNode node;
        node.box0 = quantizeBox(boundsOf(items, half), grid_);
        node.box1 = quantizeBox(boundsOf(items + half, count - half), grid_);
        node.ref0 = build(items, half);
        node.ref1 = build(items + half, count - half);
        world_.nodes[index] = node;
        return index;
    }

  private:
    static int longestAxis(const TopItem* items, std::size_t count) {
        glm::vec3 lower(INFINITY), upper(-INFINITY);
        for (std::size_t i = 0; i < count; ++i) {
            lower = glm::min(lower, items[i].box.lower + items[i].box.upper);
            upper = glm::max(upper, items[i].box.lower + items[i].box.upper);
        }
        const glm::vec3 size = upper - lower;
        return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    }

    RayWorld& world_;
    const BoxGrid& grid_;
    std::uint32_t next_ = 0;
};

bool isInvertible(const glm::dmat4& m) {
    const double determinant = glm::determinant(glm::dmat3(m));
    return std::isfinite(determinant) && determinant != 0.0;
}

void fillStats(RayWorld& world) {
    BvhStats& stats = world.stats;
    stats.pairs = world.pairs.size();
    stats.nodes = world.nodes.size();
    stats.nodeBytes = world.nodes.size() * sizeof(BvhNode);
    stats.triangleBytes = world.pairs.size() * sizeof(BvhPair) + world.pairIds.size() * sizeof(glm::uvec2);
    stats.alphaBytes = world.alpha.texels.size() + world.alpha.records.size() * sizeof(AlphaRecord) +
                       world.alpha.triangles.size() * sizeof(AlphaTriangle);
    stats.otherBytes =
        world.entries.size() * sizeof(BvhEntry) + world.instances.size() * sizeof(TraceInstance);
    const std::size_t triangles = stats.staticTriangles + stats.movingTriangles;
    stats.bytesPerTriangle =
        triangles > 0 ? double(stats.nodeBytes + stats.triangleBytes) / double(triangles) : 0;
}

} // namespace

RayWorld buildWorld(const Scene& scene, const std::vector<Instance>& instances,
                    const std::vector<bool>& moving, const glm::dvec3& anchor) {
    std::vector<bool> isMoving = moving;
    isMoving.resize(instances.size(), false);
    RayWorld world;
    const std::size_t movingCount = std::size_t(std::count(isMoving.begin(), isMoving.end(), true));
    // A binary tree over n moving instances and the static geometry has n nodes.
    world.topNodeCapacity = std::uint32_t(movingCount);
    world.nodes.resize(world.topNodeCapacity);
    world.firstSubGridEntry = kFirstMovingEntry + std::uint32_t(movingCount);
    buildStatic(world, scene, instances, isMoving, world.firstSubGridEntry, anchor);
    buildMoving(world, scene, instances, isMoving);
    world.alpha = buildAlphaMasks(scene, instances);
    for (std::size_t i = 0; i < instances.size(); ++i)
        world.instances.push_back({instances[i].firstTriangle, world.alpha.recordOfInstance[i]});
    updateChannels(world, scene, instances);
    updateInstances(world, instances, anchor);
    fillStats(world);
    return world;
}

void updateChannels(RayWorld& world, const Scene& scene, const std::vector<Instance>& instances) {
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const std::uint32_t channels = scene.nodes[std::size_t(instances[i].node)].meshChannels;
        std::uint32_t& word = world.instances[i].alphaRecordAndChannels;
        word = (word & ALPHA_RECORD_NONE) | channels << TRACE_CHANNELS_SHIFT;
    }
}

void updateInstances(RayWorld& world, const std::vector<Instance>& instances, const glm::dvec3& anchor) {
    world.staticPivot = glm::vec3(world.staticAnchor - anchor);
    const BvhEntry staticEntry = identityEntry(world.staticGrid, world.staticRootRef, world.staticPivot);
    world.entries.assign(world.firstSubGridEntry, staticEntry);
    for (const SubGrid& part : world.staticSubGrids)
        world.entries.push_back(identityEntry(part.grid, part.rootRef, world.staticPivot));
    std::vector<TopItem> items;
    if (world.staticRootRef != BVH_REF_DONE)
        items.push_back(
            {{world.staticBounds.lower + world.staticPivot, world.staticBounds.upper + world.staticPivot},
             BVH_REF_ENTER | kStaticEntry});
    const std::size_t staticItems = items.size();
    for (std::size_t i = 0; i < world.moving.size(); ++i) {
        RayWorld::Moving& placed = world.moving[i];
        glm::dmat4& anchoredFromLocal = placed.anchoredFromLocal;
        anchoredFromLocal = instances[placed.instance].worldFromLocal;
        anchoredFromLocal[3] -= glm::dvec4(anchor, 0.0);
        placed.placed = isInvertible(anchoredFromLocal);
        if (!placed.placed) continue;
        const std::uint32_t entry = kFirstMovingEntry + std::uint32_t(i);
        world.entries[entry] =
            movingEntry(placed, anchoredFromLocal, instances[placed.instance].firstTriangle);
        items.push_back({placedBounds(placed.localBounds, anchoredFromLocal), BVH_REF_ENTER | entry});
    }
    if (items.size() == staticItems) return; // the world is the static geometry
    const BoxGrid grid = gridOver(boundsOf(items.data(), items.size()));
    TopLevel top(world, grid);
    // The static geometry encloses most instances, so it is one side of the root.
    const bool both = staticItems == 1;
    const std::uint32_t root =
        both ? top.join(items.data(), 1, items.size()) : top.build(items.data(), items.size());
    world.entries[kWorldEntry] = identityEntry(grid, root, glm::vec3(0.0f));
}

} // namespace kilolux
