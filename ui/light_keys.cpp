// The keys of keys.h for tools and lights.
#include "ui/handle_overlay.h"
#include "ui/keys.h"
#include "ui/light_commands.h"
#include "ui/light_list_state.h"
#include "ui/panels.h"
#include "ui/probe_panel.h"
#include "ui/properties_state.h"
#include "ui/viewport_tools.h"
#include "ui/widgets.h"

#include <algorithm>
#include <imgui.h>

namespace kilolux {

namespace {

constexpr double kGizmoStep = 1.25;

void selectAll(Desk& desk) {
    std::vector<std::uint64_t> all;
    for (const LightNode& light : desk.session->scene().lights)
        all.push_back(light.id);
    select(desk, all);
}

// The innermost thing that can be given up.
void cancel(Desk& desk) {
    GizmoState& state = viewportTools(desk);
    if (cancelGizmoDrag(desk) || cancelHandleDrag(desk) || cancelPropertyDrag(desk) || cancelProbePick(desk))
        return;
    if (state.pressPx || state.placing || state.addMenuPx) {
        state.pressPx.reset();
        state.placing.reset();
        state.addMenuPx.reset();
        return;
    }
    select(desk, {});
}

void act(Desk& desk, KeyAction action) {
    GizmoState& state = viewportTools(desk);
    switch (action) {
    case KeyAction::SelectTool:
        desk.tool = Tool::Select;
        break;
    case KeyAction::MoveTool:
        desk.tool = Tool::Move;
        break;
    case KeyAction::RotateTool:
        desk.tool = Tool::Rotate;
        break;
    case KeyAction::ScaleTool:
        desk.tool = Tool::Scale;
        break;
    case KeyAction::ToggleSpace:
        desk.space = desk.space == GizmoSpace::World ? GizmoSpace::Local : GizmoSpace::World;
        break;
    case KeyAction::LargerGizmo:
        desk.gizmoSizePx = std::min(desk.gizmoSizePx * kGizmoStep, kGizmoSizePx.most);
        break;
    case KeyAction::SmallerGizmo:
        desk.gizmoSizePx = std::max(desk.gizmoSizePx / kGizmoStep, kGizmoSizePx.least);
        break;
    case KeyAction::ToggleGizmos:
        desk.panels.gizmos = !desk.panels.gizmos;
        break;
    case KeyAction::Cancel:
        cancel(desk);
        break;
    case KeyAction::Mute:
        toggleMute(desk, desk.selection);
        break;
    case KeyAction::Solo:
        toggleSolo(desk, desk.selection);
        break;
    case KeyAction::LookThrough:
        lookThroughLight(desk);
        break;
    case KeyAction::Duplicate:
        duplicateSelection(desk);
        break;
    case KeyAction::Delete:
        deleteSelection(desk);
        break;
    case KeyAction::Copy:
        copySelection(desk);
        break;
    case KeyAction::Cut:
        cutSelection(desk);
        break;
    case KeyAction::Paste:
        pasteLights(desk);
        break;
    case KeyAction::SelectAll:
        selectAll(desk);
        break;
    case KeyAction::Group:
        groupSelection(desk);
        break;
    case KeyAction::Ungroup:
        ungroupSelection(desk);
        break;
    case KeyAction::AddMenu: {
        const ImVec2 mouse = ImGui::GetIO().MousePos;
        if (desk.viewport.rect.contains({mouse.x, mouse.y})) state.addMenuPx = {mouse.x, mouse.y};
        break;
    }
    case KeyAction::Rename:
        if (!desk.selection.empty()) beginRename(desk, LightRow::Kind::Light, desk.selection.front());
        break;
    case KeyAction::None:
        break;
    }
}

} // namespace

void handleLightKeys(Desk& desk) {
    const ImGuiIO& io = ImGui::GetIO();
    if (desk.flying || isPopupOpen()) return; // letters fly; menus take their own
    const bool dragging = viewportTools(desk).drag || !propertiesOf(desk).dragging.empty();
    for (const KeyRow& row : keyRows()) {
        if (row.action == KeyAction::None || actionOf(row.key, io.KeyCtrl, io.KeyShift) != row.action)
            continue;
        // While something is dragged only giving it up makes sense.
        if (dragging && row.action != KeyAction::Cancel) continue;
        if (ImGui::IsKeyPressed(row.key, false)) act(desk, row.action);
    }
    // Esc with Ctrl held, as when a snapped drag is given up.
    if (dragging && io.KeyCtrl && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false))
        cancel(desk);
}

} // namespace kilolux
