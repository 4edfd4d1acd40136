// What the overlays of the viewport remember between frames: outlines, the gizmo's drag, the marquee, adding
// a light. They are drawn by light_outlines.cpp, gizmos.cpp, picking.cpp and add_light.cpp.
#pragma once

#include "ui/desk.h"
#include "ui/gizmo_math.h"
#include "ui/light_color.h"
#include "ui/outline_geometry.h"

struct ImDrawList;

namespace kilolux {

struct GizmoState {
    OutlineSet outlines; // of the frame being drawn
    LightColors colors;
    std::uint64_t hovered = 0; // light under the pointer; 0: none

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

// Lights of the selection that are not locked: those that tools may change.
std::vector<std::uint64_t> unlockedSelection(const Desk& desk);

} // namespace kilolux
