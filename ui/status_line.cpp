// The line below: what is open, what the picture is made of, how far it has come, what is slow or wrong.
#include "ui/cost_notes.h"
#include "ui/file_tasks.h"
#include "ui/light_actions.h"
#include "ui/panels.h"
#include "ui/theme.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

namespace kilolux {

namespace {

// Numbers keep their width, so that nothing behind them jumps.
std::string pictureText(const Desk& desk) {
    const ShownFrame& frame = *desk.shown;
    const int width = int(std::lround(frame.width * frame.renderScale));
    const int height = int(std::lround(frame.height * frame.renderScale));
    const std::string size = frame.renderScale < 1.0
                                 ? fmt::format("{} x {} of {} x {}", width, height, frame.width, frame.height)
                                 : fmt::format("{} x {}", width, height);
    const std::string state = frame.settled ? fmt::format("settled after {} frames", frame.meanFrames)
                                            : fmt::format("{:3} frames", frame.meanFrames);
    return fmt::format("{}   {:4.0f} ms   {:4.0f} MiB   {}", size, frame.frameMs,
                       frame.statistics.gpuMemoryPeakMiB, state);
}

void drawFileState(Desk& desk) {
    if (!desk.session) {
        ImGui::TextDisabled("Nothing is open");
        return;
    }
    const std::string name = desk.session->path().filename().string();
    ImGui::TextUnformatted(name.c_str());
    tooltip(desk.session->path().string().c_str());
    if (desk.session->hasUnsavedChanges()) {
        ImGui::SameLine(0, px(desk, 4));
        ImGui::TextColored(ImColor(theme::kAccent), "edited");
    }
    if (!desk.solo.empty()) {
        ImGui::SameLine();
        ImGui::TextColored(ImColor(theme::kAccent), "%s %s solo", theme::kSolo,
                           countedLights(desk.solo.size()).c_str());
        mark(desk, "status.solo");
    }
    if (!desk.files->changedOnDisk) return;
    ImGui::SameLine();
    ImGui::TextColored(ImColor(theme::kWarning), "%s changed on disk", theme::kWarn);
    ImGui::SameLine();
    if (ImGui::SmallButton("Reload")) reloadScene(desk);
    mark(desk, "status.reload");
}

// The worst thing to know about the picture; the rest stands in the cost panel.
void drawProblem(Desk& desk) {
    const std::vector<CostNote> notes = costNotes(desk.shown->statistics);
    if (notes.empty() || !notes.front().wrong) return;
    ImGui::SameLine();
    ImGui::TextColored(ImColor(theme::kWarning), "%s %s", theme::kWarn, notes.front().text.c_str());
}

} // namespace

void drawStatusLine(Desk& desk) {
    ImGui::PushFont(theme::smallFont());
    ImGui::SetCursorPosY(0.5f * (ImGui::GetWindowHeight() - ImGui::GetTextLineHeight()));
    drawFileState(desk);
    if (desk.shown) drawProblem(desk);
    if (desk.shown) {
        const std::string text = pictureText(desk);
        const float textWidth = ImGui::CalcTextSize(text.c_str()).x;
        const float start = ImGui::GetWindowWidth() - textWidth - px(desk, 12);
        ImGui::SameLine();
        if (start > ImGui::GetCursorPosX()) {
            ImGui::SameLine(start);
            ImGui::TextDisabled("%s", text.c_str());
            const std::string& why = desk.shown->statistics.historyReset;
            if (!why.empty()) tooltip(("History last began anew: " + why).c_str());
        } else {
            ImGui::NewLine();
        }
    }
    ImGui::PopFont();
}

} // namespace kilolux
