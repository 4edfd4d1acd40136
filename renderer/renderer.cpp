// Owns device, scene, targets and passes, and runs frames; see renderer.h.
#include "renderer/renderer.h"

#include "renderer/camera.h"
#include "renderer/frame.h"
#include "renderer/gpu_lights.h"
#include "renderer/lights_cpp/ltc_table.h"
#include "renderer/nearest_name.h"
#include "renderer/pass_statistics.h"
#include "renderer/readback.h"
#include "shaders/shared/features.h"
#include "shaders/shared/views.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fmt/format.h>
#include <thread>

namespace kilolux {

namespace {

double nowMs() {
    using namespace std::chrono;
    return duration<double, std::milli>(steady_clock::now().time_since_epoch()).count();
}

std::filesystem::path contentDirectory() {
    if (const char* folder = std::getenv("KILOLUX_CONTENT"); folder && *folder) return folder;
    return KILOLUX_CONTENT_DIR;
}

// KILOLUX_VALIDATION=1: core and synchronization; =gpu: GPU-assisted. Any message fails the render.
gpu::Validation wantedValidation() {
    const char* text = std::getenv("KILOLUX_VALIDATION");
    const std::string_view value = text ? text : "";
    if (value.empty() || value == "0") return gpu::Validation::Off;
    return value == "gpu" ? gpu::Validation::GpuAssisted : gpu::Validation::On;
}

gpu::DeviceOptions deviceOptions() {
    gpu::DeviceOptions options;
    options.validation = wantedValidation();
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

} // namespace

struct Renderer::Impl {
    Impl(const Scene& source, const RenderOptions& renderOptions)
        : startMs(nowMs()), scene(source), options(renderOptions), device(deviceOptions()),
          resources(device) {}

    std::optional<Error> prepare();
    Result<Picture> render(const RenderProgress& progress);
    void poisonTargets();
    void runFrame(std::uint32_t index, int widthPx, int heightPx, gpu::PassTimes& passTimes);
    void compilePipelines();
    Picture readPicture() const;
    void describeCounters();
    void describeHistory(const shared::FrameConstants& before);
    bool frozen(std::uint32_t index) const; // what the settings freeze stands still in this frame

    double startMs;
    Scene scene; // a copy: meshes and images are shared
    RenderOptions options;
    gpu::Device device;
    gpu::PassResources resources;
    Camera camera;
    FramePlan plan;
    double exposureEv100 = 0.0;
    std::unique_ptr<GpuScene> gpuScene;
    std::unique_ptr<Targets> targets;
    std::unique_ptr<FramePasses> passes;
    std::unique_ptr<LightGrid> grid;
    GridUse gridUse;
    double sceneExtentM = 0.0; // diagonal of the bounds
    gpu::Buffer frameBuffer, counterBuffer;
    shared::FrameConstants constants{};
    gpu::SpecValues features;
    gpu::Bindings world;
    std::unique_ptr<VisibleLists> lists;
    bool historyValid = false; // the previous frame may be looked up
    gpu::PassTimes times;
    FrameStatistics statistics;
    std::vector<std::uint64_t> counted = std::vector<std::uint64_t>(shared::COUNTER_COUNT); // of all frames
};

std::optional<Error> Renderer::Impl::prepare() {
    const std::optional<int> view = indexOfChoice(viewChoices(), options.view);
    const std::optional<int> method = indexOfChoice(methodChoices(), options.method);
    if (!view) return Error{fmt::format("no view '{}'", options.view)};
    if (!method) return Error{fmt::format("no method '{}'", options.method)};
    Result<Camera> chosen = chooseCamera(scene, options.camera, double(options.width) / options.height);
    if (!chosen) return Error{chosen.error()};
    camera = chosen.value();
    if (scene.lights.empty()) {
        addDefaultLight(scene, camera);
        statistics.notes.push_back(
            "the scene has no lights; a default directional light of 1000 lux stands in");
    }
    Result<LtcTable> table = loadLtcTable(contentDirectory() / "ltc_ggx.bin");
    if (!table) return Error{table.error()};
    useLtcTable(std::move(table.value()));

    const bool metered = options.settings.exposureEv100.automatic && !scene.hasExposure;
    exposureEv100 =
        metered ? deriveExposureEv100(scene) : options.settings.exposureEv100.valueOr(scene.exposureEv100);
    if (options.settings.tracer == TracerChoice::RayQuery && !device.hasRayQuery()) {
        return Error{fmt::format("device '{}' has no ray query; use tracer=compute", device.name())};
    }
    const bool rayQuery =
        options.settings.tracer == TracerChoice::RayQuery ||
        (options.settings.tracer == TracerChoice::Auto && device.hasRayQuery() && !device.isCpu());
    plan.tracer = rayQuery ? TraceBackEnd::RayQuery : TraceBackEnd::ComputeBvh;
    Result<std::unique_ptr<GpuScene>> uploaded =
        GpuScene::create(device, scene, anchorFor(camera, worldBounds(scene)), exposureEv100, plan.tracer);
    if (!uploaded) return Error{uploaded.error()};
    gpuScene = std::move(uploaded.value());
    if (gpuScene->derivedRanges() > 0) {
        statistics.notes.push_back(fmt::format("{} of {} lights have no range and got a derived one: less "
                                               "than 1/1000 of middle grey is lost per light",
                                               gpuScene->derivedRanges(), gpuScene->lightCount()));
    }

    plan.producer = chooseProducer(options.settings, device, gpuScene->triangles(),
                                   std::size_t(options.width) * std::size_t(options.height));
    plan.method = Method(*method);
    plan.view = *view;
    plan.raysPerLight = std::uint32_t(options.settings.raysPerLight);
    plan.halfSampling = plan.stochastic() && options.settings.sampling != Sampling::Full;
    plan.transparent = !gpuScene->transparentDraws().empty();

    features = gpuScene->features();
    if (options.allFeatures) {
        for (std::uint32_t feature = 0; feature < shared::FEATURE_COUNT; ++feature)
            features[feature] = 1;
        features[shared::CHOICE_LIGHTS_IN_UNIFORM] = 0; // texel buffers hold any number
    }
    features[shared::CHOICE_ESTIMATOR] =
        plan.method == Method::ReferenceTrue ? shared::ESTIMATOR_TRUE : shared::ESTIMATOR_SPLIT;
    features[shared::CHOICE_TONE_MAP] =
        options.settings.toneMap == ToneMap::None ? shared::TONE_MAP_NONE : shared::TONE_MAP_NEUTRAL;
    features[shared::CHOICE_VIEW] = std::uint32_t(plan.view);

    const std::uint32_t width = std::uint32_t(options.width), height = std::uint32_t(options.height);
    constants.sampling = samplingConstants(options.settings);
    features[shared::CHOICE_WHITE_NOISE] = options.settings.noise == Noise::White;
    features[shared::CHOICE_HALF_SAMPLING] = std::uint32_t(options.settings.sampling);
    features[shared::CHOICE_DEMODULATED] = plan.stochastic();
    features[shared::CHOICE_LANES] = device.subgroupSize();
    plan.choices = constants.sampling.choices;
    constants.denoising = denoisingConstants(options.settings);
    planFilters(plan, options.settings);
    features[shared::CHOICE_COUNT_SAMPLES] = plan.stochastic();
    features[shared::CHOICE_SPARSE_NEIGHBOURS] = device.isCpu();
    TargetNeeds needs;
    needs.raster = plan.producer == GBufferProducer::Raster;
    needs.debugView = plan.view != shared::VIEW_FINAL;
    needs.history = plan.stochastic();
    needs.rays = plan.stochastic() ? constants.sampling.rays : 0;
    needs.halfChoices = plan.halfSampling ? constants.sampling.choices : 0;
    needs.denoised = plan.denoise;
    needs.denoiseTrace = plan.denoise && isDenoiserView(plan.view);
    needs.antiAliased = plan.antiAlias;
    needs.rawColor = plan.raw();
    needs.mean = plan.mean;
    needs.counted = plan.mean && plan.stochastic();
    needs.settled = plan.settle;
    targets = std::make_unique<Targets>(device, width, height, needs);
    if (plan.stochastic()) {
        if (gpuScene->lightCount() > shared::SAMPLE_LIGHT_LIMIT) {
            return Error{fmt::format("{}: {} lights; the stochastic method takes up to {}",
                                     scene.sourcePath.string(), gpuScene->lightCount(),
                                     shared::SAMPLE_LIGHT_LIMIT)};
        }
        lists = std::make_unique<VisibleLists>(device, width, height);
    }
    if (options.poisonTargets) poisonTargets();
    passes = std::make_unique<FramePasses>(resources, plan);
    const Bounds bounds = worldBounds(scene);
    sceneExtentM = std::max(glm::length(bounds.max - bounds.min), 1e-3);
    grid = std::make_unique<LightGrid>(device, width, height, gpuScene->lightCount());
    if (options.gridRoom) grid->limitFineIndices(*options.gridRoom);
    frameBuffer =
        gpu::Buffer(device, {"frame", sizeof(shared::FrameConstants), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                             gpu::MemoryUse::HostWrite, "other"});
    counterBuffer =
        gpu::Buffer(device, {"counters", shared::COUNTER_COUNT * 4, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                             gpu::MemoryUse::HostReadback, "other"});
    world = gpuScene->rayWorld().traceBindings();
    return std::nullopt;
}

void Renderer::Impl::poisonTargets() {
    VkClearColorValue notANumber{};
    for (std::uint32_t& word : notANumber.uint32)
        word = 0x7fc00000u;
    gpu::Commands commands(device);
    for (const gpu::Image* image : targets->all()) {
        if (image != &targets->rasterDepth) commands.clearColor(*image, notANumber);
    }
    commands.submitAndWait();
}

void Renderer::Impl::runFrame(std::uint32_t index, int widthPx, int heightPx, gpu::PassTimes& passTimes) {
    const glm::dvec2 jitter = options.settings.jitter
                                  ? filterOffset(options.settings.pixelFilter, index, options.seed)
                                  : glm::dvec2(0.0);
    if (historyValid) targets->turnHistory();
    if (historyValid && !(options.settings.freezeHistory && frozen(index))) targets->turnFilteredHistory();
    const shared::FrameConstants before = constants;
    setCamera(constants, camera, gpuScene->anchor(), widthPx, heightPx, jitter);
    constants.tileChunks = device.isCpu() ? std::max(1u, std::thread::hardware_concurrency()) : 1u;
    constants.frame = index;
    constants.sampling.noiseFrame =
        options.settings.freezeNoise && frozen(index) ? std::uint32_t(options.settings.freezeFrame) : index;
    constants.seed = options.seed;
    constants.lightCount = gpuScene->lightCount();
    constants.exposure = float(exposureFromEv100(exposureEv100));
    describeHistory(before);
    constants.rasterized = plan.producer == GBufferProducer::Raster;
    grid->describe(constants, sceneExtentM);
    constants.grid.enabled &= options.settings.lightGrid;
    constants.grid.threadLights = std::uint32_t(options.settings.gridThreadLights);
    frameBuffer.upload(std::as_bytes(std::span(&constants, 1)));

    gpu::Commands commands(device, &passTimes);
    commands.fillBuffer(counterBuffer, 0);
    FrameContext context{commands,      *gpuScene, *targets, frameBuffer, constants,
                         counterBuffer, *grid,     features, lists.get()};
    plan.countLights = plan.view == shared::VIEW_LIGHTS_IN_RANGE || plan.view == shared::VIEW_LIGHTS_SEEN ||
                       plan.view == shared::VIEW_SEEN_SHARE || index + 1 == std::uint32_t(options.frames);
    plan.writeLists = !(frozen(index) && options.settings.freezeLists);
    recordFrame(context, *passes, plan, world, index, float(0.25 * sceneExtentM));
    commands.submitAndWait();
    const std::vector<std::uint32_t> counts = counterBuffer.downloadAs<std::uint32_t>();
    for (std::size_t i = 0; i < counted.size(); ++i)
        counted[i] += counts[i];
    if (constants.grid.enabled) gridUse = grid->finishFrame();
    if (lists && plan.writeLists) lists->turn();
    historyValid = true;
}

void Renderer::Impl::describeCounters() {
    using namespace shared;
    const auto ratio = [&](std::uint32_t above, std::uint32_t below) {
        return counted[below] ? double(counted[above]) / double(counted[below]) : 0.0;
    };
    statistics.rays = counted[COUNTER_RAYS];
    statistics.lightsInRangeMean = ratio(COUNTER_LIGHTS_IN_RANGE, COUNTER_COUNTED_PIXELS);
    statistics.lightsTestedMean = ratio(COUNTER_LIGHTS_TESTED, COUNTER_COUNTED_PIXELS);
    statistics.candidatesMean = ratio(COUNTER_CANDIDATES, COUNTER_SURFACE_PIXELS);
    statistics.raysPerPixelMean = ratio(COUNTER_RAYS, COUNTER_SURFACE_PIXELS);
    statistics.usefulRaysPerPixelMean = ratio(COUNTER_USEFUL_RAYS, COUNTER_SURFACE_PIXELS);
    statistics.missedShare = ratio(COUNTER_MISSED, COUNTER_SURFACE_PIXELS);
    const double tiles = double(constants.tiles.x) * constants.tiles.y * options.frames;
    statistics.listLengthMean = double(counted[COUNTER_LIST_ENTRIES]) / tiles;
    statistics.listOverflowMean = double(counted[COUNTER_LIST_OVERFLOW]) / tiles;
}

// What the frame knows of the one before; without one, the present stands in for it.
void Renderer::Impl::describeHistory(const shared::FrameConstants& before) {
    constants.historyValid = historyValid;
    const shared::FrameConstants& source = historyValid ? before : constants;
    constants.previousClipFromWorld = source.steadyClipFromWorld;
    constants.previousDepthRow = source.depthRow;
    constants.previousSize = source.size;
    constants.previousTiles = source.tiles;
    constants.exposureRatio = historyValid ? constants.exposure / before.exposure : 1.0f;
    constants.sampling.directionalCount = gpuScene->directionalCount();
}

bool Renderer::Impl::frozen(std::uint32_t index) const {
    return index >= std::uint32_t(options.settings.freezeFrame);
}

// CPU drivers compile at the first dispatch. A frame of one tile makes them do it apart from the work, so
// that the time is known; the frame after it starts afresh.
void Renderer::Impl::compilePipelines() {
    gpu::PassTimes compilation;
    runFrame(0, std::min(8, options.width), std::min(8, options.height), compilation);
    for (const gpu::PassTimes::Entry& entry : compilation.entries()) {
        statistics.firstDispatchMs.emplace_back(entry.name,
                                                *std::max_element(entry.ms.begin(), entry.ms.end()));
    }
    std::fill(counted.begin(), counted.end(), 0);
    historyValid = false;
}

Picture Renderer::Impl::readPicture() const {
    Picture picture{options.width, options.height, {}, {}};
    const FloatImage values =
        toFloatImage(plan.view == shared::VIEW_FINAL ? shownPicture(*targets, plan) : targets->viewValues);
    const float scale = plan.view == shared::VIEW_FINAL ? 1.0f / constants.exposure : 1.0f;
    const std::vector<std::byte> display = targets->display.download();
    const std::size_t pixels = std::size_t(options.width) * std::size_t(options.height);
    picture.rgb.resize(pixels * 3);
    picture.srgb8.resize(pixels * 3);
    for (std::size_t i = 0; i < pixels; ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            picture.rgb[i * 3 + c] = values.pixels[i * 4 + c] * scale;
            picture.srgb8[i * 3 + c] = std::uint8_t(display[i * 4 + c]);
        }
    }
    return picture;
}

Result<Picture> Renderer::Impl::render(const RenderProgress& progress) {
    compilePipelines();
    const double beginMs = nowMs();
    for (int i = 0; i < options.frames; ++i) {
        runFrame(std::uint32_t(i), options.width, options.height, times);
        if (i == 0) statistics.startupMs = processAgeMs();
        if (progress && !progress(i + 1, options.frames)) return Error{"cancelled"};
    }
    Picture picture = readPicture();
    statistics.wallMs = nowMs() - beginMs;
    const std::vector<std::string> messages = device.takeValidationMessages();
    if (!messages.empty()) return Error{fmt::format("Vulkan validation: {}", messages.front())};

    statistics.device = device.name();
    statistics.driver = device.driver();
    statistics.timing = device.hasReliableTimestamps() ? "timestamps" : "wall";
    statistics.width = options.width;
    statistics.height = options.height;
    statistics.frames = options.frames;
    statistics.seed = options.seed;
    statistics.lights = gpuScene->lightCount();
    describeCounters();
    statistics.triangles = gpuScene->triangles();
    statistics.exposureEv100 = exposureEv100;
    statistics.gridIndices = gridUse.indices;
    statistics.gridTests = gridUse.tests;
    statistics.gridCoarseCells = gridUse.coarseCells;
    statistics.rangesDerived = gpuScene->derivedRanges();
    const BvhStats& bvh = gpuScene->bvhStats();
    statistics.bvhBuildMs = bvh.flattenSceneMs + bvh.pairMs + bvh.buildMs + bvh.flattenMs;
    statistics.bvhBytesPerTriangle = bvh.bytesPerTriangle;
    describeFeatures(features, statistics);
    describePasses(times,
                   {"cull_coarse", "cull_fine", "light_all", "sample_lights", "upsample_samples",
                    "compact_rays", "trace_samples", "visible_list", "shade_samples", "denoise_temporal",
                    "denoise_spatial"},
                   statistics);
    describeMemory(device.memory(), statistics);
    return picture;
}

// --- Renderer --------------------------------------------------------------------------------------------

Renderer::Renderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Renderer::~Renderer() = default;

std::span<const NamedChoice> Renderer::views() {
    return viewChoices();
}
std::span<const NamedChoice> Renderer::methods() {
    return methodChoices();
}

Result<std::unique_ptr<Renderer>> Renderer::create(const Scene& scene, const RenderOptions& options) {
    try {
        auto impl = std::make_unique<Impl>(scene, options);
        if (auto error = impl->prepare()) return *error;
        return std::unique_ptr<Renderer>(new Renderer(std::move(impl)));
    } catch (const gpu::DeviceError& error) {
        return Error{error.what()};
    }
}

Result<Picture> Renderer::render(const RenderProgress& progress) {
    try {
        return impl_->render(progress);
    } catch (const gpu::DeviceError& error) {
        return Error{error.what()};
    }
}

FrameStatistics Renderer::statistics() const {
    return impl_->statistics;
}

Result<std::vector<NamedImage>> Renderer::targets() {
    std::vector<NamedImage> result;
    if (!impl_->options.keepTargets) return result;
    for (const gpu::Image* image : impl_->targets->all()) {
        result.push_back({image->desc().name, toFloatImage(*image), image->download()});
    }
    return result;
}

} // namespace kilolux
