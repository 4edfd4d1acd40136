// Primitives to triangle lists (glTF 2.0, section 3.7; KHR_mesh_quantization). Transforms are left to the
// nodes.
#include "renderer/document/gltf_accessor.h"
#include "renderer/document/mesh_attributes.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace kilolux::gltf {

namespace {

constexpr std::uint32_t kUnused = UINT32_MAX;
// Squares and cubes of larger coordinates leave the range of single precision.
constexpr float kMaxCoordinate = 1e9f;

// A strip's or fan's corners as a list (section 3.7.2.1); every second triangle of a strip is turned around.
std::vector<std::uint32_t> toTriangleList(const std::vector<std::uint32_t>& corners, int mode) {
    std::vector<std::uint32_t> list;
    list.reserve(corners.size() < 3 ? 0 : (corners.size() - 2) * 3);
    for (std::size_t i = 2; i < corners.size(); ++i) {
        if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
            list.insert(list.end(), {corners[i - 1], corners[i], corners[0]});
        } else {
            const std::size_t odd = i % 2;
            list.insert(list.end(), {corners[i - 2], corners[i - 1 + odd], corners[i - odd]});
        }
    }
    return list;
}

class MeshImporter {
  public:
    MeshImporter(ImportContext& context, const tinygltf::Model& model) : context_(context), model_(model) {}

    void run();

  private:
    std::optional<Primitive> importPrimitive(const tinygltf::Primitive& source, const std::string& place);
    std::vector<std::uint32_t> readCorners(const tinygltf::Primitive& source, std::size_t vertexCount,
                                           const std::string& place);
    void chooseVertices(std::vector<std::uint32_t>& indices, std::size_t vertexCount,
                        const std::string& place);
    void readPositions(const AccessorReader& reader, const std::string& place, Primitive& primitive);
    template<int N>
    std::vector<glm::vec<N, float>> readAttribute(const tinygltf::Primitive& source, const char* name,
                                                  std::initializer_list<int> types, const std::string& place);
    void completeAttributes(Primitive& primitive, const std::string& place);

    ImportContext& context_;
    const tinygltf::Model& model_;
    std::vector<std::uint32_t> remap_;  // file's vertex -> primitive's vertex, kUnused between primitives
    std::vector<std::uint32_t> chosen_; // primitive's vertex -> file's vertex
    std::size_t degenerateTriangles_ = 0;
};

std::vector<std::uint32_t> MeshImporter::readCorners(const tinygltf::Primitive& source,
                                                     std::size_t vertexCount, const std::string& place) {
    std::vector<std::uint32_t> corners;
    if (source.indices < 0) {
        context_.chargeGeometry(vertexCount * sizeof(std::uint32_t), place);
        corners.resize(vertexCount);
        for (std::size_t i = 0; i < vertexCount; ++i)
            corners[i] = static_cast<std::uint32_t>(i);
        return corners;
    }
    const std::string indicesPlace = place + "/indices";
    const AccessorReader reader(context_, model_, source.indices, {TINYGLTF_TYPE_SCALAR}, indicesPlace);
    const int type = reader.componentType();
    if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
        fail(indicesPlace, "expected unsigned integers (5121, 5123 or 5125), found component type {}", type);
    }
    context_.chargeGeometry(reader.count() * sizeof(std::uint32_t), indicesPlace);
    corners.resize(reader.count());
    for (std::size_t i = 0; i < corners.size(); ++i) {
        corners[i] = reader.readUnsigned(i);
        if (corners[i] >= vertexCount) {
            fail(indicesPlace, "expected indices under {}, found {} at {}", vertexCount, corners[i], i);
        }
    }
    return corners;
}

// Renumbers the indices to the vertices they use, in order of first use: chosen_[new] is the file's number.
void MeshImporter::chooseVertices(std::vector<std::uint32_t>& indices, std::size_t vertexCount,
                                  const std::string& place) {
    if (remap_.size() < vertexCount) {
        context_.chargeGeometry((vertexCount - remap_.size()) * sizeof(std::uint32_t), place);
        remap_.resize(vertexCount, kUnused);
    }
    chosen_.clear();
    for (std::uint32_t& index : indices) {
        if (remap_[index] == kUnused) {
            remap_[index] = static_cast<std::uint32_t>(chosen_.size());
            chosen_.push_back(index);
        }
        index = remap_[index];
    }
    for (const std::uint32_t vertex : chosen_)
        remap_[vertex] = kUnused;
}

void MeshImporter::readPositions(const AccessorReader& reader, const std::string& place,
                                 Primitive& primitive) {
    context_.chargeGeometry(chosen_.size() * sizeof(glm::vec3), place);
    primitive.positions.resize(chosen_.size());
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
        const auto value = reader.readFloats(chosen_[i]);
        for (int axis = 0; axis < 3; ++axis) {
            if (!(std::abs(value[axis]) <= kMaxCoordinate)) {
                fail(place, "expected coordinates within {:.0e} m, vertex {} has {}", kMaxCoordinate,
                     chosen_[i], value[axis]);
            }
            primitive.positions[i][axis] = value[axis];
        }
    }
}

template<int N>
std::vector<glm::vec<N, float>>
MeshImporter::readAttribute(const tinygltf::Primitive& source, const char* name,
                            std::initializer_list<int> types, const std::string& place) {
    const auto it = source.attributes.find(name);
    if (it == source.attributes.end()) return {};
    const std::string attributePlace = fmt::format("{}/attributes/{}", place, name);
    const AccessorReader reader(context_, model_, it->second, types, attributePlace);
    const std::size_t available = reader.count();
    context_.chargeGeometry(chosen_.size() * sizeof(glm::vec<N, float>), attributePlace);
    std::vector<glm::vec<N, float>> values(chosen_.size());
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
        if (chosen_[i] >= available) {
            fail(attributePlace, "expected as many elements as POSITION has, found {}", available);
        }
        const auto value = reader.readFloats(chosen_[i]);
        for (int axis = 0; axis < N; ++axis) {
            // A damaged normal or texture coordinate spoils its vertex only; zero normals are repaired later.
            values[i][axis] = std::isfinite(value[axis]) ? value[axis] : 0.0f;
        }
        if (N == 4 && reader.components() == 3) values[i][N - 1] = 1.0f;
    }
    return values;
}

void MeshImporter::completeAttributes(Primitive& primitive, const std::string& place) {
    if (primitive.normals.empty()) {
        primitive.tangents.clear(); // section 3.7.2.1: without normals they are ignored
        context_.chargeGeometry(primitive.indices.size() * sizeof(glm::vec3) * 2, place);
        makeFlatNormals(primitive);
    } else {
        repairNormals(primitive);
        repairTangents(primitive);
    }
    const Material* material =
        primitive.material >= 0 ? &context_.scene.materials[primitive.material] : nullptr;
    if (material && material->normal.image >= 0 && primitive.tangents.empty()) {
        const bool useUv1 = material->normal.texCoord == 1;
        if (!(useUv1 ? primitive.uv1 : primitive.uv0).empty()) {
            context_.chargeGeometry(primitive.positions.size() * sizeof(glm::vec4), place);
            makeTangents(primitive, useUv1 ? UvSet::Uv1 : UvSet::Uv0);
        }
    }
    updateBounds(primitive);
}

std::optional<Primitive> MeshImporter::importPrimitive(const tinygltf::Primitive& source,
                                                       const std::string& place) {
    const int mode = source.mode < 0 ? TINYGLTF_MODE_TRIANGLES : source.mode;
    if (mode < TINYGLTF_MODE_TRIANGLES) {
        context_.warnOnce("points and lines", place, "points and lines are not shown");
        return std::nullopt;
    }
    const auto position = source.attributes.find("POSITION");
    if (position == source.attributes.end()) {
        context_.warn(place + "/attributes", "expected POSITION; the primitive is left out");
        return std::nullopt;
    }
    const std::string positionPlace = place + "/attributes/POSITION";
    const AccessorReader positions(context_, model_, position->second, {TINYGLTF_TYPE_VEC3}, positionPlace);
    Primitive primitive;
    primitive.material = source.material;
    primitive.indices = readCorners(source, positions.count(), place);
    if (mode != TINYGLTF_MODE_TRIANGLES) {
        context_.chargeGeometry(primitive.indices.size() * 3 * sizeof(std::uint32_t), place);
        primitive.indices = toTriangleList(primitive.indices, mode);
    } else if (primitive.indices.size() % 3 != 0) {
        context_.warn(place, "expected corners in threes, found {}; the rest is left out",
                      primitive.indices.size());
        primitive.indices.resize(primitive.indices.size() / 3 * 3);
    }
    chooseVertices(primitive.indices, positions.count(), place);
    readPositions(positions, positionPlace, primitive);
    primitive.normals = readAttribute<3>(source, "NORMAL", {TINYGLTF_TYPE_VEC3}, place);
    primitive.tangents = readAttribute<4>(source, "TANGENT", {TINYGLTF_TYPE_VEC4}, place);
    primitive.uv0 = readAttribute<2>(source, "TEXCOORD_0", {TINYGLTF_TYPE_VEC2}, place);
    primitive.uv1 = readAttribute<2>(source, "TEXCOORD_1", {TINYGLTF_TYPE_VEC2}, place);
    primitive.colors = readAttribute<4>(source, "COLOR_0", {TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4}, place);
    degenerateTriangles_ += dropDegenerateTriangles(primitive);
    if (primitive.indices.empty()) return std::nullopt;
    completeAttributes(primitive, place);
    return primitive;
}

void MeshImporter::run() {
    std::vector<bool> used(model_.meshes.size(), false);
    for (const Node& node : context_.scene.nodes) {
        if (node.mesh >= 0) used[node.mesh] = true;
    }
    for (std::size_t i = 0; i < model_.meshes.size(); ++i) {
        context_.reach("Reading meshes", 0.7, 0.95, i, model_.meshes.size());
        auto mesh = std::make_shared<Mesh>();
        mesh->name = model_.meshes[i].name;
        // A mesh that no node shows is kept as an empty slot.
        for (std::size_t p = 0; used[i] && p < model_.meshes[i].primitives.size(); ++p) {
            auto primitive = importPrimitive(model_.meshes[i].primitives[p],
                                             fmt::format("/meshes/{}/primitives/{}", i, p));
            if (primitive) mesh->primitives.push_back(std::move(*primitive));
        }
        context_.scene.meshes.push_back(std::move(mesh));
    }
    if (degenerateTriangles_ > 0) {
        context_.warn("/meshes", "{} triangles without area are left out", degenerateTriangles_);
    }
}

} // namespace

void importMeshes(ImportContext& context, const tinygltf::Model& model) {
    MeshImporter(context, model).run();
}

} // namespace kilolux::gltf
