#include "ui/handle_overlay.h"

#include "ui/light_place.h"
#include "ui/panels.h"
#include "ui/properties_state.h"
#include "ui/theme.h"
#include "ui/viewport_tools.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>
#include <nlohmann/json.hpp>

namespace kilolux {

namespace {

constexpr double kGapPx = 16.0, kReachPx = 9.0, kConePx = 160.0;

HandleState& stateOf(Desk& desk) {
    if (!desk.handles) desk.handles = std::make_shared<HandleState>();
    return *desk.handles;
}

ImVec2 im(glm::dvec2 px) {
    return {float(px.x), float(px.y)};
}

void update(Desk& desk, HandleState& state) {
    const Scene& scene = desk.session->scene();
    const LightDef& def = defOf(scene, state.light);
    HandleFrame frame{positionOf(scene, state.light), axesOf(scene, state.light)};
    const double pxM = desk.uiScale * desk.viewport.metresPerPixel(frame.centerWs);
    frame.gapM = kGapPx * pxM;
    frame.coneM = std::min(def.rangeM.value_or(kConePx * pxM), kConePx * pxM);
    state.handles = handlesOf(def, frame);
}

void begin(Desk& desk, HandleState& state) {
    const ImVec2 press = ImGui::GetIO().MouseClickedPos[0];
    endDrag(desk); // whatever was open before is another step
    state.drag.emplace(state.handles[std::size_t(state.hot)], desk.viewport, glm::dvec2(press.x, press.y));
    state.dragStart = desk.session->scene();
    state.key = fmt::format("handle {}", ++state.drags);
    state.px = glm::dvec2(-1e9);
    state.hasDragged = false;
}

void finish(HandleState& state) {
    state.drag.reset();
    state.dragStart = {};
    state.label.clear();
}

void goOn(Desk& desk, HandleState& state) {
    const ImGuiIO& io = ImGui::GetIO();
    const glm::dvec2 px(io.MousePos.x, io.MousePos.y);
    const LightField& row = rowOf(state.drag->handle().field, defOf(desk.session->scene(), state.light).type);
    const bool snaps = io.KeyCtrl != desk.snapping.always, isAngle = row.quantity == Quantity::Angle;
    desk.pointerTaken = true;
    if (px != state.px || snaps != state.snaps) {
        const double step = !snaps    ? 0.0
                            : isAngle ? glm::radians(desk.snapping.angleDeg)
                                      : desk.snapping.moveM;
        const double value = state.drag->to(desk.viewport, px, step);
        state.px = px;
        state.snaps = snaps;
        const std::uint64_t version = desk.session->version();
        const std::uint64_t light[] = {state.light};
        applyEdits(desk,
                   editsForEntry(desk.session->scene(), state.dragStart, light, row,
                                 {ValueEntry::How::Set, value, {}}, sharingOf(desk), OutOfRange::Clamp),
                   fmt::format("{} of 1 light", row.label), state.key);
        if (desk.session->version() != version) state.hasDragged = true;
        const EditField& field = *findLightField(row.field);
        const auto def = std::uint64_t(
            desk.session->scene().lights[std::size_t(findLight(desk.session->scene(), state.light))].def);
        const EditValue now = field.get(desk.session->scene(), def);
        if (const double* number = std::get_if<double>(&now))
            state.label = fmt::format("{} {} {}", row.label, formatQuantity(*number, row.quantity, 4),
                                      unitLabel(row.quantity));
        update(desk, state);
    }
    if (ImGui::IsMouseDown(0)) return;
    endDrag(desk);
    finish(state);
}

void drawLabel(Desk& desk, ImDrawList& canvas, glm::dvec2 dot, const std::string& text) {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const float pad = px(desk, 6);
    const ViewportRect& rect = desk.viewport.rect;
    ImVec2 at{float(dot.x) + px(desk, 16), float(dot.y) + px(desk, 12)};
    at.x = std::min(at.x, float(rect.x + rect.width) - size.x - 2 * pad);
    at.y = std::min(at.y, float(rect.y + rect.height) - size.y - 2 * pad);
    canvas.AddRectFilled({at.x - pad, at.y - pad * 0.5f}, {at.x + size.x + pad, at.y + size.y + pad * 0.5f},
                         IM_COL32(24, 24, 24, 220), px(desk, 3));
    canvas.AddText(at, theme::kText, text.c_str());
}

} // namespace

bool cancelHandleDrag(Desk& desk) {
    HandleState& state = stateOf(desk);
    if (!state.drag) return false;
    if (state.hasDragged) cancelDrag(desk);
    finish(state);
    return true;
}

void drawLightHandles(Desk& desk, ImDrawList& canvas) {
    HandleState& state = stateOf(desk);
    state.hot = -1;
    const GizmoState& tools = viewportTools(desk);
    const std::vector<std::uint64_t>& lights = gizmoPlace(desk).lights;
    if (state.drag && (lights.size() != 1 || lights.front() != state.light)) cancelHandleDrag(desk);
    state.handles.clear();
    // Of one light: numbers of several are changed together in the panel.
    if (lights.size() != 1 || tools.drag) return;
    state.light = lights.front();
    update(desk, state);
    const ImGuiIO& io = ImGui::GetIO();
    const glm::dvec2 mouse(io.MousePos.x, io.MousePos.y);
    if (state.drag) {
        goOn(desk, state);
    } else if (!io.WantCaptureMouse && !desk.pointerTaken && !tools.pressPx && !tools.placing &&
               tools.hot == GizmoHandle::None && desk.viewport.rect.contains(mouse)) {
        const bool pressed = ImGui::IsMouseClicked(0) && !io.KeyAlt;
        const glm::dvec2 at = pressed ? glm::dvec2(io.MouseClickedPos[0].x, io.MouseClickedPos[0].y) : mouse;
        state.hot = handleAt(state.handles, desk.viewport, at, kReachPx * desk.uiScale);
        if (pressed && state.hot >= 0) {
            begin(desk, state);
            goOn(desk, state);
        }
    }
    for (std::size_t i = 0; i < state.handles.size(); ++i) {
        const LightHandle& handle = state.handles[i];
        const bool isDragged = state.drag && state.drag->handle().field == std::string_view(handle.field);
        const auto dot = desk.viewport.project(handle.pointWs());
        if (!dot || (state.drag && !isDragged)) continue;
        const bool isHot = isDragged || int(i) == state.hot;
        const float radius = px(desk, isHot ? 6.5 : 4.0);
        canvas.AddCircleFilled(im(*dot), radius + px(desk, 1.5), IM_COL32(0, 0, 0, 150), 20);
        canvas.AddCircleFilled(im(*dot), radius, isHot ? theme::kText : theme::kAccent, 20);
        if (isDragged) {
            drawLabel(desk, canvas, *dot, state.label);
        } else if (isHot) {
            drawLabel(desk, canvas, *dot,
                      rowOf(handle.field, defOf(desk.session->scene(), state.light).type).label);
        }
    }
}

nlohmann::json handleOverlayState(const Desk& desk) {
    nlohmann::json json = {{"dots", nlohmann::json::object()}};
    if (!desk.handles || !desk.session) return json;
    json["label"] = desk.handles->label;
    json["hot"] = desk.handles->hot >= 0;
    for (const LightHandle& handle : desk.handles->handles)
        if (const auto px = desk.viewport.project(handle.pointWs()))
            json["dots"][handle.field] = {px->x, px->y};
    return json;
}

} // namespace kilolux
