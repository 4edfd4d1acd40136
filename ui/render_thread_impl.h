// What the render thread holds, see render_thread.h: the requests that wait, and the state of its loop, which
// is in render_loop.cpp. Internal to both.
#pragma once

#include "renderer/document/task_watch.h"
#include "ui/render_thread.h"

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace kilolux {

struct OpenRequest {
    Scene scene;
    RenderOptions options;
    Camera camera;
    std::uint64_t version = 0;
};

struct LightsRequest {
    Scene scene;
    std::uint64_t version = 0;
};

struct CameraRequest {
    Camera camera;
    Renderer::CameraChange change = Renderer::CameraChange::Move;
};

// What has been asked for since the last frame; the newest of each wins.
struct Requests {
    std::optional<OpenRequest> open;
    bool close = false;
    std::optional<CameraRequest> camera;
    std::optional<LightsRequest> lights;
    std::optional<double> exposureEv100;
    std::optional<Settings> settings;
    std::optional<std::string> view;
    std::optional<ViewRange> viewRange; // of that view
    std::optional<glm::ivec2> size;
    std::optional<RenderLimits> limits;
    std::vector<RenderThread::Job> jobs;
    double atMs = 0.0; // of the newest change of what the picture shows

    // What holds whichever scene is open.
    Requests ofNoScene() const {
        Requests kept;
        kept.size = size;
        kept.limits = limits;
        return kept;
    }
    bool any() const {
        return open || close || camera || lights || exposureEv100 || settings || view || size || limits ||
               !jobs.empty();
    }
};

struct RenderThread::Impl {
    explicit Impl(std::function<void()> wakeUi) : wake(std::move(wakeUi)) {
        thread = std::thread([this] { loop(); });
    }

    // --- shared, under the mutex
    mutable std::mutex mutex;
    std::condition_variable condition;
    Requests pending;
    bool stopping = false;
    bool paused = false;
    double inputMs = 0.0;  // of the event that the next change answers
    bool jobsDone = false; // since the last takeFrame()
    std::shared_ptr<const ShownFrame> finished;
    std::optional<Error> error;
    Activity activity; // its words and share while a watch tells them: the watch's
    std::shared_ptr<TaskWatch> watch = std::make_shared<TaskWatch>(); // of the renderer, from its making on
    std::atomic<bool> interrupt = false;                              // gives the present frame up
    std::atomic<bool> canInterrupt = false;

    // --- of the thread
    std::function<void()> wake;
    std::shared_ptr<TaskWatch> watchOfRenderer; // outlives it
    std::unique_ptr<Renderer> renderer;
    Scene scene;
    RenderOptions options;
    Camera camera;
    std::uint64_t version = 0;
    RenderLimits limits;
    glm::ivec2 viewportPx{0};
    bool software = true; // until the device is known
    std::uint64_t frames = 0;
    std::uint32_t stillFrames = 0; // at full resolution since anything changed
    std::uint32_t freshFrames = 0; // since pipelines were built: the first ones compile
    double lastChangeMs = 0.0;
    double requestedMs = 0.0;
    double msPerPixel = 0.0; // smoothed; 0: not measured yet
    double scale = 1.0;
    std::thread thread;

    template<typename Change>
    void request(Change change, bool showsInPicture = true) {
        {
            const std::lock_guard lock(mutex);
            change(pending);
            if (showsInPicture) pending.atMs = inputMs > 0.0 ? inputMs : steadyMs();
        }
        if (showsInPicture && canInterrupt) interrupt = true;
        condition.notify_one();
    }

    void loop();
    void apply(Requests requests);
    void create(OpenRequest request);
    void renderOne();
    void publish(double beginMs);
    double wantedScale() const;
    bool isResting() const { return steadyMs() - lastChangeMs > limits.restMs; }
    bool settled() const { return stillFrames >= limits.meanFrames && !animated(); }
    bool animated() const {
        return options.settings.timeStepS != 0.0 &&
               (!scene.animations.empty() || options.settings.lightsSway != 0.0 ||
                options.settings.cameraTurn != 0.0 || options.settings.cameraDolly != 0.0);
    }
    glm::ivec2 pictureSize() const;
    void fail(const Error& what);
    void begin(const char* words, bool opens); // what takes long
    void end();
    void giveUp(); // under the mutex: what is being prepared is not wanted any more
};

} // namespace kilolux
