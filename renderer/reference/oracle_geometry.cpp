// Embree as a generator of candidates, decided upon in double precision.
//
// Error analysis. A world position is exact to a few units of 2^-53 of its largest coordinate; a hit point is
// put onto its triangle's plane by barycentric interpolation, so its height over any coplanar triangle stays
// under kPlaneEpsilon times that coordinate, and hits of planes that contain the origin are refused. Embree
// sees positions rounded by 2^-24 of their distance to the anchor and so may place a crossing wrong by some
// of these; its ray therefore starts that much behind the origin and ends that much after the end.
#include "renderer/reference/oracle_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kilolux::oracle {

namespace {

using glm::dvec3;

constexpr double kPlaneEpsilon = 64.0 * 2.220446049250313e-16;
constexpr double kFloatEpsilon = 16.0 * 5.9604644775390625e-8;
constexpr double kLeastFacing = 1e-3;  // of a shading normal towards the viewer, by the project's definition
constexpr double kEndTolerance = 1e-9; // a surface in which the light's own point lies does not hide it

double largestCoordinate(const dvec3& p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

} // namespace

struct OracleGeometry::Query {
    RTCIntersectContext context; // first, so that the filter finds the rest
    const OracleGeometry* geometry;
    dvec3 originWs;
    dvec3 directionWs;
    double minM;
    double maxM;
    bool primary;                           // culls back faces
    std::optional<std::uint8_t> channels{}; // of the parts that count; all where absent
};

OracleGeometry::OracleGeometry(const Scene& scene) : materials_(scene.materials, scene.images) {
    device_ = rtcNewDevice("threads=1");
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(
        scene_, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    const Bounds bounds = worldBounds(scene);
    anchorWs_ = 0.5 * (bounds.min + bounds.max);
    reachM_ = std::max(largestCoordinate(bounds.max - anchorWs_), 1e-6);
    for (int node = 0; node < static_cast<int>(scene.nodes.size()); ++node) {
        const int mesh = scene.nodes[node].mesh;
        if (!scene.nodes[node].visible || mesh < 0 || !scene.meshes[mesh]) continue;
        for (int p = 0; p < static_cast<int>(scene.meshes[mesh]->primitives.size()); ++p)
            addPart(scene, node, p);
    }
    rtcCommitScene(scene_);
}

OracleGeometry::~OracleGeometry() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

void OracleGeometry::addPart(const Scene& scene, int node, int primitiveIndex) {
    const std::shared_ptr<const Mesh>& mesh = scene.meshes[scene.nodes[node].mesh];
    const Primitive& primitive = mesh->primitives[primitiveIndex];
    const glm::dmat4& world = scene.nodes[node].worldFromNode;
    const glm::dmat3 linear(world);
    const double determinant = glm::determinant(linear);
    if (primitive.indices.size() < 3 || materials_.isDrawnLater(primitive.material)) return;
    const Material& material = materials_.material(primitive.material);
    // A flattened node has no inverse; its normals then come from the faces.
    const glm::dmat3 normalMatrix =
        determinant != 0.0 ? glm::transpose(glm::inverse(linear)) : glm::dmat3(0.0);
    parts_.push_back(
        {mesh, primitiveIndex, node, primitive.material, material.doubleSided,
         material.alphaMode != AlphaMode::Opaque,
         material.alphaMode == AlphaMode::Mask ? material.alphaCutoff : MaterialReader::kOpaqueFrom,
         determinant < 0.0 ? -1.0 : 1.0, scene.nodes[node].meshChannels, world, normalMatrix});
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices =
        static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                    3 * sizeof(float), primitive.positions.size()));
    for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
        const dvec3 p = dvec3(world * glm::dvec4(dvec3(primitive.positions[i]), 1.0)) - anchorWs_;
        for (int axis = 0; axis < 3; ++axis)
            vertices[3 * i + axis] = static_cast<float>(p[axis]);
    }
    const std::size_t triangles = primitive.indices.size() / 3;
    auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), triangles));
    std::copy_n(primitive.indices.begin(), 3 * triangles, indices);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene_, geometry, static_cast<unsigned>(parts_.size() - 1));
    rtcReleaseGeometry(geometry);
}

OracleGeometry::Triangle OracleGeometry::triangle(const Part& part, std::uint32_t index) const {
    const Primitive& primitive = part.primitive();
    Triangle result;
    for (int i = 0; i < 3; ++i) {
        const std::uint32_t vertex = primitive.indices[3 * static_cast<std::size_t>(index) + i];
        result.corner[i] = dvec3(part.worldFromNode * glm::dvec4(dvec3(primitive.positions[vertex]), 1.0));
    }
    result.normal =
        glm::cross(result.corner[1] - result.corner[0], result.corner[2] - result.corner[0]) * part.side;
    return result;
}

namespace {

// Weights of the corners at the point where the line meets the triangle's plane; slightly outside [0,1] where
// Embree, in single precision, saw the edge elsewhere.
dvec3 cornerWeights(const dvec3 (&corner)[3], const dvec3& at) {
    const dvec3 e1 = corner[1] - corner[0];
    const dvec3 e2 = corner[2] - corner[0];
    const dvec3 p = at - corner[0];
    const double d11 = glm::dot(e1, e1);
    const double d12 = glm::dot(e1, e2);
    const double d22 = glm::dot(e2, e2);
    const double determinant = d11 * d22 - d12 * d12;
    double b = (d22 * glm::dot(p, e1) - d12 * glm::dot(p, e2)) / determinant;
    double c = (d11 * glm::dot(p, e2) - d12 * glm::dot(p, e1)) / determinant;
    if (!std::isfinite(b) || !std::isfinite(c)) return dvec3(1.0, 0.0, 0.0);
    b = std::clamp(b, 0.0, 1.0);
    c = std::clamp(c, 0.0, 1.0 - b);
    return {1.0 - b - c, b, c};
}

} // namespace

bool OracleGeometry::accepts(const Query& query, std::uint32_t partIndex, std::uint32_t triangleIndex) const {
    const Part& part = parts_[partIndex];
    if (query.channels && (*query.channels & part.channels) == 0) return false;
    const Triangle tri = triangle(part, triangleIndex);
    const double area2 = glm::length(tri.normal);
    if (!(area2 > 0.0)) return false;
    const double heightM = glm::dot(tri.normal, query.originWs - tri.corner[0]) / area2;
    const double slope = glm::dot(tri.normal, query.directionWs) / area2;
    const double scale = std::max(largestCoordinate(query.originWs), largestCoordinate(tri.corner[0]));
    if (std::abs(heightM) <= kPlaneEpsilon * scale || slope == 0.0) return false;
    const double distanceM = -heightM / slope;
    if (!(distanceM > query.minM) || !(distanceM < query.maxM)) return false;
    if (query.primary && !part.doubleSided && slope > 0.0) return false;
    if (!part.masked) return true;
    const dvec3 weights = cornerWeights(tri.corner, query.originWs + query.directionWs * distanceM);
    return materials_.alpha(part.material,
                            interpolate(part.primitive(), triangleIndex, weights, dvec3(0.0))) >= part.cutoff;
}

void OracleGeometry::filter(const RTCFilterFunctionNArguments* arguments) {
    const auto& query = *reinterpret_cast<const Query*>(arguments->context);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) continue;
        const unsigned part = RTCHitN_geomID(arguments->hit, arguments->N, i);
        const unsigned triangleIndex = RTCHitN_primID(arguments->hit, arguments->N, i);
        if (!query.geometry->accepts(query, part, triangleIndex)) arguments->valid[i] = 0;
    }
}

RTCRay OracleGeometry::makeRay(const Query& query, double& shiftM) const {
    shiftM = kFloatEpsilon * std::max(reachM_, largestCoordinate(query.originWs - anchorWs_));
    const dvec3 origin = query.originWs - anchorWs_ - query.directionWs * shiftM;
    RTCRay ray{};
    ray.org_x = static_cast<float>(origin.x);
    ray.org_y = static_cast<float>(origin.y);
    ray.org_z = static_cast<float>(origin.z);
    ray.dir_x = static_cast<float>(query.directionWs.x);
    ray.dir_y = static_cast<float>(query.directionWs.y);
    ray.dir_z = static_cast<float>(query.directionWs.z);
    ray.tnear = 0.0f;
    const double end =
        std::isfinite(query.maxM) ? query.maxM * (1.0 + kFloatEpsilon) + 2.0 * shiftM : query.maxM;
    ray.tfar = static_cast<float>(end);
    ray.mask = ~0u;
    return ray;
}

bool OracleGeometry::occluded(const dvec3& originWs, const dvec3& directionWs, double lengthM,
                              std::optional<std::uint8_t> channels) const {
    Query query{{}, this, originWs, directionWs, 0.0, lengthM * (1.0 - kEndTolerance), false, channels};
    rtcInitIntersectContext(&query.context);
    query.context.filter = &OracleGeometry::filter;
    double shiftM = 0.0;
    RTCRay ray = makeRay(query, shiftM);
    rtcOccluded1(scene_, &query.context, &ray);
    return ray.tfar < 0.0f;
}

std::optional<OracleHit> OracleGeometry::nearest(const dvec3& originWs, const dvec3& directionWs,
                                                 double minDistanceM) const {
    Query query{{}, this, originWs, directionWs, minDistanceM, std::numeric_limits<double>::infinity(), true};
    rtcInitIntersectContext(&query.context);
    query.context.filter = &OracleGeometry::filter;
    double shiftM = 0.0;
    RTCRayHit rayHit{};
    rayHit.ray = makeRay(query, shiftM);
    rayHit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &query.context, &rayHit);
    if (rayHit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return describe(query, parts_[rayHit.hit.geomID], rayHit.hit.primID);
}

OracleHit OracleGeometry::describe(const Query& query, const Part& part, std::uint32_t triangleIndex) const {
    const Triangle tri = triangle(part, triangleIndex);
    const dvec3 face = glm::normalize(tri.normal);
    const double distanceM =
        glm::dot(face, tri.corner[0] - query.originWs) / glm::dot(face, query.directionWs);
    const dvec3 weights = cornerWeights(tri.corner, query.originWs + query.directionWs * distanceM);
    const dvec3 faceInNode = glm::normalize(glm::transpose(glm::dmat3(part.worldFromNode)) * face);
    const SurfaceSample at = interpolate(part.primitive(), triangleIndex, weights, faceInNode);
    const MaterialValue value = materials_.evaluate(part.material, at);

    OracleHit hit;
    hit.distanceM = distanceM;
    hit.node = part.node;
    hit.primitive = part.primitiveIndex;
    hit.triangle = static_cast<int>(triangleIndex);
    hit.emissionNit = value.emissionNit;
    hit.point.positionWs = tri.corner[0] * weights.x + tri.corner[1] * weights.y + tri.corner[2] * weights.z;
    hit.point.viewDirWs = -query.directionWs;
    hit.point.material = {value.baseColor, value.metallic, value.roughness};
    hit.point.channels = part.channels;

    dvec3 normal = part.normalMatrix * at.normal;
    const double normalLength = glm::length(normal);
    normal = normalLength > 0.0 ? normal / normalLength : face;
    dvec3 tangent = glm::dmat3(part.worldFromNode) * dvec3(at.tangent);
    tangent -= normal * glm::dot(normal, tangent);
    const double tangentLength = glm::length(tangent);
    if (tangentLength > 0.0 && value.tangentNormal.z < 1.0) {
        const dvec3 t = tangent / tangentLength;
        const dvec3 b = glm::cross(normal, t) * (at.tangent.w * part.side);
        const dvec3& m = value.tangentNormal;
        normal = glm::normalize(t * m.x + b * m.y + normal * m.z);
    }
    // Both normals turn together towards the viewer.
    const double facing = glm::dot(face, hit.point.viewDirWs) < 0.0 ? -1.0 : 1.0;
    hit.point.geometricNormalWs = face * facing;
    normal *= facing;
    const double noV = glm::dot(normal, hit.point.viewDirWs);
    if (noV < kLeastFacing) // bent until it is seen edge on
        normal = glm::normalize(normal + hit.point.viewDirWs * (kLeastFacing - noV));
    hit.point.shadingNormalWs = normal;
    return hit;
}

} // namespace kilolux::oracle
