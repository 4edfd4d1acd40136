// The overlay with every key (F1), from the table of keys.h.
#include "ui/keys.h"
#include "ui/panels.h"
#include "ui/theme.h"
#include "ui/widgets.h"

#include <imgui.h>

namespace kilolux {

namespace {

void drawGroup(Desk& desk, KeyGroup group) {
    ImGui::TextColored(ImColor(theme::kAccent), "%s", nameOf(group));
    for (const KeyRow& row : keyRows()) {
        if (row.group != group) continue;
        const float x = ImGui::GetCursorPosX();
        ImGui::TextUnformatted(row.keys);
        ImGui::SameLine();
        ImGui::SetCursorPosX(x + px(desk, 152));
        ImGui::TextDisabled("%s", row.what);
    }
    ImGui::Dummy({0, px(desk, 8)});
}

} // namespace

void drawKeysHelp(Desk& desk) {
    if (!desk.showsHelp) return;
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * window.x, 0.5f * window.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {window.x - px(desk, 32), window.y - px(desk, 32)});
    ImGui::SetNextWindowFocus();
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_PopupBg));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(px(desk, 24), px(desk, 20)));
    ImGui::Begin("keys", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::BeginGroup();
    for (const KeyGroup group : {KeyGroup::File, KeyGroup::Tools, KeyGroup::Camera})
        drawGroup(desk, group);
    ImGui::EndGroup();
    ImGui::SameLine(0, px(desk, 32));
    ImGui::BeginGroup();
    for (const KeyGroup group : {KeyGroup::Lights, KeyGroup::Views, KeyGroup::Window})
        drawGroup(desk, group);
    ImGui::EndGroup();
    if (ImGui::IsMouseClicked(0) && !ImGui::IsWindowHovered()) desk.showsHelp = false;
    ImGui::End();
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
}

} // namespace kilolux
