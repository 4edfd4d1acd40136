// Frames that render a part of their targets: a changing internal resolution keeps the history, lists are
// found by uv, and a picture is the crop of a larger one where the design says so.
#include "tests/image/motion/motion_kit.h"

#include "shaders/shared/light_grid.h"
#include "shaders/shared/sampling.h"

namespace kilolux::test {
namespace {

TEST(RenderScale, HistoryGoesOn) {
    const Scene scene = stageScene({lightCases()[0], lightCases()[4], lightCases()[2]});
    for (const glm::ivec2 size : {glm::ivec2(96, 64), glm::ivec2(61, 43)}) {
        const RenderOptions options =
            stochasticOptions(size.x, size.y, {"picture=denoised", "antiAlias=false"});
        FrameRig still(scene, options), scaled(scene, options);
        still.frames(33);
        scaled.frames(24);
        scaled.renderer().setRenderScale(0.6);
        scaled.frames(3);
        const FrameTargets smaller = scaled.partialFrame();
        scaled.renderer().setRenderScale(1.0);
        scaled.frames(1);
        const Picture back = scaled.picture();
        scaled.frames(4);
        EXPECT_EQ(scaled.renderer().statistics().historyReset, "first frame");
        // Both share one target, whose unused part still holds the picture before.
        const int width = int(std::lround(0.6 * size.x)), height = int(std::lround(0.6 * size.y));
        int seen = 0, missed = 0, young = 0;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const std::size_t i = std::size_t(y * size.x + x);
                if (!smaller.surface(i).seen) continue;
                ++seen;
                missed += isMissed(smaller, i);
                young += valueAt(smaller, "historyDiffuse", i, 3) < 5.0f;
                for (int c = 0; c < 2; ++c)
                    EXPECT_EQ(valueAt(smaller, "motion", i, c), 0.0f) << "a still camera, pixel " << i;
            }
        }
        EXPECT_LE(missed, seen / 50) << "of " << seen;
        EXPECT_LE(young, seen / 25);
        const Picture reference = still.picture();
        EXPECT_LE(relativeDifference(back, reference), 0.10) << size.x;
        EXPECT_NEAR(meanLuminance(back) / meanLuminance(reference), 1.0, 0.03);
        EXPECT_LE(relativeDifference(scaled.picture(), reference), 0.08) << size.x;
    }
}

// The first frame after a change has no history of that size, yet it must not look like a first frame.
TEST(RenderScale, FirstFrameBackIsFarFromAFirstFrame) {
    const Scene scene = stageScene({lightCases()[0], lightCases()[4], lightCases()[2]});
    const RenderOptions options = stochasticOptions(96, 64, {"picture=denoised", "antiAlias=false"});
    FrameRig first(scene, options), scaled(scene, options), still(scene, options);
    first.frames(1);
    still.frames(40);
    scaled.frames(24);
    scaled.renderer().setRenderScale(0.6);
    scaled.frames(4);
    scaled.renderer().setRenderScale(1.0);
    scaled.frames(1);
    EXPECT_LT(relativeDifference(scaled.picture(), still.picture()),
              0.5 * relativeDifference(first.picture(), still.picture()));
}

TEST(RenderScale, ListsAreFoundByUv) {
    constexpr int kTilesX = 10, kTilesY = 8;
    SceneBuilder b = bareFloor();
    for (int i = 0; i < kTilesX * kTilesY; ++i) { // below the floor: only lists can name them
        LightDef def = lightDef(LightType::Sphere, 1.0, LightUnit::Candela);
        def.rangeM = 0.5;
        b.light(def, glm::translate(glm::dmat4(1.0), glm::dvec3(0.01 * i, -2.0, 0)));
    }
    b.scene.cameras = {orthographicCamera({0, 4, 0}, {0, -1, 0}, 0.1, 64)};
    FrameRig rig(b.scene, stochasticOptions(80, 64));
    rig.frames(2);
    glm::ivec2 before(80, 64);
    for (const double scale : {0.5, 0.7, 1.0, 0.3}) {
        const glm::ivec2 now = glm::ivec2(glm::round(glm::dvec2(80, 64) * scale));
        const glm::ivec2 tilesBefore = (before + 7) / 8, tiles = (now + 7) / 8;
        std::vector<glm::uvec2> lists = rig.renderer().visibleLists();
        for (int i = 0; i < tilesBefore.x * tilesBefore.y; ++i)
            setOneEntry(lists, std::size_t(i), std::uint32_t(i));
        rig.renderer().replaceVisibleLists(lists);
        rig.renderer().setRenderScale(scale);
        rig.frames(1);
        lists = rig.renderer().visibleLists();
        for (int y = 0; y < tiles.y; ++y) {
            for (int x = 0; x < tiles.x; ++x) {
                const glm::dvec2 middle =
                    glm::min(glm::dvec2(8 * x + 4, 8 * y + 4), glm::dvec2(now - 1)) + 0.5;
                const glm::ivec2 from(middle / glm::dvec2(now) * glm::dvec2(before) / 8.0);
                const std::vector<std::uint32_t> slots = slotsOfTile(lists, std::size_t(y * tiles.x + x));
                ASSERT_EQ(slots.size(), 1u) << x << ' ' << y << " at " << scale;
                EXPECT_EQ(slots[0], std::uint32_t(from.y * tilesBefore.x + from.x))
                    << x << ' ' << y << " at " << scale;
            }
        }
        before = now;
    }
}

// Without history nothing remembers that frames were smaller for a while.
TEST(RenderScale, WithoutHistoryTheSamePicture) {
    const Scene scene = stageScene(lightCases());
    RenderOptions options = smallOptions(61, 43, {"jitter=true"});
    options.method = "all-lights";
    FrameRig scaled(scene, options), never(scene, options);
    scaled.frames(1);
    scaled.renderer().setRenderScale(0.6);
    scaled.frames(1);
    scaled.renderer().setRenderScale(1.0);
    const FrameTargets a = scaled.frame();
    never.frames(2);
    const FrameTargets b = never.frame();
    for (const char* name : {"visibility", "gDepth", "gSurface", "gMaterial", "gEmissive", "pyramid",
                             "litDiffuse", "litSpecular", "sceneColor"})
        EXPECT_TRUE(a.named(name).texels == b.named(name).texels) << name;
    FrameRig other(scene, options);
    other.frames(3);
    scaled.renderer().setCamera(scene.cameras[0], Renderer::CameraChange::Cut);
    scaled.frames(1);
    EXPECT_FALSE(a.named("litDiffuse").texels == scaled.frame().named("litDiffuse").texels)
        << "frames differ";
}

// What fewer pixels show is what more of them show: the picture does not stretch with the rounding of its
// size.
TEST(RenderScale, RoundedSizesShowTheSameView) {
    const Scene scene = stageScene({lightCases()[0]});
    FrameRig rig(scene, stochasticOptions(45, 31));
    for (const double scale : {1.0, 0.6, 0.35, 0.1}) {
        rig.renderer().setRenderScale(scale);
        const FrameTargets targets = rig.partialFrame();
        const glm::ivec2 size = glm::max(glm::ivec2(glm::round(glm::dvec2(45, 31) * scale)), glm::ivec2(1));
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                for (int c = 0; c < 2; ++c)
                    EXPECT_EQ(valueAt(targets, "motion", std::size_t(y * 45 + x), c), 0.0f) << scale;
    }
}

struct Crop {
    std::string name;
    glm::ivec2 size; // of the crop; the whole is 128 x 96
    bool lightGrid;
};

class CropOfALargerPicture : public testing::TestWithParam<Crop> {};

// Pixels in each direction whose grid cell sees the same depths in the crop. The depth pyramid takes odd last
// rows and columns into its last texels, so the last cell of a size that is no multiple of cells may hold
// more lights.
glm::ivec2 pixelsOfEqualCells(glm::ivec2 size) {
    const int cell = int(shared::GRID_TILE_PX);
    return {(size.x / cell - (size.x % cell != 0)) * cell, (size.y / cell - (size.y % cell != 0)) * cell};
}

// Pixels, tiles, grid cells and noise are counted from the top left. The first frame reads nothing of the
// frame before, and with fewer lights than missCandidates every light of a cell is a candidate: each pixel is
// its own. In the second frame pixels depend on the lists of the tiles around, which must lie within the
// crop, and on the number of lights in their grid cell, which steers how many of them are evaluated.
TEST_P(CropOfALargerPicture, IsEqualWhereTheDesignSaysSo) {
    constexpr double kPixelM = 1.0 / 16.0; // exact in binary, as are the places below
    const glm::ivec2 whole(128, 96), part = GetParam().size;
    Scene scene = stageScene(lightCases());
    const auto twoFrames = [&](glm::ivec2 size) {
        const glm::dvec2 middle = glm::dvec2(-3.0, 3.0) + glm::dvec2(0.5, -0.5) * kPixelM * glm::dvec2(size);
        scene.cameras = {orthographicCamera({middle, 6.0}, {0, 0, -1}, kPixelM, size.y)};
        RenderOptions options = stochasticOptions(size.x, size.y, {"noise=blue", "exposureEv100=6"});
        options.settings.lightGrid = GetParam().lightGrid;
        FrameRig rig(scene, options);
        std::vector<FrameTargets> frames;
        frames.push_back(rig.frame());
        frames.push_back(rig.frame());
        return frames;
    };
    const std::vector<FrameTargets> large = twoFrames(whole), small = twoFrames(part);
    glm::ivec2 equalSecond = (part / 8 - 1) * 8 + 4;
    if (GetParam().lightGrid) equalSecond = glm::min(equalSecond, pixelsOfEqualCells(part));
    ASSERT_GT(equalSecond.x * equalSecond.y, 900);
    for (const char* name : {"gDepth", "gSurface", "samples", "rayResults", "litDiffuse", "litSpecular"}) {
        for (int frame = 0; frame < 2; ++frame) {
            const std::vector<std::byte>&a = large[std::size_t(frame)].named(name).texels,
                  &b = small[std::size_t(frame)].named(name).texels;
            const std::size_t bytes = a.size() / std::size_t(whole.x * whole.y);
            const glm::ivec2 size = frame == 0 ? part : equalSecond;
            int different = 0;
            for (int y = 0; y < size.y; ++y) {
                for (int x = 0; x < size.x; ++x) {
                    const std::byte* pixel = &a[std::size_t(y * whole.x + x) * bytes];
                    different += !std::equal(pixel, pixel + bytes, &b[std::size_t(y * part.x + x) * bytes]);
                }
            }
            EXPECT_EQ(different, 0) << name << " in frame " << frame + 1;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, CropOfALargerPicture,
                         testing::Values(Crop{"Odd", {77, 69}, true}, Crop{"OddTiles", {72, 72}, true},
                                         Crop{"Cells", {64, 64}, true},
                                         Crop{"OddWithoutGrid", {61, 43}, false}),
                         [](const auto& info) { return info.param.name; });

} // namespace
} // namespace kilolux::test
