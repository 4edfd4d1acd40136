#include "ui/handle_overlay.h"

#include "ui/light_actions.h"
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

// More would hide the picture.
constexpr std::size_t kMostLights = 16;

// What several lights can be changed in together: what all of them have.
void update(Desk& desk, HandleState& state) {
    const Scene& scene = desk.session->scene();
    const std::vector<std::uint64_t>& lights = gizmoPlace(desk).lights;
    const DoorNumbers doors = doorNumbers(desk, lights);
    state.handles.clear();
    if (lights.size() > kMostLights) return;
    for (const std::uint64_t light : lights) {
        const LightDef& def = defOf(scene, light);
        HandleFrame frame{positionOf(scene, light), axesOf(scene, light)};
        const double pxM = desk.uiScale * desk.viewport.metresPerPixel(frame.centerWs);
        frame.gapM = kGapPx * pxM;
        frame.coneM = std::min(def.rangeM.value_or(kConePx * pxM), kConePx * pxM);
        for (LightHandle& handle : handlesOf(def, frame, doors)) {
            if (!allHave(scene, lights, rowOf(handle.field, def.type))) continue;
            handle.light = light;
            state.handles.push_back(handle);
        }
    }
}

void begin(Desk& desk, HandleState& state) {
    const ImVec2 press = ImGui::GetIO().MouseClickedPos[0];
    endDrag(desk); // whatever was open before is another step
    state.drag.emplace(state.handles[std::size_t(state.hot)], desk.viewport, glm::dvec2(press.x, press.y));
    state.dragStart = desk.session->scene();
    state.dragged = gizmoPlace(desk).lights;
    state.key = fmt::format("handle {}", ++state.drags);
    state.px = glm::dvec2(-1e9);
    state.hasDragged = false;
}

void finish(HandleState& state) {
    state.drag.reset();
    state.dragStart = {};
    state.dragged.clear();
    state.label.clear();
}

// The value under the pointer for the dragged light, and for the others as much more or less.
Result<Edits> editsOf(const Desk& desk, const HandleState& state, const LightField& row, double value) {
    const Scene& scene = desk.session->scene();
    if (state.dragged.size() == 1) {
        return editsForEntry(scene, state.dragStart, state.dragged, row, {ValueEntry::How::Set, value, {}},
                             sharingOf(desk), OutOfRange::Clamp);
    }
    std::vector<std::uint64_t> lights; // a light without a range keeps none
    for (const std::uint64_t light : state.dragged) {
        const EditValue start = commonValue(state.dragStart, {&light, 1}, row.field).value;
        if (std::holds_alternative<double>(start)) lights.push_back(light);
    }
    return editsForEntry(scene, state.dragStart, lights, row,
                         {ValueEntry::How::Add, value - state.drag->handle().value, {}}, sharingOf(desk),
                         OutOfRange::Clamp);
}

std::string labelOf(const Desk& desk, const HandleState& state, const LightField& row) {
    const std::uint64_t light = state.drag->handle().light;
    const EditValue now = commonValue(desk.session->scene(), {&light, 1}, row.field).value;
    const double* number = std::get_if<double>(&now);
    if (!number) return "";
    std::string text =
        fmt::format("{} {} {}", row.label, formatQuantity(*number, row.quantity, 4), unitLabel(row.quantity));
    if (state.dragged.size() > 1) {
        text += fmt::format(", {}{} for {}", *number < state.drag->handle().value ? "" : "+",
                            formatQuantity(*number - state.drag->handle().value, row.quantity, 3),
                            countedLights(state.dragged.size()));
    }
    return text;
}

void goOn(Desk& desk, HandleState& state) {
    const ImGuiIO& io = ImGui::GetIO();
    const glm::dvec2 px(io.MousePos.x, io.MousePos.y);
    const LightHandle& handle = state.drag->handle();
    const LightField& row = rowOf(handle.field, defOf(desk.session->scene(), handle.light).type);
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
        applyEdits(desk, editsOf(desk, state, row, value),
                   fmt::format("{} of {}", row.label, countedLights(state.dragged.size())), state.key);
        if (desk.session->version() != version) state.hasDragged = true;
        state.label = labelOf(desk, state, row);
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

void drawDot(Desk& desk, ImDrawList& canvas, const HandleState& state, int index) {
    const LightHandle& handle = state.handles[std::size_t(index)];
    const bool isDragged = state.drag && state.drag->handle().light == handle.light &&
                           state.drag->handle().field == std::string_view(handle.field);
    const auto dot = desk.viewport.project(handle.pointWs());
    if (!dot || (state.drag && !isDragged)) return;
    const bool isHot = isDragged || index == state.hot;
    const float radius = px(desk, isHot ? 6.5 : 4.0);
    canvas.AddCircleFilled(im(*dot), radius + px(desk, 1.5), IM_COL32(0, 0, 0, 150), 20);
    canvas.AddCircleFilled(im(*dot), radius, isHot ? theme::kText : theme::kAccent, 20);
    if (isDragged) {
        drawLabel(desk, canvas, *dot, state.label);
    } else if (isHot) {
        const LightType type = defOf(desk.session->scene(), handle.light).type;
        drawLabel(desk, canvas, *dot, rowOf(handle.field, type).label);
    }
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
    if (state.drag && lights != state.dragged) cancelHandleDrag(desk);
    state.handles.clear();
    if (lights.empty() || tools.drag || !desk.panels.gizmos) return;
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
    for (std::size_t i = 0; i < state.handles.size(); ++i)
        drawDot(desk, canvas, state, int(i));
}

nlohmann::json handleOverlayState(const Desk& desk) {
    nlohmann::json json = {{"dots", nlohmann::json::object()}};
    if (!desk.handles || !desk.session) return json;
    json["label"] = desk.handles->label;
    json["hot"] = desk.handles->hot >= 0;
    const std::vector<LightHandle>& handles = desk.handles->handles;
    const bool several = !handles.empty() && handles.front().light != handles.back().light;
    for (const LightHandle& handle : handles) {
        const std::string name =
            several ? fmt::format("{}.{}", handle.light, handle.field) : std::string(handle.field);
        if (const auto px = desk.viewport.project(handle.pointWs())) json["dots"][name] = {px->x, px->y};
    }
    return json;
}

} // namespace kilolux
