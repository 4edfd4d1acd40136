// Rays through worlds of several BVHs: moving instances, detail with a grid of its own, nothing at all.
#include "tests/unit/accel/scene_kit.h"

#include "renderer/accel/ray_world_cpu.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace kilolux::test {

TEST(Trace, DetailInAWideWorldHasItsOwnGrid) {
    // A thing of 10 cm with 20,000 triangles, 10 km from another: on one grid it would be a single cell.
    Scene scene = makeScene({makeTorus(100, 100, 0.04, 0.01, 0.002)}, placed({5000.0, 0.0, 0.0}, 1.0));
    addNode(scene, 0, placed({-5000.0, 20.0, 100.0}, 1.0));
    const glm::dvec3 anchor(5000.0, 0.0, 0.0);
    RayWorld world = worldOf(scene, anchor);
    EXPECT_TRUE(std::any_of(world.staticSubGrids.begin(), world.staticSubGrids.end(),
                            [](const SubGrid& part) { return part.grid.step.x < 1e-5f; }));
    const std::vector<SoupTriangle> triangles = worldTriangles(scene, anchor);
    const EmbreeScene embree(triangles);
    std::mt19937 random(9);
    const auto compare = [&](const glm::vec3& shift) {
        int different = 0, hits = 0;
        for (int i = 0; i < 20000; ++i) {
            const TestRay ray = randomRay(random, glm::vec3(-0.05f), glm::vec3(0.05f), i % 2 ? 0.5 : 50.0);
            const float expected = embree.nearest(ray);
            const CpuHit hit = nearest(world, ray.origin + shift, ray.dir, 0.0f, 1e30f);
            hits += std::isfinite(expected);
            different +=
                std::isfinite(expected) != (hit.instance != 0xFFFFFFFFu) ||
                (std::isfinite(expected) && std::abs(hit.tM - expected) > 1e-4f * (0.01f + expected));
        }
        EXPECT_LE(different, 10);
        EXPECT_GT(hits, 3000);
    };
    compare(glm::vec3(0.0f));
    // The anchor moves by what floats hold exactly; the sub-grids follow.
    updateInstances(world, enumerateInstances(scene), anchor - glm::dvec3(0.0, 0.0, 0.0625));
    compare(glm::vec3(0.0f, 0.0f, 0.0625f));
}

TEST(Trace, SubGridsReturnToTheGridAround) {
    // Detailed rings along a diagonal, one of them moving, in a grid within the grid of the world: rays go
    // through some to reach others.
    Scene scene = makeScene({makeTorus(100, 100, 0.04, 0.01, 0.002)}, placed({0.0, 0.0, 0.0}, 1.0));
    for (int ring = 1; ring < 5; ++ring)
        addNode(scene, 0, placed(glm::dvec3(8.0 * ring), 1.0));
    addNode(scene, 0, placed({-9000.0, -9000.0, -9000.0}, 1.0));
    const std::vector<Instance> instances = enumerateInstances(scene);
    const RayWorld still = worldOf(scene);
    const RayWorld mixed =
        buildWorld(scene, instances, {false, false, true, false, false, false}, glm::dvec3(0.0));
    ASSERT_GE(mixed.staticSubGrids.size(), 4u);
    const EmbreeScene embree(worldTriangles(scene, glm::dvec3(0.0)));
    std::mt19937 random(10);
    std::uniform_real_distribution<double> unit(-0.06, 0.06);
    int different = 0, hits = 0;
    for (int i = 0; i < 20000; ++i) {
        const bool back = i % 2 == 1;
        const glm::dvec3 from =
            glm::dvec3(back ? 40.0 : -8.0) + glm::dvec3(unit(random), unit(random), unit(random));
        const glm::dvec3 to = glm::dvec3(8.0 * double(random() % 5)) +
                              glm::dvec3(unit(random), 0.2 * unit(random), unit(random));
        const TestRay ray = rayTo(from, to);
        const float expected = embree.nearest(ray);
        hits += std::isfinite(expected);
        for (const RayWorld* world : {&still, &mixed}) {
            const CpuHit hit = nearest(*world, ray.origin, ray.dir, 0.0f, 1e30f);
            different += std::isfinite(expected) != (hit.instance != 0xFFFFFFFFu) ||
                         (std::isfinite(expected) && std::abs(hit.tM - expected) > 1e-4f);
        }
    }
    EXPECT_LE(different, 20);
    EXPECT_GT(hits, 3000);
}

TEST(Trace, MovingInstancesEqualStaticOnes) {
    Scene scene = makeScene({makeTorus(30, 20, 2.0, 0.7, 0.2), makeSphere(20, 20, 1.2)});
    std::mt19937 random(51);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int i = 0; i < 30; ++i) {
        const glm::dvec3 at(unit(random) * 10, unit(random) * 10, unit(random) * 10);
        glm::dmat4 place = glm::rotate(placed(at, 0.5), unit(random) * 3.0, randomDirectionF64(random));
        place = glm::scale(place, glm::dvec3(i % 5 == 0 ? -1.0 : 1.0, 1.0, 1.5));
        addNode(scene, i % 2, place);
    }
    const std::vector<Instance> before = enumerateInstances(scene);
    for (const bool all : {false, true}) {
        std::vector<bool> moving(before.size());
        for (std::size_t i = 0; i < moving.size(); ++i)
            moving[i] = all || i % 3 == 0;
        RayWorld world = buildWorld(scene, before, moving, glm::dvec3(0.0));
        // Then they move, and so does the anchor.
        Scene moved = scene;
        for (std::size_t i = 0; i < moved.nodes.size(); ++i)
            if (moving[i])
                moved.nodes[i].worldFromNode = glm::translate(glm::dmat4(1.0), glm::dvec3(0.5, 1.0, -2.0)) *
                                               moved.nodes[i].worldFromNode;
        const glm::dvec3 anchor(4.0, -2.0, 8.0);
        const std::vector<Instance> after = enumerateInstances(moved);
        updateInstances(world, after, anchor);
        const RayWorld fresh = worldOf(moved, anchor);
        int different = 0, hits = 0;
        for (int i = 0; i < 20000; ++i) {
            const TestRay ray = randomRay(random, fresh.staticBounds.lower, fresh.staticBounds.upper, 0.2);
            const CpuHit a = nearest(world, ray.origin, ray.dir, 0.0f, 1e30f);
            const CpuHit b = nearest(fresh, ray.origin, ray.dir, 0.0f, 1e30f);
            hits += b.instance != 0xFFFFFFFFu;
            different += a.instance != b.instance || a.primitive != b.primitive || a.backFace != b.backFace ||
                         std::abs(a.tM - b.tM) > 1e-4f * b.tM ||
                         occluded(world, ray.origin, ray.dir, 0.0f, 1e30f) != (b.instance != 0xFFFFFFFFu);
        }
        EXPECT_LE(different, 10); // edges where the two spaces round differently
        EXPECT_GT(hits, 3000);
    }
}

TEST(Trace, SurvivesEmptyAndSquashedWorlds) {
    const Scene empty;
    EXPECT_FALSE(occluded(worldOf(empty), glm::vec3(0.0f), glm::vec3(0, 0, 1), 0.0f, 1e30f));
    Scene scene = makeScene({makeSphere(10, 10)});
    const std::vector<Instance> instances = enumerateInstances(scene);
    RayWorld world = buildWorld(scene, instances, {true}, glm::dvec3(0.0));
    EXPECT_TRUE(occluded(world, glm::vec3(0.0f), glm::vec3(0, 0, 1), 0.0f, 1e30f));
    scene.nodes[0].worldFromNode = glm::dmat4(glm::dmat3(0.0));
    updateInstances(world, enumerateInstances(scene), glm::dvec3(0.0));
    EXPECT_FALSE(occluded(world, glm::vec3(0.0f), glm::vec3(0, 0, 1), 0.0f, 1e30f));
    // Directions along axes, where reciprocals are infinite.
    const RayWorld box = worldOf(makeScene({makeBox({1.0, 1.0, 1.0})}));
    for (int axis = 0; axis < 3; ++axis)
        for (const float sign : {-1.0f, 1.0f}) {
            glm::vec3 dir(0.0f);
            dir[axis] = sign;
            for (const glm::vec3& origin : {glm::vec3(0.0f), glm::vec3(0.9999f), -dir * 0.5f})
                EXPECT_NEAR(nearest(box, origin, dir, 0.0f, 1e30f).tM, 1.0f - sign * origin[axis], 1e-5f);
            EXPECT_FALSE(occluded(box, dir * 2.0f, dir, 0.0f, 1e30f));
        }
}

} // namespace kilolux::test
