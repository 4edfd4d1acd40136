// Area masks: whatever they hold, the mean stays; and rays go where the mask of the pixel's own tile says, as
// finely as light and samples allow.
#include "shaders/shared/gpu_light.h"
#include "shaders/shared/sampling.h"
#include "tests/image/loop/loop_kit.h"

#include <array>

namespace kilolux::test {
namespace {

using namespace shared;

using Texels = std::vector<glm::uvec2>;

constexpr int kWidth = 64, kHeight = 48;

// A light of 1 m, 1 m above the camera and 5 m above the floor that fills the picture: about as long as a
// tile.
SceneBuilder lightAboveFloor(LightType type = LightType::Rect) {
    SceneBuilder b;
    b.quad(floorAt({0, 0, 0}), 4, 4, b.material({0.6, 0.6, 0.6}, 0.0, 0.9));
    LightDef def = lightDef(type, 3000, LightUnit::Lumen);
    def.widthM = def.heightM = 1.0;
    def.lengthM = 1.0;
    def.radiusM = 0.02;
    def.rangeM = 20.0;
    b.light(def, lookingAlong({0, 5, 0}, {0, -1, 0}));
    b.scene.cameras.push_back(cameraLooking({0, 4, 0.01}, {0, 0, 0}));
    return b;
}

// The only light on every list, with what was seen of it by tile: cells and samples, as in shared/sampling.h.
Texels listsWith(Texels texels, const std::function<glm::uvec2(std::size_t tile)>& seen) {
    for (std::size_t tile = 0; tile < texels.size() / LIST_TEXELS; ++tile) {
        glm::uvec2* at = &texels[tile * LIST_TEXELS];
        at[0] = {1, 0};
        at[1] = {0, 1};
        at[LIST_CELLS_AT] = seen(tile);
    }
    return texels;
}

glm::uvec2 inBothWindows(std::uint32_t cells, std::uint32_t samples) {
    return {cells | cells << SEEN_OLDER_SHIFT, samples | samples << SEEN_OLDER_SHIFT};
}

using CellShares = std::array<double, 16>;

// Where the samples of the tiles that are `wanted` lie on the light.
CellShares cellShares(const FrameTargets& targets, const std::function<bool(std::size_t tile)>& wanted) {
    const std::vector<PixelSample> samples = samplesOf(targets);
    CellShares shares{};
    double all = 0.0;
    for (std::size_t pixel = 0; pixel < samples.size(); ++pixel) {
        const std::size_t x = pixel % kWidth, y = pixel / kWidth;
        const PixelSample& sample = samples[pixel];
        if (sample.contribution == 0.0f ||
            !wanted(y / LIST_TILE_PX * (kWidth / LIST_TILE_PX) + x / LIST_TILE_PX))
            continue;
        shares[(sample.uv & 0xffffu) / 0x4000u + 4u * (sample.uv >> 30)] += 1.0;
        all += 1.0;
    }
    EXPECT_GT(all, 1000.0);
    for (double& share : shares)
        share /= all;
    return shares;
}

// Of a frame after lists on which every tile has seen the same.
CellShares sharesAfter(const Scene& scene, glm::uvec2 seen, const std::vector<std::string>& settings) {
    RenderOptions options = loopOptions(kWidth, kHeight, settings);
    options.keepTargets = true;
    Loop loop(scene, options);
    loop.frames(1);
    loop.renderer().replaceVisibleLists(
        listsWith(loop.renderer().visibleLists(), [&](std::size_t) { return seen; }));
    loop.frames(1);
    return cellShares(loop.targets(), [](std::size_t) { return true; });
}

// A cell that was seen says nothing of the others at first: masks count from their second window of frames
// on.
TEST(Masks, OfLessThanAWindowAreNotBelieved) {
    const Scene scene = withIds(lightAboveFloor().scene);
    EXPECT_NEAR(sharesAfter(scene, {0x0001u, 1000}, {"maskSize=0.1"})[0], 0.0625, 0.02);
    EXPECT_NEAR(sharesAfter(scene, {0x00010001u, 1000}, {"maskSize=0.1"})[0], 0.625, 0.05);
}

// 4 x 4 cells of lights that are large beside a tile, quarters of others, none of small ones; and only with
// enough samples for each. Hidden quarters get 0.1.
TEST(Masks, FitTheLightAndItsSamples) {
    const Scene scene = withIds(lightAboveFloor().scene);
    struct Case {
        const char* maskSize;
        std::uint32_t samples; // of each window; 4 wanted for each cell
        double shareOfSeen, shareOfItsQuarter;
    };
    for (const Case& c : {Case{"maskSize=0.2", 60, 0.625, 0.7}, Case{"maskSize=1", 60, 0.175, 0.7},
                          Case{"maskSize=0.2", 25, 0.175, 0.7}, Case{"maskSize=0.2", 5, 0.0625, 0.25},
                          Case{"maskSize=4", 60, 0.0625, 0.25}}) {
        const CellShares shares = sharesAfter(scene, inBothWindows(0x0001u, c.samples), {c.maskSize});
        EXPECT_NEAR(shares[0], c.shareOfSeen, 0.04) << c.maskSize << ", " << c.samples;
        EXPECT_NEAR(shares[0] + shares[1] + shares[4] + shares[5], c.shareOfItsQuarter, 0.04)
            << c.maskSize << ", " << c.samples;
    }
}

// Around a tube nothing differs: the cells along it count, with a quarter of the samples.
TEST(Masks, OfTubesHaveColumns) {
    const Scene scene = withIds(lightAboveFloor(LightType::Tube).scene);
    const CellShares shares = sharesAfter(scene, inBothWindows(0x0002u, 10), {"maskSize=0.2"});
    EXPECT_NEAR(shares[1] + shares[5] + shares[9] + shares[13], 0.7, 0.04);
}

// Lists are drawn from the four tiles around, masks are not: what a neighbour does not see may light this
// one.
TEST(Masks, AreThoseOfTheOwnTile) {
    RenderOptions options = loopOptions(kWidth, kHeight, {"maskSize=0.2"});
    options.keepTargets = true;
    Loop loop(withIds(lightAboveFloor().scene), options);
    loop.frames(1);
    const auto isOdd = [](std::size_t tile) { return (tile + tile / (kWidth / LIST_TILE_PX)) % 2 == 1; };
    loop.renderer().replaceVisibleLists(listsWith(loop.renderer().visibleLists(), [&](std::size_t tile) {
        return inBothWindows(isOdd(tile) ? 0x8000u : 0x0001u, 100);
    }));
    loop.frames(1);
    const CellShares shares = cellShares(loop.targets(), isOdd);
    EXPECT_NEAR(shares[15], 0.625, 0.04);
    EXPECT_NEAR(shares[0], 0.025, 0.015);
}

// A board just under one half of a rectangle hides the same part from the whole floor, so that a mask whose
// density is wrong shows in the mean.
TEST(ListFuzz, AnyMaskOfAHalfHiddenLightKeepsTheMean) {
    SceneBuilder b = lightAboveFloor();
    b.quad(floorAt({0.25, 4.98, 0}), 0.5, 1.2, 0);
    b.quad(floorAt({-0.25, 4.98, -0.3}), 0.5, 0.3, 0);
    const Scene scene = withIds(std::move(b.scene));
    const RenderOptions options =
        loopOptions(kWidth, kHeight, {"raysPerPixel=4", "raysPerLight=16", "maskSize=0.2"});
    const Replicas reference = splitReference(scene, options);
    Loop loop(scene, options);
    loop.frames(1);
    for (const std::uint32_t mask : {0u, 0x33u, 0xccu, 0x3300u, 0xffu, 0x8241u}) {
        const Texels texels =
            listsWith(loop.renderer().visibleLists(), [&](std::size_t) { return inBothWindows(mask, 1000); });
        const auto replica = [&] {
            loop.renderer().replaceVisibleLists(texels);
            return lightOf(loop.next());
        };
        expectSameMean(gather(replica, 0.0011), reference, "mask " + std::to_string(mask));
    }
}

} // namespace
} // namespace kilolux::test
