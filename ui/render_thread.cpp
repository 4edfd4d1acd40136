// The loop of the render thread, see render_thread.h.
#include "ui/render_thread.h"

#include "renderer/document/task_watch.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <sys/resource.h>
#include <thread>
#include <utility>

namespace kilolux {

namespace {

// The threads of a software device begin as the render thread is by then: below the UI's, so that a redraw is
// not kept waiting for its turn.
constexpr int kNiceness = 5;
constexpr double kScaleSteps = 16.0; // the internal resolution moves in steps, so that it does not flicker

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

// Of a picture on a software device unless the limits say otherwise: beyond it memory and time get out of
// hand.
constexpr std::uint32_t kMostSoftwarePixels = 1u << 20;

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

} // namespace

double steadyMs() {
    using namespace std::chrono;
    return duration<double, std::milli>(steady_clock::now().time_since_epoch()).count();
}

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

void RenderThread::Impl::fail(const Error& what) {
    {
        const std::lock_guard lock(mutex);
        if (watchOfRenderer->isCancelled()) return; // nobody waits for it
        error = what;
    }
    wake();
}

void RenderThread::Impl::begin(const char* words, bool opens) {
    {
        const std::lock_guard lock(mutex);
        activity = {words, 0.0, opens, steadyMs()};
        watch->reach(words, 0.0);
    }
    wake();
}

void RenderThread::Impl::end() {
    {
        const std::lock_guard lock(mutex);
        activity = {};
    }
    wake();
}

void RenderThread::Impl::giveUp() {
    watch->cancel();
    watch = std::make_shared<TaskWatch>();
    interrupt = true;
}

// The viewport's size, or the largest of its shape that the limit allows.
glm::ivec2 RenderThread::Impl::pictureSize() const {
    const double pixels = double(viewportPx.x) * double(viewportPx.y);
    const std::uint32_t byDevice = software ? kMostSoftwarePixels : UINT32_MAX;
    const double most = limits.mostPixels > 0 ? limits.mostPixels : byDevice;
    if (pixels <= most) return viewportPx;
    const double factor = std::sqrt(most / pixels);
    return glm::max(glm::ivec2(glm::round(glm::dvec2(viewportPx) * factor)), glm::ivec2(1));
}

void RenderThread::Impl::create(OpenRequest request) {
    renderer.reset();
    {
        const std::lock_guard lock(mutex);
        watchOfRenderer = watch;
    }
    scene = std::move(request.scene);
    options = std::move(request.options);
    camera = request.camera;
    version = request.version;
    const glm::ivec2 size = pictureSize();
    if (size.x > 0) options.width = size.x, options.height = size.y;
    options.sliceMs = limits.sliceMs;
    options.interrupt = &interrupt;
    options.watch = watchOfRenderer.get();
    begin("Preparing the scene", true);
    Result<std::unique_ptr<Renderer>> created = Renderer::create(scene, options);
    if (!created) end();
    if (!created) return fail(Error{created.error()});
    renderer = std::move(created.value());
    software = renderer->isSoftware(); // another size follows in apply()
    renderer->setCamera(camera, Renderer::CameraChange::Cut);
    freshFrames = 0;
    msPerPixel = 0.0;
    scale = 1.0;
}

void RenderThread::Impl::apply(Requests requests) {
    if (requests.limits) limits = *requests.limits;
    if (requests.size) viewportPx = *requests.size;
    if (requests.close || requests.open) {
        renderer.reset();
        const std::lock_guard lock(mutex);
        finished.reset();
    }
    if (requests.open) create(std::move(*requests.open));
    if (requests.atMs > 0.0) {
        requestedMs = requests.atMs;
        lastChangeMs = steadyMs();
        stillFrames = 0;
    }
    if (!renderer) return;
    const auto works = [this](const std::optional<Error>& failed) {
        if (failed) fail(*failed);
        return !failed;
    };
    const glm::ivec2 size = pictureSize();
    if (size.x > 0 && (size.x != options.width || size.y != options.height)) {
        options.width = size.x;
        options.height = size.y;
        works(renderer->resize(size.x, size.y));
        stillFrames = 0;
    }
    if (requests.settings) {
        begin("Building pipelines", false);
        if (works(renderer->setSettings(*requests.settings))) options.settings = *requests.settings;
        freshFrames = 0;
    }
    if (requests.view) {
        if (works(renderer->setView(*requests.view, requests.viewRange))) options.view = *requests.view;
        freshFrames = 0;
    }
    if (requests.exposureEv100) renderer->setExposureEv100(*requests.exposureEv100);
    if (requests.lights) {
        scene = std::move(requests.lights->scene);
        version = requests.lights->version;
        renderer->setLights(scene);
    }
    if (requests.camera) {
        camera = requests.camera->camera;
        renderer->setCamera(camera, requests.camera->change);
    }
    // Jobs may render a frame of their own: what has just been taken over is no reason to give that up.
    interrupt = false;
    for (const Job& job : requests.jobs)
        job(*renderer);
    if (requests.jobs.empty()) return;
    {
        const std::lock_guard lock(mutex);
        jobsDone = true;
    }
    wake();
}

// Full resolution at rest; while something moves, what keeps a frame within its time.
double RenderThread::Impl::wantedScale() const {
    const double most = options.settings.renderScale;
    if (msPerPixel == 0.0) return std::min(limits.leastScale, most); // the first picture comes soon
    if (isResting()) return most;
    const double pixels = double(options.width) * double(options.height);
    const double fits = std::sqrt(limits.movingFrameMs / (msPerPixel * pixels));
    const double stepped = std::floor(fits * kScaleSteps) / kScaleSteps;
    return std::clamp(stepped, std::min(limits.leastScale, most), most);
}

void RenderThread::Impl::renderOne() {
    scale = wantedScale();
    renderer->setRenderScale(scale);
    if (freshFrames == 0 && activity.words.empty()) begin("Building pipelines", false);
    const double beginMs = steadyMs();
    // A frame that follows a movement must come to its end, however long it takes: given up for the next
    // movement, and the next, no picture would come. One at rest may be given up for the first of them. While
    // pipelines are built only another scene is a reason: begun anew they would take as long.
    const double expectedMs = msPerPixel * double(options.width) * double(options.height) * scale * scale;
    interrupt = false;
    canInterrupt = isResting() && expectedMs > limits.movingFrameMs && freshFrames > 0;
    {
        const std::lock_guard lock(mutex); // a change that came in between
        if (canInterrupt && pending.atMs > 0.0) interrupt = true;
    }
    const std::optional<Error> failed = renderer->renderFrame();
    canInterrupt = false;
    if (freshFrames == 0) end();
    if (failed) {
        // A device that has failed once does so for ever: the last picture stays.
        fail(*failed);
        renderer.reset();
        return;
    }
    if (renderer->wasInterrupted()) return;
    const double tookMs = steadyMs() - beginMs;
    const double pixels = double(options.width) * double(options.height) * scale * scale;
    if (++freshFrames > 1) {
        const double now = tookMs / pixels;
        // A pause of the machine, or a pipeline that was still missing, is no reason to stay coarse.
        msPerPixel = msPerPixel == 0.0 ? now : std::min(now, msPerPixel + 0.3 * (now - msPerPixel));
    }
    const bool full = scale == options.settings.renderScale;
    stillFrames = full ? stillFrames + 1 : 0;
    publish(beginMs);
}

void RenderThread::Impl::publish(double beginMs) {
    auto frame = std::make_shared<ShownFrame>();
    frame->number = ++frames;
    frame->camera = camera;
    frame->width = options.width;
    frame->height = options.height;
    frame->rgba8 = renderer->displayPixels();
    frame->documentVersion = version;
    frame->renderScale = scale;
    frame->requestedMs = std::exchange(requestedMs, 0.0);
    frame->meanFrames = renderer->meanFrames();
    frame->view = options.view;
    frame->statistics = renderer->statistics();
    frame->settled = settled();
    frame->frameMs = steadyMs() - beginMs;
    {
        const std::lock_guard lock(mutex);
        if (pending.open || pending.close) return; // of a scene that is no longer shown
        // A picture that nobody took answers its request all the same.
        if (finished && frame->requestedMs == 0.0) frame->requestedMs = finished->requestedMs;
        finished = std::move(frame);
    }
    wake();
}

void RenderThread::Impl::loop() {
    setpriority(PRIO_PROCESS, 0, getpriority(PRIO_PROCESS, 0) + kNiceness); // of this thread alone, on Linux
    std::unique_lock lock(mutex);
    while (!stopping) {
        condition.wait(lock,
                       [this] { return stopping || pending.any() || (renderer && !paused && !settled()); });
        if (stopping) break;
        Requests requests = std::exchange(pending, Requests{});
        const bool renders = !paused;
        lock.unlock();
        apply(std::move(requests));
        if (renderer && renders && !settled()) renderOne();
        lock.lock();
    }
    lock.unlock();
    renderer.reset();
}

// --- RenderThread ------------------------------------------------------------------------------------------

RenderThread::RenderThread(std::function<void()> wake) : impl_(std::make_unique<Impl>(std::move(wake))) {}

RenderThread::~RenderThread() {
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->stopping = true;
        impl_->giveUp();
    }
    impl_->condition.notify_one();
    impl_->thread.join();
}

void RenderThread::open(const Scene& scene, const RenderOptions& options, const Camera& camera,
                        std::uint64_t version) {
    impl_->request([&](Requests& r) {
        impl_->giveUp();
        r = r.ofNoScene();
        r.open = OpenRequest{scene, options, camera, version};
        impl_->finished.reset();
    });
}

void RenderThread::close() {
    impl_->request([&](Requests& r) {
        impl_->giveUp();
        r = r.ofNoScene();
        r.close = true;
        impl_->finished.reset();
    });
}

void RenderThread::setCamera(const Camera& camera, Renderer::CameraChange change) {
    impl_->request([&](Requests& r) {
        const bool cut = r.camera && r.camera->change == Renderer::CameraChange::Cut;
        r.camera = CameraRequest{camera, cut ? Renderer::CameraChange::Cut : change};
    });
}

void RenderThread::setLights(const Scene& edited, std::uint64_t version) {
    impl_->request([&](Requests& r) { r.lights = LightsRequest{edited, version}; });
}

void RenderThread::setExposureEv100(double ev100) {
    impl_->request([&](Requests& r) { r.exposureEv100 = ev100; });
}

void RenderThread::setSettings(const Settings& settings) {
    impl_->request([&](Requests& r) { r.settings = settings; });
}

void RenderThread::setView(std::string view, const std::optional<ViewRange>& range) {
    impl_->request([&](Requests& r) {
        r.view = std::move(view);
        r.viewRange = range;
    });
}

void RenderThread::setSize(glm::ivec2 sizePx) {
    impl_->request([&](Requests& r) { r.size = sizePx; }, false);
}

void RenderThread::setLimits(const RenderLimits& limits) {
    impl_->request([&](Requests& r) { r.limits = limits; });
}

void RenderThread::setInputTime(double ms) {
    const std::lock_guard lock(impl_->mutex);
    impl_->inputMs = ms;
}

void RenderThread::setPaused(bool paused) {
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->paused = paused;
    }
    impl_->condition.notify_one();
}

void RenderThread::post(Job job) {
    impl_->request([&](Requests& r) { r.jobs.push_back(std::move(job)); }, false);
}

std::shared_ptr<const ShownFrame> RenderThread::takeFrame() {
    const std::lock_guard lock(impl_->mutex);
    impl_->jobsDone = false;
    return std::exchange(impl_->finished, nullptr);
}

bool RenderThread::hasNews() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->finished || impl_->error || impl_->jobsDone;
}

std::optional<Error> RenderThread::takeError() {
    const std::lock_guard lock(impl_->mutex);
    return std::exchange(impl_->error, std::nullopt);
}

RenderThread::Activity RenderThread::activity() const {
    const std::lock_guard lock(impl_->mutex);
    Activity activity = impl_->activity;
    if (activity.words.empty()) return activity;
    activity.words = impl_->watch->doing();
    activity.share = impl_->watch->share();
    return activity;
}

} // namespace kilolux
