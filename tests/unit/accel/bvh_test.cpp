// The BVH as data: nothing lost, boxes enclose, bounds of depth and memory hold, odd input is survived.
#include "tests/unit/accel/scene_kit.h"

#include "renderer/accel/pairing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace kilolux::test {

namespace {

using namespace shared;

std::vector<SoupTriangle> trianglesOf(Primitive primitive) {
    return worldTriangles(makeScene({std::move(primitive)}), glm::dvec3(0.0));
}

// Undoes the turn of a pair's triangle: the corners as the soup had them.
std::array<glm::vec3, 3> originalCorners(const BvhPair& pair, bool second, std::uint32_t id) {
    const std::array<glm::vec3, 3> turned =
        second ? std::array{pair.c, pair.b, pair.d} : std::array{pair.a, pair.b, pair.c};
    const std::uint32_t rotation = (id & BVH_ID_TURN_MASK) % 3u;
    std::array<glm::vec3, 3> corners;
    for (std::uint32_t i = 0; i < 3; ++i)
        corners[(i + rotation) % 3] = turned[i];
    return corners;
}

std::uint32_t indexOf(std::uint32_t id) {
    return (id & BVH_ID_NONE) >> BVH_ID_TURN_BITS;
}

void expectSameTriangles(const std::vector<SoupTriangle>& triangles, const std::vector<BvhPair>& pairs,
                         const std::vector<glm::uvec2>& ids) {
    ASSERT_EQ(pairs.size(), ids.size());
    std::map<std::uint32_t, std::array<glm::vec3, 3>> found;
    for (std::size_t i = 0; i < pairs.size(); ++i)
        for (const bool second : {false, true}) {
            const std::uint32_t id = second ? ids[i].y : ids[i].x;
            if (id == BVH_ID_NONE) continue;
            EXPECT_TRUE(found.emplace(indexOf(id), originalCorners(pairs[i], second, id)).second);
        }
    ASSERT_EQ(found.size(), triangles.size());
    for (const SoupTriangle& triangle : triangles)
        for (int corner = 0; corner < 3; ++corner)
            ASSERT_EQ(found[triangle.id][corner], triangle.position[corner]) << triangle.id;
}

double plane(const BoxGrid& grid, int axis, std::uint32_t q) {
    return double(grid.min[axis]) + double(grid.step[axis]) * q;
}

// Walks the tree; every pair must lie in all boxes above it, with a sixteenth of a step to spare.
class TreeCheck {
  public:
    explicit TreeCheck(const Bvh& bvh) : bvh_(bvh), seen_(bvh.pairs.size(), 0) {
        if (bvh.rootRef != BVH_REF_DONE) visit(bvh.rootRef, 0);
    }
    std::uint32_t depth = 0;
    bool allSeenOnce() const {
        return std::all_of(seen_.begin(), seen_.end(), [](int count) { return count == 1; });
    }

  private:
    void visit(std::uint32_t ref, std::uint32_t level) {
        depth = std::max(depth, level);
        if (ref >= BVH_REF_LEAF) {
            const std::uint32_t count = ((ref & ~BVH_REF_LEAF) >> BVH_LEAF_COUNT_SHIFT) + 1;
            for (std::uint32_t i = 0; i < count; ++i)
                checkPair((ref & BVH_LEAF_FIRST_MASK) + i);
            return;
        }
        const BvhNode& node = bvh_.nodes.at(ref);
        for (const bool second : {false, true}) {
            boxes_.push_back(second ? node.box1 : node.box0);
            visit(second ? node.ref1 : node.ref0, level + 1);
            boxes_.pop_back();
        }
    }

    void checkPair(std::uint32_t index) {
        ++seen_.at(index);
        const BvhPair& pair = bvh_.pairs[index];
        for (const glm::uvec3& box : boxes_)
            for (const glm::vec3& corner : {pair.a, pair.b, pair.c, pair.d})
                for (int axis = 0; axis < 3; ++axis) {
                    const double spare = double(bvh_.grid.step[axis]) / 16.0 * 0.999;
                    ASSERT_LE(plane(bvh_.grid, axis, box[axis] & 0xFFFFu) + spare, double(corner[axis]));
                    ASSERT_GE(plane(bvh_.grid, axis, box[axis] >> 16) - spare, double(corner[axis]));
                }
    }

    const Bvh& bvh_;
    std::vector<int> seen_;
    std::vector<glm::uvec3> boxes_;
};

void expectSound(const std::vector<SoupTriangle>& triangles) {
    const Bvh bvh = buildBvh(triangles);
    expectSameTriangles(triangles, bvh.pairs, bvh.pairIds);
    const TreeCheck check(bvh);
    EXPECT_TRUE(check.allSeenOnce());
    EXPECT_EQ(check.depth, bvh.depth);
    EXPECT_LE(bvh.depth, 40u);
}

} // namespace

TEST(Pairing, KeepsEveryTriangleOnce) {
    for (const bool mirrored : {false, true}) {
        const glm::dmat4 place(glm::dmat3(mirrored ? -1.0 : 1.0));
        const std::vector<SoupTriangle> triangles =
            worldTriangles(makeScene({makeTorus(40, 20, 2.0, 0.5, 0.1)}, place), glm::dvec3(0.0));
        const TrianglePairs pairs = pairTriangles(triangles);
        expectSameTriangles(triangles, pairs.pairs, pairs.ids);
        EXPECT_EQ(triangles[0].swapped, mirrored);
        EXPECT_EQ((pairs.ids[0].x & BVH_ID_TURN_MASK) >= 3u, mirrored);
    }
}

TEST(Pairing, JoinsNearlyAllTrianglesOfMeshes) {
    const std::vector<SoupTriangle> sphere = trianglesOf(makeSphere(64, 128));
    EXPECT_LE(double(pairTriangles(sphere).pairs.size()), 0.52 * double(sphere.size()));
    const std::vector<SoupTriangle> soup = trianglesOf(makeSoup(1000, 0.1, 1));
    EXPECT_EQ(pairTriangles(soup).pairs.size(), soup.size());
}

TEST(Pairing, LeavesOppositeWindingsAlone) {
    // Two triangles on one edge that run along it the same way: no pair can describe both.
    Primitive fan = makePrimitive({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}}, {0, 1, 2, 0, 1, 3});
    EXPECT_EQ(pairTriangles(trianglesOf(fan)).pairs.size(), 2u);
    fan.indices = {0, 1, 2, 1, 0, 3};
    EXPECT_EQ(pairTriangles(trianglesOf(fan)).pairs.size(), 1u);
}

TEST(Bvh, EnclosesEveryTriangle) {
    expectSound(trianglesOf(makeSphere(32, 64)));
    expectSound(trianglesOf(makeSoup(5000, 0.05, 2)));
    expectSound(trianglesOf(makeSoup(2000, 2.0, 3)));
    expectSound(trianglesOf(makeBox({1000.0, 0.001, 1000.0})));
}

TEST(Bvh, SurvivesOddInput) {
    expectSound({});
    expectSound(trianglesOf(makeSoup(1, 0.5, 4)));
    SoupTriangle flat;
    flat.position[0] = {5, 7, 9};
    flat.position[1] = {6, 7, 9};
    flat.position[2] = {5, 7, 10};
    std::vector<SoupTriangle> same(3000, flat);
    for (std::uint32_t i = 0; i < same.size(); ++i)
        same[i].id = i;
    expectSound(same);
    for (SoupTriangle& triangle : same)
        triangle.position[0] = triangle.position[1] = triangle.position[2] = glm::vec3(10000.0f);
    expectSound(same);
    // Sizes that halve: an unbalanced tree, deeper than the stack were it not for the builder's bound.
    std::vector<SoupTriangle> halving;
    for (std::uint32_t i = 0; i < 2000; ++i) {
        const float x = std::ldexp(1.0f, -int(i % 120));
        SoupTriangle triangle;
        triangle.position[0] = {x, 0, 0};
        triangle.position[1] = {x * 1.5f, 0, 0};
        triangle.position[2] = {x, x, 0};
        triangle.id = i;
        halving.push_back(triangle);
    }
    expectSound(halving);
}

TEST(Bvh, DropsTrianglesThatAreNotFinite) {
    Primitive soup = makeSoup(10, 0.5, 5);
    soup.positions[4].y = NAN;
    soup.positions[9].x = INFINITY;
    EXPECT_EQ(trianglesOf(soup).size(), 8u);
    const Scene huge = makeScene({makeSoup(10, 0.5, 5)}, glm::dmat4(glm::dmat3(1e300)));
    EXPECT_EQ(worldTriangles(huge, glm::dvec3(0.0)).size(), 0u);
}

TEST(Bvh, MemoryPerTriangle) {
    const Scene scene = makeScene({makeTorus(200, 100, 2.0, 0.5, 0.1)});
    const RayWorld world = buildWorld(scene, enumerateInstances(scene), {}, glm::dvec3(0.0));
    EXPECT_LE(world.stats.bytesPerTriangle, 44.0);
    EXPECT_GE(world.stats.bytesPerTriangle, 28.0); // two corners, an id each: less is a wrong count
    EXPECT_EQ(world.stats.staticTriangles, triangleCount(scene));
}

} // namespace kilolux::test
