// The dome in the stochastic method: its mean is that of 'split', its samples stay within their budget where
// local lights shine, and edits of it hold from the next frame on.
#include "tests/image/dome_scenes.h"
#include "tests/image/loop/loop_kit.h"

namespace kilolux::test {
namespace {

Scene domeCrowd(int lights) {
    Scene scene = crowdScene(lights, 5);
    scene.dome.image = panorama(128, sunnySky);
    scene.dome.intensityNit = 20.0;
    scene.dome.visible = false;
    return scene;
}

TEST(DomeMeans, AreThoseOfSplit) {
    const Scene scene = domeCrowd(8);
    const Replicas reference = splitReference(scene, loopOptions(64, 48));
    for (const char* setting : {"sampling=full", "sampling=rooks", "raysPerPixel=4", "domeBudget=0.1"}) {
        Loop loop(scene, loopOptions(64, 48, {setting}));
        expectSameMean(gather(framesOf(loop)), reference, std::string("dome, ") + setting);
    }
}

TEST(DomeMeans, AloneItIsThatOfSplit) {
    const Scene scene = domeCrowd(0);
    Loop loop(scene, loopOptions(64, 48));
    expectSameMean(gather(framesOf(loop)), splitReference(scene, loopOptions(64, 48)), "dome alone");
}

// Share of the chosen samples that go to the dome.
double domeShare(const Scene& scene, const std::vector<std::string>& settings) {
    constexpr std::uint32_t kDomeList = 3;
    RenderOptions options = loopOptions(64, 48, settings);
    options.keepTargets = true;
    Loop loop(scene, options);
    loop.frames(3);
    double chosen = 0.0, dome = 0.0;
    for (int frame = 0; frame < 6; ++frame) {
        loop.frames(1);
        for (const PixelSample& sample : samplesOf(loop.targets())) {
            if (!(sample.contribution > 0.0f)) continue;
            chosen += 1.0;
            dome += sample.list == kDomeList;
        }
    }
    EXPECT_GT(chosen, 1000.0);
    return dome / chosen;
}

// Lamps that shine on all of a floor, under a dome that is far stronger.
Scene lampScene() {
    SceneBuilder b;
    b.quad(floorAt({0, 0, 0}), 8, 8, b.material({0.6, 0.6, 0.6}, 0.0, 0.9));
    for (int i = 0; i < 4; ++i) {
        LightDef lamp = lightDef(LightType::Sphere, 5000.0, LightUnit::Candela);
        lamp.radiusM = 0.1;
        lamp.rangeM = 50.0;
        b.light(lamp, lookingAlong({i - 1.5, 2.4, 0.5 * i - 1.0}, {0, -1, 0}));
    }
    b.scene.cameras.push_back(cameraLooking({0.3, 2.0, 3.6}, {0, 0.0, -0.4}));
    b.scene.dome.image = panorama(128, sunnySky);
    b.scene.dome.intensityNit = 1e6;
    return withIds(std::move(b.scene));
}

TEST(DomeBudget, LocalLightsKeepTheirShare) {
    const Scene scene = lampScene();
    EXPECT_NEAR(domeShare(scene, {}), 0.5, 0.02);
    EXPECT_NEAR(domeShare(scene, {"domeBudget=0.2"}), 0.2, 0.02);
    EXPECT_EQ(domeShare(domeCrowd(0), {}), 1.0) << "nobody else wants samples";
}

TEST(DomeEdits, HoldFromTheNextFrameOn) {
    Scene before = domeCrowd(4);
    for (LightDef& def : before.lightDefs.write())
        def.color = {0.0, 1.0, 0.0};
    before.dome.color = {1.0, 0.0, 0.0};
    const RenderOptions options = loopOptions(64, 48, {"raysPerPixel=4"});
    const auto meanOf = [&](const Scene& scene) { return splitReference(scene, options); };
    struct Change {
        const char* name;
        std::function<void(Dome&)> apply;
    };
    const Change changes[] = {
        {"intensity", [](Dome& dome) { dome.intensityNit *= 3.0; }},
        {"colour",
         [](Dome& dome) {
             dome.color = {0.4, 0.0, 0.6};
         }},
        {"rotation", [](Dome& dome) { dome.rotationRad = 2.5; }},
        {"picture", [](Dome& dome) { dome.image = panorama(64, gradientSky); }},
        {"no picture", [](Dome& dome) { dome.image = nullptr; }},
    };
    for (const Change& change : changes) {
        Scene after = before;
        change.apply(after.dome);
        Loop loop(before, options);
        loop.frames(4);
        const auto replica = [&] {
            loop.renderer().setLights(before);
            loop.frames(1);
            loop.renderer().setLights(after);
            return lightOf(loop.next());
        };
        expectSameMean(gather(replica, 0.002, 120), meanOf(after), change.name, 0.01);
    }
    Scene off = before;
    off.dome.intensityNit = 0.0;
    Loop loop(before, options);
    loop.frames(4);
    EXPECT_GT(lightOf(loop.next()).values[Light::Red], 0.0);
    loop.renderer().setLights(off);
    for (int frame = 0; frame < 2; ++frame)
        EXPECT_EQ(lightOf(loop.next()).values[Light::Red], 0.0);
    loop.renderer().setLights(before);
    EXPECT_GT(lightOf(loop.next()).values[Light::Red], 0.0);
}

} // namespace
} // namespace kilolux::test
