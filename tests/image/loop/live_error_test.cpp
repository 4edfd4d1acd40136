// The live reference: it renders on its own, follows another view, and what it measures is the error.
#include "tests/image/loop/loop_kit.h"

#include "ui/live_reference.h"

#include <thread>

namespace kilolux::test {
namespace {

// Until the condition holds; the limit only ends a test that would hang.
LiveReference::State waitFor(const LiveReference& live,
                             const std::function<bool(const LiveReference::State&)>& holds) {
    for (int i = 0; i < 20000; ++i) {
        const LiveReference::State state = live.state();
        if (holds(state)) return state;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ADD_FAILURE() << "nothing came";
    return live.state();
}

TEST(LiveError, MeasuresAgainstTheMeanOfAReference) {
    const Scene scene = crowdScene(6, 11);
    RenderOptions options = loopOptions(32, 24);
    options.method = "split";
    const Result<std::unique_ptr<Renderer>> own = Renderer::create(scene, options);
    ASSERT_TRUE(own) << own.error();
    Renderer& renderer = *own.value();
    renderer.setCamera(scene.cameras[0], Renderer::CameraChange::Cut);
    for (int frame = 0; frame < 8; ++frame)
        ASSERT_FALSE(renderer.renderFrame());
    const auto good = std::make_shared<const Picture>(renderer.picture());
    auto black = std::make_shared<Picture>(*good);
    std::fill(black->rgb.begin(), black->rgb.end(), 0.0f);
    std::fill(black->srgb8.begin(), black->srgb8.end(), std::uint8_t(0));

    LiveReference live([] {});
    const double ev100 = renderer.statistics().exposureEv100;
    live.begin({scene, options, scene.cameras[0], ev100, 7});
    waitFor(live, [](const auto& s) { return s.key == 7 && s.frames >= 8; });
    live.compare(good, 7);
    const auto near = waitFor(live, [](const auto& s) { return bool(s.report); }).report;
    ASSERT_TRUE(near);
    EXPECT_GE(near->frames, 8u);
    EXPECT_LT(near->relativeMse, 0.05);
    EXPECT_LT(near->flipMean, 0.05);
    live.compare(black, 7);
    const auto far = waitFor(live, [&](const auto& s) { return s.report && s.report != near; }).report;
    EXPECT_GT(far->relativeMse, 0.7);
    EXPECT_GT(far->flipMean, 4.0 * near->flipMean);

    // Another view begins anew; a picture of the old one is not measured against it.
    Scene darker = scene;
    for (LightDef& def : darker.lightDefs.write())
        def.intensity *= 0.25;
    live.begin({darker, options, scene.cameras[0], ev100, 8});
    live.compare(good, 7);
    waitFor(live, [](const auto& s) { return s.key == 8 && s.frames >= 8; });
    EXPECT_FALSE(live.state().report);
    live.compare(good, 8);
    const auto other = waitFor(live, [](const auto& s) { return bool(s.report); }).report;
    EXPECT_GT(other->relativeMse, 1.0) << "four times too bright";

    live.setResting(true);
    live.stop();
    waitFor(live, [](const auto& s) { return s.key == 0 && s.frames == 0; });
}

} // namespace
} // namespace kilolux::test
