// The filtered picture after a change, in frames, and what makes it fast: the fresh list and the exposure
// ratio.
#include "tests/image/motion/motion_kit.h"
#include "tests/image/motion/step_response.h"

#include <fmt/format.h>

namespace kilolux::test {
namespace {

TEST(StepResponse, InFrames) {
    const std::vector<StepResponse> responses = measureStepResponses({});
    fmt::print("{}", stepTable(responses));
    for (const StepResponse& r : responses) {
        SCOPED_TRACE(r.name);
        EXPECT_GT(r.region, 0.2) << "of the picture changes";
        if (r.name == "cut") EXPECT_LE(r.error.at(0), 0.05) << "no history, no lag";
        if (r.name == "+10 EV")
            EXPECT_LE(r.error.at(7), 0.02) << "lights are dim now: other noise, same light";
        if (r.rest.empty()) continue;
        EXPECT_LE(r.rest.at(0), 0.55) << "in the very next frame";
        EXPECT_LE(r.rest.at(3), 0.13) << "after four frames";
        EXPECT_LE(r.rest.at(7), 0.05) << "after eight frames";
        EXPECT_LE(r.rest.at(23), 0.03) << "after twenty-four frames";
    }
}

// A light that was just edited is a candidate of every pixel in its range, in the very next frame.
TEST(StepResponse, FreshLightsAreSampledAtOnce) {
    SceneBuilder b = bareFloor();
    for (int i = 0; i < 60; ++i) { // a crowd, so that the grid alone would find it rarely
        LightDef def = lightDef(LightType::Sphere, 4.0, LightUnit::Candela);
        def.rangeM = 40.0;
        b.light(def, glm::translate(glm::dmat4(1.0), glm::dvec3(0.2 * (i - 30), 5.0, 0.1 * (i % 7))));
    }
    LightDef strong = lightDef(LightType::Sphere, 1000.0, LightUnit::Candela);
    strong.rangeM = 40.0;
    b.light(strong, glm::translate(glm::dmat4(1.0), glm::dvec3(1.0, 5.0, 0)));
    b.scene.cameras = {orthographicCamera({0, 4, 0}, {0, -1, 0}, 0.1, 32)};
    for (std::size_t i = 0; i < 61; ++i)
        b.scene.lights[i].id = i + 1;
    const auto sampledShare = [&](const FrameTargets& targets, std::uint32_t slot) {
        int sampled = 0;
        for (std::size_t i = 0; i < targets.pixels(); ++i) {
            const std::uint32_t word = wordAt(targets, "samples", i, 0, 4);
            sampled += (word & 0xffffu) == slot && (word >> 16 & 3u) == 0u; // LIST_VISIBLE
        }
        return double(sampled) / double(targets.pixels());
    };
    Scene off = b.scene;
    off.lights.write()[60].muted = true;
    FrameRig rig(off, stochasticOptions(48, 32));
    rig.frames(10);
    const std::uint32_t slot = rig.renderer().lightSlot(61);
    EXPECT_EQ(sampledShare(rig.frame(), slot), 0.0);
    rig.renderer().setLights(b.scene);
    EXPECT_GT(sampledShare(rig.frame(), slot), 0.3) << "switched on";

    Scene without = b.scene;
    without.lights.write().pop_back();
    FrameRig added(without, stochasticOptions(48, 32));
    added.frames(10);
    added.renderer().setLights(b.scene);
    const FrameTargets next = added.frame();
    EXPECT_GT(sampledShare(next, added.renderer().lightSlot(61)), 0.3) << "new";

    Scene moved = b.scene;
    Node& node = moved.nodes.write()[std::size_t(moved.lights[60].node)];
    node.worldFromNode[3].x = node.localFromNode[3].x = -1.5;
    added.frames(12);
    added.renderer().setLights(moved);
    EXPECT_GT(sampledShare(added.frame(), added.renderer().lightSlot(61)), 0.3) << "moved";
}

TEST(Exposure, HistoryFollowsItsRatio) {
    const Scene scene = stageScene({lightCases()[0], lightCases()[4]});
    // Lights that fall under the threshold would be chosen by chance from then on: another noise, which the
    // filter takes for a change of light.
    for (const double stepEv : {10.0, -6.0, 0.5}) {
        FrameRig rig(
            scene, stochasticOptions(
                       64, 44, {"picture=denoised", "antiAlias=false", "exposureEv100=6", "dimLights=keep"}));
        rig.frames(40);
        const Picture before = rig.picture();
        rig.renderer().setExposureEv100(6.0 + stepEv);
        const FrameTargets targets = rig.frame();
        EXPECT_NEAR(meanLuminance(rig.picture()) / meanLuminance(before), 1.0, 0.06) << stepEv;
        EXPECT_LE(relativeDifference(rig.picture(), before), 0.15) << stepEv;
        double frames = 0.0, count = 0.0;
        for (std::size_t i = 0; i < targets.pixels(); ++i) {
            if (!targets.surface(i).seen) continue;
            frames += valueAt(targets, "historyDiffuse", i, 3);
            count += 1.0;
        }
        EXPECT_GT(frames / count, 12.0) << stepEv;
        EXPECT_EQ(rig.renderer().statistics().historyReset, "first frame");
    }
}

} // namespace
} // namespace kilolux::test
