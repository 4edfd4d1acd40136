// The list of lights: search, filter, order, groups; each row with icon, name, intensity and what switches
// it.
#include "renderer/document/light_words.h"
#include "ui/light_actions.h"
#include "ui/light_commands.h"
#include "ui/light_icon.h"
#include "ui/light_list_state.h"
#include "ui/light_menu.h"
#include "ui/light_place.h"
#include "ui/panels.h"
#include "ui/theme.h"
#include "ui/value_entry.h"
#include "ui/viewport_tools.h"
#include "ui/widgets.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>
#include <nlohmann/json.hpp>

namespace kilolux {

namespace {

constexpr double kToggleUnits = 20.0, kValueUnits = 76.0;

// --- the head of the list

void drawTypeFilter(Desk& desk, LightListState& state) {
    const ButtonLook look = state.query.types != 0 ? ButtonLook::Active : ButtonLook::Plain;
    if (iconButton(desk, "lights.filter", theme::kFilter, "Show only some types", look))
        ImGui::OpenPopup("types");
    if (!ImGui::BeginPopup("types")) return;
    closePopupOnEscape();
    for (const LightTypeWord& word : kLightTypeWords) {
        const std::uint32_t bit = 1u << unsigned(word.type);
        bool shown = state.query.types & bit;
        if (ImGui::Checkbox(typeName(word.type).data(), &shown)) state.query.types ^= bit;
    }
    if (ImGui::Selectable("All types")) state.query.types = 0;
    ImGui::EndPopup();
}

void drawOrder(Desk& desk, LightListState& state) {
    const bool sorted = state.query.order != LightOrder::File || state.query.descending;
    if (iconButton(desk, "lights.order", theme::kSort, "Order",
                   sorted ? ButtonLook::Active : ButtonLook::Plain))
        ImGui::OpenPopup("order");
    if (!ImGui::BeginPopup("order")) return;
    closePopupOnEscape();
    constexpr const char* kNames[] = {"As in the file", "Name", "Type", "Intensity", "Distance"};
    for (int i = 0; i < 5; ++i) {
        if (ImGui::MenuItem(kNames[i], nullptr, int(state.query.order) == i))
            state.query.order = LightOrder(i);
        mark(desk, fmt::format("order.{}", i));
    }
    ImGui::Separator();
    ImGui::MenuItem("Descending", nullptr, &state.query.descending);
    mark(desk, "order.descending");
    ImGui::MenuItem("Below their groups", nullptr, &state.query.grouped);
    ImGui::EndPopup();
}

void drawAdd(Desk& desk) {
    if (iconButton(desk, "lights.add", theme::kAdd, "Add a light (Shift+A at the pointer)"))
        ImGui::OpenPopup("add");
    if (!ImGui::BeginPopup("add")) return;
    closePopupOnEscape();
    for (const LightTypeWord& word : kLightTypeWords) {
        if (ImGui::MenuItem(typeName(word.type).data())) viewportTools(desk).placing = word.type;
        mark(desk, std::string("lights.add.") + word.name);
    }
    ImGui::EndPopup();
}

void drawHead(Desk& desk, LightListState& state) {
    const float buttons = 3 * (ImGui::GetFrameHeight() + px(desk, 4) + ImGui::GetStyle().ItemSpacing.x);
    ImGui::SetNextItemWidth(std::max(ImGui::GetContentRegionAvail().x - buttons, px(desk, 40)));
    ImGui::InputTextWithHint("##search", "Search lights", &state.query.search);
    mark(desk, "lights.search");
    ImGui::SameLine();
    drawTypeFilter(desk, state);
    ImGui::SameLine();
    drawOrder(desk, state);
    ImGui::SameLine();
    drawAdd(desk);
    const std::size_t all = desk.session->scene().lights.size();
    const int shown = state.model.shownLights();
    ImGui::PushFont(theme::smallFont());
    ImGui::TextDisabled("%s", (std::size_t(shown) == all ? countedLights(all)
                                                         : fmt::format("{} of {}", shown, countedLights(all)))
                                  .c_str());
    ImGui::PopFont();
}

// --- rows

// A small switch at the right end of a row: bright when on, faint when the row is pointed at, else not there.
bool rowSwitch(Desk& desk, const std::string& name, const char* icon, const char* tip, ImVec2 at, bool on,
               bool rowHot) {
    const ImVec2 size{px(desk, kToggleUnits), ImGui::GetFrameHeight()};
    ImGui::SetCursorScreenPos(at);
    const bool pressed = ImGui::InvisibleButton(name.c_str(), size);
    mark(desk, name);
    const bool hovered = ImGui::IsItemHovered();
    tooltip(tip);
    if (!on && !rowHot && !hovered) return pressed;
    const ImU32 color = on ? theme::kAccent : hovered ? theme::kText : theme::kDim;
    const ImVec2 text = ImGui::CalcTextSize(icon);
    ImGui::GetWindowDrawList()->AddText({at.x + 0.5f * (size.x - text.x), at.y + 0.5f * (size.y - text.y)},
                                        color, icon);
    return pressed;
}

// The name within `widthPx`, or the field that it is typed into; true when a new one was entered.
bool drawName(Desk& desk, LightListState& state, const LightRow& row, const std::string& name, ImVec2 at,
              float widthPx, bool dim) {
    const bool renaming = state.renaming == row.id && state.renamingKind == row.kind;
    if (!renaming) {
        ImGui::SetCursorScreenPos({at.x, at.y + ImGui::GetStyle().FramePadding.y});
        ImGui::PushStyleColor(ImGuiCol_Text, dim ? theme::kDim : theme::kText);
        textWithin(name.empty() ? "(no name)" : name, widthPx);
        ImGui::PopStyleColor();
        return false;
    }
    ImGui::SetCursorScreenPos(at);
    ImGui::SetNextItemWidth(widthPx);
    if (state.renameBegins) ImGui::SetKeyboardFocusHere();
    const bool entered =
        ImGui::InputText("##name", &state.renameText,
                         ImGuiInputTextFlags_AutoSelectAll | ImGuiInputTextFlags_EnterReturnsTrue);
    mark(desk, "lights.rename");
    const bool active = ImGui::IsItemActive();
    if (state.renameBegins) {
        state.renameBegins = !active;
        return false;
    }
    if (active && !entered) return false;
    state.renaming = 0;
    state.renameText = state.renameText.c_str();
    return !ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false) && state.renameText != name;
}

struct RowSpace {
    ImVec2 from;
    float width, height;
    bool hot;
};

// The row as a whole: its background, and what a click on it selects.
RowSpace beginRow(Desk& desk, LightListState& state, int index, bool isSelected) {
    const LightRow& row = state.model.rows()[std::size_t(index)];
    RowSpace space{ImGui::GetCursorScreenPos(), ImGui::GetContentRegionAvail().x, ImGui::GetFrameHeight(),
                   false};
    // Selected stays amber under the pointer.
    if (isSelected) ImGui::PushStyleColor(ImGuiCol_HeaderHovered, theme::kAccentDim);
    ImGui::Selectable("##row", isSelected,
                      ImGuiSelectableFlags_AllowItemOverlap | ImGuiSelectableFlags_AllowDoubleClick,
                      {space.width, space.height});
    if (isSelected) ImGui::PopStyleColor();
    mark(desk, fmt::format("{}.{}", row.kind == LightRow::Kind::Light ? "light" : "group", row.id));
    const bool clicked = ImGui::IsItemClicked(0);
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    space.hot = ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem) &&
                mouse.y >= space.from.y && mouse.y < space.from.y + space.height && mouse.x >= space.from.x &&
                mouse.x < space.from.x + space.width;
    if (clicked) {
        const ImGuiIO& io = ImGui::GetIO();
        select(desk, selectionAfter(desk.session->scene(), state.model.rows(), desk.selection,
                                    {index, io.KeyShift, io.KeyCtrl}, state.anchor));
        state.seenSelection = desk.selection;
        if (ImGui::IsMouseDoubleClicked(0) && !io.KeyCtrl && !io.KeyShift)
            beginRename(desk, row.kind, row.id);
    }
    return space;
}

// The selection when the row is part of it, else the row alone.
std::vector<std::uint64_t> meant(const Desk& desk, std::uint64_t light) {
    return desk.isSelected(light) ? desk.selection : std::vector<std::uint64_t>{light};
}

void drawLightRow(Desk& desk, LightListState& state, int index) {
    const LightRow row = state.model.rows()[std::size_t(index)];
    const Scene& scene = desk.session->scene();
    const LightNode light = scene.lights[std::size_t(row.index)];
    const LightDef def = scene.lightDefs[std::size_t(light.def)];
    const std::string name = scene.nodes[std::size_t(light.node)].name;
    const RowSpace space = beginRow(desk, state, index, desk.isSelected(row.id));
    drawLightMenu(desk, row.id);
    const float toggle = px(desk, kToggleUnits), indent = row.inGroup ? px(desk, 16) : 0.0f;
    float x = space.from.x + px(desk, 4) + indent;
    const ImU32 color = light.muted ? theme::kDim : state.colors.of(def);
    drawLightIcon(*ImGui::GetWindowDrawList(), def.type,
                  {x + px(desk, 6), space.from.y + 0.5f * space.height}, px(desk, 6), color);
    x += px(desk, 20);
    const float right = space.from.x + space.width, switches = right - 3 * toggle;
    const bool solo = std::binary_search(desk.solo.begin(), desk.solo.end(), row.id);
    const bool locked = isLocked(desk, row.id);
    // The value stands left of the switches that are on; under the pointer all switches take its place.
    const int columnsOn = light.muted ? 3 : (solo ? 2 : (locked ? 1 : 0));
    const float valueEnd = right - float(columnsOn) * toggle - px(desk, 4);
    const bool hasValue = valueEnd - x > px(desk, kValueUnits + 60);
    const float nameEnd = hasValue ? valueEnd - px(desk, kValueUnits) : valueEnd;
    const bool renamed =
        drawName(desk, state, row, name, {x, space.from.y}, nameEnd - x - px(desk, 4), light.muted);
    if (hasValue && (columnsOn == 3 || !space.hot)) {
        const std::string unit(unitLabel(Quantity::Intensity, def.unit));
        const std::string value = formatQuantity(def.intensity, Quantity::Intensity, 4);
        const float unitWidth = px(desk, 22), top = space.from.y + ImGui::GetStyle().FramePadding.y;
        ImDrawList& canvas = *ImGui::GetWindowDrawList();
        canvas.AddText({valueEnd - unitWidth, top}, theme::kDim, unit.c_str());
        canvas.AddText({valueEnd - unitWidth - px(desk, 4) - ImGui::CalcTextSize(value.c_str()).x, top},
                       light.muted ? theme::kDim : theme::kText, value.c_str());
    }
    const auto at = [&](int i) { return ImVec2{switches + float(i) * toggle, space.from.y}; };
    const std::string id = std::to_string(row.id);
    if (rowSwitch(desk, "mute." + id, light.muted ? theme::kEyeOff : theme::kEye, "Mute (H)", at(0),
                  light.muted, space.hot))
        toggleMute(desk, meant(desk, row.id));
    if (rowSwitch(desk, "solo." + id, theme::kSolo, "Solo (Shift+S)", at(1), solo, space.hot))
        toggleSolo(desk, meant(desk, row.id));
    if (rowSwitch(desk, "lock." + id, locked ? theme::kLock : theme::kUnlock,
                  "Lock: not to be picked or dragged", at(2), locked, space.hot))
        toggleLock(desk, meant(desk, row.id));
    if (renamed) renameLights(desk, {row.id}, state.renameText);
}

void drawGroupRow(Desk& desk, LightListState& state, int index) {
    const LightRow row = state.model.rows()[std::size_t(index)];
    const LightGroup group = desk.session->scene().groups[std::size_t(row.index)];
    auto& foldedGroups = state.query.foldedGroups;
    const auto folded = std::find(foldedGroups.begin(), foldedGroups.end(), row.id);
    const bool isFolded = folded != foldedGroups.end();
    const RowSpace space = beginRow(desk, state, index, false);
    drawGroupMenu(desk, row.id);
    const float toggle = px(desk, kToggleUnits);
    ImGui::SetCursorScreenPos(space.from);
    if (ImGui::InvisibleButton("fold", {px(desk, 20), space.height})) {
        if (isFolded) {
            foldedGroups.erase(folded);
        } else {
            foldedGroups.push_back(row.id);
        }
    }
    mark(desk, "fold." + std::to_string(row.id));
    const float top = space.from.y + ImGui::GetStyle().FramePadding.y;
    ImGui::GetWindowDrawList()->AddText({space.from.x + px(desk, 4), top}, theme::kDim,
                                        isFolded ? theme::kFolded : theme::kUnfolded);
    const float switches = space.from.x + space.width - toggle;
    const float x = space.from.x + px(desk, 24);
    std::string masters = std::to_string(row.members);
    if (group.intensity != 1.0)
        masters = fmt::format("\u00d7{}  {}", formatQuantity(group.intensity, Quantity::Number, 3), masters);
    if (group.exposureEv != 0.0) masters = fmt::format("{:+.3g} EV  {}", group.exposureEv, masters);
    const float mastersWidth = ImGui::CalcTextSize(masters.c_str()).x;
    const bool renamed = drawName(desk, state, row, group.name, {x, space.from.y},
                                  switches - x - mastersWidth - px(desk, 12), group.muted);
    ImGui::GetWindowDrawList()->AddText({switches - mastersWidth - px(desk, 4), top}, theme::kDim,
                                        masters.c_str());
    const auto set = [&](const char* field, EditValue value, const std::string& what) {
        applyEdits(desk, setField(desk.session->scene(), EditTarget::Group, row.id, field, std::move(value)),
                   what);
    };
    if (rowSwitch(desk, "groupMute." + std::to_string(row.id), group.muted ? theme::kEyeOff : theme::kEye,
                  "Mute the group", {switches, space.from.y}, group.muted, space.hot))
        set("muted", !group.muted, group.muted ? "Unmute group" : "Mute group");
    if (renamed) set("name", state.renameText, "Rename group");
}

// Brings what was selected elsewhere into view.
void scrollToSelection(Desk& desk, LightListState& state, float rowHeight) {
    if (desk.selection == state.seenSelection) return;
    state.seenSelection = desk.selection;
    if (desk.selection.empty()) return;
    const int row = state.model.rowOf(desk.selection.front());
    if (row < 0) return;
    const float top = float(row) * rowHeight, height = ImGui::GetWindowHeight(), scroll = ImGui::GetScrollY();
    if (top < scroll || top + rowHeight > scroll + height) ImGui::SetScrollY(top - 0.5f * height);
}

void drawRows(Desk& desk, LightListState& state) {
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, 0));
    const float rowHeight = ImGui::GetFrameHeight();
    scrollToSelection(desk, state, rowHeight);
    if (state.model.rows().empty()) {
        ImGui::PushTextWrapPos(0.0f);
        ImGui::TextDisabled(desk.session->scene().lights.empty()
                                ? "No lights yet. Shift+A over the picture adds one."
                                : "No light matches.");
        ImGui::PopTextWrapPos();
    }
    ImGuiListClipper clipper;
    clipper.Begin(int(state.model.rows().size()), rowHeight);
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd && i < int(state.model.rows().size());
             ++i) {
            const ImVec2 next{ImGui::GetCursorScreenPos().x, ImGui::GetCursorScreenPos().y + rowHeight};
            // A row's edit may have removed what the later ones show; the next frame has them right.
            const std::uint64_t version = desk.session->version();
            ImGui::PushID(i);
            if (state.model.rows()[std::size_t(i)].kind == LightRow::Kind::Light) {
                drawLightRow(desk, state, i);
            } else {
                drawGroupRow(desk, state, i);
            }
            ImGui::PopID();
            ImGui::SetCursorScreenPos(next);
            if (desk.session->version() != version)
                state.model.update(desk.session->scene(), desk.session->version(), state.query);
        }
    }
    ImGui::PopStyleVar();
}

} // namespace

LightListState& lightListOf(Desk& desk) {
    if (!desk.lightList) desk.lightList = std::make_shared<LightListState>();
    return *desk.lightList;
}

void beginRename(Desk& desk, LightRow::Kind kind, std::uint64_t id) {
    LightListState& state = lightListOf(desk);
    const Scene& scene = desk.session->scene();
    state.renaming = id;
    state.renamingKind = kind;
    state.renameBegins = true;
    if (kind == LightRow::Kind::Group) {
        state.renameText = scene.groups[std::size_t(findGroup(scene, id))].name;
    } else {
        state.renameText = nodeOf(scene, id).name;
    }
}

void drawLightList(Desk& desk) {
    if (!desk.session) return;
    LightListState& state = lightListOf(desk);
    // Distances in steps of half a metre: rows do not swap places at every step of the camera.
    state.query.eyeWs = glm::round(desk.camera.eyeWs() * 2.0) * 0.5;
    state.model.update(desk.session->scene(), desk.session->version(), state.query);
    drawHead(desk, state);
    const float bar = ImGui::GetFrameHeight() + ImGui::GetStyle().ItemSpacing.y;
    const float whole = ImGui::GetContentRegionAvail().y;
    const float history = state.showsHistory ? std::max(0.35f * whole, 3 * bar) : bar;
    // Whole rows: none is cut by what stands below.
    const float row = ImGui::GetFrameHeight(), room = std::max(whole - history, bar);
    const float rows = row * std::floor(room / row);
    ImGui::BeginChild("rows", {0, rows}, false);
    drawRows(desk, state);
    ImGui::EndChild();
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() + room - rows);
    drawHistoryPanel(desk);
}

nlohmann::json lightListState(const Desk& desk) {
    nlohmann::json json = nlohmann::json::object();
    if (!desk.lightList) return json;
    const LightListState& state = *desk.lightList;
    json["shown"] = state.model.shownLights();
    json["rows"] = state.model.rows().size();
    json["search"] = state.query.search;
    json["renaming"] = state.renaming;
    json["solo"] = desk.solo;
    json["locked"] = desk.locked;
    return json;
}

} // namespace kilolux
