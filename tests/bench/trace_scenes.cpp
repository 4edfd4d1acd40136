// Scenes and rays for the tracer's bench.
#include "tests/bench/trace_scenes.h"

#include "renderer/accel/ray_world_cpu.h"
#include "renderer/document/gltf_import.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>

namespace kilolux::test {

namespace {

double uniform(std::mt19937& random, double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
}

glm::dmat4 placed(const glm::dvec3& position, double turnRad, const glm::dvec3& scale) {
    const glm::dmat4 moved = glm::translate(glm::dmat4(1.0), position);
    return glm::scale(glm::rotate(moved, turnRad, glm::normalize(glm::dvec3(0.3, 1.0, 0.2))), scale);
}

void addHallShell(Scene& scene) {
    const std::vector<Primitive> shell = {
        makeGrid(160, [](double x, double z) { return 0.02 * std::sin(40.0 * x) * std::cos(35.0 * z); }),
        makeBox({0.4, 3.0, 0.4})};
    for (const Primitive& primitive : shell) {
        Mesh mesh;
        mesh.primitives.push_back(primitive);
        scene.meshes.push_back(std::make_shared<const Mesh>(mesh));
    }
    addNode(scene, 0, glm::scale(glm::dmat4(1.0), glm::dvec3(15.0, 1.0, 15.0)));
    addNode(scene, 1, placed({0.0, 3.0, -15.0}, 0.0, {40.0, 2.0, 1.0}));
    addNode(scene, 1, placed({0.0, 3.0, 15.0}, 0.0, {40.0, 2.0, 1.0}));
    addNode(scene, 1, placed({-15.0, 3.0, 0.0}, 0.0, {1.0, 2.0, 40.0}));
    addNode(scene, 1, placed({15.0, 3.0, 0.0}, 0.0, {1.0, 2.0, 40.0}));
    for (int column = 0; column < 16; ++column)
        addNode(scene, 1,
                placed({-12.0 + 8.0 * (column % 4), 3.0, -12.0 + 8.0 * (column / 4)}, 0.0, glm::dvec3(1.0)));
}

void addHallThings(Scene& scene, std::mt19937& random) {
    const int firstThing = int(scene.meshes.size());
    for (const Primitive& primitive :
         {makeTorus(40, 24, 0.5, 0.2, 0.04), makeSphere(24, 36, 0.4), makeTorus(30, 16, 0.3, 0.08, 0.0)}) {
        Mesh mesh;
        mesh.primitives.push_back(primitive);
        scene.meshes.push_back(std::make_shared<const Mesh>(mesh));
    }
    for (int thing = 0; thing < 130; ++thing)
        addNode(scene, firstThing + thing % 3,
                placed({uniform(random, -14, 14), uniform(random, 0.2, 4.5), uniform(random, -14, 14)},
                       uniform(random, -3, 3), glm::dvec3(uniform(random, 0.5, 2.0))));
}

} // namespace

BenchScene makeHall() {
    std::mt19937 random(1);
    BenchScene bench;
    bench.name = "hall";
    addHallShell(bench.scene);
    addHallThings(bench.scene, random);
    bench.eye = {-13.0, 2.5, -13.0};
    bench.target = {4.0, 1.0, 4.0};
    for (int light = 0; light < 256; ++light)
        bench.lights.push_back(
            glm::vec3(uniform(random, -14, 14), uniform(random, 2.0, 5.5), uniform(random, -14, 14)));
    return bench;
}

BenchScene makeMovingHall() {
    BenchScene bench = makeHall();
    bench.name = "hall, 13 moving";
    for (std::size_t instance = 0; instance < enumerateInstances(bench.scene).size(); ++instance)
        bench.moving.push_back(instance >= 21 && instance % 10 == 0);
    return bench;
}

namespace {

// Share of directions in which a point sees geometry: near 1 inside rooms.
double enclosure(const RayWorld& world, const glm::vec3& p, double& meanDistanceM) {
    std::mt19937 random(4);
    int hits = 0;
    meanDistanceM = 0.0;
    constexpr int kDirections = 64;
    for (int i = 0; i < kDirections; ++i) {
        const CpuHit hit = nearest(world, p, randomDirection(random), 0.0f, 1e30f);
        // Backs of walls: the point is inside a solid.
        if (hit.instance == 0xFFFFFFFFu || hit.backFace) continue;
        ++hits;
        meanDistanceM += hit.tM / kDirections;
    }
    return double(hits) / kDirections;
}

} // namespace

BenchScene loadBenchScene(const std::string& path) {
    Result<Scene> scene = importGltf(path);
    if (!scene) {
        std::fprintf(stderr, "%s\n", scene.error().c_str());
        std::exit(2);
    }
    BenchScene bench;
    bench.name = path.substr(path.find_last_of('/') + 1);
    bench.scene = std::move(scene.value());
    const RayWorld world = buildWorld(bench.scene, enumerateInstances(bench.scene), {}, glm::dvec3(0.0));
    const Bounds bounds = worldBounds(bench.scene);
    const glm::dvec3 size = bounds.max - bounds.min;
    // Lights where there is room around them and geometry on most sides; the camera in the widest such place.
    std::mt19937 random(2);
    double widest = -1.0;
    for (int tries = 0; tries < 20000 && bench.lights.size() < 256; ++tries) {
        const glm::dvec3 p =
            bounds.min + size * glm::dvec3(uniform(random, 0.02, 0.98), uniform(random, 0.02, 0.98),
                                           uniform(random, 0.02, 0.98));
        double distanceM = 0.0;
        if (enclosure(world, glm::vec3(p), distanceM) < (tries < 10000 ? 0.7 : 0.0)) continue;
        bench.lights.push_back(glm::vec3(p));
        if (distanceM > widest) {
            widest = distanceM;
            bench.eye = p + size * 0.001; // not at the light itself
        }
    }
    // Look along the longer horizontal axis, slightly down.
    bench.target = bench.eye + (size.x > size.z ? glm::dvec3(1.0, -0.2, 0.3) : glm::dvec3(0.3, -0.2, 1.0));
    return bench;
}

std::vector<TestRay> shadowRays(const BenchScene& bench, const RayWorld& world, int width, int height) {
    const std::vector<Instance> instances = enumerateInstances(bench.scene);
    const glm::dvec3 forward = glm::normalize(bench.target - bench.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0.0, 1.0, 0.0)));
    const glm::dvec3 up = glm::cross(right, forward);
    std::mt19937 random(3);
    std::vector<TestRay> rays;
    rays.reserve(std::size_t(width) * std::size_t(height));
    for (int index = 0; index < width * height; ++index) {
        const int tile = index / 64, inTile = index % 64;
        const int x = tile % (width / 8) * 8 + inTile % 8, y = tile / (width / 8) * 8 + inTile / 8;
        const double sx = (2.0 * (x + 0.5) / width - 1.0) * width / height,
                     sy = 1.0 - 2.0 * (y + 0.5) / height;
        const glm::vec3 eye(bench.eye), dir(glm::normalize(forward + (right * sx + up * sy) * 0.7));
        const CpuHit hit = nearest(world, eye, dir, 0.0f, 1e30f);
        glm::vec3 origin = eye;
        const glm::vec3 light = bench.lights[random() % bench.lights.size()];
        if (hit.instance != 0xFFFFFFFFu) {
            const Instance& instance = instances[hit.instance];
            const Primitive& primitive = primitiveOf(bench.scene, instance);
            glm::dvec3 corner[3];
            for (int k = 0; k < 3; ++k)
                corner[k] = glm::dvec3(
                    instance.worldFromLocal *
                    glm::dvec4(glm::dvec3(primitive.positions[primitive.indices[hit.primitive * 3 + k]]),
                               1.0));
            glm::vec3 ng(glm::normalize(glm::cross(corner[1] - corner[0], corner[2] - corner[0])));
            ng *= glm::dot(ng, dir) > 0.0f ? -1.0f : 1.0f;
            const glm::vec3 p(corner[0] + (corner[1] - corner[0]) * double(hit.barycentrics.x) +
                              (corner[2] - corner[0]) * double(hit.barycentrics.y));
            origin = offsetRayOrigin(p, ng, ng, positionErrorM(p));
        }
        rays.push_back({origin, glm::normalize(light - origin), glm::distance(light, origin)});
    }
    return rays;
}

} // namespace kilolux::test
