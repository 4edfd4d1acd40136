#include "ui/light_menu.h"

#include "ui/light_actions.h"
#include "ui/light_commands.h"
#include "ui/light_list_state.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

namespace kilolux {

namespace {

bool item(Desk& desk, const char* name, const char* text, const char* keys = nullptr) {
    const bool chosen = ImGui::MenuItem(text, keys);
    mark(desk, name);
    return chosen;
}

void drawGroupChoices(Desk& desk) {
    if (item(desk, "menu.group", "New group", "Ctrl+G")) return groupSelection(desk);
    const Scene& scene = desk.session->scene();
    const std::string lights = countedLights(desk.selection.size());
    std::optional<std::pair<std::uint64_t, std::string>> chosen; // group, and what the step is called
    for (const LightGroup& group : scene.groups) {
        ImGui::PushID(int(group.id));
        if (ImGui::MenuItem(group.name.c_str()))
            chosen = {group.id, fmt::format("Move {} to '{}'", lights, group.name)};
        ImGui::PopID();
    }
    if (!scene.groups.empty() && ImGui::MenuItem("No group"))
        chosen = {0, fmt::format("Take {} out of groups", lights)};
    if (chosen) applyEdits(desk, assignGroup(scene, desk.selection, chosen->first), chosen->second);
}

// Menus stand in the list, whose rows touch; theirs do not.
bool beginMenu(Desk& desk, const char* name) {
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(px(desk, 8), px(desk, 8)));
    if (ImGui::BeginPopupContextItem(name)) {
        closePopupOnEscape();
        return true;
    }
    ImGui::PopStyleVar();
    return false;
}

void endMenu() {
    ImGui::EndPopup();
    ImGui::PopStyleVar();
}

} // namespace

void drawLightMenu(Desk& desk, std::uint64_t light) {
    if (!beginMenu(desk, "light menu")) return;
    // The menu is about the selection, and the row is part of it.
    if (ImGui::IsWindowAppearing() && !desk.isSelected(light)) select(desk, {light});
    if (item(desk, "menu.rename", "Rename", "F2")) beginRename(desk, LightRow::Kind::Light, light);
    if (item(desk, "menu.frame", "Frame", "F")) frameSelection(desk);
    if (item(desk, "menu.look", "Look through", "L")) lookThroughLight(desk);
    ImGui::Separator();
    if (item(desk, "menu.mute", "Mute or unmute", "H")) toggleMute(desk, desk.selection);
    if (item(desk, "menu.solo", "Solo", "Shift+S")) toggleSolo(desk, desk.selection);
    if (item(desk, "menu.lock", "Lock or unlock")) toggleLock(desk, desk.selection);
    ImGui::Separator();
    if (ImGui::BeginMenu("Group")) {
        drawGroupChoices(desk);
        ImGui::EndMenu();
    }
    mark(desk, "menu.groups");
    if (item(desk, "menu.unique", "Make definition unique")) {
        applyEdits(desk, makeLightsUnique(desk.session->scene(), desk.selection),
                   fmt::format("Make {} unique", countedLights(desk.selection.size())));
    }
    ImGui::Separator();
    if (item(desk, "menu.copy", "Copy", "Ctrl+C")) copySelection(desk);
    if (item(desk, "menu.paste", "Paste", "Ctrl+V")) pasteLights(desk);
    if (item(desk, "menu.duplicate", "Duplicate", "Ctrl+D")) duplicateSelection(desk);
    if (item(desk, "menu.delete", "Delete", "Del")) deleteSelection(desk);
    endMenu();
}

void drawGroupMenu(Desk& desk, std::uint64_t group) {
    if (!beginMenu(desk, "group menu")) return;
    if (item(desk, "menu.renameGroup", "Rename")) beginRename(desk, LightRow::Kind::Group, group);
    if (item(desk, "menu.members", "Select its lights"))
        select(desk, membersOf(desk.session->scene(), group));
    if (item(desk, "menu.soloGroup", "Solo")) toggleSolo(desk, membersOf(desk.session->scene(), group));
    ImGui::Separator();
    if (item(desk, "menu.dissolve", "Dissolve", "Ctrl+Shift+G")) dissolveGroup(desk, group);
    endMenu();
}

} // namespace kilolux
