// Where the previous frame does not show a surface, a pixel weighs more lights of its cell and lets more of
// its rays go to those that the nearest tile's list does not name.
#include "shaders/shared/sampling.h"
#include "tests/image/loop/loop_kit.h"

namespace kilolux::test {
namespace {

using namespace shared;

constexpr int kLights = 20;
constexpr std::uint32_t kHiddenList = 1; // LIST_HIDDEN

Camera cameraOver(double x) {
    return cameraLooking({x, 2, 0.01}, {x, 0, 0}, 0.6);
}

// Equal lights far above a wide floor, which fills the picture: all of them in every cell.
Scene evenScene() {
    SceneBuilder b;
    b.quad(floorAt({0, 0, 0}), 20, 20, b.material({0.5, 0.5, 0.5}, 0.0, 1.0));
    for (int i = 0; i < kLights; ++i) {
        LightDef def = lightDef(LightType::Sphere, 1.0e6, LightUnit::Candela);
        def.rangeM = 500.0;
        b.light(def, lookingAlong({1e-3 * i, 50, 0}, {0, -1, 0}));
    }
    b.scene.cameras.push_back(cameraOver(0.0));
    return withIds(std::move(b.scene));
}

struct Seen {
    double missed = 0.0;      // share of the pixels
    double candidates = 0.0;  // per pixel
    double hiddenShare = 0.0; // of the samples
};

// Of the next frame, the list of every tile naming the first light only; `total` counts all frames so far.
Seen nextFrame(Loop& loop, Seen& total, int& frames) {
    std::vector<glm::uvec2> lists(loop.renderer().visibleLists().size());
    for (std::size_t first = 0; first < lists.size(); first += LIST_TEXELS)
        lists[first].x = 1;
    loop.renderer().replaceVisibleLists(lists);
    loop.frames(1);
    ++frames;
    const FrameStatistics& s = loop.renderer().statistics();
    Seen seen{s.missedShare * frames - total.missed, s.candidatesMean * frames - total.candidates};
    total.missed += seen.missed;
    total.candidates += seen.candidates;
    double samples = 0.0, hidden = 0.0;
    for (const PixelSample& sample : samplesOf(loop.targets())) {
        samples += sample.contribution > 0.0f;
        hidden += sample.contribution > 0.0f && sample.list == kHiddenList;
    }
    seen.hiddenShare = hidden / samples;
    return seen;
}

TEST(MissedPixels, WeighMoreLightsAndGiveHiddenOnesMore) {
    RenderOptions options = loopOptions(64, 48,
                                        {"cellCandidates=5", "missCandidates=20", "hiddenShare=0.1",
                                         "missHiddenShare=0.4", "hiddenRelaxedBelow=0", "dimLights=keep"});
    options.keepTargets = true;
    Loop loop(evenScene(), options);
    Seen total;
    int frames = 0;
    const Seen first = nextFrame(loop, total, frames);
    EXPECT_EQ(first.missed, 1.0);
    EXPECT_EQ(first.candidates, 20.0) << "nothing is known";
    EXPECT_EQ(first.hiddenShare, 1.0);

    const Seen still = nextFrame(loop, total, frames);
    EXPECT_NEAR(still.missed, 0.0, 1e-6);
    EXPECT_NEAR(still.candidates, 5.75, 0.1) << "every 4th of the cell, and the one on the list";
    EXPECT_NEAR(still.hiddenShare, 0.1, 0.03);

    // To a part of the floor that was not in the picture.
    loop.renderer().setCamera(cameraOver(3.0), Renderer::CameraChange::Move);
    const Seen moved = nextFrame(loop, total, frames);
    EXPECT_NEAR(moved.missed, 1.0, 1e-6);
    EXPECT_NEAR(moved.candidates, 20.0, 1e-4);
    EXPECT_NEAR(moved.hiddenShare, 0.4, 0.04) << "the nearest tile's list still counts";
}

} // namespace
} // namespace kilolux::test
