// Small scenes made in code, and two references for rays: every triangle tested in double precision, and
// Embree in robust mode. Shared by the tests of accel and the tracer's bench.
#pragma once

#include "renderer/accel/ray_world.h"
#include "renderer/document/scene.h"

#include <embree3/rtcore.h>

#include <functional>
#include <random>
#include <vector>

namespace kilolux::test {

// --- Scenes ---------------------------------------------------------------------------------------------

Primitive makePrimitive(std::vector<glm::vec3> positions, std::vector<std::uint32_t> indices);

// Closed, convex, counter-clockwise from outside.
Primitive makeSphere(int rings, int segments, double radiusM = 1.0);
Primitive makeBox(const glm::dvec3& halfSizeM);
// Closed and bumpy: a torus with a wavy tube.
Primitive makeTorus(int rings, int segments, double majorM, double minorM, double waveM);
// (cells + 1)^2 vertices over [-1, 1]^2 in x and z, height from the function.
Primitive makeGrid(int cells, const std::function<double(double, double)>& height);
// Random triangles in the unit cube with edges up to `edgeM`, a tenth of them slivers, a tenth of them
// coplanar with an axis plane.
Primitive makeSoup(int triangles, double edgeM, unsigned seed);

// One node per primitive, placed by `worldFromLocal`.
Scene makeScene(std::vector<Primitive> primitives, const glm::dmat4& worldFromLocal = glm::dmat4(1.0));
glm::dmat4 placed(const glm::dvec3& position, double scale);
RayWorld worldOf(const Scene& scene, const glm::dvec3& anchor = glm::dvec3(0.0)); // all of it static
int addNode(Scene& scene, int mesh, const glm::dmat4& worldFromLocal);            // returns the node

// --- Rays -----------------------------------------------------------------------------------------------

struct TestRay {
    glm::vec3 origin;
    glm::vec3 dir;
    float tMaxM = 1e30f;
};

glm::vec3 randomDirection(std::mt19937& random);
glm::dvec3 randomDirectionF64(std::mt19937& random);
// From a random place in the box (grown by `grow` of its size) towards another one inside it.
TestRay randomRay(std::mt19937& random, const glm::vec3& lower, const glm::vec3& upper, double grow);

// Aimed at the target as exactly as floats can.
TestRay rayTo(const glm::dvec3& origin, const glm::dvec3& target);

// --- References -----------------------------------------------------------------------------------------

// All world triangles of a scene, relative to an anchor, as the tracer gets them.
std::vector<SoupTriangle> worldTriangles(const Scene& scene, const glm::dvec3& anchor);

struct ExactHit {
    double tM = 1e300;
    bool hit = false;
    // Smallest distance, relative to the scene's size, at which the answer of some triangle flips.
    double edgeMargin = 1e300;
};
ExactHit nearestExact(const std::vector<SoupTriangle>& triangles, const TestRay& ray);

class EmbreeScene {
  public:
    explicit EmbreeScene(const std::vector<SoupTriangle>& triangles);
    // With the instancing of buildWorld(): static triangles in one mesh, each moving instance an Embree
    // instance.
    EmbreeScene(const Scene& scene, const std::vector<Instance>& instances, const std::vector<bool>& moving);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;
    bool occluded(const TestRay& ray) const;
    float nearest(const TestRay& ray) const; // distance; infinity without a hit
    RTCScene handle() const { return scene_; }

  private:
    RTCScene newScene() const;
    void attachTriangles(RTCScene scene, const std::vector<SoupTriangle>& triangles) const;

    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
};

} // namespace kilolux::test
