// What a Renderer holds between frames; see renderer.h. Preparing is in renderer_prepare.cpp, a frame in
// renderer_frames.cpp.
#pragma once

#include "renderer/renderer.h"

#include "renderer/camera.h"
#include "renderer/frame.h"
#include "renderer/pass_output.h"
#include "renderer/pass_statistics.h"

#include <deque>

namespace kilolux {

struct Renderer::Impl {
    Impl(const Scene& source, const RenderOptions& renderOptions);

    // --- renderer_prepare.cpp
    std::optional<Error> prepare(); // once
    // Tells options.watch; throws gpu::Interrupted when it is cancelled.
    void reach(const char* doing, double share) const;
    std::optional<Error> prepareScene();
    std::optional<Error> preparePlan(); // again whenever the settings change
    void makeTargets();                 // again whenever the size changes as well
    GBufferProducer wantedProducer() const;
    double wantedExposureEv100() const; // of the settings, else of the scene, else metered
    void poisonTargets();

    // --- renderer_views.cpp
    std::optional<Error> planView(); // of options.view; settings and method decide its filters
    TargetNeeds targetNeeds() const;
    std::optional<Error> setView(std::string_view view, const std::optional<ViewRange>& range);
    void takePassOutput(const gpu::Commands& commands);

    // --- renderer_frames.cpp
    void runFrame(std::uint32_t index, glm::ivec2 outputPx, gpu::PassTimes& passTimes);
    void decideUsedFeatures();
    bool submitFrame(gpu::Commands& commands, FrameContext& context); // false: given up
    void finishFrame();
    void compilePipelines();
    Picture readPicture() const;

    // --- renderer_probe.cpp
    Result<Probe> probe(glm::ivec2 pixel, ProbeDepth depth);
    Probe readProbe(glm::ivec2 pixel, ProbeDepth depth);

    // --- renderer.cpp
    std::optional<Error> renderFrame();
    Result<Picture> render(const RenderProgress& progress);
    void describe();
    void describeCounters();

    // What the settings freeze stands still in this frame.
    bool frozen(std::uint32_t index) const { return index >= std::uint32_t(options.settings.freezeFrame); }

    double startMs;
    Scene scene; // a copy: meshes and images are shared
    RenderOptions options;
    gpu::Device device;
    gpu::PassResources resources;
    Camera camera;        // at rest, before time and settings move it
    int cameraIndex = -1; // into Scene::cameras while an animation may move it
    FramePlan plan;
    double exposureEv100 = 0.0;
    std::unique_ptr<GpuScene> gpuScene;
    std::unique_ptr<Targets> targets;
    std::unique_ptr<FramePasses> passes;
    std::unique_ptr<LightGrid> grid;
    std::unique_ptr<VisibleLists> lists;
    std::unique_ptr<RayList> rayList;
    std::unique_ptr<ShadowMaps> shadowMaps; // of the method with them
    gpu::Image noise;                       // only of the stochastic method
    GridUse gridUse;
    double sceneExtentM = 0.0; // diagonal of the bounds
    gpu::Buffer frameBuffer, counterBuffer;
    shared::FrameConstants constants{};
    gpu::SpecValues used;     // features and choices of the last frame
    gpu::SpecValues features; // what the settings decide; the scene's own are in GpuScene
    gpu::Bindings world;

    bool frameStands = false;                // all that the last frame read is as it was
    const gpu::Buffer* chosenFrom = nullptr; // visible lists that the last frame's choice read; null without
    gpu::Buffer probeSurface, probeLights, probeRays;
    std::uint32_t nextFrame = 0;              // index of the next frame of renderFrame()
    std::uint64_t framesRun = 0;              // ever
    std::uint32_t meanFrames = 0;             // that the running mean holds
    std::string historyReset = "first frame"; // why there is no history; empty: there is
    std::string lastHistoryReset;             // the last one that happened
    bool interrupted = false;                 // the last frame was given up
    bool planIsNew = true;                    // no frame has run to its end since the passes were made
    int shadersCompiled = 0;                  // of these passes, for the watch
    static constexpr double kUsualShaders = 22.0;
    bool historyBegins = true;         // the last frame found none
    float historyExposure = 1.0f;      // that the denoiser's history was written with
    bool meanReset = true;             // something changed that the mean does not survive
    bool lightsDirty = false;          // setLights() since the last frame
    std::uint64_t lightsEditedRun = 0; // framesRun of the last edit of a light

    std::optional<PassOutputName> outputView; // the view is an output of a pass
    std::optional<PassOutput> passOutput;     // of the last frame
    std::optional<Error> viewProblem;         // of the last frame
    Legend legend;                            // of the last frame's view

    gpu::PassTimes times;
    // Of the last frames, the newest last; render() keeps all of its own.
    static constexpr std::size_t kTimedFrames = 64; // a window runs for hours
    std::deque<FrameTimes> recentTimes;
    FrameStatistics statistics;
    std::vector<std::uint64_t> counted = std::vector<std::uint64_t>(shared::COUNTER_COUNT); // of all frames

  private:
    Camera cameraAt(double timeS, const Scene& posed) const;
    void updateScene(double timeS);
    void describeFrame(std::uint32_t index, glm::ivec2 outputPx, const Camera& now);
    void describeHistory(const shared::FrameConstants& before);
    void countStillFrames(const shared::FrameConstants& before);
};

std::filesystem::path contentDirectory();
double nowMs(); // of a steady clock

} // namespace kilolux
