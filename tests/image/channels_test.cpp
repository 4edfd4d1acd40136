// Lighting channels in whole frames: a mesh that a light leaves out gets exactly nothing from it in every
// method, casts its shadow unless the light says otherwise, and everything else stays as it was.
#include "tests/image/oracle_kit.h"

#include "tests/image/image_scenes.h"

#include <algorithm>

namespace kilolux::test {
namespace {

constexpr std::uint32_t kBox = 3, kBall = 4; // nodes of the stage, and its instances

// A rectangle light of channel 1 over the stage, whose box is of channel 2.
Scene boxLeftOut(bool casts) {
    Scene scene = stageScene({lightCases()[4]});
    scene.lightDefs.write()[0].channelsCast = casts;
    scene.nodes.write()[kBox].meshChannels = 2;
    return scene;
}

glm::dvec3 lightAt(const Rendered& frame, std::size_t pixel) {
    return frame.targets.rgb("litDiffuse", pixel) + frame.targets.rgb("litSpecular", pixel);
}

RenderOptions optionsOf(const std::string& method, const std::vector<std::string>& settings = {}) {
    RenderOptions options = smallOptions(64, 48, settings);
    options.method = method;
    if (options.settings.exposureEv100.automatic) options.settings.exposureEv100 = {false, 6.0};
    return options;
}

bool isOn(const Rendered& frame, std::size_t pixel, std::uint32_t instance) {
    const PixelSurface s = frame.targets.surface(pixel);
    return s.seen && s.instance == instance;
}

struct Way {
    const char* method;
    std::vector<std::string> settings;
};

TEST(Channels, MeshLeftOutGetsExactlyNothing) {
    const Way ways[] = {{"all-lights", {}},
                        {"split", {}},
                        {"true", {}},
                        {"shadow-maps", {}},
                        {"stochastic", {"picture=raw"}},
                        {"stochastic", {"picture=raw", "sampling=rooks"}},
                        {"uniform", {"picture=raw"}},
                        {"resampling", {"picture=raw"}},
                        {"restir", {"picture=raw"}}};
    Scene all = boxLeftOut(true);
    all.nodes.write()[kBox].meshChannels = 3;
    for (const Way& way : ways) {
        RenderOptions options = optionsOf(way.method, way.settings);
        options.frames = 3;
        const Rendered out = renderScene(boxLeftOut(true), options), in = renderScene(all, options);
        double onBox = 0.0, onBoxBefore = 0.0, onBall = 0.0;
        for (std::size_t i = 0; i < out.targets.pixels(); ++i) {
            if (isOn(out, i, kBox)) {
                onBox += glm::length(lightAt(out, i));
                onBoxBefore += glm::length(lightAt(in, i));
            }
            if (isOn(out, i, kBall)) onBall += glm::length(lightAt(out, i));
        }
        EXPECT_EQ(onBox, 0.0) << way.method;
        EXPECT_GT(onBoxBefore, 0.0) << way.method;
        EXPECT_GT(onBall, 0.0) << way.method;
    }
}

// The features follow: nothing of them is on where every light reaches every mesh.
TEST(Channels, FeaturesFollowTheScene) {
    const auto has = [](const Rendered& frame, const char* name) {
        return std::count(frame.statistics.featuresOn.begin(), frame.statistics.featuresOn.end(), name) > 0;
    };
    Scene all = boxLeftOut(false);
    all.nodes.write()[kBox].meshChannels = 3;
    const RenderOptions options = optionsOf("all-lights");
    const Rendered none = renderScene(all, options), casting = renderScene(boxLeftOut(true), options),
                   through = renderScene(boxLeftOut(false), options);
    EXPECT_FALSE(has(none, "LightChannels") || has(none, "ChannelShadows"));
    EXPECT_TRUE(has(casting, "LightChannels") && !has(casting, "ChannelShadows"));
    EXPECT_TRUE(has(through, "LightChannels") && has(through, "ChannelShadows"));
}

// On all but the box: with its shadow the light is that of a box that is lit, without it that of no box.
void expectShadow(const std::string& tracer) {
    RenderOptions options = optionsOf("split", {"tracer=" + tracer, "raysPerLight=4"});
    Scene lit = boxLeftOut(true), gone = boxLeftOut(true);
    lit.nodes.write()[kBox].meshChannels = 3;
    gone.nodes.write()[kBox].visible = false;
    if (!Renderer::create(lit, options)) GTEST_SKIP() << "the device has no ray query";
    const Rendered casting = renderScene(boxLeftOut(true), options), of = renderScene(lit, options),
                   through = renderScene(boxLeftOut(false), options), without = renderScene(gone, options);
    int compared = 0, otherCasting = 0, otherThrough = 0, shadowed = 0;
    for (std::size_t i = 0; i < of.targets.pixels(); ++i) {
        if (!of.targets.surface(i).seen || isOn(of, i, kBox)) continue;
        const auto differs = [&](const Rendered& a, const Rendered& b) {
            return glm::length(lightAt(a, i) - lightAt(b, i)) > 1e-5 * glm::length(lightAt(b, i));
        };
        ++compared;
        otherCasting += differs(casting, of);
        otherThrough += differs(through, without);
        shadowed += differs(casting, through);
    }
    EXPECT_GT(compared, 1000);
    EXPECT_GT(shadowed, 50);
    EXPECT_EQ(otherCasting, 0);
    // Another tree, so that rays through an edge may go the other way.
    EXPECT_LE(otherThrough, 4);
}

TEST(Channels, MeshLeftOutCastsUnlessTheLightShinesThrough) {
    expectShadow("compute");
}

TEST(Channels, MeshLeftOutCastsUnlessTheLightShinesThroughByRayQuery) {
    expectShadow("rayQuery");
}

TEST(Channels, OracleAgrees) {
    for (const bool casts : {true, false}) {
        Scene scene = stageScene({lightCases()[1], lightCases()[4]});
        scene.lightDefs.write()[0].channels = 6;
        scene.lightDefs.write()[1].channels = 1;
        for (LightDef& def : scene.lightDefs.write())
            def.channelsCast = casts;
        scene.nodes.write()[kBox].meshChannels = 2;
        scene.nodes.write()[kBall].meshChannels = 5;
        for (const char* method : {"split", "true"}) {
            LightOptions options;
            options.method = method;
            const LightComparison comparison = compareLight(scene, options);
            std::printf("channels, %s, %s: ", method, casts ? "casting" : "shining through");
            std::cout << comparison << "\n";
            expectEquivalent(comparison);
        }
    }
}

} // namespace
} // namespace kilolux::test
