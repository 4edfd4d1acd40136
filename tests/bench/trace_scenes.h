// Scenes and rays for the tracer's bench: what a camera sees, and from there one shadow ray per pixel to a
// light chosen uniformly.
#pragma once

#include "renderer/accel/ray_world.h"
#include "tests/unit/accel/scene_kit.h"

#include <string>
#include <vector>

namespace kilolux::test {

struct BenchScene {
    std::string name;
    Scene scene;
    std::vector<bool> moving; // per instance; empty: none
    glm::dvec3 eye{0.0};
    glm::dvec3 target{0.0};
    std::vector<glm::vec3> lights;
};

// A hall of about a quarter of a million triangles: wavy floor, columns, tori, spheres, boxes; 256 lights.
BenchScene makeHall();
// The same things, each its own instance, a tenth of them movable.
BenchScene makeMovingHall();
// A glTF file, with 256 lights spread through its bounds.
BenchScene loadBenchScene(const std::string& path);

// Pixels in 8 x 8 tiles, row by row of tiles; those that see nothing look at a light from the eye.
std::vector<TestRay> shadowRays(const BenchScene& scene, const RayWorld& world, int width, int height);

} // namespace kilolux::test
