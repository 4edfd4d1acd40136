// The motion target against cameras and transforms in double precision: where each surface point was in the
// previous picture, and how deep it lay there.
#include "tests/image/motion/motion_kit.h"

#include "renderer/camera.h"
#include "tests/unit/accel/scene_kit.h"

namespace kilolux::test {
namespace {

// A perspective or orthographic camera in double precision, by itself.
struct View {
    Camera camera;
    double aspect = 1.0;

    glm::dvec3 inCamera(const glm::dvec3& world) const {
        return glm::dvec3(glm::inverse(camera.worldFromCamera) * glm::dvec4(world, 1.0));
    }
    double depthM(const glm::dvec3& world) const { return -inCamera(world).z; }
    glm::dvec2 uv(const glm::dvec3& world) const {
        const glm::dvec3 p = inCamera(world);
        const double halfY = camera.orthographic ? camera.ymagM : -p.z * std::tan(0.5 * camera.yfovRad);
        return {0.5 + 0.5 * p.x / (halfY * aspect), 0.5 - 0.5 * p.y / halfY};
    }
    glm::dvec3 pointAt(glm::dvec2 uv, double depthM) const {
        const double halfY = camera.orthographic ? camera.ymagM : depthM * std::tan(0.5 * camera.yfovRad);
        const glm::dvec3 p(halfY * aspect * (2.0 * uv.x - 1.0), halfY * (1.0 - 2.0 * uv.y), -depthM);
        return glm::dvec3(camera.worldFromCamera * glm::dvec4(p, 1.0));
    }
};

// Devices may round to half floats or cut off: up to 2^-10 of the value. Single precision on the way adds a
// little of the uv itself.
constexpr double kHalfRounding = 1.0 / 1024.0, kUvError = 3e-6;

using Before = std::function<glm::dvec3(std::uint32_t instance, const glm::dvec3& nowWs)>;

// Holds the motion target to two views. Returns the number of pixels that show a surface.
int expectMotion(const FrameTargets& targets, const View& now, const View& then, glm::dvec2 jitterPx,
                 const Before& before) {
    const FloatImage& motion = targets.floats("motion");
    int seen = 0;
    double worstUv = 0.0, worstDepth = 0.0;
    for (std::size_t i = 0; i < targets.pixels(); ++i) {
        const PixelSurface s = targets.surface(i);
        if (!s.seen) continue;
        ++seen;
        const glm::dvec2 px(double(i % std::size_t(motion.width)), double(i / std::size_t(motion.width)));
        const glm::dvec2 uv = (px + 0.5 + jitterPx) / glm::dvec2(motion.width, motion.height);
        const glm::dvec3 nowWs = now.pointAt(uv, s.depthM), thenWs = before(s.instance, nowWs);
        const glm::dvec2 wanted = then.uv(thenWs) - now.uv(nowWs);
        for (int c = 0; c < 2; ++c) {
            const double error = std::abs(valueAt(targets, "motion", i, c) - wanted[c]);
            worstUv = std::max(worstUv, error / (kHalfRounding * std::abs(wanted[c]) + kUvError));
        }
        const double depthM = then.depthM(thenWs);
        worstDepth =
            std::max(worstDepth, std::abs(valueAt(targets, "motion", i, 2) - depthM) / std::abs(depthM));
    }
    EXPECT_LE(worstUv, 1.0) << "of the tolerance";
    EXPECT_LE(worstDepth, kHalfRounding + 1e-5);
    return seen;
}

const Before kStands = [](std::uint32_t, const glm::dvec3& nowWs) { return nowWs; };

Camera stageCamera(bool orthographic, const glm::dvec3& offsetM, double turnRad) {
    Camera camera = cameraLooking(glm::dvec3(0.3, 2.3, 4.6) + offsetM, glm::dvec3(0, 0.6, -0.4) + offsetM);
    camera.worldFromCamera = camera.worldFromCamera * glm::rotate(glm::dmat4(1.0), turnRad, {0.3, 0.9, 0.1});
    camera.orthographic = orthographic;
    camera.ymagM = 2.0;
    camera.id = 1;
    return camera;
}

// A box that turns about y by kTurnRadPerS and slides along x by kSlideMPerS, and a still one beside it.
constexpr double kTurnRadPerS = 1.2, kSlideMPerS = 0.4;

glm::dmat4 boxAt(double timeS) {
    return glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(-0.5 + kSlideMPerS * timeS, 0.7, 0.3)),
                       kTurnRadPerS * timeS, glm::dvec3(0, 1, 0));
}

Scene turningBox(int& boxNode) {
    SceneBuilder b;
    b.scene = stageScene({lightCases()[0]});
    boxNode = addPrimitive(b, makeBox({0.4, 0.5, 0.3}), Shading::Flat, boxAt(0.0), 0);
    Node& node = b.scene.nodes[std::size_t(boxNode)];
    node.restTrs = Trs{glm::dvec3(boxAt(0.0)[3]), {1, 0, 0, 0}, {1, 1, 1}};
    Animation animation;
    animation.durationS = 2.0;
    AnimationSampler turn, slide;
    turn.timesS = slide.timesS = {0.0, 2.0};
    turn.values = {{0, 0, 0, 1}, {0, std::sin(kTurnRadPerS), 0, std::cos(kTurnRadPerS)}};
    slide.values = {glm::dvec4(glm::dvec3(boxAt(0.0)[3]), 0), glm::dvec4(glm::dvec3(boxAt(2.0)[3]), 0)};
    animation.samplers = {turn, slide};
    animation.channels = {{boxNode, AnimationPath::Rotation, 0}, {boxNode, AnimationPath::Translation, 1}};
    b.scene.animations.push_back(std::make_shared<Animation>(animation));
    return std::move(b.scene);
}

TEST(MotionVector, ExactlyZeroWhereNothingMoves) {
    int boxNode = 0;
    const Scene scene = turningBox(boxNode); // an instance that may move, and does not
    for (const char* size : {"odd", "even"}) {
        const bool odd = size[0] == 'o';
        FrameRig rig(scene, stochasticOptions(odd ? 61 : 64, odd ? 43 : 40, {"jitter=true", "timeS=0.7"}));
        rig.frames(2);
        const FrameTargets targets = rig.frame();
        std::size_t moved = 0, deep = 0;
        for (std::size_t i = 0; i < targets.pixels(); ++i) {
            moved += valueAt(targets, "motion", i, 0) != 0.0f || valueAt(targets, "motion", i, 1) != 0.0f;
            const PixelSurface s = targets.surface(i);
            if (!s.seen) continue;
            const double expectedM = valueAt(targets, "motion", i, 2);
            deep += std::abs(expectedM - s.depthM) > kHalfRounding * s.depthM + 1e-5;
        }
        EXPECT_EQ(moved, 0u) << size;
        EXPECT_EQ(deep, 0u) << size << ": expected depths are not today's";
    }
}

class MotionOfCamera : public testing::TestWithParam<bool> {};

TEST_P(MotionOfCamera, IsThatOfDoublePrecision) {
    const bool orthographic = GetParam();
    const View then{stageCamera(orthographic, {0, 0, 0}, 0.0), 61.0 / 43.0},
        now{stageCamera(orthographic, {0.21, -0.1, -0.3}, 0.07), 61.0 / 43.0};
    Scene scene = stageScene({lightCases()[0]});
    scene.cameras = {then.camera};
    RenderOptions options = stochasticOptions(61, 43, {"jitter=true"});
    options.seed = 5;
    FrameRig rig(scene, options);
    rig.frames(2);
    rig.renderer().setCamera(now.camera, Renderer::CameraChange::Move);
    const glm::dvec2 jitterPx = filterOffset(options.settings.pixelFilter, 2);
    EXPECT_GT(expectMotion(rig.frame(), now, then, jitterPx, kStands), 1500);
    const glm::dvec2 nextPx = filterOffset(options.settings.pixelFilter, 3);
    EXPECT_GT(expectMotion(rig.frame(), now, now, nextPx, kStands), 1500) << "it stands again";
}

INSTANTIATE_TEST_SUITE_P(Both, MotionOfCamera, testing::Bool(), [](const auto& info) {
    return std::string(info.param ? "orthographic" : "perspective");
});

TEST(MotionVector, OfATurningInstanceIsThatOfDoublePrecision) {
    int boxNode = 0;
    Scene scene = turningBox(boxNode);
    scene.cameras = {stageCamera(false, {0, 0, 0}, 0.0)};
    const View view{scene.cameras[0], 61.0 / 43.0};
    FrameRig rig(scene, stochasticOptions(61, 43, {"timeS=0.3", "timeStepS=0.05"}));
    rig.frames(3);
    const FrameTargets targets = rig.frame();
    // Instances are numbered by node order; the box is the last one.
    std::uint32_t box = 0;
    for (std::size_t i = 0; i < targets.pixels(); ++i)
        if (targets.surface(i).seen) box = std::max(box, targets.surface(i).instance);
    const glm::dmat4 thenFromNow = boxAt(0.3 + 2 * 0.05) * glm::inverse(boxAt(0.3 + 3 * 0.05));
    int onBox = 0;
    expectMotion(targets, view, view, glm::dvec2(0.0), [&](std::uint32_t instance, const glm::dvec3& nowWs) {
        if (instance != box) return nowWs;
        ++onBox;
        return glm::dvec3(thenFromNow * glm::dvec4(nowWs, 1.0));
    });
    EXPECT_GT(onBox, 100);
}

// What was behind the previous camera was not in its picture, wherever a projection would put it.
TEST(MotionVector, BehindThePreviousCameraIsOffScreen) {
    for (const bool orthographic : {false, true}) {
        Scene scene = stageScene({lightCases()[0]});
        Camera camera = cameraLooking({0, 1.5, 0.2}, {0, 1.4, -2.5});
        camera.orthographic = orthographic;
        camera.ymagM = 2.0;
        scene.cameras = {camera};
        FrameRig rig(scene, stochasticOptions(64, 40));
        rig.frames(2);
        const View then{camera, 1.6};
        Camera back = camera;
        back.worldFromCamera[3] += 2.5 * camera.worldFromCamera[2];
        rig.renderer().setCamera(back, Renderer::CameraChange::Move);
        const FrameTargets targets = rig.frame();
        const View now{back, 1.6};
        int behind = 0, wrong = 0;
        for (std::size_t i = 0; i < targets.pixels(); ++i) {
            const PixelSurface s = targets.surface(i);
            if (!s.seen) continue;
            const glm::dvec2 uv((double(i % 64) + 0.5) / 64.0, (double(i / 64) + 0.5) / 40.0);
            if (then.depthM(now.pointAt(uv, s.depthM)) > -0.01) continue;
            ++behind;
            const double u = uv.x + valueAt(targets, "motion", i, 0),
                         v = uv.y + valueAt(targets, "motion", i, 1);
            const bool onScreen = u >= 0.0 && v >= 0.0 && u < 1.0 && v < 1.0;
            if (onScreen || !isMissed(targets, i)) ++wrong;
        }
        EXPECT_GT(behind, 60) << (orthographic ? "orthographic" : "perspective");
        EXPECT_EQ(wrong, 0) << (orthographic ? "orthographic" : "perspective");
    }
}

} // namespace
} // namespace kilolux::test
