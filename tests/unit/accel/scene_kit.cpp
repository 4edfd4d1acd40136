// Scenes and references for tests, see scene_kit.h.
#include "tests/unit/accel/scene_kit.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

namespace kilolux::test {

namespace {

constexpr double kPi = 3.14159265358979323846;

double uniform(std::mt19937& random, double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
}

// A grid of (rows + 1) x (columns + 1) vertices closed by wrapping indices where told to.
std::vector<std::uint32_t> gridIndices(int rows, int columns,
                                       const std::function<std::uint32_t(int, int)>& id) {
    std::vector<std::uint32_t> indices;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const std::uint32_t a = id(row, column), b = id(row, column + 1);
            const std::uint32_t c = id(row + 1, column), d = id(row + 1, column + 1);
            for (const std::array<std::uint32_t, 3>& t :
                 {std::array<std::uint32_t, 3>{a, c, b}, std::array<std::uint32_t, 3>{b, c, d}})
                if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
                    indices.insert(indices.end(), t.begin(), t.end());
        }
    return indices;
}

} // namespace

Primitive makePrimitive(std::vector<glm::vec3> positions, std::vector<std::uint32_t> indices) {
    Primitive primitive;
    primitive.positions = std::move(positions);
    primitive.indices = std::move(indices);
    primitive.normals.assign(primitive.positions.size(), glm::vec3(0.0f, 1.0f, 0.0f));
    return primitive;
}

Primitive makeSphere(int rings, int segments, double radiusM) {
    std::vector<glm::vec3> positions;
    const auto id = [&](int ring, int segment) -> std::uint32_t {
        if (ring == 0) return 0;
        if (ring == rings) return 1;
        return std::uint32_t(2 + (ring - 1) * segments + segment % segments);
    };
    positions.push_back(glm::vec3(0.0f, float(radiusM), 0.0f));
    positions.push_back(glm::vec3(0.0f, float(-radiusM), 0.0f));
    for (int ring = 1; ring < rings; ++ring)
        for (int segment = 0; segment < segments; ++segment) {
            const double theta = kPi * ring / rings, phi = 2.0 * kPi * segment / segments;
            positions.push_back(glm::vec3(glm::dvec3(std::sin(theta) * std::sin(phi), std::cos(theta),
                                                     std::sin(theta) * std::cos(phi)) *
                                          radiusM));
        }
    return makePrimitive(std::move(positions), gridIndices(rings, segments, id));
}

Primitive makeBox(const glm::dvec3& halfSizeM) {
    std::vector<glm::vec3> positions;
    for (int corner = 0; corner < 8; ++corner)
        positions.push_back(
            glm::vec3(halfSizeM * glm::dvec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1)));
    return makePrimitive(std::move(positions), {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                                2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5});
}

Primitive makeTorus(int rings, int segments, double majorM, double minorM, double waveM) {
    std::vector<glm::vec3> positions;
    for (int ring = 0; ring < rings; ++ring)
        for (int segment = 0; segment < segments; ++segment) {
            const double u = 2.0 * kPi * ring / rings, v = 2.0 * kPi * segment / segments;
            const double r = minorM + waveM * std::sin(7.0 * u + 3.0 * v);
            positions.push_back(
                glm::vec3(glm::dvec3((majorM + r * std::cos(v)) * std::cos(u), r * std::sin(v),
                                     (majorM + r * std::cos(v)) * std::sin(u))));
        }
    return makePrimitive(std::move(positions), gridIndices(rings, segments, [=](int ring, int segment) {
                             return std::uint32_t((ring % rings) * segments + segment % segments);
                         }));
}

Primitive makeGrid(int cells, const std::function<double(double, double)>& height) {
    std::vector<glm::vec3> positions;
    for (int row = 0; row <= cells; ++row)
        for (int column = 0; column <= cells; ++column) {
            const double x = 2.0 * column / cells - 1.0, z = 2.0 * row / cells - 1.0;
            positions.push_back(glm::vec3(glm::dvec3(x, height(x, z), z)));
        }
    return makePrimitive(std::move(positions), gridIndices(cells, cells, [=](int row, int column) {
                             return std::uint32_t(row * (cells + 1) + column);
                         }));
}

Primitive makeSoup(int triangles, double edgeM, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    for (int t = 0; t < triangles; ++t) {
        const glm::dvec3 centre(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
        const int kind = int(uniform(random, 0, 10));
        for (int corner = 0; corner < 3; ++corner) {
            glm::dvec3 offset = randomDirectionF64(random) * edgeM * uniform(random, 0.2, 1.0);
            if (kind == 0 && corner == 2)
                offset = (glm::dvec3(positions[positions.size() - 1]) - centre) * uniform(random, 0.5, 1.5) +
                         randomDirectionF64(random) * edgeM * 1e-4; // a sliver
            glm::dvec3 position = centre + offset;
            if (kind == 1) position[t % 3] = std::round(centre[t % 3] * 4.0) / 4.0; // coplanar with others
            indices.push_back(std::uint32_t(positions.size()));
            positions.push_back(glm::vec3(position));
        }
    }
    return makePrimitive(std::move(positions), std::move(indices));
}

Scene makeScene(std::vector<Primitive> primitives, const glm::dmat4& worldFromLocal) {
    Scene scene;
    for (Primitive& primitive : primitives) {
        Mesh mesh;
        mesh.primitives.push_back(std::move(primitive));
        scene.meshes.push_back(std::make_shared<const Mesh>(std::move(mesh)));
        addNode(scene, int(scene.meshes.size()) - 1, worldFromLocal);
    }
    return scene;
}

glm::dmat4 placed(const glm::dvec3& position, double scale) {
    glm::dmat4 m = glm::scale(glm::dmat4(1.0), glm::dvec3(scale));
    m[3] = glm::dvec4(position, 1.0);
    return m;
}

RayWorld worldOf(const Scene& scene, const glm::dvec3& anchor) {
    return buildWorld(scene, enumerateInstances(scene), {}, anchor);
}

int addNode(Scene& scene, int mesh, const glm::dmat4& worldFromLocal) {
    Node node;
    node.mesh = mesh;
    node.localFromNode = worldFromLocal;
    node.worldFromNode = worldFromLocal;
    scene.nodes.push_back(node);
    return int(scene.nodes.size()) - 1;
}

glm::dvec3 randomDirectionF64(std::mt19937& random) {
    const double z = uniform(random, -1, 1), phi = uniform(random, 0, 2.0 * kPi);
    const double r = std::sqrt(1.0 - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
}

glm::vec3 randomDirection(std::mt19937& random) {
    return glm::vec3(randomDirectionF64(random));
}

TestRay randomRay(std::mt19937& random, const glm::vec3& lower, const glm::vec3& upper, double grow) {
    const glm::dvec3 size = glm::dvec3(upper) - glm::dvec3(lower);
    glm::dvec3 from, to;
    for (int axis = 0; axis < 3; ++axis) {
        from[axis] = uniform(random, lower[axis] - grow * size[axis], upper[axis] + grow * size[axis]);
        to[axis] = uniform(random, lower[axis], upper[axis]);
    }
    TestRay ray;
    ray.origin = glm::vec3(from);
    ray.dir = glm::vec3(glm::normalize(to - from));
    return ray;
}

TestRay rayTo(const glm::dvec3& origin, const glm::dvec3& target) {
    TestRay ray;
    ray.origin = glm::vec3(origin);
    ray.dir = glm::vec3(glm::normalize(target - glm::dvec3(ray.origin)));
    return ray;
}

std::vector<SoupTriangle> worldTriangles(const Scene& scene, const glm::dvec3& anchor) {
    std::vector<SoupTriangle> triangles;
    for (const Instance& instance : enumerateInstances(scene))
        if (instance.role != SurfaceRole::Absent) appendWorldTriangles(scene, instance, anchor, triangles);
    return triangles;
}

ExactHit nearestExact(const std::vector<SoupTriangle>& triangles, const TestRay& ray) {
    ExactHit best;
    const glm::dvec3 dir(ray.dir), origin(ray.origin);
    for (const SoupTriangle& triangle : triangles) {
        const glm::dvec3 a = glm::dvec3(triangle.position[0]) - origin;
        const glm::dvec3 b = glm::dvec3(triangle.position[1]) - origin;
        const glm::dvec3 c = glm::dvec3(triangle.position[2]) - origin;
        const double u = glm::dot(dir, glm::cross(c, b)), v = glm::dot(dir, glm::cross(a, c)),
                     w = glm::dot(dir, glm::cross(b, a));
        const double scale = std::max({glm::dot(a, a), glm::dot(b, b), glm::dot(c, c)});
        const double longest =
            std::max({glm::length(a - b), glm::length(b - c), glm::length(c - a)}) * std::sqrt(scale);
        const double det = u + v + w;
        const double sign = det < 0.0 ? -1.0 : 1.0;
        const double inside = std::min({u * sign, v * sign, w * sign});
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        const double t = glm::dot(normal, a) / glm::dot(normal, dir);
        if (t < ray.tMaxM * 1.001 && t > -1e-3)
            best.edgeMargin = std::min(best.edgeMargin, longest > 0.0 ? std::abs(inside) / longest : 0.0);
        if (inside < 0.0 || det == 0.0 || !(t >= 0.0 && t < ray.tMaxM)) continue;
        best.hit = true;
        best.tM = std::min(best.tM, t);
    }
    return best;
}

EmbreeScene::EmbreeScene(const std::vector<SoupTriangle>& triangles)
    : device_(rtcNewDevice(nullptr)), scene_(newScene()) {
    attachTriangles(scene_, triangles);
    rtcCommitScene(scene_);
}

EmbreeScene::EmbreeScene(const Scene& scene, const std::vector<Instance>& instances,
                         const std::vector<bool>& moving)
    : device_(rtcNewDevice(nullptr)), scene_(newScene()) {
    std::vector<SoupTriangle> fixed;
    for (std::size_t i = 0; i < instances.size(); ++i) {
        if (instances[i].role == SurfaceRole::Absent) continue;
        if (moving.empty() || !moving[i]) {
            appendWorldTriangles(scene, instances[i], glm::dvec3(0.0), fixed);
            continue;
        }
        std::vector<SoupTriangle> local;
        appendLocalTriangles(scene, instances[i], local);
        RTCScene inner = newScene();
        attachTriangles(inner, local);
        rtcCommitScene(inner);
        RTCGeometry instance = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(instance, inner);
        const glm::mat4x3 transform(glm::mat4(instances[i].worldFromLocal));
        rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &transform);
        rtcCommitGeometry(instance);
        rtcAttachGeometry(scene_, instance);
        rtcReleaseGeometry(instance);
        rtcReleaseScene(inner);
    }
    attachTriangles(scene_, fixed);
    rtcCommitScene(scene_);
}

RTCScene EmbreeScene::newScene() const {
    RTCScene scene = rtcNewScene(device_);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    return scene;
}

void EmbreeScene::attachTriangles(RTCScene scene, const std::vector<SoupTriangle>& triangles) const {
    if (triangles.empty()) return;
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), triangles.size() * 3));
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, triangles.size()));
    for (std::size_t corner = 0; corner < triangles.size() * 3; ++corner) {
        positions[corner] = triangles[corner / 3].position[corner % 3];
        indices[corner] = std::uint32_t(corner);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
}

EmbreeScene::~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

static RTCRay embreeRay(const TestRay& ray) {
    RTCRay result{};
    result.org_x = ray.origin.x;
    result.org_y = ray.origin.y;
    result.org_z = ray.origin.z;
    result.dir_x = ray.dir.x;
    result.dir_y = ray.dir.y;
    result.dir_z = ray.dir.z;
    result.tfar = ray.tMaxM;
    result.mask = 0xFFFFFFFFu;
    return result;
}

bool EmbreeScene::occluded(const TestRay& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay query = embreeRay(ray);
    rtcOccluded1(scene_, &context, &query);
    return query.tfar < 0.0f;
}

float EmbreeScene::nearest(const TestRay& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query{};
    query.ray = embreeRay(ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &query);
    return query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? std::numeric_limits<float>::infinity()
                                                       : query.ray.tfar;
}

} // namespace kilolux::test
