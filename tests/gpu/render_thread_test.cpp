// Frames that are given up between two slices, and the thread that shows the newest of what was asked for.
#include "renderer/document/gltf_import.h"
#include "ui/render_thread.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <thread>

namespace kilolux::test {
namespace {

Scene cornell() {
    setenv("KILOLUX_VALIDATION", "1", 1);
    Result<Scene> scene =
        importGltf(std::filesystem::path(KILOLUX_SOURCE_DIR) / "content" / "scenes" / "cornell.glb");
    if (!scene) throw std::runtime_error(scene.error());
    return std::move(scene.value());
}

RenderOptions smallOptions(PictureChoice picture) {
    RenderOptions options;
    options.width = 48;
    options.height = 32;
    options.settings.picture = picture;
    options.settings.exposureEv100 = {.automatic = false, .value = 5.0};
    return options;
}

// One step to the side a frame: history is reprojected, so that a lost one would show.
void stepAside(Renderer& renderer, const Camera& start, int frame) {
    Camera camera = start;
    camera.worldFromCamera[3].x += 0.01 * frame;
    renderer.setCamera(camera, Renderer::CameraChange::Move);
}

// Gives up frames after a share of what one takes and compares the others with those of a renderer that was
// never disturbed. How many were given up: a machine that became faster meanwhile ends a frame before its
// first slice.
int compareWithGivenUpFrames(const Scene& scene, double shareOfFrame) {
    const auto steady = Renderer::create(scene, smallOptions(PictureChoice::Denoised));
    EXPECT_TRUE(steady);
    for (int frame = 0; frame < 5; ++frame)
        EXPECT_FALSE(steady.value()->renderFrame());
    std::atomic<bool> interrupt = false;
    RenderOptions options = smallOptions(PictureChoice::Denoised);
    options.interrupt = &interrupt;
    options.sliceMs = std::max(shareOfFrame * steady.value()->statistics().frameMs, 0.001);
    const auto undisturbed = Renderer::create(scene, smallOptions(PictureChoice::Denoised));
    const auto stopped = Renderer::create(scene, options);
    EXPECT_TRUE(undisturbed && stopped);
    int givenUp = 0;
    for (int frame = 0; frame < 6; ++frame) {
        stepAside(*undisturbed.value(), scene.cameras[0], frame);
        stepAside(*stopped.value(), scene.cameras[0], frame);
        bool stands = false;
        if (frame == 3 || frame == 4) {
            interrupt = true;
            EXPECT_FALSE(stopped.value()->renderFrame());
            interrupt = false;
            stands = !stopped.value()->wasInterrupted();
            givenUp += !stands;
        }
        EXPECT_FALSE(undisturbed.value()->renderFrame());
        if (!stands) EXPECT_FALSE(stopped.value()->renderFrame());
        EXPECT_FALSE(stopped.value()->wasInterrupted());
        EXPECT_EQ(stopped.value()->displayPixels(), undisturbed.value()->displayPixels())
            << "frame " << frame << ", given up after " << shareOfFrame << " of a frame";
    }
    return givenUp;
}

TEST(InterruptedFrames, GoOnWithTheirHistory) {
    const Scene scene = cornell();
    EXPECT_EQ(compareWithGivenUpFrames(scene, 0.0), 2);
    for (const double shareOfFrame : {0.4, 0.8}) {
        int givenUp = 0;
        // Where clocks are wrong, passes seem longer than they are, and a frame ends before its first slice
        // does.
        for (double share = shareOfFrame; share > 1e-6 && givenUp == 0; share *= 0.25)
            givenUp = compareWithGivenUpFrames(scene, share);
        EXPECT_GT(givenUp, 0) << shareOfFrame << " of a frame";
    }
}

TEST(InterruptedFrames, BeginTheMeanAnew) {
    const Scene scene = cornell();
    std::atomic<bool> interrupt = false;
    RenderOptions options = smallOptions(PictureChoice::Mean);
    options.sliceMs = 0.001;
    options.interrupt = &interrupt;
    auto renderer = Renderer::create(scene, options);
    ASSERT_TRUE(renderer);
    for (int frame = 0; frame < 3; ++frame)
        ASSERT_FALSE(renderer.value()->renderFrame());
    EXPECT_EQ(renderer.value()->meanFrames(), 3u);
    interrupt = true;
    ASSERT_FALSE(renderer.value()->renderFrame());
    interrupt = false;
    ASSERT_FALSE(renderer.value()->renderFrame());
    EXPECT_EQ(renderer.value()->meanFrames(), 1u);
}

TEST(Resizing, PicturesOfAnotherSizeGoOn) {
    const Scene scene = cornell();
    RenderOptions options = smallOptions(PictureChoice::Viewport);
    options.settings.jitter = false;
    auto renderer = Renderer::create(scene, options);
    ASSERT_TRUE(renderer);
    ASSERT_FALSE(renderer.value()->renderFrame());
    for (const glm::ivec2& size : {glm::ivec2(81, 13), glm::ivec2(1, 1), glm::ivec2(48, 32)}) {
        ASSERT_FALSE(renderer.value()->resize(size.x, size.y));
        ASSERT_FALSE(renderer.value()->renderFrame());
        EXPECT_EQ(renderer.value()->displayPixels().size(), std::size_t(size.x) * std::size_t(size.y) * 4);
        // What shows no noise is that of a renderer of this size, byte for byte.
        RenderOptions same = options;
        same.width = size.x;
        same.height = size.y;
        same.view = "normal";
        auto fresh = Renderer::create(scene, same);
        ASSERT_TRUE(fresh);
        ASSERT_FALSE(fresh.value()->renderFrame());
        ASSERT_FALSE(renderer.value()->setView("normal"));
        ASSERT_FALSE(renderer.value()->renderFrame());
        EXPECT_EQ(renderer.value()->displayPixels(), fresh.value()->displayPixels()) << size.x;
        ASSERT_FALSE(renderer.value()->setView(""));
    }
    ASSERT_TRUE(renderer.value()->setView("no such view"));
    ASSERT_FALSE(renderer.value()->renderFrame()) << "a wrong view leaves the old one";
}

// --- the thread

class RenderThreadTest : public ::testing::Test {
  protected:
    // The first picture that fits; the limit only ends a test that would hang.
    std::shared_ptr<const ShownFrame> waitFor(const std::function<bool(const ShownFrame&)>& fits) {
        const double endMs = steadyMs() + 120e3;
        while (steadyMs() < endMs) {
            if (const auto frame = thread.takeFrame(); frame && fits(*frame)) return frame;
            if (const auto error = thread.takeError()) ADD_FAILURE() << error->message;
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        ADD_FAILURE() << "no such picture came";
        return std::make_shared<ShownFrame>();
    }
    static RenderLimits soonAtRest() {
        RenderLimits limits;
        limits.meanFrames = 3;
        limits.restMs = 1.0;
        return limits;
    }
    void open(const RenderLimits& limits = soonAtRest()) {
        thread.setLimits(limits);
        thread.setSize({48, 32});
        thread.open(scene, smallOptions(PictureChoice::Viewport), scene.cameras[0], 1);
    }

    Scene scene = cornell();
    std::atomic<int> wakes = 0;
    RenderThread thread{[this] { ++wakes; }};
};

TEST_F(RenderThreadTest, ShowsTheNewestOfEverythingAndSettles) {
    open();
    auto frame = waitFor([](const ShownFrame& f) { return f.settled; });
    EXPECT_EQ(frame->documentVersion, 1u);
    EXPECT_EQ(frame->width * frame->height * 4, int(frame->rgba8.size()));
    EXPECT_EQ(frame->renderScale, 1.0);
    const std::uint64_t number = frame->number;
    // Many changes in a row: what comes last is what is shown last.
    Camera camera = scene.cameras[0];
    for (int step = 1; step <= 20; ++step) {
        camera.worldFromCamera[3].x = 0.01 * step;
        thread.setCamera(camera, Renderer::CameraChange::Move);
        thread.setLights(scene, std::uint64_t(1 + step));
    }
    thread.setSize({30, 20});
    frame = waitFor([](const ShownFrame& f) { return f.settled && f.documentVersion == 21; });
    EXPECT_EQ(frame->camera.worldFromCamera[3].x, camera.worldFromCamera[3].x);
    EXPECT_EQ(frame->width, 30);
    EXPECT_GT(frame->number, number);
    EXPECT_GT(wakes, 0);
}

TEST_F(RenderThreadTest, LargeViewportsAreRenderedSmaller) {
    open();
    RenderLimits limits;
    limits.meanFrames = 1;
    limits.mostPixels = 600;
    thread.setLimits(limits);
    thread.setSize({400, 100});
    const auto frame = waitFor([](const ShownFrame& f) { return f.width < 60 && f.settled; });
    EXPECT_EQ(frame->width, 49);
    EXPECT_EQ(frame->height, 12);
}

TEST_F(RenderThreadTest, JobsRunBetweenFramesAndWrongViewsAreTold) {
    open();
    waitFor([](const ShownFrame& f) { return f.settled; });
    std::atomic<int> ran = 0;
    thread.post([&](Renderer& renderer) { ran = int(renderer.statistics().lights); });
    thread.setView("no such view");
    std::optional<Error> error;
    const double endMs = steadyMs() + 120e3;
    while (!error && steadyMs() < endMs) {
        error = thread.takeError();
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    ASSERT_TRUE(error);
    EXPECT_NE(error->message.find("no such view"), std::string::npos);
    thread.setView("");
    waitFor([](const ShownFrame& f) { return f.settled; });
    EXPECT_EQ(ran, int(scene.lights.size()));
}

TEST_F(RenderThreadTest, ClosingGivesUpWhatIsPreparedAndTheNextSceneComes) {
    const auto waitForWords = [&](bool some) {
        const double endMs = steadyMs() + 120e3;
        while (thread.activity().words.empty() == some && steadyMs() < endMs)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        return thread.activity().words.empty() != some;
    };
    open();
    ASSERT_TRUE(waitForWords(true));
    EXPECT_TRUE(thread.activity().opens);
    thread.close();
    ASSERT_TRUE(waitForWords(false));
    EXPECT_FALSE(thread.takeFrame());
    EXPECT_FALSE(thread.takeError()) << "who gives up needs not be told";
    open();
    waitFor([](const ShownFrame& f) { return f.settled; });
}

// Frames that take longer than a movement should, and movements that never end.
TEST_F(RenderThreadTest, ADragGetsItsPictures) {
    RenderLimits limits = soonAtRest();
    limits.movingFrameMs = 1e-3;
    limits.leastScale = 1.0;
    limits.sliceMs = 1e-3;
    limits.restMs = 1e6;
    open(limits);
    waitFor([](const ShownFrame& f) { return f.settled; });
    Camera camera = scene.cameras[0];
    int pictures = 0;
    for (const double endMs = steadyMs() + 60e3; pictures < 5 && steadyMs() < endMs;) {
        camera.worldFromCamera[3].x += 1e-4;
        thread.setCamera(camera, Renderer::CameraChange::Move);
        pictures += thread.takeFrame() ? 1 : 0;
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    EXPECT_EQ(pictures, 5);
}

TEST_F(RenderThreadTest, PausedItRendersNothing) {
    open();
    waitFor([](const ShownFrame& f) { return f.settled; });
    thread.setPaused(true);
    thread.setLights(scene, 7);
    std::atomic<bool> reached = false;
    thread.post([&](Renderer&) { reached = true; });
    const double endMs = steadyMs() + 120e3;
    while (!reached && steadyMs() < endMs)
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    EXPECT_FALSE(thread.takeFrame());
    thread.setPaused(false);
    waitFor([](const ShownFrame& f) { return f.documentVersion == 7; });
}

} // namespace
} // namespace kilolux::test
