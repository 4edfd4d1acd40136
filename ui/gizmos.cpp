// The gizmo of the selection: drawn at a constant size, dragged with one undo step per drag. The maths is
// gizmo_math's.
#include "ui/light_actions.h"
#include "ui/light_fields.h"
#include "ui/light_place.h"
#include "ui/panels.h"
#include "ui/properties_state.h"
#include "ui/theme.h"
#include "ui/viewport_tools.h"
#include "ui/widgets.h"

#include <algorithm>
#include <fmt/format.h>
#include <glm/gtc/constants.hpp>
#include <imgui.h>
#include <nlohmann/json.hpp>

namespace kilolux {

namespace {

// Red, green, blue, desaturated; grey for what has no axis.
constexpr ImU32 kAxisColors[] = {IM_COL32(216, 96, 88, 255), IM_COL32(124, 184, 92, 255),
                                 IM_COL32(96, 144, 216, 255)};
constexpr ImU32 kCenterColor = IM_COL32(219, 219, 219, 255);
constexpr GizmoHandle kHandles[] = {GizmoHandle::PlaneYZ, GizmoHandle::PlaneZX, GizmoHandle::PlaneXY,
                                    GizmoHandle::X,       GizmoHandle::Y,       GizmoHandle::Z,
                                    GizmoHandle::Center};

ImVec2 im(glm::dvec2 px) {
    return {float(px.x), float(px.y)};
}

std::optional<GizmoKind> kindOf(Tool tool) {
    switch (tool) {
    case Tool::Move:
        return GizmoKind::Move;
    case Tool::Rotate:
        return GizmoKind::Rotate;
    case Tool::Scale:
        return GizmoKind::Scale;
    case Tool::Select:
        break;
    }
    return std::nullopt;
}

// Sizes are scaled along the lights' own axes, whatever the space.
GizmoFrame frameOf(const Desk& desk, const GizmoPlace& place, GizmoKind kind) {
    GizmoFrame frame;
    frame.originWs = place.originWs;
    if (kind == GizmoKind::Scale || desk.space == GizmoSpace::Local) {
        frame.axes = place.ownAxes;
    } else if (desk.space == GizmoSpace::View) {
        frame.axes = glm::dmat3(desk.viewport.camera.worldFromCamera);
    }
    return frame;
}

void beginDrag(Desk& desk, GizmoState& state, GizmoKind kind, const GizmoFrame& frame, double lengthPx) {
    constexpr const char* kVerbs[] = {"Move", "Rotate", "Scale"};
    const ImVec2 press = ImGui::GetIO().MouseClickedPos[0];
    endDrag(desk); // whatever was open before is another step
    state.drag.emplace(kind, state.hot, frame, desk.viewport, glm::dvec2(press.x, press.y), lengthPx);
    state.dragStart = desk.session->scene();
    state.dragged = gizmoPlace(desk).lights;
    state.dragName = fmt::format("{} {}", kVerbs[int(kind)], countedLights(state.dragged.size()));
    state.dragKey = fmt::format("gizmo {}", ++state.drags);
    state.dragLabel.clear();
    state.dragPx = {press.x, press.y};
    state.dragSnaps = false;
    state.hasDragged = false;
}

Result<Edits> editsOf(const Desk& desk, const GizmoState& state, const GizmoChange& change) {
    const Scene& scene = desk.session->scene();
    if (state.drag->kind() == GizmoKind::Scale)
        return editsForSize(scene, state.dragStart, state.dragged, change.scale, sharingOf(desk));
    // In their own space several lights turn each about itself.
    if (state.drag->kind() == GizmoKind::Rotate && desk.space == GizmoSpace::Local)
        return editsForTurns(scene, state.dragStart, state.dragged, change.rotation);
    return editsForMotion(scene, state.dragStart, state.dragged,
                          {change.rotation, state.drag->frame().originWs, change.translationWs});
}

void continueDrag(Desk& desk, GizmoState& state) {
    const ImGuiIO& io = ImGui::GetIO();
    const glm::dvec2 px(io.MousePos.x, io.MousePos.y);
    const bool snaps = io.KeyCtrl != desk.snapping.always;
    desk.pointerTaken = true;
    if (px != state.dragPx || snaps != state.dragSnaps) {
        const GizmoSnap snap{desk.snapping.moveM, glm::radians(desk.snapping.angleDeg), desk.snapping.scale};
        const GizmoChange change = state.drag->to(desk.viewport, px, snaps ? &snap : nullptr);
        state.dragPx = px;
        state.dragSnaps = snaps;
        state.dragLabel = change.label;
        const std::uint64_t before = desk.session->version();
        applyEdits(desk, editsOf(desk, state, change), state.dragName, state.dragKey);
        if (desk.session->version() != before) state.hasDragged = true;
    }
    if (ImGui::IsMouseDown(0)) return;
    endDrag(desk);
    state.drag.reset();
    state.dragStart = {};
}

// ---------------------------------------------------------------------------------------------------------
// Drawing

struct Pen {
    ImDrawList& canvas;
    const Viewport& viewport;
    GizmoFrame frame;
    double lengthPx;
    double scale;

    glm::dvec3 along(const glm::dvec3& parts) const {
        return frame.originWs + lengthPx * viewport.metresPerPixel(frame.originWs) * (frame.axes * parts);
    }
};

ImU32 colorOf(GizmoHandle handle, bool hot) {
    if (hot) return theme::kAccent;
    return handle == GizmoHandle::Center ? kCenterColor : kAxisColors[axisOf(handle)];
}

void drawArrow(const Pen& pen, GizmoKind kind, GizmoHandle handle, bool hot) {
    glm::dvec3 parts(0.0);
    parts[axisOf(handle)] = 1.0;
    const auto from = pen.viewport.project(pen.along(parts * 0.14)),
               to = pen.viewport.project(pen.along(parts));
    if (!from || !to) return;
    const ImU32 color = colorOf(handle, hot);
    pen.canvas.AddLine(im(*from), im(*to), color, float(2.0 * pen.scale));
    const float radius = float((hot ? 7.0 : 5.0) * pen.scale);
    const ImVec2 end = im(*to);
    if (kind == GizmoKind::Scale) {
        pen.canvas.AddRectFilled({end.x - radius, end.y - radius}, {end.x + radius, end.y + radius}, color);
    } else {
        pen.canvas.AddCircleFilled(end, radius, color);
    }
}

void drawPlane(const Pen& pen, GizmoHandle handle, bool hot) {
    const int axis = axisOf(handle);
    ImVec2 corners[4];
    const glm::dvec2 parts[] = {
        {kPlaneFrom, kPlaneFrom}, {kPlaneTo, kPlaneFrom}, {kPlaneTo, kPlaneTo}, {kPlaneFrom, kPlaneTo}};
    for (int i = 0; i < 4; ++i) {
        glm::dvec3 at(0.0);
        at[(axis + 1) % 3] = parts[i].x;
        at[(axis + 2) % 3] = parts[i].y;
        const auto px = pen.viewport.project(pen.along(at));
        if (!px) return;
        corners[i] = im(*px);
    }
    const ImU32 color = colorOf(handle, hot);
    const ImU32 faint = (color & 0x00ffffffu) | (hot ? 0x90000000u : 0x50000000u);
    pen.canvas.AddQuadFilled(corners[0], corners[1], corners[2], corners[3], faint);
    pen.canvas.AddQuad(corners[0], corners[1], corners[2], corners[3], color, float(pen.scale));
}

void drawRing(const Pen& pen, GizmoHandle handle, bool hot) {
    const std::vector<RingPoint> points = ringPoints(handle, pen.frame, pen.viewport, pen.lengthPx);
    const ImU32 color = colorOf(handle, hot);
    const ImU32 faint = (color & 0x00ffffffu) | 0x38000000u;
    const bool isView = handle == GizmoHandle::Center;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const RingPoint &a = points[i], &b = points[(i + 1) % points.size()];
        const auto segment = pen.viewport.project(a.pointWs, b.pointWs);
        if (!segment) continue;
        const bool away = a.facesAway || b.facesAway;
        const double width = hot ? 3.0 : isView ? 1.2 : 2.0;
        pen.canvas.AddLine(im(segment->from), im(segment->to), away ? faint : color,
                           float(width * pen.scale));
    }
}

void drawHandle(const Pen& pen, GizmoKind kind, GizmoHandle handle, bool hot) {
    if (!isUsable(kind, handle, pen.frame, pen.viewport)) return;
    if (kind == GizmoKind::Rotate) return drawRing(pen, handle, hot);
    if (handle != GizmoHandle::Center) {
        const bool isPlane = handle >= GizmoHandle::PlaneYZ;
        return isPlane ? drawPlane(pen, handle, hot) : drawArrow(pen, kind, handle, hot);
    }
    const auto center = pen.viewport.project(pen.frame.originWs);
    if (!center) return;
    const float radius = float((hot ? 1.25 : 1.0) * kCenterPx / 88.0 * pen.lengthPx);
    pen.canvas.AddCircle(im(*center), radius, colorOf(handle, hot), 24, float(1.6 * pen.scale));
}

// The value beside the pointer while it is dragged.
void drawLabel(Desk& desk, ImDrawList& canvas, const std::string& text) {
    if (text.empty()) return;
    const ImVec2 mouse = ImGui::GetIO().MousePos, size = ImGui::CalcTextSize(text.c_str());
    const float pad = px(desk, 6);
    const ViewportRect& rect = desk.viewport.rect;
    ImVec2 at{mouse.x + px(desk, 20), mouse.y + px(desk, 16)};
    at.x = std::min(at.x, float(rect.x + rect.width) - size.x - 2 * pad);
    at.y = std::min(at.y, float(rect.y + rect.height) - size.y - 2 * pad);
    canvas.AddRectFilled({at.x - pad, at.y - pad * 0.5f}, {at.x + size.x + pad, at.y + size.y + pad * 0.5f},
                         IM_COL32(24, 24, 24, 220), px(desk, 3));
    canvas.AddText(at, theme::kText, text.c_str());
}

} // namespace

GizmoState& viewportTools(Desk& desk) {
    if (!desk.gizmo) desk.gizmo = std::make_shared<GizmoState>();
    return *desk.gizmo;
}

const GizmoPlace& gizmoPlace(const Desk& desk) {
    GizmoPlace& place = desk.gizmo->place;
    const bool same = place.version == desk.session->version() && place.selection == desk.selection &&
                      place.locked == desk.locked;
    if (same) return place;
    place = {desk.session->version(), desk.selection, desk.locked, {}};
    std::set_difference(desk.selection.begin(), desk.selection.end(), desk.locked.begin(), desk.locked.end(),
                        std::back_inserter(place.lights));
    const Scene& scene = desk.session->scene();
    for (const std::uint64_t light : place.lights)
        place.originWs += positionOf(scene, light) / double(place.lights.size());
    if (!place.lights.empty()) place.ownAxes = axesOf(scene, place.lights.front());
    return place;
}

bool cancelGizmoDrag(Desk& desk) {
    GizmoState& state = viewportTools(desk);
    if (!state.drag) return false;
    if (state.hasDragged) cancelDrag(desk);
    state.drag.reset();
    state.dragStart = {};
    return true;
}

void drawGizmos(Desk& desk, ImDrawList& canvas) {
    GizmoState& state = viewportTools(desk);
    const std::optional<GizmoKind> kind = kindOf(desk.tool);
    state.hot = GizmoHandle::None;
    if (state.drag && gizmoPlace(desk).lights.empty()) cancelGizmoDrag(desk); // undone while it was dragged
    if (!kind || gizmoPlace(desk).lights.empty() || !desk.panels.gizmos) return;
    const double lengthPx = desk.gizmoSizePx * desk.uiScale;
    const ImGuiIO& io = ImGui::GetIO();
    const glm::dvec2 mouse(io.MousePos.x, io.MousePos.y);
    if (state.drag) {
        continueDrag(desk, state);
    } else if (!io.WantCaptureMouse && !desk.pointerTaken && !state.pressPx && !state.placing &&
               desk.viewport.rect.contains(mouse)) {
        const GizmoFrame frame = frameOf(desk, gizmoPlace(desk), *kind);
        // At the press: what is clicked is where the pointer was then.
        const bool pressed = ImGui::IsMouseClicked(0) && !io.KeyAlt;
        const glm::dvec2 at = pressed ? glm::dvec2(io.MouseClickedPos[0].x, io.MouseClickedPos[0].y) : mouse;
        state.hot = handleAt(*kind, frame, desk.viewport, at, {lengthPx, 8.0 * desk.uiScale});
        if (pressed && state.hot != GizmoHandle::None) {
            beginDrag(desk, state, *kind, frame, lengthPx);
            continueDrag(desk, state);
        }
    }
    const GizmoHandle active = state.drag ? state.drag->handle() : GizmoHandle::None;
    if (gizmoPlace(desk).lights.empty()) return; // an edit of the drag may have taken them
    const GizmoFrame frame = frameOf(desk, gizmoPlace(desk), *kind);
    if (desk.viewport.depthM(frame.originWs) < desk.viewport.camera.znearM) return;
    const Pen pen{canvas, desk.viewport, frame, lengthPx, desk.uiScale};
    for (const GizmoHandle handle : kHandles) {
        if (active != GizmoHandle::None && handle != active) continue;
        drawHandle(pen, *kind, handle, handle == state.hot || handle == active);
    }
    if (state.drag) drawLabel(desk, canvas, state.dragLabel);
}

nlohmann::json gizmoState(const Desk& desk) {
    nlohmann::json json = nlohmann::json::object();
    if (!desk.gizmo || !desk.session) return json;
    const GizmoState& state = *desk.gizmo;
    json["dragging"] = state.drag.has_value();
    json["label"] = state.dragLabel;
    json["hot"] = int(state.hot);
    json["outlines"] = state.outlines.outlines().size();
    const std::optional<GizmoKind> kind = kindOf(desk.tool);
    const GizmoPlace& place = gizmoPlace(desk);
    if (!kind || place.lights.empty() || !desk.panels.gizmos) return json;
    // Where a test finds each handle.
    const GizmoFrame frame = frameOf(desk, place, *kind);
    const double lengthM = desk.gizmoSizePx * desk.uiScale * desk.viewport.metresPerPixel(frame.originWs);
    const auto put = [&](const char* name, const glm::dvec3& point) {
        if (const auto px = desk.viewport.project(point)) json["handles"][name] = {px->x, px->y};
    };
    constexpr const char* kNames[] = {"x", "y", "z"};
    for (int axis = 0; axis < 3; ++axis) {
        if (*kind == GizmoKind::Rotate) {
            const auto ring =
                ringPoints(GizmoHandle(axis + 1), frame, desk.viewport, desk.gizmoSizePx * desk.uiScale);
            const auto near =
                std::find_if(ring.begin(), ring.end(), [](const RingPoint& p) { return !p.facesAway; });
            if (near != ring.end()) put(kNames[axis], near->pointWs);
        } else {
            put(kNames[axis], frame.originWs + lengthM * frame.axes[axis]);
        }
    }
    put("center", frame.originWs);
    return json;
}

} // namespace kilolux
