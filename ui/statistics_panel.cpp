// The cost panel: times of the passes, whose rows show what the pass wrote, memory, what is off and why, and
// what the picture suffers from.
#include "ui/cost_notes.h"
#include "ui/panels.h"
#include "ui/quality_part.h"
#include "ui/theme.h"
#include "ui/view_choice.h"
#include "ui/widgets.h"

#include <algorithm>
#include <fmt/format.h>
#include <imgui.h>

namespace kilolux {

namespace {

void title(const char* text) {
    ImGui::Spacing();
    ImGui::PushFont(theme::smallFont());
    ImGui::TextDisabled("%s", text);
    ImGui::PopFont();
}

// A value at the right end of the row, and behind all of it a bar of that share of the width.
void barRow(Desk& desk, const char* place, const std::string& name, const std::string& value, double share,
            bool chosen) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, height = ImGui::GetTextLineHeight();
    const float bar = width * float(std::clamp(share, 0.0, 1.0));
    ImGui::GetWindowDrawList()->AddRectFilled(corner, {corner.x + bar, corner.y + height},
                                              chosen ? theme::kAccentDim : theme::kField);
    textWithin(name, width - px(desk, 72));
    ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(value.c_str()).x);
    ImGui::TextUnformatted(value.c_str());
    mark(desk, place);
}

void drawPasses(Desk& desk, const FrameStatistics& s) {
    double longest = 1e-6;
    for (const PassTiming& pass : s.passes)
        longest = std::max(longest, pass.medianMs);
    title("Median times; click for what it wrote");
    for (const PassTiming& pass : s.passes) {
        ImGui::PushID(pass.name.c_str());
        const bool chosen = passOfView(s.view) == pass.name;
        const ImVec2 at = ImGui::GetCursorPos();
        if (ImGui::Selectable("##row", chosen))
            setView(desk,
                    chosen && s.viewOutputs.size() <= 1 ? "" : viewOfPass(pass.name, s.view, s.viewOutputs));
        const std::string place = "cost.pass." + pass.name;
        mark(desk, place);
        tooltip(fmt::format("95 % of frames within {:.2f} ms", pass.p95Ms).c_str());
        ImGui::SetCursorPos(at);
        const ViewportRect rect = desk.recordsPlaces ? desk.places[place] : ViewportRect{};
        barRow(desk, place.c_str(), pass.name, fmt::format("{:.2f} ms", pass.medianMs),
               pass.medianMs / longest, chosen);
        if (desk.recordsPlaces) desk.places[place] = rect;
        ImGui::PopID();
    }
    barRow(desk, "cost.frame", "direct light", fmt::format("{:.1f} ms", s.directLightingMs), 0.0, false);
    barRow(desk, "cost.frame", "frame", fmt::format("{:.1f} ms", s.frameMs), 0.0, false);
    if (passOfView(s.view).empty()) return;
    if (textButton(desk, "cost.picture", "Back to the picture")) setView(desk, "");
    ImGui::SameLine();
    ImGui::TextDisabled("%s", s.view.c_str());
}

void drawMemory(Desk& desk, const FrameStatistics& s) {
    title("Device memory, peak");
    for (const MemoryCause& cause : s.gpuMemory)
        barRow(desk, "cost.memory", cause.cause, fmt::format("{:.1f} MiB", cause.peakMiB),
               cause.peakMiB / std::max(s.gpuMemoryPeakMiB, 1e-6), false);
    barRow(desk, "cost.memory", "at once", fmt::format("{:.1f} MiB", s.gpuMemoryPeakMiB), 0.0, false);
}

void drawCounts(Desk& desk, const FrameStatistics& s) {
    title("The picture");
    const auto row = [&](const char* name, const std::string& value) {
        barRow(desk, "cost.count", name, value, 0.0, false);
    };
    row("lights", fmt::format("{}", s.lights));
    row("triangles", fmt::format("{}", s.triangles));
    if (s.lightsInRangeMean > 0.0)
        row("lights in range of a pixel", fmt::format("{:.1f}", s.lightsInRangeMean));
    if (s.candidatesMean > 0.0) {
        row("lights weighed per pixel", fmt::format("{:.1f}", s.candidatesMean));
        row("rays per pixel", fmt::format("{:.2f}", s.raysPerPixelMean));
        row("of these met their light",
            fmt::format("{:.0f} %", 100.0 * s.usefulRaysPerPixelMean / std::max(s.raysPerPixelMean, 1e-6)));
        row("not found in the frame before", fmt::format("{:.1f} %", 100.0 * s.missedShare));
        if (s.droppedLightMean > 0.0)
            row("light lost with dim lights", fmt::format("{:.2f} %", 100.0 * s.droppedLightMean));
        row("lights on a tile's list", fmt::format("{:.1f}", s.listLengthMean));
    }
    row("bounding volumes built in", fmt::format("{:.0f} ms", s.bvhBuildMs));
}

} // namespace

void drawStatisticsPanel(Desk& desk) {
    if (!desk.session || !desk.shown) return;
    const FrameStatistics& s = desk.shown->statistics;
    for (const CostNote& note : costNotes(s)) {
        ImGui::PushTextWrapPos(0.0f);
        ImGui::TextColored(ImColor(note.wrong ? theme::kWarning : theme::kDim), "%s",
                           note.wrong ? theme::kWarn : theme::kInfo);
        ImGui::SameLine();
        ImGui::TextUnformatted(note.text.c_str());
        ImGui::PopTextWrapPos();
    }
    drawQualityPart(desk);
    ImGui::PushFont(theme::smallFont());
    drawPasses(desk, s);
    drawMemory(desk, s);
    drawCounts(desk, s);
    title("History last began anew");
    ImGui::TextUnformatted(s.historyReset.empty() ? "never" : s.historyReset.c_str());
    title("Off, as nothing needs it");
    for (const std::string& feature : s.featuresOff)
        ImGui::TextWrapped("%s", feature.c_str());
    if (!s.notes.empty()) title("Decided for you");
    for (const std::string& note : s.notes)
        ImGui::TextWrapped("%s", note.c_str());
    title("Device");
    ImGui::TextWrapped("%s (%s)", s.device.c_str(), s.driver.c_str());
    ImGui::PopFont();
}

} // namespace kilolux
