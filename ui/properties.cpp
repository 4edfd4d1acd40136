// The properties of the selected lights: sections that fold, numbers that are typed or dragged, 'mixed' where
// lights differ. Which fields there are is light_fields' table.
#include "renderer/document/light_words.h"
#include "ui/light_actions.h"
#include "ui/light_commands.h"
#include "ui/light_place.h"
#include "ui/mesh_rows.h"
#include "ui/panels.h"
#include "ui/property_rows.h"
#include "ui/shaping_rows.h"
#include "ui/theme.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>
#include <nlohmann/json.hpp>
#include <utility>

namespace kilolux {

namespace {

// What the panel shows is read again when the document or the selection has changed.
void refresh(Desk& desk, PropertiesState& state) {
    const bool sameSelection = state.selection == desk.selection;
    if (sameSelection && state.version == desk.session->version()) return;
    const Scene& scene = desk.session->scene();
    if (!sameSelection) {
        if (!state.dragging.empty()) endDrag(desk); // a drag is of the lights that it began with
        state.givenUp = std::exchange(state.dragging, {});
        state.dragStart = {};
        state.selection = desk.selection;
        state.sharing = Sharing::MakeUnique;
        state.editing.clear();
        state.eulerRad = glm::dvec3(0.0);
    }
    state.version = desk.session->version();
    state.values.clear();
    state.coordinates = {};
    state.applies.clear();
    const DoorNumbers doors = doorNumbers(desk, state.selection);
    for (const LightField& field : lightFields())
        state.applies.push_back(allHave(scene, state.selection, field) &&
                                doorNumbersOf(field).value_or(doors) == doors);
    countMeshes(desk);
    state.othersSharing = othersSharing(scene, state.selection);
    if (!state.selection.empty())
        state.eulerRad = eulerFrom(rotationOf(scene, state.selection.front()), state.eulerRad);
}

bool beginSection(Desk& desk, const char* name, ImGuiTreeNodeFlags flags = ImGuiTreeNodeFlags_DefaultOpen) {
    ImGui::Dummy({0, px(desk, 2)});
    ImGui::PushStyleColor(ImGuiCol_Header, ImGui::GetColorU32(ImGuiCol_TableHeaderBg));
    const bool open = ImGui::CollapsingHeader(name, flags);
    ImGui::PopStyleColor();
    mark(desk, std::string("section.") + name);
    return open;
}

void drawSharing(Desk& desk, PropertiesState& state) {
    if (state.othersSharing == 0) return;
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextDisabled("Shared with %s; a change is for",
                        countedLights(std::size_t(state.othersSharing)).c_str());
    ImGui::PopTextWrapPos();
    const bool all = state.sharing == Sharing::EditAll;
    const char* here = state.selection.size() == 1 ? "this one" : "these";
    if (textButton(desk, "sharing.unique", here, all ? ButtonLook::Plain : ButtonLook::Active))
        state.sharing = Sharing::MakeUnique;
    ImGui::SameLine();
    const std::string everyone =
        fmt::format("all {}", state.selection.size() + std::size_t(state.othersSharing));
    if (textButton(desk, "sharing.all", everyone.c_str(), all ? ButtonLook::Active : ButtonLook::Plain))
        state.sharing = Sharing::EditAll;
}

void drawName(Desk& desk, PropertiesState& state) {
    const Scene& scene = desk.session->scene();
    const bool one = state.selection.size() == 1;
    const std::string name =
        one ? nodeOf(scene, state.selection.front()).name : countedLights(state.selection.size());
    const FieldEvent event = valueField(
        desk, "name", {name, "", one ? name : "", FieldText::Tone::Name}, ImGui::GetContentRegionAvail().x,
        one ? "Click to rename" : "Typing a name gives all of them that name with a number",
        FieldDrag::Never);
    if (event.kind == FieldEvent::Kind::Typed) renameLights(desk, state.selection, event.text);
}

void drawType(Desk& desk, PropertiesState& state) {
    const CommonValue value = valueOf(desk, "type");
    const LightType type = std::get<LightType>(value.value);
    const float width = rowLabel(desk, "Type", nullptr);
    ImGui::SetNextItemWidth(width);
    if (beginCombo("##type", value.mixed ? "mixed" : typeName(type).data())) {
        for (const LightTypeWord& word : kLightTypeWords) {
            const bool same = !value.mixed && word.type == type;
            if (ImGui::Selectable(typeName(word.type).data(), same) && !same) {
                applyEdits(
                    desk,
                    editsForValue(desk.session->scene(), state.selection, "type", word.type, state.sharing),
                    "Type of " + countedLights(state.selection.size()));
            }
            mark(desk, std::string("type.") + word.name);
        }
        ImGui::EndCombo();
    }
    mark(desk, "type");
}

void drawGroupChoice(Desk& desk, PropertiesState& state) {
    const CommonValue value = valueOf(desk, "group");
    const Scene& scene = desk.session->scene();
    const std::uint64_t id = std::get<std::uint64_t>(value.value);
    const int at = findGroup(scene, id);
    const float width = rowLabel(desk, "Group", "Dims, tints and mutes its lights together");
    ImGui::SetNextItemWidth(width);
    const std::string shown = value.mixed ? "mixed" : at < 0 ? "none" : scene.groups[std::size_t(at)].name;
    const bool open = beginCombo("##group", shown.c_str());
    if (!open) return mark(desk, "group");
    std::optional<std::uint64_t> chosen;
    if (ImGui::Selectable("none", !value.mixed && id == 0)) chosen = 0;
    for (const LightGroup& group : scene.groups)
        if (ImGui::Selectable(group.name.c_str(), !value.mixed && group.id == id)) chosen = group.id;
    const bool wantsNew = ImGui::Selectable("New group");
    ImGui::EndCombo();
    mark(desk, "group");
    if (chosen) {
        applyEdits(desk, assignGroup(scene, state.selection, *chosen),
                   "Group of " + countedLights(state.selection.size()));
    }
    if (wantsNew) groupSelection(desk);
}

void drawTable(Desk& desk, PropertiesState& state, LightSection section) {
    const auto fields = lightFields();
    bool hasDoors = false;
    for (std::size_t i = 0; i < fields.size(); ++i) {
        if (fields[i].section != section || !state.applies[i]) continue;
        if (!hasDoors && doorNumbersOf(fields[i])) drawDoorSwitch(desk), hasDoors = true;
        drawFieldRow(desk, fields[i]);
    }
}

bool hasAny(const PropertiesState& state, LightSection section) {
    const auto fields = lightFields();
    for (std::size_t i = 0; i < fields.size(); ++i)
        if (fields[i].section == section && state.applies[i]) return true;
    return false;
}

void drawVisibility(Desk& desk, PropertiesState& state) {
    const CommonValue value = valueOf(desk, "muted");
    const auto check = [&](const char* name, const char* label, bool on, bool mixed) {
        rowLabel(desk, label, nullptr);
        bool wanted = on && !mixed;
        const bool pressed = ImGui::Checkbox((std::string("##") + name).c_str(), &wanted);
        mark(desk, name);
        if (mixed) {
            ImGui::SameLine();
            ImGui::TextDisabled("mixed");
        }
        return pressed;
    };
    if (check("muted", "Muted", std::get<bool>(value.value), value.mixed)) toggleMute(desk, state.selection);
    if (check("solo", "Solo", !desk.solo.empty() && desk.solo == state.selection, false))
        toggleSolo(desk, state.selection);
    const bool locked =
        std::includes(desk.locked.begin(), desk.locked.end(), state.selection.begin(), state.selection.end());
    if (check("locked", "Locked", locked, false)) toggleLock(desk, state.selection);
}

void drawSections(Desk& desk, PropertiesState& state) {
    if (beginSection(desk, "Light")) {
        drawType(desk, state);
        drawPresetRow(desk);
        drawTable(desk, state, LightSection::Light);
        drawGroupChoice(desk, state);
    }
    if (beginSection(desk, "Place")) drawPlaceRows(desk);
    if (hasAny(state, LightSection::Shape) && beginSection(desk, "Shape"))
        drawTable(desk, state, LightSection::Shape);
    if (hasAny(state, LightSection::Shaping) && beginSection(desk, "Shaping"))
        drawTable(desk, state, LightSection::Shaping);
    if (hasAny(state, LightSection::Profile) && beginSection(desk, "Profile"))
        drawTable(desk, state, LightSection::Profile);
    if (hasAny(state, LightSection::Function) && beginSection(desk, "Light function"))
        drawTable(desk, state, LightSection::Function);
    if (beginSection(desk, "Colour")) {
        drawTintRow(desk);
        drawTable(desk, state, LightSection::Colour);
    }
    if (hasAny(state, LightSection::Shadow) && beginSection(desk, "Shadow"))
        drawTable(desk, state, LightSection::Shadow);
    if (beginSection(desk, "Visibility")) {
        drawVisibility(desk, state);
        drawTable(desk, state, LightSection::Visibility);
        drawReach(desk);
    }
    const CommonValue group = valueOf(desk, "group");
    const std::uint64_t id = std::get<std::uint64_t>(group.value);
    if (!group.mixed && id != 0 && beginSection(desk, "Group")) drawGroupRows(desk, id);
    if (beginSection(desk, "Meshes", ImGuiTreeNodeFlags_None)) drawMeshRows(desk);
}

} // namespace

PropertiesState& propertiesOf(Desk& desk) {
    if (!desk.properties) desk.properties = std::make_shared<PropertiesState>();
    return *desk.properties;
}

Sharing sharingOf(const Desk& desk) {
    const bool about = desk.properties && desk.properties->selection == desk.selection;
    return about ? desk.properties->sharing : Sharing::MakeUnique;
}

DoorNumbers doorNumbers(Desk& desk, std::span<const std::uint64_t> lights) {
    const bool even = doorsAreEven(desk.session->scene(), lights);
    return even && !propertiesOf(desk).wantsFlaps ? DoorNumbers::OnePair : DoorNumbers::FourFlaps;
}

bool cancelPropertyDrag(Desk& desk) {
    PropertiesState& state = propertiesOf(desk);
    if (state.dragging.empty()) return false;
    if (state.hasDragged) cancelDrag(desk);
    state.givenUp = std::exchange(state.dragging, {});
    state.dragStart = {};
    return true;
}

void drawProperties(Desk& desk) {
    if (!desk.session) return;
    PropertiesState& state = propertiesOf(desk);
    refresh(desk, state);
    state.fieldCount = 0;
    if (desk.selection.empty()) {
        ImGui::PushTextWrapPos(0.0f);
        ImGui::TextDisabled(
            "No light is selected. Click one in the picture or in the list; Shift+A over the picture "
            "adds one; F1 shows all keys.");
        ImGui::PopTextWrapPos();
        if (beginSection(desk, "Dome and fill")) drawDomeRows(desk);
        if (beginSection(desk, "Meshes")) drawMeshRows(desk);
        return;
    }
    drawName(desk, state);
    drawSharing(desk, state);
    // An edit above may have changed what is there.
    refresh(desk, state);
    if (!desk.selection.empty()) drawSections(desk, state);
    if (state.editNext >= state.fieldCount) state.editNext = 0;
    if (state.editNext < -1) state.editNext = state.fieldCount - 1;
}

nlohmann::json propertiesState(const Desk& desk) {
    nlohmann::json json = nlohmann::json::object();
    if (!desk.properties) return json;
    json["editing"] = desk.properties->editing;
    json["dragging"] = desk.properties->dragging;
    json["sharing"] = desk.properties->sharing == Sharing::EditAll ? "all" : "unique";
    json["othersSharing"] = desk.properties->othersSharing;
    return json;
}

} // namespace kilolux
