// The bar above: file, undo, tools, snapping, exposure, views, panels.
#include "ui/file_tasks.h"
#include "ui/panels.h"
#include "ui/theme.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>
#include <string>

namespace kilolux {

namespace {

void gap(Desk& desk) {
    ImGui::SameLine(0, px(desk, 16));
}

void drawFile(Desk& desk) {
    if (iconButton(desk, "top.open", theme::kOpen, "Open (Ctrl+O)")) askToOpen(desk);
    ImGui::SameLine();
    const bool unsaved = desk.session && desk.session->hasUnsavedChanges();
    const ButtonLook look = !desk.session ? ButtonLook::Disabled
                            : unsaved     ? ButtonLook::Active
                                          : ButtonLook::Plain;
    if (iconButton(desk, "top.save", theme::kSave, "Save (Ctrl+S), under another name (Ctrl+Shift+S)", look))
        saveScene(desk);
}

void drawHistory(Desk& desk) {
    const History* history = desk.session ? &desk.session->history() : nullptr;
    const bool canUndo = history && history->canUndo(), canRedo = history && history->canRedo();
    const std::string undoTip =
        canUndo ? fmt::format("Undo '{}' (Ctrl+Z)", history->undoName()) : "Nothing to undo";
    const std::string redoTip =
        canRedo ? fmt::format("Redo '{}' (Ctrl+Shift+Z)", history->redoName()) : "Nothing to redo";
    const auto look = [](bool can) { return can ? ButtonLook::Plain : ButtonLook::Disabled; };
    if (iconButton(desk, "top.undo", theme::kUndo, undoTip.c_str(), look(canUndo))) undo(desk);
    ImGui::SameLine();
    if (iconButton(desk, "top.redo", theme::kRedo, redoTip.c_str(), look(canRedo))) redo(desk);
}

void drawTools(Desk& desk) {
    struct Row {
        Tool tool;
        const char *name, *icon, *tip;
    };
    constexpr Row kRows[] = {{Tool::Select, "top.select", theme::kSelect, "Select (Q)"},
                             {Tool::Move, "top.move", theme::kMove, "Move (W)"},
                             {Tool::Rotate, "top.rotate", theme::kRotate, "Rotate (E)"},
                             {Tool::Scale, "top.scale", theme::kScale, "Scale (R)"}};
    for (const Row& row : kRows) {
        if (&row != kRows) ImGui::SameLine();
        const ButtonLook look = row.tool == desk.tool ? ButtonLook::Active : ButtonLook::Plain;
        if (iconButton(desk, row.name, row.icon, row.tip, look)) desk.tool = row.tool;
    }
}

void drawSpace(Desk& desk) {
    constexpr const char* kNames[] = {"World", "Local", "View"};
    ImGui::SetNextItemWidth(px(desk, 92));
    const bool open = beginCombo("##space", kNames[int(desk.space)]);
    for (int space = 0; open && space < 3; ++space) {
        if (ImGui::Selectable(kNames[space], space == int(desk.space))) desk.space = GizmoSpace(space);
        mark(desk, std::string("space.") + kNames[space]);
    }
    if (open) ImGui::EndCombo();
    mark(desk, "top.space");
    if (!open) tooltip("Axes of the gizmo (X: world or local)");
    ImGui::SameLine();
    const ButtonLook look = desk.snapping.always ? ButtonLook::Active : ButtonLook::Plain;
    if (iconButton(desk, "top.snap", theme::kSnap, "Snap always (hold Ctrl to snap once)", look))
        desk.snapping.always = !desk.snapping.always;
}

void drawExposure(Desk& desk) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("EV");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(px(desk, 72));
    float ev = float(desk.exposureEv100);
    if (ImGui::DragFloat("##exposure", &ev, 0.02f, -30.0f, 40.0f, "%.2f", ImGuiSliderFlags_AlwaysClamp))
        setExposure(desk, double(ev));
    mark(desk, "top.exposure");
    if (ImGui::IsItemDeactivated()) endDrag(desk);
    tooltip("Exposure, EV100: drag, or double-click to type");
}

void drawPanels(Desk& desk) {
    const auto toggle = [&](const char* name, const char* icon, const char* tip, bool& shown) {
        ImGui::SameLine();
        if (iconButton(desk, name, icon, tip, shown ? ButtonLook::Active : ButtonLook::Plain)) shown = !shown;
    };
    ImGui::NewLine();
    ImGui::SameLine(0, 0);
    toggle("top.gizmos", theme::kGizmos, "Gizmo and dots of the selected lights (G)", desk.panels.gizmos);
    toggle("top.outlines", theme::kLight, "Outlines of lights", desk.panels.outlines);
    toggle("top.lights", theme::kGroup, "Column of lights", desk.panels.lights);
    toggle("top.properties", theme::kSliders, "Column of properties", desk.panels.properties);
}

} // namespace

void drawTopBar(Desk& desk) {
    // Controls are set in the middle of the bar; groups without room are left out, the least needed first.
    ImGui::SetCursorPosY(0.5f * (ImGui::GetWindowHeight() - ImGui::GetFrameHeight()));
    const float width = ImGui::GetWindowWidth();
    drawFile(desk);
    gap(desk);
    drawHistory(desk);
    if (width > px(desk, 340)) gap(desk), drawTools(desk);
    if (width > px(desk, 520)) gap(desk), drawSpace(desk);
    if (!desk.session) return;
    if (width > px(desk, 660)) gap(desk), drawExposure(desk);
    if (width > px(desk, 720)) gap(desk), drawCameraMenu(desk);
    if (width < px(desk, 852)) return;
    ImGui::SameLine(width - px(desk, 152));
    drawPanels(desk);
}

} // namespace kilolux
