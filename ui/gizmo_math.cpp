#include "ui/gizmo_math.h"

#include "ui/outline_geometry.h"
#include "ui/value_entry.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

namespace kilolux {

namespace {

constexpr double kLeastSine = 0.12;     // between an arrow and the line of sight: 7 degrees
constexpr double kEdgeOnSine = 0.2;     // a ring flatter than this is dragged along its tangent
constexpr double kLeastFactor = 0.01;   // of scaling
constexpr double kFarthestArrows = 1e4; // past that the pointer has crossed the horizon

glm::dvec3 towardsViewer(const Viewport& viewport, const glm::dvec3& point) {
    if (viewport.camera.orthographic) return glm::normalize(glm::dvec3(viewport.camera.worldFromCamera[2]));
    const glm::dvec3 to = viewport.eyeWs() - point;
    const double length = glm::length(to);
    return length > 0.0 ? to / length : glm::dvec3(0, 0, 1);
}

double snapped(double value, double step) {
    return step > 0.0 ? std::round(value / step) * step : value;
}

std::string signedLength(double metres) {
    const double shown = std::round(metres * 1000.0) / 1000.0;
    return fmt::format("{}{:.3f} m", shown < 0.0 ? "\u2212" : "+", std::abs(shown));
}

double wrapped(double angle) {
    return angle - glm::two_pi<double>() * std::round(angle / glm::two_pi<double>());
}

bool isAxis(GizmoHandle handle) {
    return handle == GizmoHandle::X || handle == GizmoHandle::Y || handle == GizmoHandle::Z;
}
bool isPlane(GizmoHandle handle) {
    return handle == GizmoHandle::PlaneYZ || handle == GizmoHandle::PlaneZX || handle == GizmoHandle::PlaneXY;
}

constexpr GizmoHandle kAxes[] = {GizmoHandle::X, GizmoHandle::Y, GizmoHandle::Z};
constexpr GizmoHandle kPlanes[] = {GizmoHandle::PlaneYZ, GizmoHandle::PlaneZX, GizmoHandle::PlaneXY};
constexpr const char* kNames[] = {"X", "Y", "Z"};

// Whether a point lies within a convex quadrilateral in pixels.
bool insideQuad(glm::dvec2 px, const std::array<glm::dvec2, 4>& corners) {
    int positive = 0, negative = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec2 edge = corners[(i + 1) % 4] - corners[i], to = px - corners[i];
        const double side = edge.x * to.y - edge.y * to.x;
        positive += side > 0.0;
        negative += side < 0.0;
    }
    return positive == 0 || negative == 0;
}

bool overPlane(GizmoHandle handle, const GizmoFrame& frame, const Viewport& viewport, glm::dvec2 px,
               double lengthM) {
    const int axis = axisOf(handle);
    const glm::dvec3 u = frame.axes[(axis + 1) % 3] * lengthM, v = frame.axes[(axis + 2) % 3] * lengthM;
    std::array<glm::dvec2, 4> corners;
    const glm::dvec2 parts[] = {
        {kPlaneFrom, kPlaneFrom}, {kPlaneTo, kPlaneFrom}, {kPlaneTo, kPlaneTo}, {kPlaneFrom, kPlaneTo}};
    for (std::size_t i = 0; i < 4; ++i) {
        const auto corner = viewport.project(frame.originWs + parts[i].x * u + parts[i].y * v);
        if (!corner) return false;
        corners[i] = *corner;
    }
    return insideQuad(px, corners);
}

double distanceToRing(GizmoHandle handle, const GizmoFrame& frame, const Viewport& viewport, glm::dvec2 px,
                      double lengthPx) {
    double nearest = 1e9;
    const std::vector<RingPoint> points = ringPoints(handle, frame, viewport, lengthPx);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const RingPoint &a = points[i], &b = points[(i + 1) % points.size()];
        if (a.facesAway || b.facesAway) continue;
        if (const auto segment = viewport.project(a.pointWs, b.pointWs))
            nearest = std::min(nearest, distanceToSegment(px, segment->from, segment->to));
    }
    return nearest;
}

} // namespace

int axisOf(GizmoHandle handle) {
    switch (handle) {
    case GizmoHandle::Y:
    case GizmoHandle::PlaneZX:
        return 1;
    case GizmoHandle::Z:
    case GizmoHandle::PlaneXY:
        return 2;
    default:
        return 0;
    }
}

bool isUsable(GizmoKind kind, GizmoHandle handle, const GizmoFrame& frame, const Viewport& viewport) {
    if (handle == GizmoHandle::None) return false;
    if (handle == GizmoHandle::Center) return true;
    if (kind == GizmoKind::Rotate) return isAxis(handle);
    if (kind == GizmoKind::Scale && isPlane(handle)) return false;
    const double cosine =
        std::abs(glm::dot(frame.axes[axisOf(handle)], towardsViewer(viewport, frame.originWs)));
    if (isPlane(handle)) return cosine > kLeastSine;
    return std::sqrt(std::max(0.0, 1.0 - cosine * cosine)) > kLeastSine;
}

std::vector<RingPoint> ringPoints(GizmoHandle handle, const GizmoFrame& frame, const Viewport& viewport,
                                  double lengthPx) {
    constexpr int kSides = 64;
    const glm::dvec3 to = towardsViewer(viewport, frame.originWs);
    glm::dvec3 u, v;
    double radius = kRing;
    if (handle == GizmoHandle::Center) {
        const glm::dvec3 up(viewport.camera.worldFromCamera[1]);
        u = glm::normalize(glm::cross(up, to));
        v = glm::cross(to, u);
        radius = kViewRing;
    } else {
        u = frame.axes[(axisOf(handle) + 1) % 3];
        v = frame.axes[(axisOf(handle) + 2) % 3];
    }
    radius *= lengthPx * viewport.metresPerPixel(frame.originWs);
    std::vector<RingPoint> points;
    for (int i = 0; i < kSides; ++i) {
        const double angle = glm::two_pi<double>() * i / kSides;
        const glm::dvec3 out = std::cos(angle) * u + std::sin(angle) * v;
        // A ring seen almost from above is whole.
        points.push_back({frame.originWs + radius * out, glm::dot(out, to) < -0.15});
    }
    return points;
}

GizmoHandle handleAt(GizmoKind kind, const GizmoFrame& frame, const Viewport& viewport, glm::dvec2 px,
                     const GizmoSize& size) {
    const std::optional<glm::dvec2> origin = viewport.project(frame.originWs);
    if (!origin) return GizmoHandle::None;
    const double lengthM = size.lengthPx * viewport.metresPerPixel(frame.originWs);
    const double centerPx = kCenterPx / 88.0 * size.lengthPx;
    if (kind != GizmoKind::Rotate && glm::distance(px, *origin) <= centerPx + 2.0) return GizmoHandle::Center;
    double nearest = size.reachPx;
    GizmoHandle found = GizmoHandle::None;
    const auto consider = [&](GizmoHandle handle, double distance) {
        if (distance <= nearest && isUsable(kind, handle, frame, viewport)) {
            nearest = distance;
            found = handle;
        }
    };
    if (kind == GizmoKind::Rotate) {
        consider(GizmoHandle::Center,
                 distanceToRing(GizmoHandle::Center, frame, viewport, px, size.lengthPx));
        for (const GizmoHandle handle : kAxes)
            consider(handle, distanceToRing(handle, frame, viewport, px, size.lengthPx));
        return found;
    }
    for (const GizmoHandle handle : kAxes) {
        if (const auto end = viewport.project(frame.originWs + lengthM * frame.axes[axisOf(handle)]))
            consider(handle, distanceToSegment(px, *origin, *end));
    }
    if (found != GizmoHandle::None) return found;
    for (const GizmoHandle handle : kPlanes)
        if (isUsable(kind, handle, frame, viewport) && overPlane(handle, frame, viewport, px, lengthM))
            return handle;
    return GizmoHandle::None;
}

// ---------------------------------------------------------------------------------------------------------
// Dragging

GizmoDrag::GizmoDrag(GizmoKind kind, GizmoHandle handle, const GizmoFrame& frame, const Viewport& viewport,
                     glm::dvec2 startPx, double lengthPx)
    : kind_(kind), handle_(handle), frame_(frame), startPx_(startPx), lengthPx_(lengthPx),
      viewAxes_(glm::dmat3(viewport.camera.worldFromCamera)) {
    startAlong_ = alongAxis(viewport, startPx).value_or(0.0);
    const glm::dvec3 normal = isPlane(handle) ? frame.axes[axisOf(handle)] : viewAxes_[2];
    startPoint_ = onPlane(viewport, startPx, normal).value_or(frame.originWs);
    lastAngle_ = angleAt(viewport, startPx).value_or(0.0);
}

// The point of the axis that is nearest to the pointer's ray, in metres from the origin.
std::optional<double> GizmoDrag::alongAxis(const Viewport& viewport, glm::dvec2 px) const {
    const ViewRay ray = viewport.ray(px);
    const glm::dvec3 axis = frame_.axes[axisOf(handle_)], from = ray.originWs - frame_.originWs;
    const double cosine = glm::dot(axis, ray.dirWs), sine2 = 1.0 - cosine * cosine;
    if (sine2 < 1e-6) return std::nullopt;
    const double onRay = (cosine * glm::dot(axis, from) - glm::dot(ray.dirWs, from)) / sine2;
    const double along = glm::dot(axis, from) + cosine * onRay;
    const double farthest = kFarthestArrows * lengthPx_ * viewport.metresPerPixel(frame_.originWs);
    if (onRay < 0.0 || !(std::abs(along) < farthest)) return std::nullopt;
    return along;
}

std::optional<glm::dvec3> GizmoDrag::onPlane(const Viewport& viewport, glm::dvec2 px,
                                             const glm::dvec3& normal) const {
    const ViewRay ray = viewport.ray(px);
    const double cosine = glm::dot(ray.dirWs, normal);
    if (std::abs(cosine) < 1e-4) return std::nullopt;
    const double t = glm::dot(frame_.originWs - ray.originWs, normal) / cosine;
    const double farthest = kFarthestArrows * lengthPx_ * viewport.metresPerPixel(frame_.originWs);
    if (!(t > 0.0) || t > farthest) return std::nullopt;
    return ray.originWs + t * ray.dirWs;
}

// The pointer's place about the ring. Rings seen from the edge count along their tangent.
std::optional<double> GizmoDrag::angleAt(const Viewport& viewport, glm::dvec2 px) const {
    const std::optional<glm::dvec2> origin = viewport.project(frame_.originWs);
    if (!origin) return std::nullopt;
    const glm::dvec3 to = towardsViewer(viewport, frame_.originWs);
    const bool aboutSight = handle_ == GizmoHandle::Center;
    const glm::dvec3 axis = aboutSight ? to : frame_.axes[axisOf(handle_)];
    if (!aboutSight && std::abs(glm::dot(axis, to)) < kEdgeOnSine) {
        const glm::dvec3 tangent = glm::cross(axis, to); // of the near side of the ring
        const auto end =
            viewport.project(frame_.originWs + tangent * viewport.metresPerPixel(frame_.originWs));
        if (!end || glm::distance(*end, *origin) < 1e-9) return std::nullopt;
        return glm::dot(px - startPx_, glm::normalize(*end - *origin)) / (kRing * lengthPx_);
    }
    if (aboutSight) return -std::atan2(px.y - origin->y, px.x - origin->x);
    const std::optional<glm::dvec3> point = onPlane(viewport, px, axis);
    if (!point) return std::nullopt;
    const glm::dvec3 out = *point - frame_.originWs;
    const int index = axisOf(handle_);
    return std::atan2(glm::dot(out, frame_.axes[(index + 2) % 3]),
                      glm::dot(out, frame_.axes[(index + 1) % 3]));
}

GizmoChange GizmoDrag::to(const Viewport& viewport, glm::dvec2 px, const GizmoSnap* snap) {
    switch (kind_) {
    case GizmoKind::Move:
        last_ = moved(viewport, px, snap);
        break;
    case GizmoKind::Rotate:
        last_ = turned(viewport, px, snap);
        break;
    case GizmoKind::Scale:
        last_ = scaled(viewport, px, snap);
        break;
    }
    return last_;
}

GizmoChange GizmoDrag::moved(const Viewport& viewport, glm::dvec2 px, const GizmoSnap* snap) {
    GizmoChange change;
    const double step = snap ? snap->moveM : 0.0;
    if (isAxis(handle_)) {
        const std::optional<double> along = alongAxis(viewport, px);
        if (!along) return last_;
        const double moved = snapped(*along - startAlong_, step);
        change.translationWs = moved * frame_.axes[axisOf(handle_)];
        change.label = fmt::format("{} {}", kNames[axisOf(handle_)], signedLength(moved));
        return change;
    }
    const bool plane = isPlane(handle_);
    const int axis = axisOf(handle_);
    const glm::dmat3& axes = plane ? frame_.axes : viewAxes_;
    const std::optional<glm::dvec3> point = onPlane(viewport, px, plane ? axes[axis] : axes[2]);
    if (!point) return last_;
    const int u = plane ? (axis + 1) % 3 : 0, v = plane ? (axis + 2) % 3 : 1;
    const double alongU = snapped(glm::dot(*point - startPoint_, axes[u]), step);
    const double alongV = snapped(glm::dot(*point - startPoint_, axes[v]), step);
    change.translationWs = alongU * axes[u] + alongV * axes[v];
    change.label = fmt::format("{} {}  {} {}", plane ? kNames[u] : "Right", signedLength(alongU),
                               plane ? kNames[v] : "Up", signedLength(alongV));
    return change;
}

GizmoChange GizmoDrag::turned(const Viewport& viewport, glm::dvec2 px, const GizmoSnap* snap) {
    const std::optional<double> angle = angleAt(viewport, px);
    if (!angle) return last_;
    angle_ += wrapped(*angle - lastAngle_);
    lastAngle_ = *angle;
    const double turn = snapped(angle_, snap ? snap->angleRad : 0.0);
    const bool aboutSight = handle_ == GizmoHandle::Center;
    const glm::dvec3 axis =
        aboutSight ? towardsViewer(viewport, frame_.originWs) : frame_.axes[axisOf(handle_)];
    GizmoChange change;
    if (turn != 0.0) change.rotation = glm::angleAxis(turn, axis);
    const double degrees = std::round(glm::degrees(turn) * 10.0) / 10.0;
    change.label = fmt::format("{} {}{:.1f}\u00b0", aboutSight ? "View" : kNames[axisOf(handle_)],
                               degrees < 0.0 ? "\u2212" : "+", std::abs(degrees));
    return change;
}

GizmoChange GizmoDrag::scaled(const Viewport& viewport, glm::dvec2 px, const GizmoSnap* snap) {
    double factor = 1.0;
    if (handle_ == GizmoHandle::Center) {
        const glm::dvec2 moved = px - startPx_;
        factor = std::exp2((moved.x - moved.y) / lengthPx_);
    } else {
        const std::optional<double> along = alongAxis(viewport, px);
        const double least = 0.05 * lengthPx_ * viewport.metresPerPixel(frame_.originWs);
        if (!along || std::abs(startAlong_) < least) return last_;
        factor = *along / startAlong_;
    }
    factor = std::max(snapped(factor, snap ? snap->scale : 0.0), snap ? snap->scale : kLeastFactor);
    GizmoChange change;
    if (handle_ == GizmoHandle::Center) {
        change.scale = glm::dvec3(factor);
    } else {
        change.scale[axisOf(handle_)] = factor;
    }
    change.label = fmt::format("{} \u00d7{:.3f}",
                               handle_ == GizmoHandle::Center ? "Size" : kNames[axisOf(handle_)], factor);
    return change;
}

} // namespace kilolux
