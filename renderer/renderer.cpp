// The renderer's public face and its statistics; see renderer.h.
#include "renderer/renderer.h"

#include "renderer/document/light_units.h"
#include "renderer/dome_maps.h"
#include "renderer/readback.h"
#include "renderer/renderer_impl.h"
#include "renderer/views.h"

#include <algorithm>
#include <fmt/format.h>

namespace kilolux {

namespace {

// Does the work; what the device throws, or who cancels, becomes the result.
template<typename Work>
auto told(Work work) -> decltype(work()) {
    try {
        return work();
    } catch (const gpu::DeviceError& error) {
        return Error{error.what()};
    } catch (const gpu::Interrupted&) {
        return Error{"cancelled"};
    }
}

} // namespace

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
    statistics.droppedLightMean = ratio(COUNTER_DROPPED, COUNTER_SURFACE_PIXELS) / DROPPED_STEPS;
    const double tiles = double(constants.tiles.x) * constants.tiles.y * options.frames;
    statistics.listLengthMean = double(counted[COUNTER_LIST_ENTRIES]) / tiles;
    statistics.listOverflowMean = double(counted[COUNTER_LIST_OVERFLOW]) / tiles;
}

Result<Picture> Renderer::Impl::render(const RenderProgress& progress) {
    compilePipelines();
    const double beginMs = nowMs();
    for (int i = 0; i < options.frames; ++i) {
        const std::vector<std::size_t> timed = runCounts(times);
        runFrame(std::uint32_t(i), {options.width, options.height}, times);
        recentTimes.push_back(frameTimes(times, timed));
        if (i == 0) statistics.startupMs = processAgeMs();
        if (progress && !progress(i + 1, options.frames)) return Error{"cancelled"};
        if (viewProblem) return *viewProblem;
    }
    Picture picture = readPicture();
    statistics.wallMs = nowMs() - beginMs;
    const std::vector<std::string> messages = device.takeValidationMessages();
    if (!messages.empty()) return Error{fmt::format("Vulkan validation: {}", messages.front())};
    describe();
    return picture;
}

void Renderer::Impl::describe() {
    // After every frame of renderFrame(): the lists begin anew.
    statistics.passes.clear();
    statistics.featuresOn.clear();
    statistics.featuresOff.clear();
    statistics.gpuMemory.clear();
    statistics.device = device.name();
    statistics.driver = device.driver();
    statistics.timing = device.hasReliableTimestamps() ? "timestamps" : "wall";
    statistics.width = options.width;
    statistics.height = options.height;
    statistics.frames = options.frames;
    statistics.seed = options.seed;
    statistics.lights = scene.lights.size();
    statistics.historyReset = lastHistoryReset;
    statistics.view = plan.view == shared::VIEW_FINAL && outputView
                          ? fmt::format("pass:{}/{}", outputView->pass, passOutput ? passOutput->name : "")
                          : viewChoices()[std::size_t(plan.view)].name;
    statistics.legend = legend;
    statistics.viewProblem = viewProblem ? viewProblem->message : "";
    statistics.viewOutputs = passOutput ? passOutput->names : std::vector<std::string>{};
    describeCounters();
    statistics.triangles = gpuScene->triangles();
    statistics.exposureEv100 = exposureEv100;
    statistics.fillNit = luminanceOf(glm::dvec3(constants.fillNit));
    statistics.gridIndices = gridUse.indices;
    statistics.gridTests = gridUse.tests;
    statistics.gridCoarseCells = gridUse.coarseCells;
    statistics.rangesDerived = gpuScene->derivedRanges();
    const BvhStats& bvh = gpuScene->bvhStats();
    statistics.bvhBuildMs = bvh.flattenSceneMs + bvh.pairMs + bvh.buildMs + bvh.flattenMs;
    statistics.bvhBytesPerTriangle = bvh.bytesPerTriangle;
    statistics.shadowMaps = {};
    if (shadowMaps)
        statistics.shadowMaps = {shadowMaps->layout().faces, shadowMaps->layout().sizePx,
                                 shadowMaps->drawn()};
    describeFeatures(used, statistics);
    describePasses(recentTimes,
                   {"cull_coarse", "cull_fine", "shadow_maps", "light_all", "sample_lights",
                    "upsample_samples", "compact_rays", "trace_samples", "visible_list", "shade_samples",
                    "resample_lights", "reuse_reservoirs", "denoise_temporal", "denoise_spatial"},
                   statistics);
    describeMemory(device.memory(), statistics);
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
    return told([&]() -> Result<std::unique_ptr<Renderer>> {
        auto impl = std::make_unique<Impl>(scene, options);
        if (auto error = impl->prepare()) return *error;
        return std::unique_ptr<Renderer>(new Renderer(std::move(impl)));
    });
}

Result<Picture> Renderer::render(const RenderProgress& progress) {
    return told([&] { return impl_->render(progress); });
}

std::optional<Error> Renderer::Impl::renderFrame() {
    const std::vector<std::size_t> timed = runCounts(times);
    runFrame(nextFrame, {options.width, options.height}, times);
    if (interrupted) return std::nullopt;
    ++nextFrame;
    recentTimes.push_back(frameTimes(times, timed));
    if (recentTimes.size() > kTimedFrames) recentTimes.pop_front();
    times.keepNewest(kTimedFrames);
    options.frames = int(nextFrame);
    describe();
    const std::vector<std::string> messages = device.takeValidationMessages();
    if (!messages.empty()) return Error{fmt::format("Vulkan validation: {}", messages.front())};
    return std::nullopt;
}

std::optional<Error> Renderer::renderFrame() {
    return told([&] { return impl_->renderFrame(); });
}

bool Renderer::wasInterrupted() const {
    return impl_->interrupted;
}

Picture Renderer::picture() const {
    return impl_->readPicture();
}

void Renderer::setCamera(const Camera& camera, CameraChange change) {
    impl_->camera = camera;
    impl_->cameraIndex = -1;
    if (change == CameraChange::Cut) impl_->historyReset = "camera cut";
}

void Renderer::setLights(const Scene& edited) {
    impl_->scene.lights = edited.lights;
    impl_->scene.lightDefs = edited.lightDefs;
    impl_->scene.groups = edited.groups;
    impl_->scene.nodes = edited.nodes;
    const Dome &was = impl_->scene.dome, &now = edited.dome;
    // Neither is a light; what is, is compared as such.
    if (was.visible != now.visible || fillNit(was) != fillNit(now)) impl_->meanReset = true;
    impl_->scene.dome = edited.dome;
    impl_->lightsDirty = true;
}

void Renderer::setExposureEv100(double ev100) {
    impl_->exposureEv100 = ev100;
}

void Renderer::setRenderScale(double scale) {
    impl_->options.settings.renderScale = scale;
}

std::optional<Error> Renderer::setSettings(const Settings& settings) {
    const Settings before = std::exchange(impl_->options.settings, settings);
    return told([&] {
        std::optional<Error> error = impl_->preparePlan();
        if (error) {
            impl_->options.settings = before;
            impl_->preparePlan();
        }
        impl_->historyReset = "settings";
        const bool sameExposure = impl_->options.settings.exposureEv100 == before.exposureEv100;
        if (!sameExposure) impl_->exposureEv100 = impl_->wantedExposureEv100();
        return error;
    });
}

std::optional<Error> Renderer::setView(std::string_view view, const std::optional<ViewRange>& range) {
    return told([&] { return impl_->setView(view, range); });
}

std::optional<Error> Renderer::resize(int width, int height) {
    impl_->options.width = width;
    impl_->options.height = height;
    return told([&]() -> std::optional<Error> {
        // Pipelines stay, unless another size wants another producer.
        const bool samePasses = impl_->wantedProducer() == impl_->plan.producer;
        if (samePasses) impl_->makeTargets();
        impl_->historyReset = "size of the picture";
        return samePasses ? std::nullopt : impl_->preparePlan();
    });
}

std::uint32_t Renderer::meanFrames() const {
    return impl_->meanFrames;
}

std::vector<std::byte> Renderer::displayPixels() const {
    return impl_->targets->display.download();
}

Result<Probe> Renderer::probe(glm::ivec2 pixel, ProbeDepth depth) {
    return told([&] { return impl_->probe(pixel, depth); });
}

std::vector<glm::uvec2> Renderer::visibleLists() const {
    return impl_->lists ? impl_->lists->readPrevious() : std::vector<glm::uvec2>{};
}

void Renderer::replaceVisibleLists(const std::vector<glm::uvec2>& texels) {
    impl_->lists->replacePrevious(texels);
}

std::uint32_t Renderer::lightSlot(std::uint64_t lightId) const {
    return impl_->gpuScene->slots().slotOf(lightId);
}

bool Renderer::isSoftware() const {
    return impl_->device.isCpu();
}

FrameStatistics Renderer::statistics() const {
    return impl_->statistics;
}

Result<std::vector<NamedImage>> Renderer::targets() {
    std::vector<NamedImage> result;
    if (!impl_->options.keepTargets) return result;
    for (const auto& [name, image] : impl_->targets->all()) {
        result.push_back({std::string(name), toFloatImage(*image), image->download()});
    }
    return result;
}

} // namespace kilolux
