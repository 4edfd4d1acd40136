// Gizmos: which handle the pointer is over, and that dragging from one pixel to another moves, turns and
// scales by what the picture shows.
#include "ui/gizmo_math.h"

#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>
#include <random>

namespace kilolux {
namespace {

Viewport viewFrom(const glm::dvec3& eye, const glm::dvec3& target) {
    Viewport viewport;
    viewport.rect = {300, 40, 700, 500};
    const glm::dvec3 back = glm::normalize(eye - target);
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), back));
    viewport.camera.worldFromCamera = glm::dmat4(glm::dmat3(right, glm::cross(back, right), back));
    viewport.camera.worldFromCamera[3] = glm::dvec4(eye, 1.0);
    return viewport;
}

GizmoFrame turnedFrame() {
    GizmoFrame frame;
    frame.originWs = {0.3, 1.1, -0.4};
    frame.axes = glm::mat3_cast(glm::normalize(glm::dquat(0.9, 0.2, -0.3, 0.1)));
    return frame;
}

constexpr double kLengthPx = 88.0;
constexpr GizmoHandle kAxes[] = {GizmoHandle::X, GizmoHandle::Y, GizmoHandle::Z};

TEST(GizmoMath, EveryHandleIsWhereItIsDrawn) {
    const Viewport viewport = viewFrom({3, 2.5, 4}, {0.3, 1.1, -0.4});
    const GizmoFrame frame = turnedFrame();
    const double lengthM = kLengthPx * viewport.metresPerPixel(frame.originWs);
    const GizmoSize size{kLengthPx, 8.0};
    for (const GizmoKind kind : {GizmoKind::Move, GizmoKind::Scale}) {
        for (const GizmoHandle handle : kAxes) {
            const auto px = viewport.project(frame.originWs + 0.9 * lengthM * frame.axes[axisOf(handle)]);
            EXPECT_EQ(handleAt(kind, frame, viewport, *px, size), handle);
        }
        EXPECT_EQ(handleAt(kind, frame, viewport, *viewport.project(frame.originWs), size),
                  GizmoHandle::Center);
        EXPECT_EQ(
            handleAt(kind, frame, viewport, *viewport.project(frame.originWs) + glm::dvec2(0, 200), size),
            GizmoHandle::None);
    }
    // Planes yield to arrows that cross them: here none does.
    GizmoFrame upright = frame;
    upright.axes = glm::dmat3(1.0);
    for (const GizmoHandle handle : {GizmoHandle::PlaneYZ, GizmoHandle::PlaneZX, GizmoHandle::PlaneXY}) {
        const int axis = axisOf(handle);
        const auto px = viewport.project(upright.originWs + 0.36 * lengthM * upright.axes[(axis + 1) % 3] +
                                         0.36 * lengthM * upright.axes[(axis + 2) % 3]);
        EXPECT_EQ(handleAt(GizmoKind::Move, upright, viewport, *px, size), handle);
        EXPECT_NE(handleAt(GizmoKind::Scale, upright, viewport, *px, size), handle);
    }
    for (const GizmoHandle handle : {GizmoHandle::X, GizmoHandle::Y, GizmoHandle::Z, GizmoHandle::Center}) {
        int found = 0, seen = 0;
        for (const RingPoint& point : ringPoints(handle, frame, viewport, kLengthPx)) {
            if (point.facesAway) continue;
            ++seen;
            found += handleAt(GizmoKind::Rotate, frame, viewport, *viewport.project(point.pointWs), size) ==
                     handle;
        }
        EXPECT_GT(found, seen * 3 / 4) << int(handle); // rings cross
    }
}

TEST(GizmoMath, SizeOnScreenIsConstant) {
    for (const double distance : {0.5, 4.0, 200.0}) {
        const Viewport viewport = viewFrom({0, 1, distance}, {0, 1, 0});
        GizmoFrame frame;
        frame.originWs = {0, 1, 0};
        const double lengthM = kLengthPx * viewport.metresPerPixel(frame.originWs);
        EXPECT_NEAR(glm::distance(*viewport.project(frame.originWs),
                                  *viewport.project(frame.originWs + lengthM * frame.axes[1])),
                    kLengthPx, 1e-6);
    }
}

TEST(GizmoMath, ArrowsFollowThePointer) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    int checked = 0;
    for (int i = 0; i < 300; ++i) {
        const GizmoFrame frame = turnedFrame();
        const Viewport viewport = viewFrom(
            frame.originWs + 4.0 * glm::dvec3(uniform(random), 0.3 + uniform(random), uniform(random)),
            frame.originWs);
        const GizmoHandle handle = kAxes[i % 3];
        if (!isUsable(GizmoKind::Move, handle, frame, viewport)) continue;
        const glm::dvec3 axis = frame.axes[axisOf(handle)];
        const double from = 0.2, moved = 0.5 * uniform(random);
        const auto start = viewport.project(frame.originWs + from * axis);
        const auto end = viewport.project(frame.originWs + (from + moved) * axis);
        if (!start || !end) continue;
        GizmoDrag drag(GizmoKind::Move, handle, frame, viewport, *start, kLengthPx);
        const GizmoChange change = drag.to(viewport, *end, nullptr);
        EXPECT_LT(glm::distance(change.translationWs, moved * axis), 1e-6) << i;
        ++checked;
    }
    EXPECT_GT(checked, 150);
}

TEST(GizmoMath, PlanesAndTheCentreFollowThePointer) {
    const GizmoFrame frame = turnedFrame();
    const Viewport viewport = viewFrom({3, 2.5, 4}, frame.originWs);
    for (const GizmoHandle handle : {GizmoHandle::PlaneYZ, GizmoHandle::PlaneZX, GizmoHandle::PlaneXY}) {
        const int axis = axisOf(handle);
        const glm::dvec3 moved = 0.3 * frame.axes[(axis + 1) % 3] - 0.2 * frame.axes[(axis + 2) % 3];
        GizmoDrag drag(GizmoKind::Move, handle, frame, viewport, *viewport.project(frame.originWs),
                       kLengthPx);
        const GizmoChange change = drag.to(viewport, *viewport.project(frame.originWs + moved), nullptr);
        EXPECT_LT(glm::distance(change.translationWs, moved), 1e-6);
    }
    GizmoDrag drag(GizmoKind::Move, GizmoHandle::Center, frame, viewport, *viewport.project(frame.originWs),
                   kLengthPx);
    const glm::dvec2 px = *viewport.project(frame.originWs) + glm::dvec2(100, -30);
    const GizmoChange change = drag.to(viewport, px, nullptr);
    EXPECT_LT(glm::distance(*viewport.project(frame.originWs + change.translationWs), px), 1e-6);
    EXPECT_NEAR(viewport.depthM(frame.originWs + change.translationWs), viewport.depthM(frame.originWs),
                1e-9);
}

TEST(GizmoMath, RingsTurnByTheAngleThatThePointerGoes) {
    const GizmoFrame frame = turnedFrame();
    const Viewport viewport = viewFrom({3, 2.5, 4}, frame.originWs);
    for (const GizmoHandle handle : kAxes) {
        const std::vector<RingPoint> ring = ringPoints(handle, frame, viewport, kLengthPx);
        GizmoDrag drag(GizmoKind::Rotate, handle, frame, viewport, *viewport.project(ring[0].pointWs),
                       kLengthPx);
        GizmoChange change;
        // One and a half times round, as the pointer would go.
        for (std::size_t i = 1; i <= 96; ++i)
            change = drag.to(viewport, *viewport.project(ring[i % 64].pointWs), nullptr);
        const glm::dvec3 turned = change.rotation * (ring[0].pointWs - frame.originWs);
        EXPECT_LT(glm::distance(turned, ring[32].pointWs - frame.originWs), 1e-6) << int(handle);
        EXPECT_NE(change.label.find("+540.0"), std::string::npos) << change.label;
    }
    // About the line of sight counter-clockwise is positive, as seen.
    const glm::dvec2 origin = *viewport.project(frame.originWs);
    GizmoDrag drag(GizmoKind::Rotate, GizmoHandle::Center, frame, viewport, origin + glm::dvec2(98, 0),
                   kLengthPx);
    EXPECT_NE(drag.to(viewport, origin + glm::dvec2(0, -98), nullptr).label.find("+90.0"), std::string::npos);
}

TEST(GizmoMath, EdgeOnRingsTurnAlongTheirTangent) {
    GizmoFrame frame;
    const Viewport viewport = viewFrom({0, 0, 4}, {0, 0, 0});
    GizmoDrag drag(GizmoKind::Rotate, GizmoHandle::Y, frame, viewport, *viewport.project({0, 0, 0}),
                   kLengthPx);
    const GizmoChange change =
        drag.to(viewport, *viewport.project({0, 0, 0}) + glm::dvec2(0.9 * kLengthPx * 0.5, 17.0), nullptr);
    // Half a radian: the front goes to the right.
    EXPECT_LT(
        glm::distance(change.rotation * glm::dvec3(0, 0, 1), glm::dvec3(std::sin(0.5), 0, std::cos(0.5))),
        1e-6);
}

TEST(GizmoMath, ScalesByTheRatio) {
    const GizmoFrame frame = turnedFrame();
    const Viewport viewport = viewFrom({3, 2.5, 4}, frame.originWs);
    const auto start = viewport.project(frame.originWs + 0.3 * frame.axes[1]);
    GizmoDrag drag(GizmoKind::Scale, GizmoHandle::Y, frame, viewport, *start, kLengthPx);
    const auto twice = viewport.project(frame.originWs + 0.6 * frame.axes[1]);
    EXPECT_LT(glm::distance(drag.to(viewport, *twice, nullptr).scale, glm::dvec3(1, 2, 1)), 1e-9);
    // Past the centre sizes do not turn negative.
    const auto negative = viewport.project(frame.originWs - 0.6 * frame.axes[1]);
    EXPECT_GT(drag.to(viewport, *negative, nullptr).scale.y, 0.0);
    GizmoDrag all(GizmoKind::Scale, GizmoHandle::Center, frame, viewport, {500, 300}, kLengthPx);
    EXPECT_NEAR(all.to(viewport, {500 + kLengthPx, 300}, nullptr).scale.z, 2.0, 1e-9);
    EXPECT_NEAR(all.to(viewport, {500, 300 + kLengthPx}, nullptr).scale.x, 0.5, 1e-9);
}

TEST(GizmoMath, SnapsToSteps) {
    GizmoFrame frame;
    const Viewport viewport = viewFrom({0.5, 0.4, 4}, {0, 0, 0});
    const GizmoSnap snap;
    GizmoDrag move(GizmoKind::Move, GizmoHandle::X, frame, viewport, *viewport.project({0.2, 0, 0}),
                   kLengthPx);
    EXPECT_NEAR(move.to(viewport, *viewport.project({0.56, 0, 0}), &snap).translationWs.x, 0.4, 1e-12);
    const std::vector<RingPoint> ring = ringPoints(GizmoHandle::Z, frame, viewport, kLengthPx);
    GizmoDrag turn(GizmoKind::Rotate, GizmoHandle::Z, frame, viewport, *viewport.project(ring[0].pointWs),
                   kLengthPx);
    const GizmoChange change = turn.to(viewport, *viewport.project(ring[2].pointWs), &snap); // 11.25 degrees
    EXPECT_NEAR(2.0 * std::acos(change.rotation.w), glm::radians(10.0), 1e-9);
    GizmoDrag scale(GizmoKind::Scale, GizmoHandle::X, frame, viewport, *viewport.project({0.2, 0, 0}),
                    kLengthPx);
    EXPECT_NEAR(scale.to(viewport, *viewport.project({0.276, 0, 0}), &snap).scale.x, 1.4, 1e-9);
}

TEST(GizmoMath, NothingIsThrownPastTheHorizon) {
    GizmoFrame frame;
    const Viewport viewport = viewFrom({0, 0.3, 4}, {0, 0.3, 0});
    EXPECT_FALSE(isUsable(GizmoKind::Move, GizmoHandle::Z, frame, viewport)); // points at the viewer
    EXPECT_FALSE(isUsable(GizmoKind::Move, GizmoHandle::PlaneZX, frame, viewport));
    GizmoDrag drag(GizmoKind::Move, GizmoHandle::PlaneZX, frame, viewport, *viewport.project({0, 0, 1}),
                   kLengthPx);
    for (double y = 40; y < 540; y += 7) {
        const GizmoChange change = drag.to(viewport, {650, y}, nullptr);
        EXPECT_TRUE(std::isfinite(glm::length(change.translationWs)));
        EXPECT_LT(glm::length(change.translationWs), 1e5) << y;
    }
}

} // namespace
} // namespace kilolux
