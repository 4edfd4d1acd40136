// One frame of a Renderer: where everything is at its time, the constants, the passes, what came of it; see
// renderer_impl.h.
#include "renderer/renderer_impl.h"

#include "renderer/document/animation.h"
#include "renderer/dome_maps.h"
#include "renderer/gpu_lights.h"
#include "renderer/readback.h"
#include "shaders/shared/features.h"
#include "shaders/shared/views.h"

#include <algorithm>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <thread>

namespace kilolux {

namespace {

constexpr double kSwayPeriodS = 2.0;
constexpr double kDepthMiddle = 0.25; // of the scene's extent, in the middle of the scale of depth

// Every local light swings along a level direction of its own, out of step with the others.
std::vector<glm::dvec3> swayOffsets(std::size_t lights, double amplitudeM, double timeS) {
    std::vector<glm::dvec3> offsets;
    if (amplitudeM == 0.0) return offsets;
    for (std::size_t i = 0; i < lights; ++i) {
        const double turn = std::fmod(double(i) * 0.61803398875, 1.0) * glm::two_pi<double>();
        const double swing = amplitudeM * std::sin(glm::two_pi<double>() * timeS / kSwayPeriodS + 2.0 * turn);
        offsets.emplace_back(swing * std::cos(turn), 0.0, swing * std::sin(turn));
    }
    return offsets;
}

} // namespace

// The camera of a time: carried by its animated node, then turned about the vertical and moved forward.
Camera Renderer::Impl::cameraAt(double timeS, const Scene& posed) const {
    Camera now = camera;
    if (cameraIndex >= 0 && !posed.animations.empty())
        now.worldFromCamera = posed.cameras[std::size_t(cameraIndex)].worldFromCamera;
    const double turnRad = glm::radians(options.settings.cameraTurn) * timeS;
    const glm::dvec3 position(now.worldFromCamera[3]);
    const glm::dvec3 forward = -glm::dvec3(now.worldFromCamera[2]);
    if (turnRad != 0.0) {
        now.worldFromCamera = glm::translate(glm::dmat4(1.0), position) *
                              glm::rotate(glm::dmat4(1.0), turnRad, glm::dvec3(0, 1, 0)) *
                              glm::translate(glm::dmat4(1.0), -position) * now.worldFromCamera;
    }
    now.worldFromCamera[3] += glm::dvec4(forward * (options.settings.cameraDolly * timeS), 0.0);
    return now;
}

void Renderer::Impl::updateScene(double timeS) {
    if (!scene.animations.empty()) poseScene(scene, timeS);
    gpuScene->updateMovingInstances(scene);
    const bool swaying = options.settings.lightsSway != 0.0;
    // The marks of an edit fade over some frames, and slots come free.
    const bool fading = framesRun < lightsEditedRun + LightSlots::kRestFrames;
    const bool flowing = std::any_of(scene.lightDefs.begin(), scene.lightDefs.end(), [](const LightDef& def) {
        return def.function.kind == LightFunctionKind::Caustics ||
               def.function.kind == LightFunctionKind::Flicker;
    });
    if (gpuScene->setPenumbraScale(options.settings.penumbraScale)) lightsDirty = true;
    if (!lightsDirty && !fading && !swaying && !flowing && scene.animations.empty()) return;
    if (lightsDirty && gpuScene->updateChannels(scene)) historyReset = "lighting channels";
    gpuScene->setEditMemory(options.settings);
    gpuScene->updateLights(scene, exposureEv100, framesRun,
                           swayOffsets(scene.lights.size(), options.settings.lightsSway, timeS), timeS);
    lightsDirty = false;
    if (gpuScene->slots().edited()) {
        lightsEditedRun = framesRun;
        meanReset = true;
    }
}

// What the frame knows of the one before; without one, the present stands in for it.
void Renderer::Impl::describeHistory(const shared::FrameConstants& before) {
    const bool valid = historyReset.empty();
    constants.historyValid = valid;
    const shared::FrameConstants& source = valid ? before : constants;
    constants.previousClipFromWorld = source.steadyClipFromWorld;
    constants.previousDepthRow = source.depthRow;
    constants.previousSize = source.size;
    constants.previousTiles = source.tiles;
    constants.exposureRatio = valid ? constants.exposure / historyExposure : 1.0f;
}

void Renderer::Impl::describeFrame(std::uint32_t index, glm::ivec2 outputPx, const Camera& now) {
    const Settings& settings = options.settings;
    const std::uint32_t noiseFrame =
        settings.freezeNoise && frozen(index) ? std::uint32_t(settings.freezeFrame) : index;
    const glm::dvec2 jitter =
        settings.jitter ? filterOffset(settings.pixelFilter, noiseFrame) : glm::dvec2(0.0);
    const glm::ivec2 inner =
        glm::max(glm::ivec2(glm::round(glm::dvec2(outputPx) * settings.renderScale)), glm::ivec2(1));
    const shared::FrameConstants before = constants;
    // Rounding to whole pixels must not change what the picture shows, or history would slide at every
    // change.
    kilolux::setCamera(constants, now, gpuScene->anchor(), inner.x, inner.y, jitter,
                       double(outputPx.x) / double(outputPx.y));
    constants.outputSize = glm::uvec2(outputPx);
    constants.tileChunks = device.isCpu() ? std::max(1u, std::thread::hardware_concurrency()) : 1u;
    constants.frame = index;
    constants.seed = options.seed;
    constants.lightCount = gpuScene->lightCount();
    constants.exposure = float(exposureFromEv100(exposureEv100));
    if (const DomeMaps* dome = gpuScene->dome()) {
        constants.backgroundNit =
            gpuScene->showsDome() ? glm::vec3(domeTexelNit(scene.dome, *dome)) : glm::vec3(0.0f);
        constants.backgroundTurn = {float(std::cos(scene.dome.rotationRad)),
                                    float(std::sin(scene.dome.rotationRad))};
    }
    constants.fillNit = settings.fill ? glm::vec3(fillNit(scene.dome)) : glm::vec3(0.0f);
    constants.rasterized = plan.producer == GBufferProducer::Raster;
    shared::SamplingConstants& sampling = constants.sampling;
    sampling.noiseFrame = noiseFrame;
    sampling.directionalCount = gpuScene->directionalCount();
    const std::vector<std::uint32_t>& fresh = gpuScene->freshSlots();
    sampling.freshCount = std::uint32_t(fresh.size());
    for (std::size_t i = 0; i < fresh.size(); ++i)
        (i < 4 ? sampling.fresh0 : sampling.fresh1)[int(i % 4)] = fresh[i];
    describeHistory(before);
    grid->describe(constants, sceneExtentM);
    constants.grid.enabled &= settings.lightGrid;
    countStillFrames(before);
}

// The running mean goes on only while nothing that it averages has changed.
void Renderer::Impl::countStillFrames(const shared::FrameConstants& before) {
    const bool still = constants.historyValid && !meanReset && constants.exposure == before.exposure &&
                       constants.size == before.size &&
                       constants.steadyClipFromWorld == before.steadyClipFromWorld &&
                       !(gpuScene->hasMovingInstances() && options.settings.timeStepS != 0.0);
    meanFrames = still ? meanFrames : 0;
    meanReset = false;
}

bool Renderer::Impl::submitFrame(gpu::Commands& commands, FrameContext& context) {
    // Given up, a frame with moving instances would lose where they had been.
    const bool canStop = !gpuScene->hasMovingInstances();
    // While pipelines are built every pass is a slice: the watch sees each, and each can be the last.
    if (options.sliceMs > 0.0)
        commands.submitInSlices(planIsNew ? 1e-3 : options.sliceMs, canStop ? options.interrupt : nullptr);
    int begun = 0;
    if (planIsNew && options.watch) {
        commands.onPass([this, &begun](const std::string&) {
            reach("Building pipelines", 0.5 + 0.5 * std::min(1.0, double(++begun) / kUsualShaders));
        });
    }
    try {
        recordFrame(context, *passes, plan, world, meanFrames,
                    viewConstants(plan.view, legend, kDepthMiddle * sceneExtentM));
        commands.submitAndWait();
        planIsNew = false;
        return true;
    } catch (const gpu::Interrupted&) {
        return false;
    }
}

void Renderer::Impl::decideUsedFeatures() {
    used = gpuScene->features();
    if (options.allFeatures) {
        for (std::uint32_t feature = 0; feature < shared::FEATURE_COUNT; ++feature)
            used[feature] = 1;
        used[shared::CHOICE_LIGHTS_IN_UNIFORM] = 0; // texel buffers hold any number
    }
    if (!options.settings.fill) used[shared::FEATURE_FILL] = 0;
    used.insert(features.begin(), features.end());
}

// What a finished frame came to, and what the next one finds.
void Renderer::Impl::finishFrame() {
    const std::vector<std::uint32_t> counts = counterBuffer.downloadAs<std::uint32_t>();
    for (std::size_t i = 0; i < counted.size(); ++i)
        counted[i] += counts[i];
    if (constants.grid.enabled) gridUse = grid->finishFrame();
    frameStands = !constants.grid.enabled || gridUse.indices <= gridUse.capacity;
    chosenFrom = lists ? &lists->previous() : nullptr;
    if (lists && plan.writeLists) lists->turn();
    historyBegins = !historyReset.empty();
    if (historyBegins) lastHistoryReset = historyReset;
    historyReset.clear();
    ++meanFrames;
    ++framesRun;
}

namespace {

// Buffers of what stands in for a frame's light; empty where nothing does.
struct ReplacedLight {
    ReplacedLight(gpu::Device& device, const LitTexels& lit)
        : diffuse(of(device, lit.diffuse)), specular(of(device, lit.specular)) {}

    gpu::Buffer diffuse, specular;

  private:
    static gpu::Buffer of(gpu::Device& device, const std::vector<float>& texels) {
        if (texels.empty()) return {};
        gpu::Buffer buffer(device, {"replaced light", texels.size() * sizeof(float),
                                    VK_BUFFER_USAGE_TRANSFER_SRC_BIT, gpu::MemoryUse::HostWrite, "other"});
        buffer.upload(texels);
        return buffer;
    }
};

} // namespace

void Renderer::Impl::runFrame(std::uint32_t index, glm::ivec2 outputPx, gpu::PassTimes& passTimes) {
    const double timeS = options.settings.timeS + index * options.settings.timeStepS;
    updateScene(timeS);
    if (plan.resamples())
        gpuScene->prepareLightDraws(int(features.at(shared::CHOICE_DRAW_FROM)), sceneExtentM);
    if (shadowMaps) shadowMaps->update(*gpuScene);
    const bool turns = historyReset.empty();
    // Frozen at once, it holds the first frame: before that there is nothing to hold.
    const bool turnsFiltered = turns && (historyBegins || !(options.settings.freezeHistory && frozen(index)));
    const shared::FrameConstants constantsBefore = constants;
    const float exposureBefore = historyExposure;
    if (turns) targets->turnHistory();
    if (turnsFiltered) {
        targets->turnFilteredHistory();
        historyExposure = constants.exposure;
    }
    describeFrame(index, outputPx, cameraAt(timeS, scene));
    frameBuffer.upload(std::as_bytes(std::span(&constants, 1)));
    plan.countLights = plan.view == shared::VIEW_LIGHTS_IN_RANGE || plan.view == shared::VIEW_LIGHTS_SEEN ||
                       plan.view == shared::VIEW_SEEN_SHARE ||
                       (outputView && outputView->pass == "count_lights") ||
                       index + 1 == std::uint32_t(options.frames);
    plan.writeLists = !(frozen(index) && options.settings.freezeLists);

    decideUsedFeatures();
    gpu::Commands commands(device, &passTimes);
    commands.fillBuffer(counterBuffer, 0);
    if (rayList) commands.fillBuffer(rayList->heads, 0);
    FrameContext context{commands, *gpuScene, *targets,    frameBuffer, constants,     counterBuffer,
                         *grid,    used,      lists.get(), &noise,      rayList.get(), shadowMaps.get()};
    const ReplacedLight replaced(device, options.replaceLit ? options.replaceLit(int(index)) : LitTexels{});
    context.replacedDiffuse = replaced.diffuse ? &replaced.diffuse : nullptr;
    context.replacedSpecular = replaced.specular ? &replaced.specular : nullptr;
    legend =
        viewLegend(plan.view, double(constants.exposure), kDepthMiddle * sceneExtentM, options.viewRange);
    if (outputView) commands.captureAfter(outputView->pass);
    interrupted = !submitFrame(commands, context);
    if (interrupted) {
        // Everything that lasts is written into one of two images in turn: turned back, it is as it was.
        if (turns) targets->turnHistory();
        if (turnsFiltered) targets->turnFilteredHistory();
        historyExposure = exposureBefore;
        constants = constantsBefore;
        meanReset = true; // it has one image only
        frameStands = false;
        return;
    }
    takePassOutput(commands);
    if (shadowMaps) shadowMaps->finishFrame();

    finishFrame();
}

// CPU drivers compile at the first dispatch. A frame of one tile makes them do it apart from the work, so
// that the time is known; the frame after it starts afresh.
void Renderer::Impl::compilePipelines() {
    gpu::PassTimes compilation;
    if (shadowMaps) shadowMaps->limitFaces(1);
    runFrame(0, glm::min(glm::ivec2(8), glm::ivec2(options.width, options.height)), compilation);
    for (const gpu::PassTimes::Entry& entry : compilation.entries()) {
        statistics.firstDispatchMs.emplace_back(entry.name,
                                                *std::max_element(entry.ms.begin(), entry.ms.end()));
    }
    if (shadowMaps) shadowMaps->limitFaces();
    std::fill(counted.begin(), counted.end(), 0);
    historyReset = "first frame";
}

// Linear between rendered pixels, as tone_map.comp shows them.
static glm::vec3 shownColor(const FloatImage& image, glm::ivec2 pixel, glm::dvec2 scale, glm::ivec2 size) {
    const glm::dvec2 at = (glm::dvec2(pixel) + 0.5) * scale - 0.5;
    const glm::dvec2 corner = glm::floor(at), part = at - corner;
    glm::dvec3 sum(0.0);
    for (int i = 0; i < 4; ++i) {
        const glm::ivec2 offset(i & 1, i >> 1);
        const glm::ivec2 p = glm::clamp(glm::ivec2(corner) + offset, glm::ivec2(0), size - 1);
        const double weight = (offset.x ? part.x : 1.0 - part.x) * (offset.y ? part.y : 1.0 - part.y);
        const float* texel =
            &image.pixels[(std::size_t(p.y) * std::size_t(image.width) + std::size_t(p.x)) * 4];
        sum += weight * glm::dvec3(texel[0], texel[1], texel[2]);
    }
    return glm::vec3(sum);
}

Picture Renderer::Impl::readPicture() const {
    if (passOutput) return passOutput->picture;
    Picture picture{options.width, options.height, {}, {}};
    const bool view = plan.view != shared::VIEW_FINAL;
    const FloatImage values = toFloatImage(view ? targets->viewValues : shownPicture(*targets, plan));
    const float scale = view ? 1.0f : 1.0f / constants.exposure;
    const std::vector<std::byte> display = targets->display.download();
    const glm::ivec2 size(constants.size);
    const bool smaller = !view && constants.size != constants.outputSize;
    picture.rgb.reserve(std::size_t(options.width) * std::size_t(options.height) * 3);
    for (std::size_t i = 0; i < std::size_t(options.width) * std::size_t(options.height); ++i) {
        const glm::ivec2 pixel(int(i) % options.width, int(i) / options.width);
        glm::vec3 color(values.pixels[i * 4], values.pixels[i * 4 + 1], values.pixels[i * 4 + 2]);
        if (smaller) {
            const glm::dvec2 step = glm::dvec2(size) / glm::dvec2(options.width, options.height);
            color = shownColor(values, pixel, step, size);
        }
        for (int c = 0; c < 3; ++c) {
            picture.rgb.push_back(color[c] * scale);
            picture.srgb8.push_back(std::uint8_t(display[i * 4 + std::size_t(c)]));
        }
    }
    return picture;
}

} // namespace kilolux
