#include "renderer/document/mesh_attributes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace kilolux {

namespace {

// Doubles, because products of single precision coordinates of large scenes overflow or cancel.
glm::dvec3 edgeCross(const Primitive& primitive, std::size_t triangle) {
    const glm::dvec3 a(primitive.positions[primitive.indices[triangle * 3]]);
    const glm::dvec3 b(primitive.positions[primitive.indices[triangle * 3 + 1]]);
    const glm::dvec3 c(primitive.positions[primitive.indices[triangle * 3 + 2]]);
    return glm::cross(b - a, c - a);
}

glm::dvec3 normalizeOr(const glm::dvec3& vector, const glm::dvec3& fallback) {
    const double length = glm::length(vector);
    return length > 0.0 && std::isfinite(length) ? vector / length : fallback;
}

double cornerAngleRad(const glm::dvec3& corner, const glm::dvec3& next, const glm::dvec3& previous) {
    const glm::dvec3 a = normalizeOr(next - corner, glm::dvec3(0.0));
    const glm::dvec3 b = normalizeOr(previous - corner, glm::dvec3(0.0));
    return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
}

glm::dvec3 anyPerpendicular(const glm::dvec3& normal) {
    const glm::dvec3 axis = std::abs(normal.x) < 0.7 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    return glm::normalize(axis - normal * glm::dot(axis, normal));
}

// Calls function(attribute) for every vertex attribute that is present.
template<typename Function>
void forEachAttribute(Primitive& primitive, Function function) {
    const auto visit = [&](auto& attribute) {
        if (!attribute.empty()) function(attribute);
    };
    visit(primitive.positions);
    visit(primitive.normals);
    visit(primitive.tangents);
    visit(primitive.uv0);
    visit(primitive.uv1);
    visit(primitive.colors);
}

} // namespace

std::size_t dropDegenerateTriangles(Primitive& primitive) {
    std::size_t kept = 0;
    const std::size_t triangles = primitive.indices.size() / 3;
    for (std::size_t t = 0; t < triangles; ++t) {
        const glm::dvec3 normal = edgeCross(primitive, t);
        if (normal == glm::dvec3(0.0)) continue;
        for (int corner = 0; corner < 3; ++corner) {
            primitive.indices[kept * 3 + corner] = primitive.indices[t * 3 + corner];
        }
        ++kept;
    }
    primitive.indices.resize(kept * 3);
    return triangles - kept;
}

void makeFlatNormals(Primitive& primitive) {
    const std::vector<std::uint32_t> corners = primitive.indices;
    primitive.normals.clear();
    forEachAttribute(primitive, [&](auto& attribute) {
        std::decay_t<decltype(attribute)> split(corners.size());
        for (std::size_t i = 0; i < corners.size(); ++i)
            split[i] = attribute[corners[i]];
        attribute = std::move(split);
    });
    for (std::size_t i = 0; i < corners.size(); ++i)
        primitive.indices[i] = static_cast<std::uint32_t>(i);
    primitive.normals.resize(corners.size());
    for (std::size_t t = 0; t < corners.size() / 3; ++t) {
        const glm::vec3 normal(normalizeOr(edgeCross(primitive, t), glm::dvec3(0.0, 1.0, 0.0)));
        std::fill_n(primitive.normals.begin() + static_cast<std::ptrdiff_t>(t * 3), 3, normal);
    }
}

void repairNormals(Primitive& primitive) {
    std::vector<bool> broken(primitive.normals.size(), false);
    bool anyBroken = false;
    for (std::size_t i = 0; i < primitive.normals.size(); ++i) {
        const glm::dvec3 normal = normalizeOr(glm::dvec3(primitive.normals[i]), glm::dvec3(0.0));
        broken[i] = normal == glm::dvec3(0.0);
        anyBroken = anyBroken || broken[i];
        primitive.normals[i] = glm::vec3(normal);
    }
    if (!anyBroken) return;
    std::vector<glm::dvec3> sums(primitive.normals.size(), glm::dvec3(0.0));
    for (std::size_t t = 0; t < primitive.indices.size() / 3; ++t) {
        const glm::dvec3 normal = normalizeOr(edgeCross(primitive, t), glm::dvec3(0.0));
        for (int corner = 0; corner < 3; ++corner) {
            const auto at = [&](int i) {
                return glm::dvec3(primitive.positions[primitive.indices[t * 3 + (corner + i) % 3]]);
            };
            sums[primitive.indices[t * 3 + corner]] += normal * cornerAngleRad(at(0), at(1), at(2));
        }
    }
    for (std::size_t i = 0; i < primitive.normals.size(); ++i) {
        if (broken[i]) primitive.normals[i] = glm::vec3(normalizeOr(sums[i], glm::dvec3(0.0, 1.0, 0.0)));
    }
}

void makeTangents(Primitive& primitive, UvSet uvSet) {
    const std::size_t vertexCount = primitive.positions.size();
    const std::vector<glm::vec2> uv = uvSet == UvSet::Uv1 ? primitive.uv1 : primitive.uv0;
    // Sums per vertex for triangles whose texture is mirrored (0) and not (1).
    std::vector<std::array<glm::dvec3, 2>> sums(vertexCount, {glm::dvec3(0.0), glm::dvec3(0.0)});
    std::vector<std::uint8_t> cornerSide(primitive.indices.size(), 2); // 2: no direction of its own
    std::vector<std::uint8_t> sidesUsed(vertexCount, 0);
    for (std::size_t t = 0; t < primitive.indices.size() / 3; ++t) {
        const std::uint32_t* corner = &primitive.indices[t * 3];
        const glm::dvec3 p0(primitive.positions[corner[0]]);
        const glm::dvec3 e1 = glm::dvec3(primitive.positions[corner[1]]) - p0;
        const glm::dvec3 e2 = glm::dvec3(primitive.positions[corner[2]]) - p0;
        const glm::dvec2 d1 = glm::dvec2(uv[corner[1]]) - glm::dvec2(uv[corner[0]]);
        const glm::dvec2 d2 = glm::dvec2(uv[corner[2]]) - glm::dvec2(uv[corner[0]]);
        const double determinant = d1.x * d2.y - d1.y * d2.x;
        if (determinant == 0.0 || !std::isfinite(determinant)) continue;
        const double sign = determinant > 0.0 ? 1.0 : -1.0;
        const glm::dvec3 tangent = sign * (e1 * d2.y - e2 * d1.y); // along dP/du
        // With v growing downwards, counter-clockwise in (u, v) is clockwise in the picture.
        const std::uint8_t side = sign > 0.0 ? 0 : 1;
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t vertex = corner[i];
            const glm::dvec3 normal(primitive.normals[vertex]);
            const auto at = [&](int k) { return glm::dvec3(primitive.positions[corner[(i + k) % 3]]); };
            const glm::dvec3 inPlane =
                normalizeOr(tangent - normal * glm::dot(tangent, normal), glm::dvec3(0.0));
            sums[vertex][side] += inPlane * cornerAngleRad(at(0), at(1), at(2));
            cornerSide[t * 3 + i] = side;
            sidesUsed[vertex] |= static_cast<std::uint8_t>(1 << side);
        }
    }
    primitive.tangents.assign(vertexCount, glm::vec4(0.0f));
    const auto tangentOf = [&](std::size_t vertex, int side) {
        const glm::dvec3 normal(primitive.normals[vertex]);
        const glm::dvec3 sum = sums[vertex][side] - normal * glm::dot(sums[vertex][side], normal);
        const glm::vec3 direction(normalizeOr(sum, anyPerpendicular(normal)));
        return glm::vec4(direction, side == 1 ? 1.0f : -1.0f);
    };
    std::vector<std::uint32_t> mirroredCopy(vertexCount, 0);
    for (std::size_t vertex = 0; vertex < vertexCount; ++vertex) {
        const int side = sidesUsed[vertex] & 2 || sidesUsed[vertex] == 0 ? 1 : 0;
        primitive.tangents[vertex] = tangentOf(vertex, side);
        if (sidesUsed[vertex] != 3) continue;
        mirroredCopy[vertex] = static_cast<std::uint32_t>(primitive.positions.size());
        forEachAttribute(primitive, [&](auto& attribute) {
            const auto copy = attribute[vertex];
            attribute.push_back(copy);
        });
        primitive.tangents.back() = tangentOf(vertex, 0);
    }
    for (std::size_t i = 0; i < primitive.indices.size(); ++i) {
        const std::uint32_t vertex = primitive.indices[i];
        if (cornerSide[i] == 0 && sidesUsed[vertex] == 3) primitive.indices[i] = mirroredCopy[vertex];
    }
}

void repairTangents(Primitive& primitive) {
    for (std::size_t i = 0; i < primitive.tangents.size(); ++i) {
        const glm::dvec3 normal(primitive.normals[i]);
        const glm::dvec3 tangent(primitive.tangents[i]);
        const glm::dvec3 inPlane = tangent - normal * glm::dot(tangent, normal);
        const float handedness = primitive.tangents[i].w < 0.0f ? -1.0f : 1.0f;
        primitive.tangents[i] =
            glm::vec4(glm::vec3(normalizeOr(inPlane, anyPerpendicular(normal))), handedness);
    }
}

void updateBounds(Primitive& primitive) {
    primitive.boundsMin = primitive.boundsMax = glm::vec3(0.0f);
    if (primitive.positions.empty()) return;
    primitive.boundsMin = primitive.boundsMax = primitive.positions.front();
    for (const glm::vec3& position : primitive.positions) {
        primitive.boundsMin = glm::min(primitive.boundsMin, position);
        primitive.boundsMax = glm::max(primitive.boundsMax, position);
    }
}

} // namespace kilolux
