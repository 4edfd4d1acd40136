// Rows of the properties panel whose values are no numbers: flags, words, channels, files.
#include "ui/shaping_rows.h"

#include "ui/light_actions.h"
#include "ui/luminaires.h"
#include "ui/profile_browser.h"
#include "ui/property_rows.h"
#include "ui/scene_folder.h"
#include "ui/theme.h"
#include "ui/widgets.h"

#include <cmath>
#include <fmt/format.h>
#include <imgui.h>

namespace kilolux {

namespace {

void setAll(Desk& desk, const LightField& row, const EditValue& value) {
    applyEdits(desk, editsForValue(desk.session->scene(), desk.selection, row.field, value, sharingOf(desk)),
               fmt::format("{} of {}", row.label, countedLights(desk.selection.size())));
}

std::string sentence(std::string word) {
    if (!word.empty() && word[0] >= 'a' && word[0] <= 'z') word[0] = char(word[0] - 32);
    return word;
}

// One of several side by side, amber when it holds.
bool choiceButton(Desk& desk, const std::string& name, const char* text, float widthPx, bool on) {
    for (const ImGuiCol part : {ImGuiCol_Button, ImGuiCol_ButtonHovered, ImGuiCol_ButtonActive}) {
        const ImGuiCol off = part == ImGuiCol_Button ? ImGuiCol_FrameBg : part;
        ImGui::PushStyleColor(part, on ? theme::kAccent : ImGui::GetColorU32(off));
    }
    ImGui::PushStyleColor(ImGuiCol_Text, on ? IM_COL32(20, 20, 20, 255) : theme::kDim);
    const bool pressed = ImGui::Button(fmt::format("{}##{}", text, name).c_str(), {widthPx, 0});
    ImGui::PopStyleColor(4);
    mark(desk, name);
    return pressed;
}

} // namespace

void drawFlagRow(Desk& desk, const LightField& row) {
    const CommonValue value = valueOf(desk, row.field);
    rowLabel(desk, row.label, row.help);
    bool wanted = !value.mixed && std::get<bool>(value.value);
    const bool pressed = ImGui::Checkbox(fmt::format("##{}", row.field).c_str(), &wanted);
    mark(desk, row.field);
    if (value.mixed) {
        ImGui::SameLine();
        ImGui::TextDisabled("mixed");
    }
    if (pressed) setAll(desk, row, wanted);
}

void drawWordRow(Desk& desk, const LightField& row) {
    const CommonValue value = valueOf(desk, row.field);
    const std::string& now = std::get<std::string>(value.value);
    ImGui::SetNextItemWidth(rowLabel(desk, row.label, row.help));
    if (!beginCombo(fmt::format("##{}", row.field).c_str(), value.mixed ? "mixed" : sentence(now).c_str()))
        return mark(desk, row.field);
    std::string chosen;
    for (const char* word : findLightField(row.field)->words) {
        const bool same = !value.mixed && now == word;
        if (ImGui::Selectable(sentence(word).c_str(), same) && !same) chosen = word;
        mark(desk, fmt::format("{}.{}", row.field, word));
    }
    ImGui::EndCombo();
    mark(desk, row.field);
    if (!chosen.empty()) setAll(desk, row, chosen);
}

std::optional<std::uint64_t> channelButtons(Desk& desk, const std::string& name, const CommonValue& value,
                                            float widthPx) {
    const std::uint64_t bits = std::get<std::uint64_t>(value.value);
    std::optional<std::uint64_t> wanted;
    const float gap = px(desk, 2), each = std::floor((widthPx - 7 * gap) / 8.0f);
    for (int i = 0; i < 8; ++i) {
        if (i > 0) ImGui::SameLine(0, gap);
        const bool on = !value.mixed && (bits >> i & 1);
        const char digit[] = {char('1' + i), '\0'};
        if (choiceButton(desk, fmt::format("{}.{}", name, i + 1), digit, each, on))
            wanted = (value.mixed ? 0 : bits) ^ (std::uint64_t{1} << i);
    }
    return wanted;
}

void drawChannelsRow(Desk& desk, const LightField& row) {
    const CommonValue value = valueOf(desk, row.field);
    const float width = rowLabel(desk, row.label, value.mixed ? "These lights differ" : row.help);
    if (const auto bits = channelButtons(desk, row.field, value, width)) setAll(desk, row, *bits);
}

std::optional<std::string> fileCombo(Desk& desk, const std::string& name, const CommonValue& value,
                                     bool isProfile, float widthPx) {
    PropertiesState& state = propertiesOf(desk);
    const std::string& now = std::get<std::string>(value.value);
    ImGui::SetNextItemWidth(widthPx);
    const std::string shown = value.mixed ? "mixed" : now.empty() ? "none" : readableUri(now);
    const bool open = beginCombo(("##" + name).c_str(), shown.c_str());
    if (!open) {
        mark(desk, name);
        if (!now.empty() && !value.mixed) tooltip(now.size() < 200 ? now.c_str() : shown.c_str());
        return std::nullopt;
    }
    if (ImGui::IsWindowAppearing()) {
        const std::filesystem::path folder = desk.session->path().parent_path();
        state.fileChoices = isProfile ? filesBelow(folder.empty() ? "." : folder, kProfileEndings)
                                      : filesBelow(folder.empty() ? "." : folder, kPictureEndings);
    }
    std::optional<std::string> chosen;
    if (ImGui::Selectable("none", now.empty() && !value.mixed)) chosen = "";
    mark(desk, name + ".none");
    for (const std::string& uri : state.fileChoices) {
        if (ImGui::Selectable(uri.c_str(), !value.mixed && uri == now)) chosen = uri;
        mark(desk, name + "." + uri);
    }
    if (state.fileChoices.empty())
        ImGui::TextDisabled("%s",
                            isProfile ? "No .ies files beside the scene" : "No pictures beside the scene");
    ImGui::EndCombo();
    mark(desk, name);
    return chosen;
}

void drawFileRow(Desk& desk, const LightField& row) {
    const bool isProfile = findLightField(row.field)->kind == FieldKind::Profile;
    const CommonValue value = valueOf(desk, row.field);
    const float width = rowLabel(desk, row.label, row.help), side = ImGui::GetFrameHeight();
    const float combo = isProfile ? width - side - px(desk, 4) : width;
    if (const auto chosen = fileCombo(desk, row.field, value, isProfile, combo)) setAll(desk, row, *chosen);
    if (!isProfile) return;
    ImGui::SameLine(0, px(desk, 4));
    if (iconButton(desk, "profiles.browse", theme::kOpen, "All profiles, with their shapes"))
        openProfileBrowser(desk);
}

void drawPresetRow(Desk& desk) {
    ImGui::SetNextItemWidth(rowLabel(desk, "Preset", "Lumens, temperature, size and profile of a luminaire"));
    if (!beginCombo("##preset", "Choose")) return mark(desk, "preset");
    const Luminaire* chosen = nullptr;
    for (const Luminaire& each : luminaires()) {
        if (ImGui::Selectable(each.name)) chosen = &each;
        mark(desk, std::string("preset.") + each.name);
    }
    ImGui::EndCombo();
    mark(desk, "preset");
    if (!chosen) return;
    Result<std::string> uri = std::string();
    if (*chosen->profile)
        uri = bringProfile(shippedProfiles() / chosen->profile, desk.session->path().parent_path());
    if (!uri) return notify(desk, Notice::Kind::Error, uri.error());
    applyEdits(
        desk, editsForLuminaire(desk.session->scene(), desk.selection, *chosen, uri.value(), sharingOf(desk)),
        fmt::format("{} for {}", chosen->name, countedLights(desk.selection.size())));
}

void drawDoorSwitch(Desk& desk) {
    PropertiesState& state = propertiesOf(desk);
    const bool isPair = doorNumbers(desk, desk.selection) == DoorNumbers::OnePair;
    const float width = rowLabel(desk, "Doors", "One angle and length for all flaps, or each its own");
    const float gap = px(desk, 2), each = std::floor((width - gap) / 2.0f);
    if (choiceButton(desk, "doors.pair", "One pair", each, isPair) && !isPair) {
        state.wantsFlaps = false;
        applyEdits(desk, editsForEvenDoors(desk.session->scene(), desk.selection, sharingOf(desk)),
                   fmt::format("Even doors of {}", countedLights(desk.selection.size())));
        state.version = 0;
    }
    tooltip("Makes all flaps as the longest one");
    ImGui::SameLine(0, gap);
    if (choiceButton(desk, "doors.flaps", "Four flaps", each, !isPair) && isPair) {
        state.wantsFlaps = true;
        state.version = 0; // to be read again
    }
}

} // namespace kilolux
