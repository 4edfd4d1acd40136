// Shared controls, see widgets.h.
#include "ui/widgets.h"

#include "ui/theme.h"

#include <algorithm>
#include <cmath>
#include <imgui.h>

namespace kilolux {

namespace {

constexpr float kTipDelayS = 0.5f;

bool styledButton(Desk& desk, const char* name, const char* text, ImVec2 size, ButtonLook look) {
    ImGui::PushID(name);
    const bool disabled = look == ButtonLook::Disabled;
    if (disabled) ImGui::BeginDisabled();
    if (look == ButtonLook::Active) {
        ImGui::PushStyleColor(ImGuiCol_Button, theme::kAccentDim);
        ImGui::PushStyleColor(ImGuiCol_Text, theme::kAccent);
    }
    const bool pressed = ImGui::Button(text, size);
    if (look == ButtonLook::Active) ImGui::PopStyleColor(2);
    if (disabled) ImGui::EndDisabled();
    ImGui::PopID();
    mark(desk, name);
    return pressed;
}

} // namespace

float px(const Desk& desk, double units) {
    return float(std::round(units * desk.uiScale));
}

bool iconButton(Desk& desk, const char* name, const char* icon, const char* tip, ButtonLook look) {
    const float side = ImGui::GetFrameHeight();
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(0.0f, ImGui::GetStyle().FramePadding.y));
    const bool pressed = styledButton(desk, name, icon, {side + px(desk, 4), side}, look);
    ImGui::PopStyleVar();
    tooltip(tip);
    return pressed;
}

bool textButton(Desk& desk, const char* name, const char* text, ButtonLook look) {
    ImGui::PushStyleColor(ImGuiCol_Button, theme::kField);
    const bool pressed = styledButton(desk, name, text, {0, 0}, look);
    ImGui::PopStyleColor();
    return pressed;
}

bool beginCombo(const char* id, const char* preview) {
    ImGui::PushStyleColor(ImGuiCol_Button, theme::kField);
    const bool open = ImGui::BeginCombo(id, preview);
    ImGui::PopStyleColor();
    return open;
}

void tooltip(const char* text) {
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    // How long the pointer has been still, kept with the window.
    ImGuiStorage& storage = *ImGui::GetStateStorage();
    const ImGuiID id = ImGui::GetID(text);
    const int frame = ImGui::GetFrameCount();
    const bool began = storage.GetInt(id, -2) < frame - 1;
    storage.SetInt(id, frame);
    const float rested = began ? 0.0f : storage.GetFloat(id + 1) + ImGui::GetIO().DeltaTime;
    storage.SetFloat(id + 1, rested);
    if (rested > kTipDelayS) ImGui::SetTooltip("%s", text);
}

void textWithin(std::string_view text, float widthPx) {
    const std::string whole(text);
    if (ImGui::CalcTextSize(whole.c_str()).x <= widthPx) {
        ImGui::TextUnformatted(whole.c_str());
        return;
    }
    std::string cut = whole;
    const auto tooWide = [&] { return ImGui::CalcTextSize((cut + "…").c_str()).x > widthPx; };
    while (!cut.empty() && tooWide()) {
        // A character of UTF-8 goes whole.
        while (!cut.empty() && (static_cast<unsigned char>(cut.back()) & 0xc0) == 0x80)
            cut.pop_back();
        if (!cut.empty()) cut.pop_back();
    }
    ImGui::TextUnformatted((cut + "…").c_str());
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", whole.c_str());
}

void closePopupOnEscape() {
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) ImGui::CloseCurrentPopup();
}

bool isPopupOpen() {
    return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

void progressBar(Desk& desk, double share) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, height = px(desk, 4);
    const float done = width * float(std::clamp(share, 0.02, 1.0));
    ImDrawList& canvas = *ImGui::GetWindowDrawList();
    canvas.AddRectFilled(corner, {corner.x + width, corner.y + height}, theme::kField, height);
    canvas.AddRectFilled(corner, {corner.x + done, corner.y + height}, theme::kAccent, height);
    ImGui::Dummy({width, height});
}

void mark(Desk& desk, const std::string& name) {
    if (!desk.recordsPlaces) return;
    const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
    desk.places[name] = {from.x, from.y, to.x - from.x, to.y - from.y};
}

} // namespace kilolux
