#include "ui/live_reference.h"

#include "renderer/document/task_watch.h"
#include "renderer/measure/flip.h"
#include "renderer/measure/metrics.h"

#include <condition_variable>
#include <mutex>
#include <sys/resource.h>
#include <thread>

namespace kilolux {

namespace {

constexpr int kLowestPriority = 19;
constexpr double kSliceMs = 15.0; // between two of which a frame can be given up

std::vector<float> unitValues(const std::vector<std::uint8_t>& bytes) {
    std::vector<float> values;
    values.reserve(bytes.size());
    for (const std::uint8_t byte : bytes)
        values.push_back(float(byte) / 255.0f);
    return values;
}

// The same meshes in the same nodes: only what setLights() takes over may differ.
bool sharesGeometry(const Scene& a, const Scene& b) {
    return a.meshes == b.meshes && a.images == b.images && a.nodes.size() == b.nodes.size();
}

} // namespace

ErrorReport measureError(const Picture& reference, const Picture& shown) {
    ErrorReport report;
    report.width = shown.width;
    report.height = shown.height;
    const measure::ImageView truth{reference.width, reference.height, reference.rgb};
    const measure::ImageView tested{shown.width, shown.height, shown.rgb};
    double sum = 0.0;
    for (const float value : reference.rgb)
        sum += double(value);
    const double mean = reference.rgb.empty() ? 0.0 : sum / double(reference.rgb.size());
    report.relativeMse =
        measure::relativeMeanSquaredError(truth, tested, std::max(0.01 * mean * mean, 1e-12));
    const std::vector<float> truthSrgb = unitValues(reference.srgb8), testedSrgb = unitValues(shown.srgb8);
    measure::FlipResult flip = measure::flip({reference.width, reference.height, truthSrgb},
                                             {shown.width, shown.height, testedSrgb});
    report.flipMean = flip.mean;
    report.flip95 = flip.percentile95;
    report.flip = std::move(flip.map);
    report.reference = reference.srgb8;
    return report;
}

struct LiveReference::Impl {
    explicit Impl(std::function<void()> wakeUi) : wake(std::move(wakeUi)) {
        thread = std::thread([this] { loop(); });
    }

    // --- shared, under the mutex
    mutable std::mutex mutex;
    std::condition_variable condition;
    std::optional<ReferenceView> wanted;
    std::shared_ptr<const Picture> shown;
    std::uint64_t shownKey = 0;
    MeasuredPicture shownIs;
    bool resting = false, stopping = false, givenUp = false;
    State state;
    TaskWatch watch; // of what is prepared
    std::atomic<bool> interrupt = false;

    // --- of the thread
    std::function<void()> wake;
    std::unique_ptr<Renderer> renderer;
    Scene scene;
    RenderOptions options;
    std::thread thread;

    void loop();
    // Under the mutex: nobody waits any more for what the thread does.
    void giveUp() {
        interrupt = true;
        watch.cancel();
    }
    void prepare(ReferenceView view);
    void renderOne();
    void measure(const Picture& picture, std::uint64_t key, MeasuredPicture of);
    template<typename Change>
    void tell(Change change) {
        {
            const std::lock_guard lock(mutex);
            change(state);
        }
        wake();
    }
};

void LiveReference::Impl::prepare(ReferenceView view) {
    const bool same = renderer && sharesGeometry(scene, view.scene) && options.width == view.options.width &&
                      options.height == view.options.height && options.method == view.options.method &&
                      options.settings == view.options.settings;
    tell([&](State& s) {
        s = State{};
        s.key = view.key;
        s.preparing = "Preparing";
        interrupt = false;
        watch.rearm();
        if (stopping || givenUp || wanted) giveUp(); // since it was taken
    });
    scene = std::move(view.scene);
    options = std::move(view.options);
    std::string problem;
    if (!same) {
        renderer.reset();
        options.watch = &watch;
        options.interrupt = &interrupt;
        options.sliceMs = kSliceMs;
        Result<std::unique_ptr<Renderer>> created = Renderer::create(scene, options);
        if (created) {
            renderer = std::move(created.value());
        } else if (!watch.isCancelled()) {
            problem = created.error();
        }
    }
    if (renderer) {
        renderer->setLights(scene);
        renderer->setExposureEv100(view.exposureEv100);
        renderer->setCamera(view.camera, Renderer::CameraChange::Cut);
    }
    tell([&](State& s) {
        s.preparing.clear();
        s.problem = problem;
    });
}

void LiveReference::Impl::renderOne() {
    const std::optional<Error> failed = renderer->renderFrame();
    if (renderer->wasInterrupted()) return;
    if (failed) renderer.reset();
    const std::uint32_t frames = renderer ? renderer->meanFrames() : 0;
    tell([&](State& s) {
        s.frames = frames;
        if (failed) s.problem = failed->message;
    });
}

void LiveReference::Impl::measure(const Picture& picture, std::uint64_t key, MeasuredPicture of) {
    const Picture reference = renderer->picture();
    if (reference.width != picture.width || reference.height != picture.height) return;
    auto report = std::make_shared<ErrorReport>(measureError(reference, picture));
    report->key = key;
    report->of = std::move(of);
    report->frames = renderer->meanFrames();
    tell([&](State& s) { s.report = std::move(report); });
}

void LiveReference::Impl::loop() {
    // Threads that the device starts inherit it: on software drivers the reference takes only what is idle.
    setpriority(PRIO_PROCESS, 0, kLowestPriority);
    std::unique_lock lock(mutex);
    while (true) {
        condition.wait(lock, [this] {
            const bool renders = renderer && !resting && state.frames < kMostFrames;
            return stopping || givenUp || wanted || shown || renders;
        });
        if (stopping) break;
        if (std::exchange(givenUp, false)) {
            lock.unlock();
            renderer.reset();
            tell([](State& s) { s = State{}; });
            lock.lock();
            continue;
        }
        std::optional<ReferenceView> view = std::exchange(wanted, std::nullopt);
        std::shared_ptr<const Picture> picture = view ? nullptr : std::exchange(shown, nullptr);
        const bool measures = picture && renderer && shownKey == state.key && state.frames > 0;
        const std::uint64_t key = shownKey;
        MeasuredPicture of = shownIs;
        const bool renders = !resting && state.frames < kMostFrames;
        lock.unlock();
        if (view) prepare(std::move(*view));
        if (measures) measure(*picture, key, std::move(of));
        if (!view && renderer && renders) renderOne();
        lock.lock();
    }
    lock.unlock();
    renderer.reset();
}

LiveReference::LiveReference(std::function<void()> wake) : impl_(std::make_unique<Impl>(std::move(wake))) {}

LiveReference::~LiveReference() {
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->stopping = true;
        impl_->giveUp();
    }
    impl_->condition.notify_one();
    impl_->thread.join();
}

void LiveReference::begin(ReferenceView view) {
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->giveUp();
        impl_->wanted = std::move(view);
        impl_->shown.reset();
    }
    impl_->condition.notify_one();
}

void LiveReference::stop() {
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->giveUp();
        impl_->wanted.reset();
        impl_->shown.reset();
        impl_->givenUp = true;
    }
    impl_->condition.notify_one();
}

void LiveReference::setResting(bool resting) {
    {
        const std::lock_guard lock(impl_->mutex);
        if (impl_->resting == resting) return;
        impl_->resting = resting;
    }
    impl_->condition.notify_one();
}

void LiveReference::compare(std::shared_ptr<const Picture> shown, std::uint64_t key, MeasuredPicture of) {
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->shown = std::move(shown);
        impl_->shownKey = key;
        impl_->shownIs = std::move(of);
    }
    impl_->condition.notify_one();
}

LiveReference::State LiveReference::state() const {
    const std::lock_guard lock(impl_->mutex);
    State state = impl_->state;
    if (!state.preparing.empty()) {
        state.preparing = impl_->watch.doing();
        state.preparedShare = impl_->watch.share();
    }
    return state;
}

} // namespace kilolux
