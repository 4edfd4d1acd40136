// Lights of a scene on the device, and the pictures and tables that they look up; see gpu_scene.h.
#include "renderer/gpu_scene.h"

#include "renderer/dome_maps.h"
#include "renderer/gpu/filled_buffer.h"
#include "renderer/gpu_lights.h"
#include "renderer/light_powers.h"
#include "renderer/light_tree.h"
#include "renderer/lights_cpp/ltc_table.h"
#include "shaders/shared/features.h"

#include <algorithm>
#include <glm/gtc/packing.hpp>

namespace kilolux {

using namespace shared;

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
        lightsHot_ = gpu::Buffer(
            device_, {"lightsHot", hot.size() * sizeof(LightHot),
                      VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                      gpu::MemoryUse::DeviceOnly, "lights", VK_FORMAT_R32G32B32A32_UINT});
    }
    lightsHot_.upload(hot);
    lightsCold_ = gpu::storageBuffer(device_, "lightsCold", slots_.cold(), "lights");
    lightShapings_ = slots_.shapings().empty()
                         ? gpu::Buffer()
                         : gpu::storageBuffer(device_, "lightShapings", slots_.shapings(), "lights");
    directionalSlots_ = gpu::storageBuffer(device_, "directionalSlots", directional, "lights");
    lightPowers_ = gpu::Buffer();
    lightTree_ = gpu::Buffer();
}

void GpuScene::prepareLightDraws(int drawnFrom, double sceneExtentM) {
    if (drawnFrom == DRAW_FROM_POWER && !lightPowers_) {
        const std::vector<double> powers = kilolux::lightPowers(slots_.hot(), slots_.cold(), sceneExtentM);
        lightPowers_ = gpu::storageBuffer(device_, "lightPowers", aliasTable(powers), "lights");
    }
    if (drawnFrom == DRAW_FROM_TREE && !lightTree_)
        lightTree_ = gpu::storageBuffer(device_, "lightTree", makeLightTree(slots_.hot()), "lights");
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
        gpu::texelBuffer(device_, "domeDistribution", dome->distribution, VK_FORMAT_R32_SFLOAT, "lights");
}

void GpuScene::decideLightFeatures() {
    const auto anyOfType = [&](std::uint32_t type) {
        return std::any_of(slots_.hot().begin(), slots_.hot().end(), [type](const LightHot& hot) {
            return !(hot.typeFlags & LIGHT_FLAG_DEAD) && (hot.typeFlags & LIGHT_TYPE_MASK) == type;
        });
    };
#define KILOLUX_TYPE(UPPER, Name, place) features_[FEATURE_##UPPER##_LIGHTS] = anyOfType(LIGHT_##UPPER);
    KX_LIGHT_TYPES(KILOLUX_TYPE)
#undef KILOLUX_TYPE
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
