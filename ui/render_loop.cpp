// The loop of the render thread: it takes over what has been asked for, renders, and hands pictures over.
#include "ui/render_thread_impl.h"

#include <algorithm>
#include <cmath>
#include <sys/resource.h>
#include <utility>

namespace kilolux {

namespace {

// The threads of a software device begin as the render thread is by then: below the UI's, so that a redraw is
// not kept waiting for its turn.
constexpr int kNiceness = 5;
constexpr double kScaleSteps = 16.0; // the internal resolution moves in steps, so that it does not flicker

// Of a picture on a software device unless the limits say otherwise: beyond it memory and time get out of
// hand.
constexpr std::uint32_t kMostSoftwarePixels = 1u << 20;

} // namespace

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
    frame->settings = options.settings;
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

} // namespace kilolux
