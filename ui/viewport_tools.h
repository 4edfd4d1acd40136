// What the overlays of the viewport remember between frames: outlines, the gizmo's drag, the marquee, adding
// a light. They are drawn by light_outlines.cpp, gizmos.cpp, picking.cpp and add_light.cpp.
#pragma once

#include "ui/desk.h"
#include "ui/gizmo_math.h"
#include "ui/light_color.h"
#include "ui/outline_geometry.h"

struct ImDrawList;

namespace kilolux {

// Where the gizmo stands: the middle of the lights that tools may change, and the axes of the first of them.
// Made again when what it follows from has changed.
struct GizmoPlace {
    std::uint64_t version = 0;
    std::vector<std::uint64_t> selection, locked;
    std::vector<std::uint64_t> lights; // selected and not locked
    glm::dvec3 originWs{0.0};
    glm::dmat3 ownAxes{1.0};
};

struct GizmoState {
    OutlineSet outlines; // made again when the document or where it is seen from has changed
    std::uint64_t outlinesVersion = 0;
    Viewport outlinesViewport;
    double outlinesScale = 0.0;
    LightColors colors;
    std::uint64_t hovered = 0; // light under the pointer; 0: none

    GizmoPlace place;
    GizmoHandle hot = GizmoHandle::None; // under the pointer
    std::optional<GizmoDrag> drag;
    Scene dragStart; // the document when the drag began
    std::vector<std::uint64_t> dragged;
    std::string dragName, dragKey, dragLabel;
    glm::dvec2 dragPx{0.0}; // where the pointer was when the document was changed last
    bool dragSnaps = false;
    bool hasDragged = false; // the newest step is this drag's
    std::uint64_t drags = 0; // so far, for keys of their own

    std::optional<glm::dvec2> pressPx; // on the picture, not yet released
    bool marquee = false;
    glm::dvec2 clickedPx{-1e9}; // the place of the last click: a second one there takes what lies behind

    std::optional<LightType> placing;    // the next click puts one there
    std::optional<glm::dvec2> addMenuPx; // the menu of types is open, for a light at this place
    std::optional<Camera> before;        // looked through a light: the camera to come back to
};

GizmoState& viewportTools(Desk& desk); // made on first use

// Gives a drag of the gizmo up; false: there is none.
bool cancelGizmoDrag(Desk& desk);

// The menu of light types, while it is open.
void drawAddMenu(Desk& desk);

const GizmoPlace& gizmoPlace(const Desk& desk); // brought up to date

} // namespace kilolux
