// Rays through the shaders' traversal, compiled as C++: against exact arithmetic, against Embree, at edges
// and vertices, from surfaces, at scales from a centimetre to 10 km, with moving instances.
#include "tests/unit/accel/scene_kit.h"

#include "renderer/accel/ray_world_cpu.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>

namespace kilolux::test {

namespace {

// KILOLUX_SLOW_TESTS=1 asks for the ten million rays that the design names.
int rayCount(int quick) {
    return std::getenv("KILOLUX_SLOW_TESTS") ? quick * 10 : quick;
}

struct Comparison {
    int rays = 0;
    int hits = 0;
    int ties = 0;  // differ, and a triangle's edge is within rounding of the ray
    int wrong = 0; // differ without that excuse
};

// Nearest and occluded against every triangle in double precision.
Comparison compareToExact(const Scene& scene, int rays, unsigned seed) {
    const RayWorld world = worldOf(scene);
    const std::vector<SoupTriangle> triangles = worldTriangles(scene, glm::dvec3(0.0));
    std::mt19937 random(seed);
    Comparison result;
    for (int i = 0; i < rays; ++i) {
        TestRay ray = randomRay(random, world.staticBounds.lower, world.staticBounds.upper, 0.5);
        if (i % 3 == 0)
            ray.tMaxM = std::uniform_real_distribution<float>(0.1f, 1.0f)(random) *
                        glm::length(world.staticBounds.upper - world.staticBounds.lower);
        const ExactHit exact = nearestExact(triangles, ray);
        const CpuHit hit = nearest(world, ray.origin, ray.dir, 0.0f, ray.tMaxM);
        const bool any = occluded(world, ray.origin, ray.dir, 0.0f, ray.tMaxM);
        const bool found = hit.instance != 0xFFFFFFFFu;
        const bool same = found == exact.hit && any == exact.hit &&
                          (!found || std::abs(hit.tM - exact.tM) <= 1e-4 * (1.0 + exact.tM));
        ++result.rays;
        result.hits += found;
        if (!same) ++(exact.edgeMargin < 1e-5 ? result.ties : result.wrong);
    }
    return result;
}

void expectExact(const Scene& scene, int rays, unsigned seed) {
    const Comparison result = compareToExact(scene, rays, seed);
    EXPECT_EQ(result.wrong, 0);
    EXPECT_LE(result.ties, rays / 1000);
    EXPECT_GE(result.hits, rays / 20);
}

// Rays from inside a closed mesh through points of its edges and corners: each must hit something.
int countLeaks(const Scene& scene, const glm::dvec3& inside, int rays, unsigned seed) {
    const RayWorld world = worldOf(scene);
    const std::vector<SoupTriangle> triangles = worldTriangles(scene, glm::dvec3(0.0));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    int leaks = 0;
    for (int i = 0; i < rays; ++i) {
        const SoupTriangle& triangle = triangles[random() % triangles.size()];
        const int corner = int(random() % 3);
        const glm::dvec3 a = triangle.position[corner], b = triangle.position[(corner + 1) % 3];
        const glm::dvec3 target = i % 2 == 0 ? a : glm::mix(a, b, unit(random));
        const TestRay ray = rayTo(inside, target);
        leaks += !occluded(world, ray.origin, ray.dir, 0.0f, 1e30f);
    }
    return leaks;
}

// Rays that leave points of a convex mesh outwards: none may meet it again.
int countSelfHits(const Scene& scene, const glm::dvec3& anchor, int rays, unsigned seed) {
    const RayWorld world = worldOf(scene, anchor);
    const std::vector<SoupTriangle> triangles = worldTriangles(scene, anchor);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    int selfHits = 0;
    for (int i = 0; i < rays; ++i) {
        const SoupTriangle& triangle = triangles[random() % triangles.size()];
        const glm::dvec3 a = triangle.position[0], b = triangle.position[1], c = triangle.position[2];
        const double r = std::sqrt(unit(random)), s = unit(random);
        // As a camera would find it: by tracing to it from some distance.
        const glm::dvec3 surface = a * (1.0 - r) + b * (r * (1.0 - s)) + c * (r * s);
        const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
        const double viewDistance = glm::length(b - a) * (1.0 + 10.0 * unit(random));
        glm::dvec3 viewDir = randomDirectionF64(random);
        viewDir *= glm::dot(viewDir, normal) < 0.0 ? -1.0 : 1.0;
        const TestRay view = rayTo(surface + viewDir * viewDistance, surface);
        const CpuHit hit = nearest(world, view.origin, view.dir, 0.0f, 1e30f);
        if (hit.instance == 0xFFFFFFFFu) continue; // past the silhouette by a rounding
        // The triangle that was hit: a silhouette's ray may have changed it.
        const SoupTriangle& met = triangles[hit.primitive];
        const glm::vec3* q = met.position;
        const glm::vec3 p = q[0] * (1.0f - hit.barycentrics.x - hit.barycentrics.y) +
                            q[1] * hit.barycentrics.x + q[2] * hit.barycentrics.y;
        const glm::dvec3 metNormal = glm::normalize(
            glm::cross(glm::dvec3(q[1]) - glm::dvec3(q[0]), glm::dvec3(q[2]) - glm::dvec3(q[0])));
        glm::dvec3 away = randomDirectionF64(random);
        if (i % 4 == 0) // grazing
            away = glm::normalize(away - metNormal * glm::dot(metNormal, away) * 0.999);
        away *= glm::dot(away, metNormal) < 0.0 ? -1.0 : 1.0;
        const glm::vec3 dir(away);
        if (glm::dot(glm::vec3(metNormal), dir) <= 0.0f) continue;
        const glm::vec3 origin = offsetRayOrigin(p, glm::vec3(metNormal), dir, positionErrorM(p));
        selfHits += occluded(world, origin, dir, 0.0f, 1e30f);
    }
    return selfHits;
}

} // namespace

TEST(Trace, EqualsExactArithmeticOnSoups) {
    expectExact(makeScene({makeSoup(300, 0.3, 11)}), 20000, 1);
    expectExact(makeScene({makeSoup(2000, 0.1, 12)}), 5000, 2);
    expectExact(makeScene({makeSoup(50, 3.0, 13)}), 20000, 3);
}

TEST(Trace, EqualsExactArithmeticAtAllScales) {
    for (const double scale : {0.01, 1.0, 100.0, 10000.0})
        expectExact(makeScene({makeSoup(300, 0.3, 14)}, placed(glm::dvec3(0.0), scale)), 5000, 4);
    // A centimetre of detail in ten kilometres: boxes on the world's grid are coarse, hits must not be lost.
    Scene scene = makeScene({makeSoup(200, 0.3, 15)}, placed({5000.0, 0.0, 0.0}, 0.05));
    addNode(scene, 0, placed({-5000.0, 20.0, 100.0}, 1.0));
    const RayWorld world = worldOf(scene, {5000.0, 0.0, 0.0});
    const std::vector<SoupTriangle> triangles = worldTriangles(scene, {5000.0, 0.0, 0.0});
    std::mt19937 random(5);
    int wrong = 0, hits = 0;
    for (int i = 0; i < 5000; ++i) {
        const TestRay ray = randomRay(random, glm::vec3(-0.05f), glm::vec3(0.05f), 0.5);
        const ExactHit exact = nearestExact(triangles, ray);
        const CpuHit hit = nearest(world, ray.origin, ray.dir, 0.0f, 1e30f);
        hits += exact.hit;
        wrong += exact.hit != (hit.instance != 0xFFFFFFFFu) && exact.edgeMargin > 1e-5;
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(hits, 1000);
}

TEST(Trace, EqualsEmbreeOnMeshes) {
    const Scene scene = makeScene({makeTorus(120, 60, 2.0, 0.7, 0.2), makeSphere(60, 60, 1.2)});
    const RayWorld world = worldOf(scene);
    const EmbreeScene embree(worldTriangles(scene, glm::dvec3(0.0)));
    std::mt19937 random(6);
    int different = 0, hits = 0;
    const int rays = rayCount(100000);
    for (int i = 0; i < rays; ++i) {
        const TestRay ray = randomRay(random, world.staticBounds.lower, world.staticBounds.upper, 0.5);
        const float expected = embree.nearest(ray);
        const CpuHit hit = nearest(world, ray.origin, ray.dir, 0.0f, 1e30f);
        const bool found = hit.instance != 0xFFFFFFFFu;
        hits += found;
        different += found != std::isfinite(expected) ||
                     (found && std::abs(hit.tM - expected) > 1e-4f * (1.0f + expected)) ||
                     occluded(world, ray.origin, ray.dir, 0.0f, 1e30f) != embree.occluded(ray);
    }
    EXPECT_LE(different, rays / 20000); // silhouettes where the two round differently
    EXPECT_GT(hits, rays / 4);
}

TEST(Trace, ReportsWhatWasHit) {
    Scene scene = makeScene({makeTorus(30, 20, 2.0, 0.7, 0.2), makeSphere(20, 20, 1.2)});
    addNode(scene, 1, glm::scale(placed({5.0, 0.0, 0.0}, 1.0), glm::dvec3(-1.0, 2.0, 0.5))); // mirrored
    const std::vector<Instance> instances = enumerateInstances(scene);
    const RayWorld world = worldOf(scene);
    std::mt19937 random(7);
    int backFaces = 0, mirroredHits = 0;
    for (int i = 0; i < 20000; ++i) {
        const TestRay ray = randomRay(random, world.staticBounds.lower, world.staticBounds.upper, 0.2);
        const CpuHit hit = nearest(world, ray.origin, ray.dir, 0.0f, 1e30f);
        if (hit.instance == 0xFFFFFFFFu) continue;
        const Instance& instance = instances.at(hit.instance);
        const Primitive& primitive = primitiveOf(scene, instance);
        ASSERT_LT(hit.primitive, instance.triangleCount);
        glm::dvec3 corner[3];
        for (int k = 0; k < 3; ++k)
            corner[k] = glm::dvec3(
                instance.worldFromLocal *
                glm::dvec4(glm::dvec3(primitive.positions[primitive.indices[hit.primitive * 3 + k]]), 1.0));
        const double b1 = hit.barycentrics.x, b2 = hit.barycentrics.y;
        const glm::dvec3 p = corner[0] * (1.0 - b1 - b2) + corner[1] * b1 + corner[2] * b2;
        EXPECT_LT(glm::length(p - (glm::dvec3(ray.origin) + glm::dvec3(ray.dir) * double(hit.tM))), 2e-5);
        const bool mirrored = glm::determinant(glm::dmat3(instance.worldFromLocal)) < 0.0;
        const glm::dvec3 normal =
            glm::cross(corner[1] - corner[0], corner[2] - corner[0]) * (mirrored ? -1.0 : 1.0);
        EXPECT_EQ(hit.backFace, glm::dot(normal, glm::dvec3(ray.dir)) > 0.0);
        backFaces += hit.backFace;
        mirroredHits += mirrored;
    }
    EXPECT_GT(backFaces, 100);
    EXPECT_GT(mirroredHits, 100);
}

TEST(Trace, NothingLeaksAtEdgesAndCorners) {
    const int rays = rayCount(200000);
    EXPECT_EQ(countLeaks(makeScene({makeSphere(60, 120)}), {0.1, 0.2, -0.3}, rays, 21), 0);
    EXPECT_EQ(countLeaks(makeScene({makeSphere(60, 120)}), {0.0, 0.0, 0.0}, rays, 22), 0);
    EXPECT_EQ(countLeaks(makeScene({makeBox({1.0, 1.0, 1.0})}), {0.0, 0.0, 0.0}, rays, 23), 0);
    // Slivers of 1 : 100,000, and a torus seen along its tube.
    EXPECT_EQ(countLeaks(makeScene({makeSphere(1000, 6)}), {0.1, 0.2, -0.3}, rays, 24), 0);
    EXPECT_EQ(countLeaks(makeScene({makeBox({1000.0, 0.01, 1000.0})}), {0.0, 0.0, 0.0}, rays, 25), 0);
    EXPECT_EQ(countLeaks(makeScene({makeTorus(200, 100, 2.0, 0.7, 0.2)}), {2.0, 0.0, 0.0}, rays, 26), 0);
    const glm::dmat4 far = placed({9000.0, 500.0, -4000.0}, 3.0);
    EXPECT_EQ(countLeaks(makeScene({makeSphere(60, 120)}, far), {9000.1, 500.2, -4000.3}, rays, 27), 0);
}

TEST(Trace, ConvexMeshesDoNotShadowThemselves) {
    const int rays = rayCount(50000);
    for (const double scale : {0.01, 0.1, 1.0, 100.0, 10000.0}) {
        const glm::dmat4 place = placed(glm::dvec3(0.0), scale);
        EXPECT_EQ(countSelfHits(makeScene({makeSphere(40, 80)}, place), glm::dvec3(0.0), rays, 31), 0)
            << scale;
        EXPECT_EQ(countSelfHits(makeScene({makeBox({1.0, 0.3, 2.0})}, place), glm::dvec3(0.0), rays, 32), 0)
            << scale;
    }
    // 10 km from the world's origin: near an anchor, and without one.
    const glm::dvec3 far(8000.0, 3000.0, -6000.0);
    const Scene scene = makeScene({makeSphere(40, 80)}, placed(far, 1.0));
    EXPECT_EQ(countSelfHits(scene, far - glm::dvec3(3.0, 1.0, 2.0), rays, 33), 0);
    EXPECT_EQ(countSelfHits(scene, glm::dvec3(0.0), rays, 34), 0);
    // Turned, so that no plane is aligned with an axis, and stretched.
    const glm::dmat4 turned =
        glm::rotate(placed({3.0, 2.0, 1.0}, 1.0), 0.7, glm::normalize(glm::dvec3(1, 2, 3)));
    EXPECT_EQ(countSelfHits(makeScene({makeBox({50.0, 0.3, 20.0})}, turned), glm::dvec3(0.0), rays, 35), 0);
}

TEST(Trace, WallOfOneMillimetreStopsLight) {
    // A wall of 10 m, 1 mm thick, in every orientation; rays from one face towards lights behind the other.
    std::mt19937 random(41);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int turn = 0; turn < 20; ++turn) {
        const glm::dmat4 place =
            glm::rotate(placed({unit(random) * 20, unit(random) * 20, unit(random) * 20}, 1.0),
                        unit(random) * 3.0, randomDirectionF64(random));
        const Scene scene = makeScene({makeBox({5.0, 0.0005, 5.0})}, place);
        const RayWorld world = worldOf(scene);
        int leaks = 0;
        for (int i = 0; i < rayCount(5000); ++i) {
            const glm::vec3 p(place * glm::dvec4(unit(random) * 4.9, 0.0005, unit(random) * 4.9, 1.0));
            const glm::vec3 light(place * glm::dvec4(unit(random) * 4.0, -0.01 - std::abs(unit(random)) * 3.0,
                                                     unit(random) * 4.0, 1.0));
            const glm::vec3 ng(glm::dmat3(place) * glm::dvec3(0.0, 1.0, 0.0));
            const glm::vec3 dir = glm::normalize(light - p);
            // A light below the horizon is dark by its normal; here the wall itself must stop it.
            const glm::vec3 origin = offsetRayOrigin(p, ng, ng, positionErrorM(p));
            leaks += !occluded(world, origin, dir, 0.0f, glm::distance(light, origin));
        }
        EXPECT_EQ(leaks, 0);
    }
}

TEST(TileOrder, IsABijectionDealtInTurn) {
    for (const glm::uvec2& tiles : {glm::uvec2(1, 1), glm::uvec2(7, 5), glm::uvec2(64, 33), glm::uvec2(2, 1)})
        for (const std::uint32_t chunks : {1u, 2u, 3u, 16u}) {
            std::vector<int> seen(tiles.x * tiles.y, 0);
            for (std::uint32_t group = 0; group < seen.size(); ++group) {
                const glm::uvec2 tile = interleavedTile(group, tiles, chunks);
                ASSERT_LT(tile.x, tiles.x);
                ASSERT_LT(tile.y, tiles.y);
                ++seen[tile.y * tiles.x + tile.x];
            }
            EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](int count) { return count == 1; }));
        }
    EXPECT_EQ(interleavedTile(1, {8, 8}, 2), glm::uvec2(2, 0));
    EXPECT_EQ(interleavedTile(32, {8, 8}, 2), glm::uvec2(1, 0));
}

} // namespace kilolux::test
