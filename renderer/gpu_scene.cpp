// Scene upload, see gpu_scene.h. Textures are in gpu_textures.cpp.
#include "renderer/gpu_scene.h"

#include "renderer/dome_maps.h"
#include "renderer/gpu_lights.h"
#include "renderer/gpu_textures.h"
#include "renderer/light_powers.h"
#include "renderer/light_tree.h"
#include "renderer/lights_cpp/lights_f32.h"
#include "renderer/lights_cpp/ltc_table.h"
#include "shaders/shared/features.h"

#include <algorithm>
#include <fmt/format.h>
#include <glm/gtc/packing.hpp>
#include <map>

namespace kilolux {

namespace {

using namespace shared;

constexpr VkBufferUsageFlags kTexels = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;

template<typename T>
gpu::Buffer texelBuffer(gpu::Device& device, const char* name, const std::vector<T>& data, VkFormat format,
                        std::string_view cause) {
    gpu::BufferDesc desc{name, data.size() * sizeof(T), kTexels, gpu::MemoryUse::DeviceOnly, cause, format};
    gpu::Buffer buffer(device, desc);
    buffer.upload(data);
    return buffer;
}

template<typename T>
gpu::Buffer storageBuffer(gpu::Device& device, const char* name, const std::vector<T>& data,
                          std::string_view cause) {
    gpu::Buffer buffer(device, {name, data.size() * sizeof(T), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                gpu::MemoryUse::DeviceOnly, cause});
    buffer.upload(data);
    return buffer;
}

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
    vertexBuffer_ = texelBuffer(device_, "vertices", vertices, VK_FORMAT_R32G32B32A32_UINT, "geometry");
    gpu::BufferDesc indexDesc{"indices",
                              indices.size() * 4,
                              kTexels | VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
                              gpu::MemoryUse::DeviceOnly,
                              "geometry",
                              VK_FORMAT_R32_UINT};
    indexBuffer_ = gpu::Buffer(device_, indexDesc);
    indexBuffer_.upload(indices);
    uv1Buffer_ = texelBuffer(device_, "uv1s", uv1s, VK_FORMAT_R32G32_SFLOAT, "geometry");
    instanceBuffer_ = storageBuffer(device_, "instances", gpuInstances_, "geometry");
    if (movingInstances_.empty()) return;
    for (const GpuInstance& gpu : gpuInstances_)
        previousRows_.push_back({gpu.row0, gpu.row1, gpu.row2});
    previousInstanceBuffer_ = storageBuffer(device_, "previousInstances", previousRows_, "geometry");
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
    materialBuffer_ = storageBuffer(device_, "materials", materials, "geometry");
}

std::optional<Error> GpuScene::uploadTextures(const Scene& scene, std::vector<std::uint32_t>& placeOfImage) {
    Result<TextureArrays> arrays = makeTextureArrays(device_, scene);
    if (!arrays) return Error{arrays.error()};
    textures_ = std::move(arrays.value().images);
    placeOfImage = std::move(arrays.value().placeOfImage);
    return std::nullopt;
}

void GpuScene::uploadLtcTable() {
    const LtcTable& table = boundLtcTable();
    const auto image = [&](const char* name, const std::vector<glm::vec4>& texels) {
        gpu::Image result(device_, {.name = name,
                                    .format = VK_FORMAT_R32G32B32A32_SFLOAT,
                                    .width = std::uint32_t(table.width),
                                    .height = std::uint32_t(table.height),
                                    .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
                                    .cause = "lights"});
        result.upload(std::as_bytes(std::span(texels)));
        return result;
    };
    ltcParameters_ = image("ltcParameters", table.parameters);
    ltcScales_ = image("ltcScales", table.scales);
}

void GpuScene::updateLights(const Scene& scene, double exposureEv100, std::uint64_t frame,
                            const std::vector<glm::dvec3>& offsetsM, double timeS) {
    GpuLights lights = makeGpuLights(scene, anchor_, exposureEv100, timeS);
    std::vector<std::uint64_t> ids;
    for (std::size_t i = 0; i < lights.hot.size(); ++i) {
        // Lights made in memory may have no name yet: their place in the scene stands for it.
        constexpr std::uint64_t kUnnamed = std::uint64_t(1) << 63;
        const std::uint64_t id = i < scene.lights.size() ? scene.lights[i].id : kDomeLightId;
        ids.push_back(id != 0 ? id : kUnnamed + i);
        lights.cold[i].penumbraScale *= float(penumbraScale_);
        if (i < offsetsM.size()) lights.hot[i].positionWs += glm::vec3(offsetsM[i]);
    }
    derivedRanges_ = lights.derivedRanges;
    slots_.update(lights, ids, frame);
    lightCount_ = std::uint32_t(slots_.hot().size());
    freshSlots_ = slots_.fresh();
    uploadLightPictures(lights.tables);
    uploadDome(lights.tables.dome);
    showsDome_ = lights.tables.dome && scene.dome.visible;
    features_[FEATURE_DOME] = lights.tables.dome != nullptr;
    features_[FEATURE_BACKGROUND] = showsDome_;
    features_[FEATURE_FILL] = fillNit(scene.dome) != glm::dvec3(0.0);
    if (!slots_.changed() && lightsHot_) return;
    decideLightFeatures();
    const std::vector<std::uint32_t> directional = slots_.directional();
    directionalCount_ = std::uint32_t(directional.size());
    // The uniform block is as large as the shader declares it, whatever the scene holds.
    std::vector<LightHot> hot = slots_.hot();
    hot.resize(std::max<std::size_t>(hot.size(), LIGHT_UNIFORM_SLOTS),
               LightHot{.typeFlags = LIGHT_FLAG_DEAD});
    if (!lightsHot_ || lightsHot_.bytes() != hot.size() * sizeof(LightHot)) {
        lightsHot_ =
            gpu::Buffer(device_, {"lightsHot", hot.size() * sizeof(LightHot),
                                  kTexels | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, gpu::MemoryUse::DeviceOnly,
                                  "lights", VK_FORMAT_R32G32B32A32_UINT});
    }
    lightsHot_.upload(hot);
    lightsCold_ = storageBuffer(device_, "lightsCold", slots_.cold(), "lights");
    lightShapings_ = slots_.shapings().empty()
                         ? gpu::Buffer()
                         : storageBuffer(device_, "lightShapings", slots_.shapings(), "lights");
    directionalSlots_ = storageBuffer(device_, "directionalSlots", directional, "lights");
    lightPowers_ = gpu::Buffer();
    lightTree_ = gpu::Buffer();
}

void GpuScene::prepareLightDraws(int drawnFrom, double sceneExtentM) {
    if (drawnFrom == DRAW_FROM_POWER && !lightPowers_) {
        const std::vector<double> powers = kilolux::lightPowers(slots_.hot(), slots_.cold(), sceneExtentM);
        lightPowers_ = storageBuffer(device_, "lightPowers", aliasTable(powers), "lights");
    }
    if (drawnFrom == DRAW_FROM_TREE && !lightTree_)
        lightTree_ = storageBuffer(device_, "lightTree", makeLightTree(slots_.hot()), "lights");
}

gpu::Bindings GpuScene::lightDrawBindings() const {
    gpu::Bindings bindings;
    if (lightPowers_) bindings.emplace_back("LightPowers", lightPowers_);
    if (lightTree_) bindings.emplace_back("LightTree", lightTree_);
    return bindings;
}

// Pictures of lights come and go by edits; what is there already stays.
void GpuScene::uploadLightPictures(const LightTables& tables) {
    const auto upload = [&](const char* name, const std::vector<std::shared_ptr<const LightPicture>>& layers,
                            std::vector<std::shared_ptr<const LightPicture>>& before, gpu::Image& image) {
        if (layers == before) return;
        before = layers;
        image = gpu::Image();
        if (layers.empty()) return;
        image = gpu::Image(device_, {.name = name,
                                     .format = VK_FORMAT_R32_SFLOAT,
                                     .width = std::uint32_t(layers[0]->width),
                                     .height = std::uint32_t(layers[0]->height),
                                     .layers = std::uint32_t(layers.size()),
                                     .arrayed = true,
                                     .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
                                     .cause = "lights"});
        for (std::uint32_t layer = 0; layer < layers.size(); ++layer)
            image.upload(std::as_bytes(std::span(layers[layer]->texels)), 0, layer);
    };
    upload("iesProfiles", tables.profiles, lightPictures_.profiles, iesProfiles_);
    upload("functionImages", tables.functionImages, lightPictures_.functionImages, functionImages_);
    sourcePictures_.update(device_, tables.pictures);
}

void GpuScene::uploadDome(const std::shared_ptr<const DomeMaps>& dome) {
    if (dome == lightPictures_.dome) return;
    lightPictures_.dome = dome;
    domeRadiances_ = gpu::Image();
    domeIrradiances_ = gpu::Image();
    domeDistribution_ = gpu::Buffer();
    if (!dome) return;
    domeRadiances_ = gpu::Image(device_, {.name = "domeRadiances",
                                          .format = VK_FORMAT_R16G16B16A16_SFLOAT,
                                          .width = std::uint32_t(dome->levels[0].width),
                                          .height = std::uint32_t(dome->levels[0].height),
                                          .mips = std::uint32_t(dome->levels.size()),
                                          .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
                                          .cause = "lights"});
    for (std::uint32_t level = 0; level < dome->levels.size(); ++level) {
        std::vector<glm::uint64> texels;
        for (const glm::vec3& texel : dome->levels[level].texels)
            texels.push_back(glm::packHalf4x16(glm::vec4(texel, 1.0f)));
        domeRadiances_.upload(std::as_bytes(std::span(texels)), level);
    }
    std::vector<glm::vec4> lux;
    for (const glm::vec3& texel : dome->irradiance.texels)
        lux.emplace_back(texel, 1.0f);
    domeIrradiances_ = gpu::Image(device_, {.name = "domeIrradiances",
                                            .format = VK_FORMAT_R32G32B32A32_SFLOAT,
                                            .width = std::uint32_t(dome->irradiance.width),
                                            .height = std::uint32_t(dome->irradiance.height),
                                            .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
                                            .cause = "lights"});
    domeIrradiances_.upload(std::as_bytes(std::span(lux)));
    domeDistribution_ =
        texelBuffer(device_, "domeDistribution", dome->distribution, VK_FORMAT_R32_SFLOAT, "lights");
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

void GpuScene::decideLightFeatures() {
    constexpr std::array<std::pair<std::uint32_t, int>, 6> kFeatureOfType{
        {{LIGHT_DIRECTIONAL, FEATURE_DIRECTIONAL_LIGHTS},
         {LIGHT_SPHERE, FEATURE_SPHERE_LIGHTS},
         {LIGHT_SPOT, FEATURE_SPOT_LIGHTS},
         {LIGHT_TUBE, FEATURE_TUBE_LIGHTS},
         {LIGHT_RECT, FEATURE_RECT_LIGHTS},
         {LIGHT_DISK, FEATURE_DISK_LIGHTS}}};
    for (const auto& [type, feature] : kFeatureOfType) {
        features_[std::uint32_t(feature)] =
            std::any_of(slots_.hot().begin(), slots_.hot().end(), [type = type](const LightHot& hot) {
                return !(hot.typeFlags & LIGHT_FLAG_DEAD) && (hot.typeFlags & LIGHT_TYPE_MASK) == type;
            });
    }
    const auto anyShaping = [&](auto&& has) {
        return std::any_of(slots_.shapings().begin(), slots_.shapings().end(), has);
    };
    features_[FEATURE_BARN_DOORS] =
        anyShaping([](const LightShaping& shaping) { return shaping.doorDepthM != glm::vec4(0.0f); });
    features_[FEATURE_IES_PROFILES] =
        anyShaping([](const LightShaping& shaping) { return shaping.profile != 0u; });
    features_[FEATURE_LIGHT_FUNCTIONS] =
        anyShaping([](const LightShaping& shaping) { return shaping.functionKind != LIGHT_FUNCTION_NONE; });
    features_[FEATURE_LIGHT_CHANNELS] =
        anyShaping([](const LightShaping& shaping) { return shaping.channels != CHANNELS_ALL; });
    features_[FEATURE_CHANNEL_SHADOWS] =
        anyShaping([](const LightShaping& shaping) { return shaping.shadowChannels != CHANNELS_ALL; });
    features_[FEATURE_TEXTURED_LIGHTS] =
        anyShaping([](const LightShaping& shaping) { return shaping.picture != 0u; });
    const bool fits = slots_.hot().size() <= LIGHT_UNIFORM_SLOTS &&
                      device_.limits().maxUniformBufferRange >= LIGHT_UNIFORM_SLOTS * sizeof(LightHot);
    features_[CHOICE_LIGHTS_IN_UNIFORM] = fits;
}

namespace {
void append(gpu::Bindings& bindings, const gpu::Bindings& more) {
    bindings.insert(bindings.end(), more.begin(), more.end());
}
} // namespace

gpu::Bindings GpuScene::geometryBindings() const {
    return {{"vertices", vertexBuffer_}, {"indices", indexBuffer_}, {"Instances", instanceBuffer_}};
}

gpu::Bindings GpuScene::surfaceBindings() const {
    static constexpr std::array<std::string_view, 4> linear{"textures0", "textures1", "textures2",
                                                            "textures3"};
    static constexpr std::array<std::string_view, 4> srgb{"texturesSrgb0", "texturesSrgb1", "texturesSrgb2",
                                                          "texturesSrgb3"};
    gpu::Bindings bindings{{"Materials", materialBuffer_}, {"uv1s", uv1Buffer_}};
    append(bindings, geometryBindings());
    for (std::size_t i = 0; i < textures_.size(); ++i) {
        if (!textures_[i]) continue;
        bindings.emplace_back(linear[i], textures_[i], gpu::SamplerKind::LinearRepeat);
        bindings.push_back(gpu::Binding::second(srgb[i], textures_[i], gpu::SamplerKind::LinearRepeat));
    }
    return bindings;
}

gpu::Binding GpuScene::environmentBrdf() const {
    return {"ltcScales", ltcScales_, gpu::SamplerKind::LinearClamp};
}

gpu::Bindings GpuScene::backgroundBindings() const {
    if (!domeRadiances_) return {};
    return {{"domeRadiances", domeRadiances_, gpu::SamplerKind::LinearRepeat}};
}

gpu::Bindings GpuScene::lightBindings() const {
    gpu::Bindings bindings{{"lightsHotTexels", lightsHot_},
                           {"LightsCold", lightsCold_},
                           {"ltcParameters", ltcParameters_, gpu::SamplerKind::LinearClamp},
                           {"ltcScales", ltcScales_, gpu::SamplerKind::LinearClamp}};
    if (lightShapings_) bindings.emplace_back("LightShapings", lightShapings_);
    if (iesProfiles_) bindings.emplace_back("iesProfiles", iesProfiles_, gpu::SamplerKind::LinearClamp);
    if (functionImages_)
        bindings.emplace_back("functionImages", functionImages_, gpu::SamplerKind::LinearRepeat);
    if (domeRadiances_) {
        append(bindings, backgroundBindings());
        bindings.emplace_back("domeIrradiances", domeIrradiances_, gpu::SamplerKind::LinearRepeat);
        bindings.emplace_back("domeDistribution", domeDistribution_);
    }
    append(bindings, sourcePictures_.bindings());
    if (features_.at(CHOICE_LIGHTS_IN_UNIFORM)) bindings.emplace_back("LightsHot", lightsHot_);
    return bindings;
}

} // namespace kilolux
