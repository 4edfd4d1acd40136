// Handles to move, turn and scale what is selected: where they stand, which one the pointer is over, and what
// dragging one from here to there means. In pixels of the window and metres of the scene; draws nothing.
#pragma once

#include "ui/viewport.h"

#include <array>
#include <string>
#include <vector>

namespace kilolux {

// As Tool and GizmoSpace of the desk.
enum class GizmoKind : std::uint8_t { Move, Rotate, Scale };

enum class GizmoHandle : std::uint8_t {
    None,
    X,
    Y,
    Z,
    PlaneYZ, // two axes at once, named in the order of the axis that they leave out
    PlaneZX,
    PlaneXY,
    Center // moves along the picture, turns about the line of sight, scales all alike
};

struct GizmoFrame {
    glm::dvec3 originWs{0.0};
    glm::dmat3 axes{1.0}; // columns, unit length
};

struct GizmoSize {
    double lengthPx = 88.0; // of an arrow
    double reachPx = 8.0;   // how far from a handle the pointer may be
};

// Parts of the arrow's length.
inline constexpr double kPlaneFrom = 0.24, kPlaneTo = 0.42, kRing = 0.9, kViewRing = 1.12;
inline constexpr double kCenterPx = 7.0; // of 88

// An arrow that points at the viewer, or a plane seen from its edge, would throw things far off: it is left
// out.
bool isUsable(GizmoKind kind, GizmoHandle handle, const GizmoFrame& frame, const Viewport& viewport);

// The axis of an axis, ring or plane handle.
int axisOf(GizmoHandle handle);

// Points of a ring about an axis; the half that faces away from the viewer is marked. Center: about the line
// of sight.
struct RingPoint {
    glm::dvec3 pointWs;
    bool facesAway;
};
std::vector<RingPoint> ringPoints(GizmoHandle handle, const GizmoFrame& frame, const Viewport& viewport,
                                  double lengthPx);

GizmoHandle handleAt(GizmoKind kind, const GizmoFrame& frame, const Viewport& viewport, glm::dvec2 px,
                     const GizmoSize& size);

struct GizmoSnap {
    double moveM = 0.1;
    double angleRad = 0.0872664625997165; // 5 degrees
    double scale = 0.1;
};

// What the drag comes to since it began; one of the three is set, by the kind.
struct GizmoChange {
    glm::dvec3 translationWs{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0}; // w, x, y, z; about the frame's origin
    glm::dvec3 scale{1.0};                   // along the light's own axes
    std::string label;                       // 'X +1.25 m'
};

class GizmoDrag {
  public:
    GizmoDrag(GizmoKind kind, GizmoHandle handle, const GizmoFrame& frame, const Viewport& viewport,
              glm::dvec2 startPx, double lengthPx);

    // `snap`: null moves freely.
    GizmoChange to(const Viewport& viewport, glm::dvec2 px, const GizmoSnap* snap);

    GizmoKind kind() const { return kind_; }
    GizmoHandle handle() const { return handle_; }
    const GizmoFrame& frame() const { return frame_; }

  private:
    GizmoChange moved(const Viewport& viewport, glm::dvec2 px, const GizmoSnap* snap);
    GizmoChange turned(const Viewport& viewport, glm::dvec2 px, const GizmoSnap* snap);
    GizmoChange scaled(const Viewport& viewport, glm::dvec2 px, const GizmoSnap* snap);
    std::optional<double> alongAxis(const Viewport& viewport, glm::dvec2 px) const;
    std::optional<glm::dvec3> onPlane(const Viewport& viewport, glm::dvec2 px,
                                      const glm::dvec3& normal) const;
    std::optional<double> angleAt(const Viewport& viewport, glm::dvec2 px) const;

    GizmoKind kind_;
    GizmoHandle handle_;
    GizmoFrame frame_;
    glm::dvec2 startPx_;
    double lengthPx_;
    glm::dmat3 viewAxes_{1.0}; // right, up, towards the viewer
    double startAlong_ = 0.0;  // metres
    glm::dvec3 startPoint_{0.0};
    double lastAngle_ = 0.0, angle_ = 0.0; // radians; `angle_` counts whole turns
    GizmoChange last_;                     // kept where the pointer leaves what can be reached
};

} // namespace kilolux
