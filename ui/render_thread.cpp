// What others ask of the render thread, see render_thread.h. Each call puts a request down and wakes the
// loop.
#include "ui/render_thread_impl.h"

#include <chrono>
#include <utility>

namespace kilolux {

double steadyMs() {
    using namespace std::chrono;
    return duration<double, std::milli>(steady_clock::now().time_since_epoch()).count();
}

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
