// What a Renderer makes before its first frame, and again when the settings change; see renderer_impl.h.
#include "renderer/renderer_impl.h"

#include "renderer/document/animation.h"
#include "renderer/document/task_watch.h"
#include "renderer/dome_maps.h"
#include "renderer/gpu_lights.h"
#include "renderer/lights_cpp/ltc_table.h"
#include "renderer/noise.h"
#include "renderer/views.h"
#include "shaders/shared/features.h"
#include "shaders/shared/views.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>

namespace kilolux {

namespace {

std::string_view validationWord() {
    const char* text = std::getenv("KILOLUX_VALIDATION");
    return text ? text : "";
}

// KILOLUX_VALIDATION=1: core and synchronization; =passes: with a command buffer for every pass, so that
// hazards between passes are seen; =gpu: GPU-assisted. Any message fails the render.
gpu::Validation wantedValidation() {
    const std::string_view value = validationWord();
    if (value.empty() || value == "0") return gpu::Validation::Off;
    return value == "gpu" ? gpu::Validation::GpuAssisted : gpu::Validation::On;
}

gpu::DeviceOptions deviceOptions() {
    gpu::DeviceOptions options;
    options.validation = wantedValidation();
    options.commandBufferPerPass = validationWord() == "passes";
    if (const char* name = std::getenv("KILOLUX_DEVICE"); name && *name) options.nameContains = name;
    return options;
}

// A scene without lights would be black: it gets a sun over the viewer's left shoulder, which is said.
void addDefaultLight(Scene& scene, const Camera& camera) {
    LightDef def;
    def.name = "default light";
    def.type = LightType::Directional;
    def.unit = LightUnit::Lux;
    def.intensity = 1000.0;
    def.angularDiameterRad = glm::radians(4.0);
    scene.lightDefs.push_back(def);
    const glm::dmat3 view(camera.worldFromCamera);
    const glm::dvec3 toLight = glm::normalize(view * glm::dvec3(-0.6, 0.8, 1.0) + glm::dvec3(0, 0.6, 0));
    const glm::dvec3 side = glm::normalize(glm::cross(glm::dvec3(0.3, 1, 0.2), toLight));
    Node node;
    node.name = "default light";
    node.worldFromNode = node.localFromNode =
        glm::dmat4(glm::dvec4(side, 0), glm::dvec4(glm::cross(toLight, side), 0), glm::dvec4(toLight, 0),
                   glm::dvec4(0, 0, 0, 1));
    scene.nodes.push_back(node);
    LightNode light;
    light.node = int(scene.nodes.size()) - 1;
    light.def = int(scene.lightDefs.size()) - 1;
    scene.lights.push_back(light);
}

Result<Camera> chooseCamera(const Scene& scene, const std::string& name, double aspect) {
    if (name == "derived" || (name.empty() && scene.cameras.empty())) return derivedCamera(scene, aspect);
    if (name.empty()) return scene.cameras.front();
    std::string known;
    for (const Camera& camera : scene.cameras) {
        if (camera.name == name) return camera;
        known += fmt::format("{}'{}'", known.empty() ? "" : ", ", camera.name);
    }
    return Error{fmt::format("{}: no camera '{}'; it has {}", scene.sourcePath.string(), name,
                             known.empty() ? "none" : known)};
}

// Measured on lavapipe, two cores: raster costs by triangles, primary rays by pixels (README, "Measured").
GBufferProducer chooseProducer(const Settings& settings, const gpu::Device& device, std::size_t triangles,
                               std::size_t pixels) {
    if (settings.gbuffer == GBufferChoice::Raster) return GBufferProducer::Raster;
    if (settings.gbuffer == GBufferChoice::Compute) return GBufferProducer::Compute;
    if (!device.hasGeometryShader())
        return GBufferProducer::Compute; // fragments would not know their triangle
    return device.isCpu() && pixels < triangles ? GBufferProducer::Compute : GBufferProducer::Raster;
}

// Lights made in memory have no names yet; slots need one each.
void nameLights(Scene& scene) {
    std::uint64_t last = 0;
    for (const LightNode& light : scene.lights)
        last = std::max(last, light.id);
    const bool unnamed = std::any_of(scene.lights.begin(), scene.lights.end(),
                                     [](const LightNode& light) { return light.id == 0; });
    if (!unnamed) return;
    for (LightNode& light : scene.lights.write()) {
        if (light.id == 0) light.id = ++last;
    }
}

std::vector<bool> movingInstances(const Scene& scene) {
    const std::vector<bool> nodes = movingNodes(scene);
    std::vector<bool> result;
    bool any = false;
    for (const Instance& instance : enumerateInstances(scene)) {
        result.push_back(nodes[std::size_t(instance.node)]);
        any = any || result.back();
    }
    return any ? result : std::vector<bool>{};
}

Result<gpu::Image> uploadNoise(gpu::Device& device) {
    const Result<NoiseMask> mask = loadNoiseMask(contentDirectory() / "blue_noise.bin");
    if (!mask) return Error{mask.error()};
    gpu::Image image(device, {.name = "noiseMask",
                              .format = VK_FORMAT_R16G16B16A16_UINT,
                              .width = NoiseMask::kWidth,
                              .height = NoiseMask::kHeight,
                              .layers = NoiseMask::kLayers,
                              .arrayed = true,
                              .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
                              .cause = "noise"});
    constexpr std::size_t kLayerTexels = std::size_t(NoiseMask::kWidth) * NoiseMask::kHeight;
    const std::span texels(mask.value().texels);
    for (std::uint32_t layer = 0; layer < NoiseMask::kLayers; ++layer)
        image.upload(std::as_bytes(texels.subspan(layer * kLayerTexels, kLayerTexels)), 0, layer);
    return image;
}

} // namespace

double nowMs() {
    using namespace std::chrono;
    return duration<double, std::milli>(steady_clock::now().time_since_epoch()).count();
}

std::filesystem::path contentDirectory() {
    if (const char* folder = std::getenv("KILOLUX_CONTENT"); folder && *folder) return folder;
    return KILOLUX_CONTENT_DIR;
}

Renderer::Impl::Impl(const Scene& source, const RenderOptions& renderOptions)
    : startMs(nowMs()), scene(source), options(renderOptions), device(deviceOptions()), resources(device) {
    resources.onCompiled([this](const std::string&) {
        ++shadersCompiled;
        reach("Compiling shaders", 0.5 * std::min(1.0, double(shadersCompiled) / kUsualShaders));
    });
}

void Renderer::Impl::reach(const char* doing, double share) const {
    if (!options.watch) return;
    if (options.watch->isCancelled()) throw gpu::Interrupted();
    options.watch->reach(doing, share);
}

std::optional<Error> Renderer::Impl::prepare() {
    if (auto error = prepareScene()) return error;
    frameBuffer =
        gpu::Buffer(device, {"frame", sizeof(shared::FrameConstants), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                             gpu::MemoryUse::HostWrite, "other"});
    counterBuffer =
        gpu::Buffer(device, {"counters", shared::COUNTER_COUNT * 4, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                             gpu::MemoryUse::HostReadback, "other"});
    return preparePlan();
}

std::optional<Error> Renderer::Impl::prepareScene() {
    nameLights(scene);
    if (!scene.animations.empty()) poseScene(scene, options.settings.timeS);
    Result<Camera> chosen = chooseCamera(scene, options.camera, double(options.width) / options.height);
    if (!chosen) return Error{chosen.error()};
    camera = chosen.value();
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        if (scene.cameras[i].node >= 0 && scene.cameras[i].id == camera.id &&
            scene.cameras[i].name == camera.name)
            cameraIndex = int(i);
    }
    if (scene.lights.empty() && !domeShines(scene.dome)) {
        addDefaultLight(scene, camera);
        statistics.notes.push_back(
            "the scene has no lights; a default directional light of 1000 lux stands in");
        nameLights(scene);
    }
    const Bounds bounds = worldBounds(scene);
    sceneExtentM = std::max(glm::length(bounds.max - bounds.min), 1e-3);
    Result<LtcTable> table = loadLtcTable(contentDirectory() / "ltc_ggx.bin");
    if (!table) return Error{table.error()};
    useLtcTable(std::move(table.value()));

    exposureEv100 = wantedExposureEv100();
    if (options.settings.tracer == TracerChoice::RayQuery && !device.hasRayQuery()) {
        return Error{fmt::format("device '{}' has no ray query; use tracer=compute", device.name())};
    }
    const bool rayQuery =
        options.settings.tracer == TracerChoice::RayQuery ||
        (options.settings.tracer == TracerChoice::Auto && device.hasRayQuery() && !device.isCpu());
    plan.tracer = rayQuery ? TraceBackEnd::RayQuery : TraceBackEnd::ComputeBvh;
    reach("Preparing the scene", 0.0);
    Result<std::unique_ptr<GpuScene>> uploaded =
        GpuScene::create(device, scene, anchorFor(camera, worldBounds(scene)), exposureEv100, plan.tracer,
                         movingInstances(scene));
    if (!uploaded) return Error{uploaded.error()};
    gpuScene = std::move(uploaded.value());
    if (gpuScene->derivedRanges() > 0) {
        statistics.notes.push_back(fmt::format("{} of {} lights have no range and got a derived one: less "
                                               "than 1/1000 of middle grey is lost per light",
                                               gpuScene->derivedRanges(), gpuScene->lightCount()));
    }

    world = gpuScene->rayWorld().traceBindings();
    return std::nullopt;
}

double Renderer::Impl::wantedExposureEv100() const {
    const AutoNumber& wanted = options.settings.exposureEv100;
    const bool metered = wanted.automatic && !scene.hasExposure;
    return metered ? deriveExposureEv100(scene) : wanted.valueOr(scene.exposureEv100);
}

GBufferProducer Renderer::Impl::wantedProducer() const {
    return chooseProducer(options.settings, device, gpuScene->triangles(),
                          std::size_t(options.width) * std::size_t(options.height));
}

std::optional<Error> Renderer::Impl::preparePlan() {
    features.clear();
    if (auto error = planView()) return error;
    plan.producer = wantedProducer();
    plan.lightAll = {std::uint32_t(options.settings.raysPerLight),
                     std::uint32_t(options.settings.shadowSamples)};
    plan.halfSampling = plan.stochastic() && options.settings.sampling != Sampling::Full;
    plan.compactRays = plan.stochastic() && options.settings.compactRays;
    plan.transparent = !gpuScene->transparentDraws().empty();

    features[shared::CHOICE_ESTIMATOR] = plan.method == Method::ReferenceTrue ? shared::ESTIMATOR_TRUE
                                         : plan.mapsShadows()                 ? shared::ESTIMATOR_MAPS
                                                                              : shared::ESTIMATOR_SPLIT;
    features[shared::CHOICE_TONE_MAP] =
        options.settings.toneMap == ToneMap::None ? shared::TONE_MAP_NONE : shared::TONE_MAP_NEUTRAL;

    constants.sampling = samplingConstants(options.settings);
    features[shared::CHOICE_WHITE_NOISE] = options.settings.noise == Noise::White;
    features[shared::CHOICE_HALF_SAMPLING] = std::uint32_t(options.settings.sampling);
    features[shared::CHOICE_DIM_DROP] = options.settings.dimLights == DimLights::Drop;
    plan.resampling = resamplingConstants(plan.method, options.settings);
    features[shared::CHOICE_DRAW_FROM] = std::uint32_t(drawnFrom(plan.method, options.settings));
    if (plan.resamples()) constants.sampling.rays = 1;
    features[shared::CHOICE_DEMODULATED] = plan.filtersLight();
    features[shared::CHOICE_COMPACT_RAYS] = plan.compactRays;
    features[shared::CHOICE_LANES] = device.subgroupSize();
    plan.choices = constants.sampling.choices;
    constants.denoising = denoisingConstants(options.settings);
    features[shared::CHOICE_COUNT_SAMPLES] = plan.filtersLight();
    const bool cpuFilters = options.cpuFilters.value_or(device.isCpu());
    features[shared::CHOICE_SPARSE_NEIGHBOURS] = cpuFilters;
    features[shared::CHOICE_PIXEL_ROWS] = cpuFilters;
    if (plan.stochastic()) {
        if (gpuScene->lightCount() > shared::SAMPLE_LIGHT_LIMIT) {
            return Error{fmt::format("{}: {} lights; the stochastic method takes up to {}",
                                     scene.sourcePath.string(), gpuScene->lightCount(),
                                     shared::SAMPLE_LIGHT_LIMIT)};
        }
        Result<gpu::Image> mask = uploadNoise(device);
        if (!mask) return Error{mask.error()};
        noise = std::move(mask.value());
    }
    shadowMaps.reset();
    if (plan.mapsShadows()) {
        if (!device.hasGeometryShader())
            return Error{fmt::format("device '{}' cannot draw shadow maps: its fragments do not know their "
                                     "triangle",
                                     device.name())};
        shadowMaps = std::make_unique<ShadowMaps>(device, std::uint32_t(options.settings.shadowMapSize));
    }
    makeTargets();
    shadersCompiled = 0;
    planIsNew = true;
    passes = std::make_unique<FramePasses>(resources, plan);
    return std::nullopt;
}

void Renderer::Impl::makeTargets() {
    const std::uint32_t width = std::uint32_t(options.width), height = std::uint32_t(options.height);
    frameStands = false;
    targets = std::make_unique<Targets>(device, width, height, targetNeeds());
    if (plan.stochastic()) {
        lists = std::make_unique<VisibleLists>(device, width, height);
        if (plan.compactRays)
            rayList = std::make_unique<RayList>(device, width, height, constants.sampling.rays);
    }
    if (options.poisonTargets) poisonTargets();
    grid = std::make_unique<LightGrid>(device, width, height, gpuScene->lightCount());
    if (options.gridRoom) grid->limitFineIndices(*options.gridRoom);
}

void Renderer::Impl::poisonTargets() {
    VkClearColorValue notANumber{};
    for (std::uint32_t& word : notANumber.uint32)
        word = 0x7fc00000u;
    gpu::Commands commands(device);
    for (const auto& [name, image] : targets->all()) {
        if (image != &targets->rasterDepth) commands.clearColor(*image, notANumber);
    }
    commands.submitAndWait();
}

} // namespace kilolux
