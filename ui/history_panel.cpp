// The steps of the document below the light list: a click goes back or forth to one.
#include "ui/light_list_state.h"
#include "ui/theme.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

namespace kilolux {

void drawHistoryPanel(Desk& desk) {
    LightListState& state = lightListOf(desk);
    const History& history = desk.session->history();
    const ImVec2 from = ImGui::GetCursorScreenPos();
    if (ImGui::Selectable("##history", false, 0, {0, ImGui::GetFrameHeight()}))
        state.showsHistory = !state.showsHistory;
    mark(desk, "history.fold");
    const std::string title =
        fmt::format("{}  History", state.showsHistory ? theme::kUnfolded : theme::kFolded);
    const std::string count = std::to_string(history.steps());
    const float top = from.y + ImGui::GetStyle().FramePadding.y, width = ImGui::GetContentRegionAvail().x;
    ImDrawList& canvas = *ImGui::GetWindowDrawList();
    canvas.AddText({from.x + px(desk, 6), top}, theme::kText, title.c_str());
    canvas.AddText({from.x + width - ImGui::CalcTextSize(count.c_str()).x - px(desk, 4), top}, theme::kDim,
                   count.c_str());
    if (!state.showsHistory) return;
    ImGui::BeginChild("steps");
    std::ptrdiff_t wanted = -1; // steps that shall be in effect
    const std::size_t done = history.doneSteps();
    ImGuiListClipper clipper;
    clipper.Begin(int(history.steps()) + 1);
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const std::string name = i == 0 ? "As opened" : history.stepName(std::size_t(i - 1));
            ImGui::PushID(i);
            ImGui::PushStyleColor(ImGuiCol_Text, std::size_t(i) > done ? theme::kDim : theme::kText);
            if (ImGui::Selectable(name.c_str(), std::size_t(i) == done)) wanted = i;
            ImGui::PopStyleColor();
            mark(desk, fmt::format("history.{}", i));
            ImGui::PopID();
        }
    }
    for (std::size_t at = done; wanted >= 0 && at > std::size_t(wanted); --at)
        if (!undo(desk)) break;
    for (std::size_t at = done; wanted >= 0 && at < std::size_t(wanted); ++at)
        if (!redo(desk)) break;
    ImGui::EndChild();
}

} // namespace kilolux
