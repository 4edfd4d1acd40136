#include "ui/profile_browser.h"

#include "ui/light_actions.h"
#include "ui/light_fields.h"
#include "ui/properties_state.h"
#include "ui/theme.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

namespace kilolux {

namespace {

namespace fs = std::filesystem;

constexpr const char* kTitle = "Photometric profiles";

ProfileBrowserState& stateOf(Desk& desk) {
    if (!desk.profileBrowser) desk.profileBrowser = std::make_shared<ProfileBrowserState>();
    return *desk.profileBrowser;
}

// Hundreds of files take a while: the window goes on meanwhile.
void read(Desk& desk, ProfileBrowserState& state) {
    std::vector<fs::path> folders;
    const fs::path scene = desk.session->path().parent_path();
    folders.push_back(scene.empty() ? "." : scene);
    folders.push_back(shippedProfiles());
    if (!state.folder.empty()) folders.push_back(state.folder);
    state.reading = std::async(std::launch::async, [folders, wake = desk.wake] {
        std::vector<ProfileEntry> all;
        for (const fs::path& folder : folders) {
            std::vector<ProfileEntry> entries = profilesIn(folder);
            std::move(entries.begin(), entries.end(), std::back_inserter(all));
        }
        if (wake) wake();
        return all;
    });
}

void take(ProfileBrowserState& state) {
    if (!state.reading.valid() ||
        state.reading.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return;
    state.entries = state.reading.get();
    state.chosen = state.entries.empty() ? -1 : 0;
}

// Two planes through the axis: straight ahead is down, as such plots are drawn.
void drawPlot(Desk& desk, const ProfileEntry& entry, float sizePx) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::Dummy({sizePx, sizePx});
    mark(desk, "profiles.plot");
    ImDrawList& canvas = *ImGui::GetWindowDrawList();
    const ImVec2 middle{corner.x + 0.5f * sizePx, corner.y + 0.5f * sizePx};
    const float radius = 0.5f * sizePx - px(desk, 14);
    canvas.AddRectFilled(corner, {corner.x + sizePx, corner.y + sizePx}, theme::kEmpty);
    constexpr ImU32 kGrid = IM_COL32(70, 70, 70, 255);
    for (const float share : {0.25f, 0.5f, 0.75f, 1.0f})
        canvas.AddCircle(middle, share * radius, kGrid, 64);
    for (int spoke = 0; spoke < 12; ++spoke) {
        const float angle = float(glm::radians(30.0 * spoke));
        canvas.AddLine(middle, {middle.x + radius * std::sin(angle), middle.y + radius * std::cos(angle)},
                       kGrid);
    }
    for (int plane = 1; plane >= 0; --plane) {
        ImVec2 last{};
        for (int step = 0; step <= 240; ++step) {
            const double degrees = 1.5 * step;
            const float length = radius * float(relativeAt(*entry.profile, 90.0 * plane, degrees));
            const float angle = float(glm::radians(degrees));
            const ImVec2 at{middle.x + length * std::sin(angle), middle.y + length * std::cos(angle)};
            if (step > 0)
                canvas.AddLine(last, at, plane == 0 ? theme::kAccent : IM_COL32(120, 170, 230, 255),
                               px(desk, 1.5));
            last = at;
        }
    }
    const std::string most = fmt::format("{:.0f} cd", entry.facts.maxCandela);
    canvas.AddText({middle.x + px(desk, 4), middle.y + radius - px(desk, 16)}, theme::kDim, most.c_str());
}

void drawFacts(const ProfileEntry& entry) {
    const ProfileFacts& facts = entry.facts;
    ImGui::TextWrapped("%s", entry.title.empty() ? entry.name.c_str() : entry.title.c_str());
    const auto line = [](const char* label, const std::string& text) {
        ImGui::TextDisabled("%s", label);
        ImGui::SameLine(ImGui::GetFontSize() * 6);
        ImGui::TextUnformatted(text.c_str());
    };
    const auto degrees = [](const double(&pair)[2]) {
        return std::abs(pair[0] - pair[1]) < 0.5
                   ? fmt::format("{:.0f}\u00b0", pair[0])
                   : fmt::format("{:.0f}\u00b0 \u00d7 {:.0f}\u00b0", pair[0], pair[1]);
    };
    line("Light", fmt::format("{:.0f} lm", facts.lumens));
    if (const auto efficiency = entry.profile->efficiency())
        line("Of its lamps", fmt::format("{:.0f} %", 100.0 * *efficiency));
    line("Beam, field", degrees(facts.beamDeg) + ", " + degrees(facts.fieldDeg));
    line("Symmetry", facts.symmetry);
    line("Photometry", fmt::format("type {}, {}", "CBA"[int(entry.profile->photometry) - 1],
                                   entry.profile->lampLumens ? "relative" : "absolute"));
    line("Revision", entry.profile->standard);
}

// What a folder of the list is called: a path says little about the two that are always there.
std::string headingOf(const Desk& desk, const fs::path& folder) {
    if (folder == shippedProfiles()) return "Shipped with Kilolux";
    const fs::path scene = desk.session->path().parent_path();
    const fs::path inside = folder.lexically_relative(scene.empty() ? "." : scene);
    if (inside.empty() || *inside.begin() == "..") return folder.string();
    return inside == "." ? "Beside the scene" : "Beside the scene, " + inside.generic_string();
}

// The rows; true: one was double-clicked.
bool drawList(Desk& desk, ProfileBrowserState& state, float widthPx, float heightPx) {
    bool used = false;
    ImGui::BeginChild("profiles", {widthPx, heightPx});
    fs::path folder;
    for (int i = 0; i < int(state.entries.size()); ++i) {
        const ProfileEntry& entry = state.entries[std::size_t(i)];
        const fs::path own = entry.path.parent_path();
        if (own != folder) ImGui::TextDisabled("%s", headingOf(desk, folder = own).c_str());
        ImGui::PushID(i);
        if (!entry.profile) ImGui::PushStyleColor(ImGuiCol_Text, theme::kWarning);
        if (ImGui::Selectable(entry.path.filename().string().c_str(), state.chosen == i,
                              ImGuiSelectableFlags_AllowDoubleClick)) {
            state.chosen = i;
            used = ImGui::IsMouseDoubleClicked(0) && entry.profile;
        }
        if (!entry.profile) ImGui::PopStyleColor();
        mark(desk, "profiles." + entry.path.filename().string());
        ImGui::PopID();
    }
    if (state.entries.empty())
        ImGui::TextDisabled(state.reading.valid() ? "Reading..." : "No .ies files here");
    ImGui::EndChild();
    return used;
}

} // namespace

fs::path shippedProfiles() {
    return fs::path(KILOLUX_CONTENT_DIR) / "ies";
}

void openProfileBrowser(Desk& desk) {
    ProfileBrowserState& state = stateOf(desk);
    state.open = true;
    read(desk, state);
}

void useProfile(Desk& desk, const fs::path& profile) {
    if (!desk.session || desk.selection.empty()) return;
    const Result<std::string> uri = bringProfile(profile, desk.session->path().parent_path());
    if (!uri) return notify(desk, Notice::Kind::Error, uri.error());
    applyEdits(
        desk,
        editsForValue(desk.session->scene(), desk.selection, "iesProfile", uri.value(), sharingOf(desk)),
        "IES profile of " + countedLights(desk.selection.size()));
}

void drawProfileBrowser(Desk& desk) {
    if (!desk.profileBrowser || !desk.profileBrowser->open) return;
    ProfileBrowserState& state = *desk.profileBrowser;
    take(state);
    if (!ImGui::IsPopupOpen(kTitle)) ImGui::OpenPopup(kTitle);
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * screen.x, 0.5f * screen.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(px(desk, 620), screen.x - px(desk, 16)), 0});
    if (!ImGui::BeginPopupModal(kTitle, nullptr,
                                ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings))
        return;
    const float plot = px(desk, 260), whole = ImGui::GetContentRegionAvail().x;
    bool used = drawList(desk, state, whole - plot - px(desk, 12), px(desk, 420));
    const bool chosen = state.chosen >= 0 && state.chosen < int(state.entries.size());
    const ProfileEntry* entry = chosen ? &state.entries[std::size_t(state.chosen)] : nullptr;
    ImGui::SameLine(0, px(desk, 12));
    ImGui::BeginChild("facts", {plot, px(desk, 420)});
    if (entry && entry->profile) {
        drawPlot(desk, *entry, plot);
        drawFacts(*entry);
    } else if (entry) {
        ImGui::TextWrapped("%s", entry->error.c_str());
    }
    ImGui::EndChild();
    ImGui::SetNextItemWidth(-1);
    if (ImGui::InputTextWithHint("##folder", "Another folder", &state.typed,
                                 ImGuiInputTextFlags_EnterReturnsTrue)) {
        state.folder = state.typed;
        read(desk, state);
    }
    mark(desk, "profiles.folder");
    used = textButton(desk, "profiles.use", "Use",
                      entry && entry->profile ? ButtonLook::Plain : ButtonLook::Disabled) ||
           used;
    ImGui::SameLine();
    const bool closed = textButton(desk, "profiles.close", "Close") || ImGui::IsKeyPressed(256 /* Esc */);
    if (used || closed) {
        state.open = false;
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
    if (used && entry && entry->profile) useProfile(desk, entry->path);
}

} // namespace kilolux
