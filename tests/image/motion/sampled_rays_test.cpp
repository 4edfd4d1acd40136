// Rays of the stochastic method: surfaces do not shadow themselves at any scale and place, thin walls let
// nothing through, and both tracing back ends give the same raw picture.
#include "tests/image/motion/motion_kit.h"

#include "shaders/shared/sampling.h"
#include "tests/unit/accel/scene_kit.h"

namespace kilolux::test {
namespace {

// Convex bodies beside one another, lit by a point light that all rays can reach unless their own body is in
// the way. Flat and round shading, large and small triangles.
Scene convexBodies() {
    SceneBuilder b;
    const int matt = b.material({0.6, 0.6, 0.6}, 0.0, 0.8);
    const auto at = [](double x, double turnRad) {
        return glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(x, 0, 0)), turnRad,
                           glm::normalize(glm::dvec3(0.3, 1, 0.2)));
    };
    addPrimitive(b, makeBox({0.5, 0.4, 0.5}), Shading::Flat, at(-1.6, 0.7), matt);
    addPrimitive(b, makeSphere(8, 12, 0.6), Shading::Flat, at(0.0, 0.3), matt);
    addPrimitive(b, makeSphere(32, 48, 0.6), Shading::Round, at(1.6, 0.0), matt);
    LightDef def = lightDef(LightType::Sphere, 300.0, LightUnit::Candela);
    def.rangeM = 50.0;
    b.light(def, glm::translate(glm::dmat4(1.0), glm::dvec3(0.5, 4.0, 3.0)));
    Camera camera = cameraLooking({0.2, 1.6, 4.5}, {0, 0, 0});
    b.scene.cameras.push_back(camera);
    return std::move(b.scene);
}

struct Placement {
    std::string name;
    double scale;
    double offsetM;
};

class SelfShadowing : public testing::TestWithParam<Placement> {};

TEST_P(SelfShadowing, FacesThatSeeTheLightAreLit) {
    const Placement& placement = GetParam();
    const glm::dvec3 offsetM(placement.offsetM, 0.25 * placement.offsetM, -0.5 * placement.offsetM);
    const Scene scene = placedScene(convexBodies(), placement.scale, offsetM);
    const glm::dvec3 light(scene.nodes[std::size_t(scene.lights[0].node)].worldFromNode[3]);
    const Camera& camera = scene.cameras[0];
    for (const char* gbuffer : {"gbuffer=compute", "gbuffer=raster"}) {
        FrameRig rig(scene, stochasticOptions(96, 64, {gbuffer, "jitter=true", "dimLights=keep"}));
        int lit = 0, hidden = 0, unlit = 0;
        for (int frame = 0; frame < 3; ++frame) {
            const FrameTargets targets = rig.frame();
            for (std::size_t i = 0; i < targets.pixels(); ++i) {
                const PixelSurface s = targets.surface(i);
                if (!s.seen) continue;
                const glm::dvec2 ndc(2.0 * (double(i % 96) + 0.5) / 96.0 - 1.0,
                                     1.0 - 2.0 * (double(i / 96) + 0.5) / 64.0);
                const double tanY = std::tan(0.5 * camera.yfovRad);
                const glm::dvec4 inCamera(s.depthM * ndc.x * tanY * 1.5, s.depthM * ndc.y * tanY, -s.depthM,
                                          1.0);
                const glm::dvec3 dir = glm::normalize(light - glm::dvec3(camera.worldFromCamera * inCamera));
                const double cosGeo = glm::dot(s.geoNormalWs, dir), cosShading = glm::dot(s.normalWs, dir);
                // Jitter moves the point by a pixel: faces near the horizon are left out.
                if (cosGeo < 0.05 || cosShading < 0.05) continue;
                const std::uint32_t state = wordAt(targets, "rayResults", i, 0, 1) & shared::RAY_STATE_MASK;
                lit += state == shared::RAY_VISIBLE;
                hidden += state == shared::RAY_HIDDEN;
                unlit += state == shared::RAY_NONE;
            }
        }
        EXPECT_GT(lit, 2000) << gbuffer;
        EXPECT_EQ(hidden, 0) << gbuffer;
        EXPECT_EQ(unlit, 0) << gbuffer;
    }
}

INSTANTIATE_TEST_SUITE_P(Scales, SelfShadowing,
                         testing::Values(Placement{"Hundredth", 0.01, 0.0}, Placement{"One", 1.0, 0.0},
                                         Placement{"TenThousand", 1e4, 0.0}, Placement{"OneFarOff", 1.0, 1e4},
                                         Placement{"HundredthFarOff", 0.01, 1e4}),
                         [](const auto& info) { return info.param.name; });

// A lamp in a box of 1 mm walls, and one behind a 1 mm sheet: outside there is exactly no light.
TEST(ThinWall, LetsNothingThrough) {
    for (const double offsetM : {0.0, 1e4}) {
        SceneBuilder b = bareFloor();
        const int matt = b.material({0.6, 0.6, 0.6}, 0.0, 0.8);
        addPrimitive(b, makeBox({3.0, 0.0005, 3.0}), Shading::Flat,
                     glm::translate(glm::dmat4(1.0), glm::dvec3(0, 1.0, 0)), matt);
        LightDef lamp = lightDef(LightType::Sphere, 1000.0, LightUnit::Candela);
        lamp.radiusM = 0.1;
        lamp.rangeM = 20.0;
        b.light(lamp, glm::translate(glm::dmat4(1.0), glm::dvec3(0.3, 1.15, 0.2)));
        LightDef panel = lightDef(LightType::Rect, 1000.0, LightUnit::Nit);
        panel.widthM = panel.heightM = 0.5;
        panel.rangeM = 20.0;
        b.light(panel, lookingAlong({-0.5, 1.002, 0}, {0, -1, 0})); // 1.5 mm over the sheet's upper side
        // Below the sheet, looking along the floor and up at the sheet's lower side.
        b.scene.cameras = {cameraLooking({0.2, 0.5, 1.5}, {0, 0.45, 0}, 1.0)};
        const Scene scene = placedScene(b.scene, 1.0, {offsetM, 0, -offsetM});
        for (const char* gbuffer : {"gbuffer=compute", "gbuffer=raster"}) {
            FrameRig rig(scene, stochasticOptions(96, 64, {gbuffer, "jitter=true", "exposureEv100=5"}));
            for (int frame = 0; frame < 4; ++frame) {
                const FrameTargets targets = rig.frame();
                int shadowed = 0, leaks = 0;
                for (std::size_t i = 0; i < targets.pixels(); ++i) {
                    const PixelSurface s = targets.surface(i);
                    // Floor under the middle of the sheet, where no light comes in from the side.
                    if (!s.seen || s.depthM > 2.3) continue;
                    ++shadowed;
                    const glm::dvec3 light = targets.rgb("litDiffuse", i) + targets.rgb("litSpecular", i);
                    leaks += light != glm::dvec3(0.0);
                }
                EXPECT_GT(shadowed, 1500) << gbuffer;
                EXPECT_EQ(leaks, 0) << gbuffer << ", " << offsetM << " m off";
            }
        }
    }
}

TEST(RayQuery, GivesTheSameRawPicture) {
    const Scene scene = stageScene(lightCases());
    RenderOptions options = stochasticOptions(64, 44, {"jitter=true"});
    FrameRig compute(scene, options);
    options.settings.tracer = TracerChoice::RayQuery;
    Result<std::unique_ptr<Renderer>> probe = Renderer::create(scene, options);
    if (!probe) GTEST_SKIP() << probe.error();
    FrameRig query(scene, options);
    for (int frame = 0; frame < 4; ++frame) {
        const FrameTargets a = compute.frame(), b = query.frame();
        int depths = 0, rays = 0;
        for (std::size_t i = 0; i < a.pixels(); ++i) {
            depths += std::abs(a.surface(i).depthM - b.surface(i).depthM) > 1e-4 * a.surface(i).depthM;
            rays += (wordAt(a, "rayResults", i, 0, 1) & shared::RAY_STATE_MASK) !=
                    (wordAt(b, "rayResults", i, 0, 1) & shared::RAY_STATE_MASK);
        }
        EXPECT_LE(depths, 4) << frame;
        // From the second frame on a ray that differed may change a list, and through it what pixels choose.
        if (frame == 0) EXPECT_LE(rays, 8);
        double light = 0.0, other = 0.0;
        for (std::size_t i = 0; i < a.pixels(); ++i) {
            light += luminanceOf(a.rgb("sceneColor", i));
            other += luminanceOf(b.rgb("sceneColor", i));
        }
        EXPECT_NEAR(light / other, 1.0, frame == 0 ? 0.003 : 0.05) << frame;
    }
}

} // namespace
} // namespace kilolux::test
