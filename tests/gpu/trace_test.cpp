// Both tracing back ends on the device: the compute BVH against the same shader source run on the CPU, ray
// query against the compute BVH, with moving instances, alpha masks, and rays that leave surfaces.
#include "tests/gpu/support/gpu_fixture.h"
#include "tests/unit/accel/scene_kit.h"

#include "renderer/accel/ray_world_cpu.h"
#include "renderer/accel_gpu/gpu_ray_world.h"
#include "shaders/shared/features.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace kilolux::test {

namespace {

struct TracedRay {
    float tM;
    std::uint32_t instance, primitive;
    float barycentric1, barycentric2;
    std::uint32_t flags;
    bool occluded() const { return (flags & 1u) != 0; }
    bool backFace() const { return (flags & 2u) != 0; }
    bool hit() const { return instance != 0xFFFFFFFFu; }
};

constexpr const char* kShader = "../tests/gpu/trace_rays.comp";

class TraceTest : public GpuTest {
  protected:
    std::vector<TracedRay> runCompute(const RayWorld& world, const std::vector<TestRay>& rays) {
        const GpuRayWorld buffers(device(), world);
        gpu::ComputePass pass(resources(), "trace_rays", withTestUses(GpuRayWorld::traceUses()), kShader);
        return run(pass, buffers.traceBindings(), world.hasAlpha(), rays);
    }

    std::vector<TracedRay> runRayQuery(const RayWorld& world, const std::vector<TestRay>& rays) {
        const GpuRayWorld buffers(device(), world, TraceBackEnd::RayQuery);
        gpu::ComputePass pass(resources(), "trace_rays",
                              withTestUses(GpuRayWorld::traceUses(TraceBackEnd::RayQuery)), kShader,
                              {"KX_RAY_QUERY"});
        return run(pass, buffers.traceBindings(), world.hasAlpha(), rays);
    }

    // Same hits within ties; returns how many rays differ.
    int compare(const std::vector<TracedRay>& a, const std::vector<TracedRay>& b) {
        int different = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            const bool sameTriangle = a[i].instance == b[i].instance && a[i].primitive == b[i].primitive;
            const bool same = a[i].occluded() == b[i].occluded() && a[i].hit() == b[i].hit() &&
                              (!a[i].hit() || (sameTriangle && a[i].backFace() == b[i].backFace() &&
                                               std::abs(a[i].tM - b[i].tM) <= 1e-4f * (1.0f + b[i].tM) &&
                                               std::abs(a[i].barycentric1 - b[i].barycentric1) < 2e-3f &&
                                               std::abs(a[i].barycentric2 - b[i].barycentric2) < 2e-3f));
            different += !same;
        }
        return different;
    }

  private:
    static std::vector<gpu::PassUse> withTestUses(std::vector<gpu::PassUse> uses) {
        uses.push_back({"testRays"});
        uses.push_back({"TracedRays", gpu::Access::Write});
        return uses;
    }

    std::vector<TracedRay> run(gpu::ComputePass& pass, gpu::Bindings bindings, bool hasAlpha,
                               const std::vector<TestRay>& rays) {
        std::vector<glm::vec4> texels;
        for (const TestRay& ray : rays) {
            texels.push_back(glm::vec4(ray.origin, 0.0f));
            texels.push_back(glm::vec4(ray.dir, ray.tMaxM));
        }
        gpu::BufferDesc desc{"testRays", texels.size() * sizeof(glm::vec4),
                             VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT};
        desc.texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
        gpu::Buffer rayBuffer(device(), desc);
        rayBuffer.upload(texels);
        gpu::Buffer results(device(), {"tracedRays", rays.size() * sizeof(TracedRay)});
        bindings.push_back({"testRays", rayBuffer});
        bindings.push_back({"TracedRays", results});
        gpu::Commands commands(device());
        const std::uint32_t count = std::uint32_t(rays.size());
        pass.record(commands, {{shared::FEATURE_ALPHA_MASK, hasAlpha}}, bindings, count, {(count + 63) / 64});
        commands.submitAndWait();
        return results.downloadAs<TracedRay>();
    }
};

std::vector<TracedRay> runCpu(const RayWorld& world, const std::vector<TestRay>& rays) {
    std::vector<TracedRay> results;
    for (const TestRay& ray : rays) {
        const CpuHit hit = nearest(world, ray.origin, ray.dir, 0.0f, ray.tMaxM);
        const bool any = occluded(world, ray.origin, ray.dir, 0.0f, ray.tMaxM);
        results.push_back({hit.tM, hit.instance, hit.primitive, hit.barycentrics.x, hit.barycentrics.y,
                           (any ? 1u : 0u) | (hit.backFace ? 2u : 0u)});
    }
    return results;
}

glm::dmat4 placed(const glm::dvec3& position, double scale, double turnRad) {
    const glm::dmat4 moved = glm::translate(glm::dmat4(1.0), position);
    return glm::scale(glm::rotate(moved, turnRad, glm::normalize(glm::dvec3(1.0, 2.0, 0.5))),
                      glm::dvec3(scale));
}

Scene clutter(double scale) {
    Scene scene =
        makeScene({makeTorus(40, 24, 2.0, 0.7, 0.2), makeSphere(24, 24, 1.2), makeBox({3.0, 0.001, 3.0})},
                  placed(glm::dvec3(0.0), scale, 0.3));
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int i = 0; i < 12; ++i) {
        const glm::dmat4 place = placed(glm::dvec3(unit(random), unit(random), unit(random)) * 5.0 * scale,
                                        0.5 * scale, unit(random) * 3.0);
        addNode(scene, i % 3, i % 4 == 0 ? glm::scale(place, glm::dvec3(-1.0, 1.0, 1.5)) : place);
    }
    return scene;
}

std::vector<TestRay> raysThrough(const Box& bounds, int count, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<TestRay> rays;
    for (int i = 0; i < count; ++i) {
        rays.push_back(randomRay(random, bounds.lower, bounds.upper, 0.3));
        if (i % 4 == 0) rays.back().tMaxM = 0.3f * glm::length(bounds.upper - bounds.lower);
    }
    return rays;
}

// Leaves, as quads with a checkered alpha texture, in front of a wall.
Scene foliage() {
    auto image = std::make_shared<Image>();
    image->width = image->height = 16;
    for (int texel = 0; texel < 256; ++texel) {
        const bool solid = (texel / 4 + texel / 64) % 2 == 0;
        for (const int value : {255, 255, 255, solid ? 255 : 0})
            image->rgba8.push_back(std::uint8_t(value));
    }
    Material leaf;
    leaf.alphaMode = AlphaMode::Mask;
    leaf.alphaCutoff = 0.4;
    leaf.baseColor.image = 0;
    leaf.baseColor.scale = {2.0, 1.5};
    leaf.baseColor.offset = {0.2, 0.1};
    leaf.baseColor.rotationRad = 0.3;
    leaf.baseColor.wrapT = WrapMode::MirroredRepeat;
    Material faded; // no texture: vertex alpha alone
    faded.alphaMode = AlphaMode::Mask;
    Scene scene;
    scene.images.push_back(image);
    scene.materials = {leaf, faded};
    for (const int material : {0, 1, -1}) {
        Primitive card = makeGrid(3, [](double x, double z) { return 0.2 * x * z; });
        card.material = material;
        for (const glm::vec3& p : card.positions) {
            card.uv0.push_back(glm::vec2(p.x, p.z));
            card.colors.push_back(glm::vec4(1.0f, 1.0f, 1.0f, material == 1 ? 0.5f + 0.5f * p.x : 1.0f));
        }
        Mesh mesh;
        mesh.primitives.push_back(card);
        scene.meshes.push_back(std::make_shared<const Mesh>(mesh));
    }
    std::mt19937 random(8);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int i = 0; i < 60; ++i)
        addNode(scene, i % 8 == 0 ? 2 : i % 2,
                placed(glm::dvec3(unit(random), unit(random), unit(random)) * 4.0, 0.8, unit(random) * 3.0));
    return scene;
}

} // namespace

TEST_F(TraceTest, ComputeEqualsTheSameSourceOnTheCpu) {
    for (const double scale : {0.01, 1.0, 1000.0}) {
        const Scene scene = clutter(scale);
        const RayWorld world = buildWorld(scene, enumerateInstances(scene), {}, glm::dvec3(0.0));
        const std::vector<TestRay> rays = raysThrough(world.staticBounds, 20000, 1);
        const std::vector<TracedRay> expected = runCpu(world, rays);
        EXPECT_LE(compare(runCompute(world, rays), expected), 4) << scale;
        EXPECT_GT(std::count_if(expected.begin(), expected.end(), [](const TracedRay& r) { return r.hit(); }),
                  4000);
    }
}

TEST_F(TraceTest, RayQueryEqualsComputeWithinTies) {
    if (!device().hasRayQuery()) GTEST_SKIP() << "'" << device().name() << "' has no ray query";
    for (const double scale : {0.01, 1.0, 1000.0}) {
        const Scene scene = clutter(scale);
        const RayWorld world = buildWorld(scene, enumerateInstances(scene), {}, glm::dvec3(0.0));
        const std::vector<TestRay> rays = raysThrough(world.staticBounds, 20000, 2);
        const int different = compare(runRayQuery(world, rays), runCompute(world, rays));
        std::printf("scale %g: %d of %zu rays differ between the back ends\n", scale, different, rays.size());
        EXPECT_LE(different, 20) << scale;
    }
}

TEST_F(TraceTest, MovingInstancesInBothBackEnds) {
    Scene scene = clutter(1.0);
    const std::vector<Instance> before = enumerateInstances(scene);
    std::vector<bool> moving(before.size());
    for (std::size_t i = 0; i < moving.size(); ++i)
        moving[i] = i % 2 == 1;
    RayWorld world = buildWorld(scene, before, moving, glm::dvec3(0.0));
    for (std::size_t i = 0; i < moving.size(); ++i)
        if (moving[i]) scene.nodes[i].worldFromNode[3] += glm::dvec4(1.0, 0.5, -0.7, 0.0);
    const glm::dvec3 anchor(2.0, 1.0, 0.0);
    const std::vector<Instance> after = enumerateInstances(scene);
    updateInstances(world, after, anchor);
    const RayWorld fresh = buildWorld(scene, after, {}, anchor);
    const std::vector<TestRay> rays = raysThrough(fresh.staticBounds, 20000, 3);
    const std::vector<TracedRay> expected = runCompute(fresh, rays);
    EXPECT_LE(compare(runCompute(world, rays), expected), 10);
    if (device().hasRayQuery()) {
        EXPECT_LE(compare(runRayQuery(world, rays), expected), 20);
    }
}

TEST_F(TraceTest, EmptyWorldsInBothBackEnds) {
    const std::vector<TestRay> rays = raysThrough({glm::vec3(-5.0f), glm::vec3(5.0f)}, 100, 4);
    const RayWorld empty = buildWorld(Scene{}, {}, {}, glm::dvec3(0.0));
    // Nothing but one thing that moves, squashed to nothing.
    Scene scene = makeScene({makeSphere(10, 10)}, glm::dmat4(glm::dmat3(0.0)));
    const RayWorld squashed = buildWorld(scene, enumerateInstances(scene), {true}, glm::dvec3(0.0));
    for (const RayWorld* world : {&empty, &squashed}) {
        for (const TracedRay& ray : runCompute(*world, rays))
            ASSERT_FALSE(ray.hit() || ray.occluded());
        if (!device().hasRayQuery()) continue;
        for (const TracedRay& ray : runRayQuery(*world, rays))
            ASSERT_FALSE(ray.hit() || ray.occluded());
    }
}

TEST_F(TraceTest, WorldsBeyondTheDevicesLimitsAreRefused) {
    const Scene scene = clutter(1.0);
    RayWorld world = buildWorld(scene, enumerateInstances(scene), {}, glm::dvec3(0.0));
    EXPECT_FALSE(GpuRayWorld::excess(device(), world).has_value());
    const std::size_t limit = device().limits().maxTexelBufferElements;
    if (limit > (std::size_t{1} << 28))
        GTEST_SKIP() << "no world of the test's size is too large for this device";
    world.alpha.texels.resize(limit + 1);
    const std::optional<Error> error = GpuRayWorld::excess(device(), world);
    ASSERT_TRUE(error.has_value());
    EXPECT_NE(error->message.find("alpha texels"), std::string::npos);
}

TEST_F(TraceTest, UpdateEqualsAFreshUpload) {
    Scene scene = clutter(1.0);
    const std::vector<Instance> before = enumerateInstances(scene);
    RayWorld world = buildWorld(scene, before, std::vector<bool>(before.size(), true), glm::dvec3(0.0));
    GpuRayWorld buffers(device(), world);
    const std::vector<std::byte> nodesBefore = buffers.nodes().download();
    for (Node& node : scene.nodes)
        node.worldFromNode = glm::rotate(node.worldFromNode, 0.8, glm::dvec3(0.0, 1.0, 0.0));
    updateInstances(world, enumerateInstances(scene), glm::dvec3(0.0));
    buffers.update(world);
    const GpuRayWorld fresh(device(), world);
    const std::vector<std::byte> nodes = buffers.nodes().download(), entries = buffers.entries().download();
    EXPECT_EQ(nodes, fresh.nodes().download());
    EXPECT_EQ(entries, fresh.entries().download());
    EXPECT_NE(nodes, nodesBefore);
}

TEST_F(TraceTest, AlphaMasksInBothBackEnds) {
    const Scene scene = foliage();
    const std::vector<Instance> instances = enumerateInstances(scene);
    const RayWorld world = buildWorld(scene, instances, {}, glm::dvec3(0.0));
    ASSERT_TRUE(world.hasAlpha());
    const std::vector<TestRay> rays = raysThrough(world.staticBounds, 20000, 5);
    const std::vector<TracedRay> expected = runCpu(world, rays);
    EXPECT_LE(compare(runCompute(world, rays), expected), 20); // texels whose edge lies within rounding
    if (device().hasRayQuery()) {
        EXPECT_LE(compare(runRayQuery(world, rays), expected), 40);
    }
    // The masks matter: without them, other rays are stopped.
    Scene opaque = scene;
    for (Material& material : opaque.materials)
        material.alphaMode = AlphaMode::Opaque;
    const RayWorld solid = buildWorld(opaque, enumerateInstances(opaque), {}, glm::dvec3(0.0));
    EXPECT_FALSE(solid.hasAlpha());
    EXPECT_GT(compare(runCompute(solid, rays), expected), 1000);
    // An alpha-tested hit is only reported where alphaPasses() says so.
    int tested = 0;
    for (const TracedRay& ray : expected)
        if (ray.hit() && instances[ray.instance].role == SurfaceRole::AlphaTested) {
            ++tested;
            EXPECT_TRUE(
                alphaPasses(world, ray.instance, ray.primitive, {ray.barycentric1, ray.barycentric2}));
        }
    EXPECT_GT(tested, 500);
}

TEST_F(TraceTest, SurfacesDoNotShadowThemselvesInBothBackEnds) {
    std::mt19937 random(6);
    for (const double scale : {0.01, 1.0, 10000.0}) {
        const Scene scene =
            makeScene({makeSphere(40, 80), makeBox({0.9, 0.02, 0.9})}, placed(glm::dvec3(0.0), scale, 0.4));
        for (int mesh = 0; mesh < 2; ++mesh) {
            Scene one = scene;
            one.nodes = {scene.nodes[mesh]};
            const RayWorld world = buildWorld(one, enumerateInstances(one), {}, glm::dvec3(0.0));
            const std::vector<SoupTriangle> triangles = worldTriangles(one, glm::dvec3(0.0));
            std::uniform_real_distribution<double> unit(0.0, 1.0);
            std::vector<TestRay> rays;
            for (int i = 0; i < 10000; ++i) {
                const glm::vec3* q = triangles[random() % triangles.size()].position;
                const double r = std::sqrt(unit(random)), s = unit(random);
                const glm::vec3 p = q[0] * float(1.0 - r) + q[1] * float(r * (1.0 - s)) + q[2] * float(r * s);
                const glm::vec3 ng(glm::normalize(
                    glm::cross(glm::dvec3(q[1]) - glm::dvec3(q[0]), glm::dvec3(q[2]) - glm::dvec3(q[0]))));
                glm::vec3 dir = randomDirection(random);
                dir *= glm::dot(dir, ng) < 0.0f ? -1.0f : 1.0f;
                rays.push_back({offsetRayOrigin(p, ng, dir, positionErrorM(p)), dir, 1e30f});
            }
            const auto blocked = [](const std::vector<TracedRay>& results) {
                return std::count_if(results.begin(), results.end(),
                                     [](const TracedRay& r) { return r.occluded(); });
            };
            EXPECT_EQ(blocked(runCompute(world, rays)), 0) << scale;
            if (device().hasRayQuery()) {
                EXPECT_EQ(blocked(runRayQuery(world, rays)), 0) << scale;
            }
        }
    }
}

TEST_F(TraceTest, NothingLeaksAtEdgesOnTheDevice) {
    const Scene scene = makeScene({makeSphere(60, 120)});
    const RayWorld world = buildWorld(scene, enumerateInstances(scene), {}, glm::dvec3(0.0));
    const std::vector<SoupTriangle> triangles = worldTriangles(scene, glm::dvec3(0.0));
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<TestRay> rays;
    for (int i = 0; i < 200000; ++i) {
        const SoupTriangle& t = triangles[random() % triangles.size()];
        const int corner = int(random() % 3);
        const glm::dvec3 target =
            glm::mix(glm::dvec3(t.position[corner]), glm::dvec3(t.position[(corner + 1) % 3]),
                     i % 2 ? unit(random) : 0.0);
        const glm::dvec3 origin(0.1, 0.2, -0.3);
        rays.push_back(
            {glm::vec3(origin), glm::vec3(glm::normalize(target - glm::dvec3(glm::vec3(origin)))), 1e30f});
    }
    int leaks = 0;
    for (const TracedRay& ray : runCompute(world, rays))
        leaks += !ray.occluded() || !ray.hit();
    EXPECT_EQ(leaks, 0);
}

} // namespace kilolux::test
