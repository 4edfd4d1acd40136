// A scene on the device: geometry, materials and what moves; see gpu_scene.h. Its lights are in
// gpu_scene_lights.cpp, textures in gpu_textures.cpp.
#include "renderer/gpu_scene.h"

#include "renderer/gpu/filled_buffer.h"
#include "renderer/gpu_textures.h"
#include "renderer/lights_cpp/lights_f32.h"
#include "shaders/shared/features.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace kilolux {

namespace {

using namespace shared;

// The two texels of shaders/shared/geometry.h.
void appendVertices(const Primitive& primitive, std::vector<glm::uvec4>& out) {
    for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
        const glm::vec3 p = primitive.positions[i];
        const glm::vec3 n = i < primitive.normals.size() ? primitive.normals[i] : glm::vec3(0, 1, 0);
        const glm::vec4 t = i < primitive.tangents.size() ? primitive.tangents[i] : glm::vec4(1, 0, 0, 1);
        const glm::vec2 uv = i < primitive.uv0.size() ? primitive.uv0[i] : glm::vec2(0.0f);
        const glm::vec4 color = i < primitive.colors.size() ? primitive.colors[i] : glm::vec4(1.0f);
        out.emplace_back(glm::floatBitsToUint(p.x), glm::floatBitsToUint(p.y), glm::floatBitsToUint(p.z),
                         f32::packOct16(n));
        const std::uint32_t tangent = (f32::packOct16(glm::vec3(t)) & ~1u) | (t.w < 0.0f ? 1u : 0u);
        out.emplace_back(tangent, glm::floatBitsToUint(uv.x), glm::floatBitsToUint(uv.y),
                         glm::packUnorm4x8(glm::clamp(color, 0.0f, 1.0f)));
    }
}

struct PrimitivePlace {
    std::uint32_t firstVertex, firstIndex, firstUv1;
};

Bounds boundsOf(const Primitive& primitive, const glm::dmat4& world) {
    Bounds bounds{glm::dvec3(1e300), glm::dvec3(-1e300)};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 local(corner & 1 ? primitive.boundsMax.x : primitive.boundsMin.x,
                               corner & 2 ? primitive.boundsMax.y : primitive.boundsMin.y,
                               corner & 4 ? primitive.boundsMax.z : primitive.boundsMin.z);
        const glm::dvec3 p(world * glm::dvec4(local, 1.0));
        bounds.min = glm::min(bounds.min, p);
        bounds.max = glm::max(bounds.max, p);
    }
    return bounds;
}

const Material& materialOf(const Scene& scene, int index) {
    static const Material kDefault;
    return index >= 0 ? scene.materials[std::size_t(index)] : kDefault;
}

void setRows(GpuInstance& gpu, const glm::dmat4& m) {
    gpu.row0 = glm::vec4(m[0][0], m[1][0], m[2][0], m[3][0]);
    gpu.row1 = glm::vec4(m[0][1], m[1][1], m[2][1], m[3][1]);
    gpu.row2 = glm::vec4(m[0][2], m[1][2], m[2][2], m[3][2]);
}

GpuInstance makeInstance(const Instance& instance, const Primitive& primitive, const Material& material,
                         const PrimitivePlace& place, const glm::dvec3& anchor, std::uint32_t defaultMaterial,
                         std::uint8_t channels) {
    glm::dmat4 m = instance.worldFromLocal;
    m[3] -= glm::dvec4(anchor, 0.0);
    GpuInstance gpu{};
    setRows(gpu, m);
    gpu.firstVertex = place.firstVertex;
    gpu.firstIndex = place.firstIndex;
    gpu.firstUv1 = place.firstUv1;
    gpu.material = instance.material >= 0 ? std::uint32_t(instance.material) : defaultMaterial;
    gpu.triangleCount = instance.triangleCount;
    gpu.flags = (glm::determinant(glm::dmat3(m)) < 0.0 ? INSTANCE_MIRRORED : 0u) |
                (material.doubleSided ? INSTANCE_DOUBLE_SIDED : 0u) |
                (instance.role == SurfaceRole::AlphaTested ? INSTANCE_ALPHA_TESTED : 0u) |
                (primitive.tangents.empty() ? 0u : INSTANCE_HAS_TANGENTS) |
                std::uint32_t(channels) << INSTANCE_CHANNELS_SHIFT;
    return gpu;
}

} // namespace

Result<std::unique_ptr<GpuScene>> GpuScene::create(gpu::Device& device, const Scene& scene,
                                                   const glm::dvec3& anchor, double exposureEv100,
                                                   TraceBackEnd backEnd, const std::vector<bool>& moving) {
    std::unique_ptr<GpuScene> result(new GpuScene(device, anchor));
    result->instances_ = enumerateInstances(scene);
    std::vector<std::uint32_t> placeOfImage;
    if (auto error = result->uploadTextures(scene, placeOfImage)) return *error;
    result->uploadGeometry(scene, moving);
    result->uploadMaterials(scene, placeOfImage);
    result->world_ = buildWorld(scene, result->instances_, moving, anchor);
    if (auto error = GpuRayWorld::excess(device, result->world_)) {
        return Error{fmt::format("{}: {}", scene.sourcePath.string(), error->message)};
    }
    result->rayWorld_ = std::make_unique<GpuRayWorld>(device, result->world_, backEnd);
    result->world_.nodes.resize(result->world_.topNodeCapacity);
    result->world_.nodes.shrink_to_fit();
    result->world_.pairs = {};
    result->world_.pairIds = {};
    result->world_.alpha = {};
    result->decideFeatures(scene);
    result->uploadLtcTable();
    result->updateLights(scene, exposureEv100, 0);
    return result;
}

void GpuScene::uploadGeometry(const Scene& scene, const std::vector<bool>& moving) {
    std::map<std::pair<int, int>, PrimitivePlace> places;
    std::vector<glm::uvec4> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<glm::vec2> uv1s;
    for (std::size_t i = 0; i < instances_.size(); ++i) {
        const Instance& instance = instances_[i];
        const Primitive& primitive = primitiveOf(scene, instance);
        const auto [place, isNew] = places.try_emplace({instance.mesh, instance.primitive});
        if (isNew) {
            place->second = {std::uint32_t(vertices.size() / VERTEX_TEXELS), std::uint32_t(indices.size()),
                             primitive.uv1.empty() ? NO_OFFSET : std::uint32_t(uv1s.size())};
            appendVertices(primitive, vertices);
            indices.insert(indices.end(), primitive.indices.begin(), primitive.indices.end());
            uv1s.insert(uv1s.end(), primitive.uv1.begin(), primitive.uv1.end());
        }
        const Material& material = materialOf(scene, instance.material);
        GpuInstance gpu = makeInstance(instance, primitive, material, place->second, anchor_,
                                       std::uint32_t(scene.materials.size()),
                                       scene.nodes[std::size_t(instance.node)].meshChannels);
        if (i < moving.size() && moving[i]) {
            gpu.flags |= INSTANCE_MOVING;
            movingInstances_.push_back(std::uint32_t(i));
        }
        gpuInstances_.push_back(gpu);
        triangles_ += instance.triangleCount;
        const Bounds bounds = boundsOf(primitive, instance.worldFromLocal);
        DrawItem draw;
        draw.instance = std::uint32_t(i);
        draw.firstIndex = gpu.firstIndex;
        draw.indexCount = instance.triangleCount * 3;
        draw.vertexOffset = std::int32_t(gpu.firstVertex);
        draw.cullBackFaces = !material.doubleSided;
        draw.clockwise = gpu.flags & INSTANCE_MIRRORED;
        draw.emits = material.emissiveNit != glm::dvec3(0.0);
        draw.boundsMin = bounds.min;
        draw.boundsMax = bounds.max;
        (instance.role == SurfaceRole::Absent ? transparent_ : opaque_).push_back(draw);
    }
    vertexBuffer_ = gpu::texelBuffer(device_, "vertices", vertices, VK_FORMAT_R32G32B32A32_UINT, "geometry");
    indexBuffer_ = gpu::texelBuffer(device_, "indices", indices, VK_FORMAT_R32_UINT, "geometry",
                                    VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
    uv1Buffer_ = gpu::texelBuffer(device_, "uv1s", uv1s, VK_FORMAT_R32G32_SFLOAT, "geometry");
    instanceBuffer_ = gpu::storageBuffer(device_, "instances", gpuInstances_, "geometry");
    if (movingInstances_.empty()) return;
    for (const GpuInstance& gpu : gpuInstances_)
        previousRows_.push_back({gpu.row0, gpu.row1, gpu.row2});
    previousInstanceBuffer_ = gpu::storageBuffer(device_, "previousInstances", previousRows_, "geometry");
}

void GpuScene::uploadMaterials(const Scene& scene, const std::vector<std::uint32_t>& placeOfImage) {
    std::vector<GpuMaterial> materials;
    for (std::size_t i = 0; i <= scene.materials.size(); ++i) {
        const Material& material = materialOf(scene, i < scene.materials.size() ? int(i) : -1);
        GpuMaterial gpu{};
        gpu.baseColor = glm::vec4(material.baseColorFactor);
        gpu.emissive = glm::vec3(material.emissiveNit);
        gpu.metallic = float(material.metallicFactor);
        gpu.roughness = float(material.roughnessFactor);
        gpu.normalScale = float(material.normalScale);
        const bool transmissive = material.transmission > 0.0;
        gpu.opacity = float(1.0 - material.transmission);
        gpu.flags = transmissive ? MATERIAL_TRANSMISSIVE : 0u;
        gpu.baseColorTexture = makeTextureRef(material.baseColor, placeOfImage);
        gpu.metallicRoughnessTexture = makeTextureRef(material.metallicRoughness, placeOfImage);
        gpu.normalTexture = makeTextureRef(material.normal, placeOfImage);
        gpu.emissiveTexture = makeTextureRef(material.emissive, placeOfImage);
        materials.push_back(gpu);
    }
    materialBuffer_ = gpu::storageBuffer(device_, "materials", materials, "geometry");
}

std::optional<Error> GpuScene::uploadTextures(const Scene& scene, std::vector<std::uint32_t>& placeOfImage) {
    Result<TextureArrays> arrays = makeTextureArrays(device_, scene);
    if (!arrays) return Error{arrays.error()};
    textures_ = std::move(arrays.value().images);
    placeOfImage = std::move(arrays.value().placeOfImage);
    return std::nullopt;
}

void GpuScene::updateMovingInstances(const Scene& scene) {
    if (movingInstances_.empty()) return;
    for (const std::uint32_t i : movingInstances_) {
        Instance& instance = instances_[i];
        instance.worldFromLocal = scene.nodes[std::size_t(instance.node)].worldFromNode;
        glm::dmat4 m = instance.worldFromLocal;
        m[3] -= glm::dvec4(anchor_, 0.0);
        GpuInstance& gpu = gpuInstances_[i];
        previousRows_[i] = {gpu.row0, gpu.row1, gpu.row2};
        setRows(gpu, m);
        gpu.flags = (gpu.flags & ~INSTANCE_MIRRORED) |
                    (glm::determinant(glm::dmat3(m)) < 0.0 ? INSTANCE_MIRRORED : 0u);
        const Bounds bounds = boundsOf(primitiveOf(scene, instance), instance.worldFromLocal);
        for (std::vector<DrawItem>* draws : {&opaque_, &transparent_}) {
            for (DrawItem& draw : *draws) {
                if (draw.instance != i) continue;
                draw.boundsMin = bounds.min;
                draw.boundsMax = bounds.max;
                draw.clockwise = gpu.flags & INSTANCE_MIRRORED;
            }
        }
    }
    instanceBuffer_.upload(gpuInstances_);
    previousInstanceBuffer_.upload(previousRows_);
    updateInstances(world_, instances_, anchor_);
    rayWorld_->update(world_);
}

bool GpuScene::updateChannels(const Scene& scene) {
    bool changed = false;
    for (std::size_t i = 0; i < instances_.size(); ++i) {
        const std::uint32_t channels = scene.nodes[std::size_t(instances_[i].node)].meshChannels;
        std::uint32_t& flags = gpuInstances_[i].flags;
        const std::uint32_t now =
            (flags & ((1u << INSTANCE_CHANNELS_SHIFT) - 1u)) | channels << INSTANCE_CHANNELS_SHIFT;
        changed = changed || now != flags;
        flags = now;
    }
    if (!changed) return false;
    instanceBuffer_.upload(gpuInstances_);
    kilolux::updateChannels(world_, scene, instances_);
    rayWorld_->updateChannels(world_);
    return true;
}

void GpuScene::decideFeatures(const Scene& scene) {
    for (int feature = 0; feature < FEATURE_COUNT; ++feature)
        features_[std::uint32_t(feature)] = 0;
    features_[FEATURE_ALPHA_MASK] = rayWorld_->hasAlpha();
    for (const Instance& instance : instances_) {
        const Material& material = materialOf(scene, instance.material);
        for (const TextureRef* ref :
             {&material.baseColor, &material.metallicRoughness, &material.normal, &material.emissive}) {
            if (ref->image >= 0) features_[FEATURE_TEXTURES] = 1;
        }
    }
    features_[FEATURE_MOVING_INSTANCES] = !movingInstances_.empty();
}

gpu::Bindings GpuScene::geometryBindings() const {
    return {{"vertices", vertexBuffer_}, {"indices", indexBuffer_}, {"Instances", instanceBuffer_}};
}

gpu::Bindings GpuScene::surfaceBindings() const {
    static constexpr std::array<std::string_view, 4> linear{"textures0", "textures1", "textures2",
                                                            "textures3"};
    static constexpr std::array<std::string_view, 4> srgb{"texturesSrgb0", "texturesSrgb1", "texturesSrgb2",
                                                          "texturesSrgb3"};
    gpu::Bindings bindings = geometryBindings();
    bindings.emplace_back("Materials", materialBuffer_);
    bindings.emplace_back("uv1s", uv1Buffer_);
    for (std::size_t i = 0; i < textures_.size(); ++i) {
        if (!textures_[i]) continue;
        bindings.emplace_back(linear[i], textures_[i], gpu::SamplerKind::LinearRepeat);
        bindings.push_back(gpu::Binding::second(srgb[i], textures_[i], gpu::SamplerKind::LinearRepeat));
    }
    return bindings;
}

} // namespace kilolux
