// What survives a moving camera: visible lists and filtered light are found where the surface was, what was
// not in the picture is known as missing, and only a cut or other settings begin anew.
#include "tests/image/motion/motion_kit.h"

#include "tests/unit/accel/scene_kit.h"

#include <bit>
#include <numbers>

namespace kilolux::test {
namespace {

constexpr double kPixelM = 0.125;

// A floor seen from above with one lamp, and `count` lights below it that nothing shows: whatever lists hold
// of them is what was carried.
Scene floorOverHiddenLights(int count) {
    SceneBuilder b = bareFloor();
    for (int i = 0; i < count; ++i) {
        LightDef def = lightDef(LightType::Sphere, 1.0, LightUnit::Candela);
        def.rangeM = 0.5;
        b.light(def, glm::translate(glm::dmat4(1.0), glm::dvec3(0.01 * i, -2.0, 0)));
    }
    LightDef lamp = lightDef(LightType::Sphere, 500.0, LightUnit::Candela);
    lamp.radiusM = 0.2;
    b.light(lamp, glm::translate(glm::dmat4(1.0), glm::dvec3(0.7, 2.0, 0.4)));
    return std::move(b.scene);
}

std::uint32_t hiddenEntry(const std::vector<glm::uvec2>& lists, std::size_t tile, std::uint32_t hidden) {
    for (const std::uint32_t slot : slotsOfTile(lists, tile))
        if (slot < hidden) return slot;
    return 0xffffffffu;
}

TEST(VisibleLists, FollowTheCameraByWholeTiles) {
    const glm::ivec2 tiles(8, 6);
    Scene scene = floorOverHiddenLights(tiles.x * tiles.y);
    const Camera camera = orthographicCamera({0, 4, 0}, {0, -1, 0}, kPixelM, 43);
    scene.cameras = {camera};
    for (const glm::ivec2 step : {glm::ivec2(2, 1), glm::ivec2(-3, 2), glm::ivec2(0, -1)}) {
        FrameRig rig(scene, stochasticOptions(61, 43)); // the last tiles are not whole
        rig.frames(2);
        std::vector<glm::uvec2> lists = rig.renderer().visibleLists();
        for (int i = 0; i < tiles.x * tiles.y; ++i)
            setOneEntry(lists, std::size_t(i), std::uint32_t(i));
        rig.renderer().replaceVisibleLists(lists);
        rig.renderer().setCamera(movedByPixels(camera, kPixelM, glm::dvec2(8 * step)),
                                 Renderer::CameraChange::Move);
        rig.frames(1);
        lists = rig.renderer().visibleLists();
        for (int y = 0; y < tiles.y; ++y) {
            for (int x = 0; x < tiles.x; ++x) {
                // What comes from beyond the border gets the nearest list.
                const glm::ivec2 from = glm::clamp(glm::ivec2(x, y) + step, glm::ivec2(0), tiles - 1);
                EXPECT_EQ(hiddenEntry(lists, std::size_t(y * tiles.x + x), 48),
                          std::uint32_t(from.y * tiles.x + from.x))
                    << x << ' ' << y << ", step " << step.x << ' ' << step.y;
            }
        }
    }
}

// Pixels choose among the lights of the list where their surface was: with a list per tile that names one
// light, samples from lists name the lights of the tiles around.
TEST(VisibleLists, ArePickedAroundThePreviousPlace) {
    constexpr int kLights = 48, kTilesX = 8, kTilesY = 6;
    SceneBuilder b = bareFloor();
    for (int i = 0; i < kLights; ++i) {
        LightDef def = lightDef(LightType::Sphere, 100.0, LightUnit::Candela);
        def.rangeM = 30.0;
        b.light(def, glm::translate(glm::dmat4(1.0), glm::dvec3(0.1 * (i - 24), 6.0, 0)));
    }
    const Camera camera = orthographicCamera({0, 4, 0}, {0, -1, 0}, kPixelM, 48);
    b.scene.cameras = {camera};
    FrameRig rig(b.scene, stochasticOptions(64, 48));
    rig.frames(2);
    std::vector<glm::uvec2> lists = rig.renderer().visibleLists();
    for (std::size_t i = 0; i < kLights; ++i)
        setOneEntry(lists, i, std::uint32_t(i));
    rig.renderer().replaceVisibleLists(lists);
    rig.renderer().setCamera(movedByPixels(camera, kPixelM, {11, -6}), Renderer::CameraChange::Move);
    const FrameTargets targets = rig.frame();
    int listed = 0, foreign = 0;
    for (std::size_t i = 0; i < targets.pixels(); ++i) {
        const std::uint32_t word = wordAt(targets, "samples", i, 0, 4);
        if ((word >> 16 & 3u) != 0u || valueAt(targets, "litDiffuse", i, 3) == 0.0f) continue; // LIST_VISIBLE
        ++listed;
        const int slot = int(word & 0xffffu);
        // In tiles; a list is that of one of the four nearest tile centres.
        const double x = (double(i % 64) + 0.5 + 11) / 8 - 0.5, y = (double(i / 64) + 0.5 - 6) / 8 - 0.5;
        const double offX = std::abs(std::clamp(x, 0.0, kTilesX - 1.0) - slot % kTilesX),
                     offY = std::abs(std::clamp(y, 0.0, kTilesY - 1.0) - slot / kTilesX);
        foreign += offX >= 1.0 || offY >= 1.0;
    }
    EXPECT_GT(listed, 1000);
    EXPECT_EQ(foreign, 0);
}

// A picture moved by whole pixels: its light, and how many frames it holds, moved along.
void expectHistoryAfterAMove(bool cpuFilters) {
    constexpr int kWidth = 64, kHeight = 48, kRight = 5, kDown = 3;
    Scene scene = stageScene({lightCases()[0], lightCases()[4]});
    const Camera camera = orthographicCamera({0, 2.5, 4}, {0, -0.5, -1}, 0.06, kHeight);
    scene.cameras = {camera};
    RenderOptions options = stochasticOptions(kWidth, kHeight, {"picture=denoised"});
    options.cpuFilters = cpuFilters;
    FrameRig rig(scene, options);
    rig.frames(11);
    const FrameTargets before = rig.frame();
    rig.renderer().setCamera(movedByPixels(camera, 0.06, {kRight, kDown}), Renderer::CameraChange::Move);
    const FrameTargets after = rig.frame();
    int inside = 0, missed = 0, lost = 0, outside = 0, found = 0;
    double apart = 0.0, apartUnmoved = 0.0, sum = 0.0;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const std::size_t i = std::size_t(y * kWidth + x);
            if (!after.surface(i).seen) continue;
            const double frames = valueAt(after, "historyDiffuse", i, 3);
            if (x + kRight >= kWidth || y + kDown >= kHeight) {
                ++outside;
                found += !isMissed(after, i) || frames > 1.0;
                continue;
            }
            ++inside;
            missed += isMissed(after, i);
            lost += frames < 4.0;
            const std::size_t from = std::size_t((y + kDown) * kWidth + x + kRight);
            const double now = luminanceOf(after.rgb("historyDiffuse", i));
            apart += std::abs(now - luminanceOf(before.rgb("historyDiffuse", from)));
            apartUnmoved += std::abs(now - luminanceOf(before.rgb("historyDiffuse", i)));
            sum += now;
        }
    }
    ASSERT_GT(inside, 1500);
    ASSERT_GT(outside, 300);
    EXPECT_LE(missed, inside / 50) << "of " << inside;
    EXPECT_LE(lost, inside / 30);
    EXPECT_EQ(found, 0) << "pixels that were not in the picture";
    EXPECT_LE(apart / sum, 0.12);
    EXPECT_GE(apartUnmoved, 2.0 * apart) << "the picture is too even for this test";
    EXPECT_EQ(rig.renderer().statistics().historyReset, "first frame");
}

TEST(History, FollowsTheCameraByWholePixels) {
    withFiltersOfAllDevices(expectHistoryAfterAMove);
}

// Stripes of light, six pixels wide, that go by by parts of a pixel: drawing history anew in every frame must
// not wash them out.
TEST(History, ShadowsOfAMovingPictureStaySharp) {
    constexpr int kWidth = 64, kHeight = 48, kFrames = 40;
    SceneBuilder b = bareFloor();
    for (int i = -20; i <= 20; ++i) {
        addPrimitive(b, makeBox({0.5 * 6.0 * kPixelM, 0.01, 8.0}), Shading::Flat,
                     glm::translate(glm::dmat4(1.0), glm::dvec3(12.0 * kPixelM * i, 3.0, 0.0)), 0);
    }
    b.light(lightDef(LightType::Directional, 100.0, LightUnit::Lux),
            glm::rotate(glm::dmat4(1.0), -std::numbers::pi / 2.0, glm::dvec3(1, 0, 0)));
    Camera camera = orthographicCamera({0, 2.5, 0}, {0, -1, -1.0e-3}, kPixelM, kHeight);
    b.scene.cameras = {camera};
    RenderOptions options = stochasticOptions(kWidth, kHeight, {"raysPerPixel=4", "spatialRadius=0"});
    FrameRig rig(b.scene, options);
    for (int i = 0; i < kFrames; ++i) {
        rig.frames(1);
        camera = movedByPixels(camera, kPixelM, {0.37, 0.23});
        rig.renderer().setCamera(camera, Renderer::CameraChange::Move);
    }
    const FrameTargets moving = rig.frame();
    b.scene.cameras = {camera};
    options.method = "split";
    const FrameTargets reference = FrameRig(b.scene, options).frame();
    // The share of the reference's contrast that is left: the slope of one picture over the other.
    double mean = 0.0, product = 0.0, square = 0.0, count = 0.0;
    std::vector<std::pair<double, double>> values;
    for (std::size_t i = 0; i < moving.pixels(); ++i) {
        if (valueAt(moving, "historyDiffuse", i, 3) < 8.0f) continue; // came in not long ago
        values.emplace_back(luminanceOf(moving.rgb("denoisedDiffuse", i)),
                            luminanceOf(reference.rgb("litDiffuse", i)));
        mean += values.back().second;
        count += 1.0;
    }
    ASSERT_GT(count, 1500.0);
    for (const auto& [shown, right] : values) {
        product += shown * (right - mean / count);
        square += (right - mean / count) * (right - mean / count);
    }
    std::printf("contrast of stripes that go by: %.3f of the reference's\n", product / square);
    EXPECT_GT(product / square, 0.68); // bilinear drawing leaves 0.56
    EXPECT_LT(product / square, 1.02);
}

// What a near box uncovers as the camera moves was not in the picture, though its place was: neither lists'
// misses nor filtered light take the box for the wall.
TEST(History, DisoccludedSurfacesBeginAnew) {
    SceneBuilder b;
    const int matt = b.material({0.6, 0.6, 0.6}, 0.0, 0.9);
    b.quad(lookingAlong({0, 0, -9}, {0, 0, -1}), 40, 20, matt);
    addPrimitive(b, makeBox({0.35, 0.35, 0.1}), Shading::Flat,
                 glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, -2)), matt);
    LightDef lamp = lightDef(LightType::Sphere, 2000.0, LightUnit::Candela);
    lamp.rangeM = 60.0;
    b.light(lamp, glm::translate(glm::dmat4(1.0), glm::dvec3(1, 3, 3)));
    Camera camera = cameraLooking({0, 0, 0}, {0, 0, -1});
    b.scene.cameras = {camera};
    FrameRig rig(b.scene, stochasticOptions(64, 48));
    rig.frames(8);
    camera.worldFromCamera[3].x = 0.3;
    rig.renderer().setCamera(camera, Renderer::CameraChange::Move);
    const FrameTargets targets = rig.frame();
    int uncovered = 0, taken = 0, known = 0, young = 0;
    for (int y = 1; y < 47; ++y) {
        for (int x = 1; x < 63; ++x) {
            const std::size_t i = std::size_t(y * 64 + x);
            const int fromX = int(std::floor(x + 0.5 + 64.0 * valueAt(targets, "motion", i, 0)));
            const double expectedM = valueAt(targets, "motion", i, 2);
            if (fromX < 1 || fromX > 62) continue;
            bool similar = false;
            for (int k = 0; k < 9; ++k) {
                const std::size_t from = std::size_t((y + k / 3 - 1) * 64 + fromX + k % 3 - 1);
                const float foundM = std::bit_cast<float>(wordAt(targets, "previousSurface", from, 0, 4));
                similar = similar || std::abs(foundM / expectedM - 1.0) < 0.3;
            }
            const float frames = valueAt(targets, "historyDiffuse", i, 3);
            if (similar) {
                ++known;
                young += frames < 4.0f;
                continue;
            }
            ++uncovered;
            taken += frames > 1.0f || !isMissed(targets, i);
        }
    }
    EXPECT_GT(uncovered, 60);
    EXPECT_EQ(taken, 0);
    EXPECT_GT(known, 1500);
    EXPECT_LE(young, known / 20);
}

// Dark bars go by in front of a patterned wall: where the pattern widens the box that history is clipped to,
// bars that passed must not darken what is shown of the wall.
TEST(AntiAlias, NothingIsLeftOfWhatPassed) {
    constexpr int kWidth = 64, kHeight = 48;
    constexpr double kCellM = 0.3, kDistanceM = 9.0;
    SceneBuilder b;
    const int bright = b.material({0.8, 0.8, 0.8}, 0.0, 1.0), dark = b.material({0.1, 0.1, 0.1}, 0.0, 1.0),
              black = b.material({0, 0, 0}, 0.0, 1.0);
    for (int i = 0; i < 40 * 24; ++i) {
        const glm::dvec3 place(kCellM * (i % 40 - 20), kCellM * (i / 40 - 12), -kDistanceM);
        b.quad(lookingAlong(place, {0, 0, -1}), kCellM, kCellM, (i % 40 + i / 40) % 2 == 0 ? bright : dark);
    }
    for (int i = -20; i <= 20; ++i) {
        addPrimitive(b, makeBox({0.05, 3.0, 0.03}), Shading::Flat,
                     glm::translate(glm::dmat4(1.0), glm::dvec3(0.6 * i, 0, -2)), black);
    }
    b.light(lightDef(LightType::Directional, 100.0, LightUnit::Lux), glm::dmat4(1.0));
    Camera camera = cameraLooking({-0.5, 0, 0}, {0, 0, -1});
    b.scene.cameras = {camera};
    RenderOptions options = stochasticOptions(kWidth, kHeight, {"picture=denoised", "raysPerPixel=4"});
    FrameRig rig(b.scene, options);
    for (int i = 0; i < 24; ++i) {
        rig.frames(1);
        camera.worldFromCamera[3].x += 0.043;
        rig.renderer().setCamera(camera, Renderer::CameraChange::Move);
    }
    const FrameTargets moving = rig.frame();
    // The light of the wall, bars' edges apart: what is shown over what the frame itself found.
    double shown = 0.0, found = 0.0;
    int count = 0;
    for (int y = 2; y < kHeight - 2; ++y) {
        for (int x = 2; x < kWidth - 2; ++x) {
            bool wall = true;
            for (int k = 0; k < 25; ++k) {
                const std::size_t at = std::size_t((y + k / 5 - 2) * kWidth + x + k % 5 - 2);
                wall = wall && valueAt(moving, "gDepth", at, 0) > 4.0f;
            }
            if (!wall) continue;
            const std::size_t i = std::size_t(y * kWidth + x);
            shown += luminanceOf(moving.rgb("antiAliased", i));
            found += luminanceOf(moving.rgb("sceneColor", i));
            ++count;
        }
    }
    ASSERT_GT(count, 500);
    std::printf("light behind bars that passed: %.4f of the wall's\n", shown / found);
    EXPECT_NEAR(shown / found, 1.0, 0.02);
}

double meanFramesHeld(const FrameTargets& targets) {
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < targets.pixels(); ++i) {
        if (!targets.surface(i).seen) continue;
        sum += valueAt(targets, "historyDiffuse", i, 3);
        count += 1.0;
    }
    return sum / count;
}

TEST(History, BeginsAnewOnCutsAndSettingsOnly) {
    Scene scene = stageScene({lightCases()[0]});
    const RenderOptions options = stochasticOptions(48, 32);
    FrameRig rig(scene, options);
    rig.frames(9);
    EXPECT_GT(meanFramesHeld(rig.frame()), 6.0);
    EXPECT_EQ(rig.renderer().statistics().historyReset, "first frame");

    Camera camera = scene.cameras[0];
    camera.worldFromCamera[3] += glm::dvec4(0.02, 0, 0, 0);
    rig.renderer().setCamera(camera, Renderer::CameraChange::Move);
    rig.renderer().setExposureEv100(3.0);
    rig.renderer().setRenderScale(0.75);
    scene.lights.write()[0].muted = true;
    rig.renderer().setLights(scene);
    rig.frames(1);
    EXPECT_EQ(rig.renderer().statistics().historyReset, "first frame") << "none of these is a cut";
    scene.lights.write()[0].muted = false;
    rig.renderer().setLights(scene);
    rig.renderer().setRenderScale(1.0);
    rig.frames(8);
    EXPECT_GT(meanFramesHeld(rig.frame()), 3.0);

    rig.renderer().setCamera(camera, Renderer::CameraChange::Cut);
    const FrameTargets cut = rig.frame();
    EXPECT_EQ(meanFramesHeld(cut), 0.25) << "what a first frame counts";
    EXPECT_EQ(rig.renderer().statistics().historyReset, "camera cut");
    for (std::size_t i = 0; i < cut.pixels(); ++i) {
        if (cut.surface(i).seen) EXPECT_TRUE(isMissed(cut, i)) << "pixel " << i;
    }

    rig.frames(5);
    Settings settings = options.settings;
    settings.diffuseFrames = 12.0;
    ASSERT_FALSE(rig.renderer().setSettings(settings));
    EXPECT_EQ(meanFramesHeld(rig.frame()), 0.25);
    EXPECT_EQ(rig.renderer().statistics().historyReset, "settings");
    rig.frames(2);
    EXPECT_GT(meanFramesHeld(rig.frame()), 1.9) << "and goes on";
}

// The ranges of lights follow the exposure, and nothing that was edited: history goes on growing.
TEST(History, ExposureStepsEditNoLight) {
    FrameRig rig(stageScene({lightCases()[0], lightCases()[2]}),
                 stochasticOptions(48, 32, {"exposureEv100=4"}));
    rig.frames(6);
    const double before = meanFramesHeld(rig.frame());
    rig.renderer().setExposureEv100(5.0);
    EXPECT_GT(meanFramesHeld(rig.frame()), before + 0.5);
}

TEST(History, ExposureFollowsChangedSettings) {
    const Scene scene = stageScene({lightCases()[0]});
    RenderOptions options = stochasticOptions(32, 24, {"exposureEv100=5"});
    FrameRig rig(scene, options);
    rig.frames(1);
    EXPECT_EQ(rig.renderer().statistics().exposureEv100, 5.0);
    rig.renderer().setExposureEv100(6.0);
    options.settings.diffuseFrames = 10.0;
    ASSERT_FALSE(rig.renderer().setSettings(options.settings));
    rig.frames(1);
    EXPECT_EQ(rig.renderer().statistics().exposureEv100, 6.0) << "settings that say nothing new of it";
    options.settings.exposureEv100.value = 7.0;
    ASSERT_FALSE(rig.renderer().setSettings(options.settings));
    rig.frames(1);
    EXPECT_EQ(rig.renderer().statistics().exposureEv100, 7.0);
}

} // namespace
} // namespace kilolux::test
