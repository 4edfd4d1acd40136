// Quality presets and the plot of error against time, see quality_part.h.
#include "ui/quality_part.h"

#include "renderer/legend.h"
#include "renderer/settings_presets.h"
#include "ui/reference_image.h"
#include "ui/theme.h"
#include "ui/widgets.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <imgui.h>
#include <nlohmann/json.hpp>

namespace kilolux {

namespace {

constexpr std::uint32_t kRunFrames = 32;       // of a preset's picture, when all are measured
constexpr std::uint32_t kEnoughReference = 32; // frames of the reference before they are

QualityState& state(Desk& desk) {
    if (!desk.quality) desk.quality = std::make_shared<QualityState>();
    return *desk.quality;
}

void choose(Desk& desk, const SettingsPreset& preset) {
    Settings settings = desk.settings;
    applyPreset(settings, preset);
    setSettings(desk, settings);
}

// The picture as it is from its first frame on.
void restart(Desk& desk) {
    desk.renderThread->setCamera(desk.camera.camera(), Renderer::CameraChange::Cut);
}

void endRun(Desk& desk) {
    QualityState& quality = state(desk);
    if (quality.run) setSettings(desk, quality.run->before);
    quality.run.reset();
}

// On to the next preset when the present one has been measured long enough.
void goOn(Desk& desk) {
    QualityState& quality = state(desk);
    if (!quality.run) return;
    QualityState::Run& run = *quality.run;
    const auto presets = settingsPresets();
    const ErrorCurve* curve = quality.curves.present();
    const bool measured =
        run.begun && curve && !curve->points.empty() && curve->points.back().frames >= kRunFrames;
    if (run.next > 0 && !measured) return;
    if (run.next == presets.size()) return endRun(desk);
    run.begun = false;
    const Settings before = desk.settings;
    choose(desk, presets[run.next++]);
    if (desk.settings == before) restart(desk);
}

void drawRow(Desk& desk, const SettingsPreset& preset, bool chosen) {
    const QualityState& quality = state(desk);
    const std::string name(preset.name), place = "quality." + name;
    if (chosen) ImGui::PushStyleColor(ImGuiCol_Text, theme::kAccent);
    if (ImGui::Selectable(name.c_str(), chosen)) {
        endRun(desk);
        choose(desk, preset);
    }
    if (chosen) ImGui::PopStyleColor();
    mark(desk, place);
    tooltip(fmt::format("{}\nLook: {}", preset.help, preset.look).c_str());
    const ErrorCurve* curve = quality.curves.curveOf(name);
    const float right = ImGui::GetContentRegionMax().x;
    const auto column = [&](const std::string& text, float end) {
        ImGui::SameLine(end - ImGui::CalcTextSize(text.c_str()).x);
        ImGui::TextDisabled("%s", text.c_str());
    };
    const double ms = chosen ? desk.shown->statistics.frameMs : curve ? curve->frameMs : 0.0;
    const bool measured = curve && !curve->points.empty();
    column(ms > 0.0 ? fmt::format("{:.0f} ms", ms) : "-", right - px(desk, 72));
    column(measured ? fmt::format("{:.3f}", curve->points.back().flip) : "-", right);
}

struct Plot {
    ImVec2 corner, size;
    SpeedError::Axes axes;

    ImVec2 at(double seconds, double error) const {
        return {corner.x + size.x * float(axisPosition(axes.seconds, seconds)),
                corner.y + size.y * float(1.0 - axisPosition(axes.error, error))};
    }
};

void drawGrid(Desk& desk, ImDrawList& canvas, const Plot& plot) {
    constexpr ImU32 kGrid = IM_COL32(58, 58, 58, 255);
    const float line = ImGui::GetTextLineHeight();
    for (double s = plot.axes.seconds[0]; s <= plot.axes.seconds[1] * 1.001; s *= 10.0) {
        const ImVec2 at = plot.at(s, plot.axes.error[0]);
        canvas.AddLine({at.x, plot.corner.y}, at, kGrid);
        const std::string text = fmt::format("{:g} s", s);
        const float width = ImGui::CalcTextSize(text.c_str()).x;
        const float x = std::clamp(at.x - 0.5f * width, plot.corner.x, plot.corner.x + plot.size.x - width);
        canvas.AddText({x, at.y + px(desk, 2)}, theme::kDim, text.c_str());
    }
    for (double e = plot.axes.error[0]; e <= plot.axes.error[1] * 1.001; e *= 10.0) {
        const ImVec2 at = plot.at(plot.axes.seconds[0], e);
        canvas.AddLine(at, {plot.corner.x + plot.size.x, at.y}, kGrid);
        const std::string text = fmt::format("{:g}", e);
        canvas.AddText({at.x - px(desk, 6) - ImGui::CalcTextSize(text.c_str()).x, at.y - 0.5f * line},
                       theme::kDim, text.c_str());
    }
}

// Points that the reference is too young for are rings.
void drawCurve(Desk& desk, ImDrawList& canvas, const Plot& plot, const ErrorCurve& curve, bool isPresent) {
    const ImU32 color = isPresent ? theme::kAccent : theme::kDim;
    const ErrorPoint* before = nullptr;
    for (const ErrorPoint& point : curve.points) {
        const ImVec2 at = plot.at(point.seconds, point.flip);
        if (before)
            canvas.AddLine(plot.at(before->seconds, before->flip), at, color,
                           px(desk, isPresent ? 1.6 : 1.0));
        if (point.isCertain()) {
            canvas.AddCircleFilled(at, px(desk, isPresent ? 3.0 : 2.0), color);
        } else {
            canvas.AddCircle(at, px(desk, isPresent ? 3.0 : 2.0), color);
        }
        before = &point;
    }
    if (isPresent || !before) return;
    const ImVec2 end = plot.at(before->seconds, before->flip);
    const float width = ImGui::CalcTextSize(curve.preset.c_str()).x;
    const float x = std::min(end.x + px(desk, 4), plot.corner.x + plot.size.x - width);
    canvas.AddText({x, end.y - ImGui::GetTextLineHeight()}, color, curve.preset.c_str());
}

// What the point next to the pointer is.
void drawPointTip(Desk& desk, const SpeedError& curves, const Plot& plot) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    float nearest = px(desk, 12);
    std::string text;
    for (const ErrorCurve& curve : curves.curves()) {
        for (const ErrorPoint& point : curve.points) {
            const ImVec2 at = plot.at(point.seconds, point.flip);
            const float away = std::hypot(at.x - mouse.x, at.y - mouse.y);
            if (away >= nearest) continue;
            nearest = away;
            text =
                fmt::format("{}: {} frames of {:.0f} ms\nFLIP {:.4f}, relMSE {:.3g}{}",
                            curve.preset.empty() ? "own settings" : curve.preset, point.frames, curve.frameMs,
                            point.flip, point.relativeMse,
                            point.isCertain() ? "" : "\nwith noise of the reference, which is still young");
        }
    }
    if (!text.empty()) ImGui::SetTooltip("%s", text.c_str());
}

} // namespace

std::string presetName(const Settings& settings) {
    const SettingsPreset* preset = presetOf(settings);
    return preset ? std::string(preset->name) : "";
}

void followQuality(Desk& desk) {
    QualityState& quality = state(desk);
    const ReferenceState* ref = desk.reference.get();
    if (!ref || !ref->measures) return endRun(desk);
    const ShownFrame& shown = *desk.shown;
    const bool viewChanged = quality.view != ref->wantedKey;
    if (viewChanged && quality.view != 0) endRun(desk); // what was measured is of another one
    quality.view = ref->wantedKey;
    quality.curves.setView(ref->wantedKey);
    const std::string preset = presetName(shown.settings);
    if (viewChanged || preset != quality.preset || shown.meanFrames < quality.frames) {
        quality.curves.begin(preset);
        if (quality.run) quality.run->begun = true;
    }
    quality.preset = preset;
    quality.frames = shown.meanFrames;
    if (const ErrorReport* report = ref->report.get(); report && report != quality.report) {
        quality.report = report;
        const MeasuredPicture& of = report->of;
        const ErrorPoint point{of.frames, of.frames * of.frameMs * 1e-3, report->flipMean,
                               report->relativeMse, report->frames};
        if (of.preset == preset && of.frames <= shown.meanFrames) quality.curves.add(point, of.frameMs);
    }
    goOn(desk);
}

void drawQualityPart(Desk& desk) {
    const std::string chosen = presetName(desk.settings);
    ImGui::PushFont(theme::smallFont());
    ImGui::TextDisabled("%s", chosen.empty() ? "Quality: settings of your own" : "Quality");
    const float right = ImGui::GetContentRegionMax().x;
    ImGui::SameLine(right - px(desk, 72) - ImGui::CalcTextSize("frame").x);
    ImGui::TextDisabled("frame");
    ImGui::SameLine(right - ImGui::CalcTextSize("FLIP").x);
    ImGui::TextDisabled("FLIP");
    ImGui::PopFont();
    for (const SettingsPreset& preset : settingsPresets())
        drawRow(desk, preset, preset.name == chosen);
}

void drawErrorPlot(Desk& desk) {
    QualityState& quality = state(desk);
    const ReferenceState* ref = desk.reference.get();
    if (!ref || !ref->measures) return;
    if (textButton(desk, "quality.again", "Again")) restart(desk);
    tooltip("Begins the picture anew, to be measured from its first frames on");
    ImGui::SameLine();
    const bool ready = ref->live->state().frames >= kEnoughReference;
    const ButtonLook look = quality.run ? ButtonLook::Active
                            : ready     ? ButtonLook::Plain
                                        : ButtonLook::Disabled;
    if (textButton(desk, "quality.all", quality.run ? "Stop" : "Measure all", look)) {
        if (quality.run) {
            endRun(desk);
        } else {
            quality.run = QualityState::Run{desk.settings, 0};
        }
    }
    tooltip(ready ? "Every preset in turn, from its first frames on" : "When the reference has 32 frames");
    SpeedError::Axes axes;
    if (!quality.curves.axes(axes)) return;
    ImGui::PushFont(theme::smallFont());
    const float left = px(desk, 44), line = ImGui::GetTextLineHeight();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 whole{ImGui::GetContentRegionAvail().x, px(desk, 140) + 1.5f * line};
    const Plot plot{{corner.x + left, corner.y + line}, {whole.x - left - px(desk, 4), px(desk, 132)}, axes};
    ImDrawList& canvas = *ImGui::GetWindowDrawList();
    canvas.AddText(corner, theme::kDim, "FLIP");
    drawGrid(desk, canvas, plot);
    for (const ErrorCurve& curve : quality.curves.curves())
        if (&curve != quality.curves.present()) drawCurve(desk, canvas, plot, curve, false);
    if (const ErrorCurve* present = quality.curves.present()) drawCurve(desk, canvas, plot, *present, true);
    ImGui::Dummy({whole.x, whole.y + line});
    mark(desk, "quality.plot");
    if (ImGui::IsItemHovered()) drawPointTip(desk, quality.curves, plot);
    ImGui::PopFont();
    drawQualityPart(desk);
}

nlohmann::json qualityState(const Desk& desk) {
    nlohmann::json json = {{"preset", presetName(desk.settings)}, {"curves", nlohmann::json::object()}};
    if (!desk.quality) return json;
    json["measuring"] = desk.quality->run.has_value();
    for (const ErrorCurve& curve : desk.quality->curves.curves()) {
        nlohmann::json points = nlohmann::json::array();
        for (const ErrorPoint& point : curve.points)
            points.push_back({point.frames, point.seconds, point.flip});
        json["curves"][curve.preset] = std::move(points);
    }
    return json;
}

} // namespace kilolux
