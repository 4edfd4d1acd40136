// Lighting channels in the stochastic method: its mean is that of 'split', also at half resolution, where
// pixels of one mesh choose for those of another; and an edit of a mesh's channels holds from the next frame
// on.
#include "tests/image/loop/loop_kit.h"

namespace kilolux::test {
namespace {

// Floors, box and ball of the stage see different halves of the crowd.
Scene dividedCrowd() {
    Scene scene = crowdScene(16, 5);
    auto& nodes = scene.nodes.write();
    nodes[0].meshChannels = 1;
    nodes[1].meshChannels = 2;
    nodes[3].meshChannels = 2;
    nodes[4].meshChannels = 4;
    auto& defs = scene.lightDefs.write();
    for (std::size_t i = 0; i < defs.size(); ++i) {
        defs[i].channels = std::uint8_t(i % 3 == 0 ? 1 : i % 3 == 1 ? 6 : 3);
        defs[i].channelsCast = i % 2 == 0;
    }
    return scene;
}

TEST(Channels, MeanIsThatOfSplit) {
    const Scene scene = dividedCrowd();
    const Replicas reference = splitReference(scene, loopOptions(96, 64));
    for (const char* sampling : {"sampling=full", "sampling=rooks"}) {
        Loop loop(scene, loopOptions(96, 64, {sampling}));
        expectSameMean(gather(framesOf(loop)), reference, std::string("channels, ") + sampling);
    }
}

// A light that leaves a mesh out has no weight there: its ray would be a ray for nothing, and only noise.
TEST(Channels, NoSampleGoesToALightThatLeavesTheMeshOut) {
    const Scene scene = dividedCrowd();
    RenderOptions options = loopOptions(64, 48);
    options.keepTargets = true;
    Loop loop(scene, options);
    int chosen = 0, inVain = 0;
    for (int frame = 0; frame < 3; ++frame) {
        loop.frames(1);
        const FrameTargets targets = loop.targets();
        const std::vector<PixelSample> samples = samplesOf(targets);
        for (std::size_t pixel = 0; pixel < samples.size(); ++pixel) {
            const PixelSurface surface = targets.surface(pixel);
            if (!surface.seen || !(samples[pixel].contribution > 0.0f)) continue;
            const LightNode& light = scene.lights[samples[pixel].slot];
            const std::uint8_t ofMesh = scene.nodes[surface.instance].meshChannels;
            ++chosen;
            inVain += (scene.lightDefs[std::size_t(light.def)].channels & ofMesh) == 0;
        }
    }
    EXPECT_GT(chosen, 3000);
    EXPECT_EQ(inVain, 0);
}

TEST(Channels, EditOfAMeshHoldsFromTheNextFrameOn) {
    Scene before = dividedCrowd();
    for (LightDef& def : before.lightDefs.write())
        def.channels = 1;
    Scene after = before;
    for (Node& node : after.nodes.write())
        node.meshChannels = 2;
    Loop loop(before, loopOptions(64, 48));
    loop.frames(3);
    EXPECT_GT(lightOf(loop.next()).values[Light::Luminance], 0.0);
    loop.renderer().setLights(after);
    EXPECT_EQ(lightOf(loop.next()).values[Light::Luminance], 0.0);
    loop.renderer().setLights(before);
    EXPECT_GT(lightOf(loop.next()).values[Light::Luminance], 0.0);
}

} // namespace
} // namespace kilolux::test
