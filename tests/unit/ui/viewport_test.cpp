// The viewport's projections against each other and the renderer's, and the camera's movements.
#include "renderer/camera.h"
#include "ui/viewport.h"
#include "ui/viewport_camera.h"

#include <gtest/gtest.h>

#include <random>

namespace kilolux {
namespace {

Camera someCamera() {
    ViewportCamera maker;
    maker.look(0.7, -0.3);
    maker.move({2.0, 1.0, -4.0});
    return maker.camera();
}

Viewport someViewport() {
    return {{264.0, 40.0, 712.0, 652.0}, someCamera()};
}

TEST(Viewport, APixelsRayProjectsOntoThePixel) {
    Viewport viewport = someViewport();
    std::mt19937 random(1);
    std::uniform_real_distribution<double> u(0.0, 1.0);
    for (const bool orthographic : {false, true}) {
        viewport.camera.orthographic = orthographic;
        for (int i = 0; i < 100; ++i) {
            const glm::dvec2 px(264.0 + 712.0 * u(random), 40.0 + 652.0 * u(random));
            const ViewRay ray = viewport.ray(px);
            const auto back = viewport.project(ray.originWs + ray.dirWs * (0.5 + 20.0 * u(random)));
            ASSERT_TRUE(back);
            EXPECT_NEAR(back->x, px.x, 1e-8);
            EXPECT_NEAR(back->y, px.y, 1e-8);
        }
    }
}

// Outlines lie on the picture only if the window projects as the renderer does.
TEST(Viewport, AgreesWithTheRenderersMatrix) {
    const Viewport viewport = someViewport();
    shared::FrameConstants frame{};
    setCamera(frame, viewport.camera, glm::dvec3(0.0), 712, 652, glm::dvec2(0.0));
    const glm::dvec3 point(0.5, 0.2, -2.0);
    const glm::vec4 clip = frame.steadyClipFromWorld * glm::vec4(glm::vec3(point), 1.0f);
    const auto px = viewport.project(point);
    ASSERT_TRUE(px);
    EXPECT_NEAR(px->x, 264.0 + 712.0 * (0.5 + 0.5 * double(clip.x / clip.w)), 1e-3);
    EXPECT_NEAR(px->y, 40.0 + 652.0 * (0.5 + 0.5 * double(clip.y / clip.w)), 1e-3);
    const glm::dvec4 own = viewport.clipFromView() * viewport.viewFromWorld() * glm::dvec4(point, 1.0);
    EXPECT_NEAR(own.z / own.w, double(clip.z / clip.w), 1e-6);
}

TEST(Viewport, SegmentsAreCutAtTheNearPlane) {
    const Viewport viewport = someViewport();
    const glm::dvec3 ahead = viewport.ray(viewport.rect.center()).dirWs;
    const glm::dvec3 before = viewport.eyeWs() + ahead * 3.0, behind = viewport.eyeWs() - ahead * 3.0;
    EXPECT_FALSE(viewport.project(behind));
    EXPECT_TRUE(viewport.project(before, behind + glm::dvec3(0, 1, 0)));
    EXPECT_FALSE(viewport.project(behind, behind + ahead));
}

TEST(Viewport, PixelsPerMetreShrinkWithDistance) {
    const Viewport viewport = someViewport();
    const glm::dvec3 ahead = viewport.ray(viewport.rect.center()).dirWs;
    const glm::dvec3 at = viewport.eyeWs() + ahead * 4.0;
    const glm::dvec3 right(viewport.camera.worldFromCamera[0]);
    const auto a = viewport.project(at),
               b = viewport.project(at + right * (10.0 * viewport.metresPerPixel(at)));
    ASSERT_TRUE(a && b);
    EXPECT_NEAR(glm::length(*b - *a), 10.0, 1e-6);
}

TEST(ViewportCamera, LooksThroughACameraExactly) {
    // Rolled by 0.4 rad.
    Camera camera = someCamera();
    const glm::dvec4 right = camera.worldFromCamera[0], up = camera.worldFromCamera[1];
    camera.worldFromCamera[0] = right * std::cos(0.4) + up * std::sin(0.4);
    camera.worldFromCamera[1] = up * std::cos(0.4) - right * std::sin(0.4);
    ViewportCamera viewer;
    viewer.lookThrough(camera, 2.0);
    const glm::dmat4 seen = viewer.camera().worldFromCamera;
    for (int column = 0; column < 4; ++column)
        EXPECT_LT(glm::length(seen[column] - camera.worldFromCamera[column]), 1e-12) << column;
}

TEST(ViewportCamera, OrbitKeepsThePivotAndItsDistance) {
    ViewportCamera camera;
    camera.lookThrough(someCamera(), 3.0);
    const glm::dvec3 pivot = camera.pivotWs();
    for (int i = 0; i < 50; ++i)
        camera.orbit(0.3, 0.17);
    EXPECT_LT(glm::length(camera.pivotWs() - pivot), 1e-9);
    EXPECT_NEAR(glm::length(camera.eyeWs() - pivot), 3.0, 1e-9);
}

TEST(ViewportCamera, DollyComesCloserAndNeverThrough) {
    ViewportCamera camera;
    camera.lookThrough(someCamera(), 3.0);
    const glm::dvec3 pivot = camera.pivotWs();
    camera.dolly(0.5);
    EXPECT_NEAR(glm::length(camera.eyeWs() - pivot), 1.5, 1e-9);
    for (int i = 0; i < 100; ++i)
        camera.dolly(0.5);
    EXPECT_GE(glm::length(camera.eyeWs() - pivot), 0.009);
}

TEST(ViewportCamera, PanMovesThePivotWithThePointer) {
    ViewportCamera mover;
    mover.lookThrough(someCamera(), 3.0);
    Viewport viewport = someViewport();
    const glm::dvec3 pivot = mover.pivotWs();
    mover.pan({25.0, -40.0}, viewport.rect.height);
    viewport.camera = mover.camera();
    const auto px = viewport.project(pivot);
    ASSERT_TRUE(px);
    EXPECT_NEAR(px->x, viewport.rect.center().x + 25.0, 1e-6);
    EXPECT_NEAR(px->y, viewport.rect.center().y - 40.0, 1e-6);
}

TEST(ViewportCamera, FramingShowsTheWholeSphere) {
    for (const double aspect : {0.4, 1.0, 2.2}) {
        ViewportCamera mover;
        mover.lookThrough(someCamera(), 3.0);
        mover.frame({1, 2, 3}, 0.8, aspect);
        const Viewport viewport{{0.0, 0.0, 600.0 * aspect, 600.0}, mover.camera()};
        std::mt19937 random(2);
        std::normal_distribution<double> n;
        for (int i = 0; i < 200; ++i) {
            const glm::dvec3 onSphere = glm::normalize(glm::dvec3(n(random), n(random), n(random)));
            const auto px = viewport.project(glm::dvec3(1, 2, 3) + 0.8 * onSphere);
            ASSERT_TRUE(px);
            EXPECT_TRUE(viewport.rect.contains(*px)) << aspect << " " << px->x << " " << px->y;
        }
    }
}

} // namespace
} // namespace kilolux
