// The view panel: what the picture shows, what its colours mean, the value under the pointer, and a file of
// it.
#include "ui/view_panel.h"

#include "renderer/document/light_units.h"
#include "ui/panels.h"
#include "ui/probe_panel.h"
#include "ui/quality_part.h"
#include "ui/reference_image.h"
#include "ui/theme.h"
#include "ui/view_choice.h"
#include "ui/widgets.h"

#include <cmath>
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>
#include <limits>
#include <nlohmann/json.hpp>

namespace kilolux {

namespace {

ViewPanelState& state(Desk& desk) {
    if (!desk.viewPanel) desk.viewPanel = std::make_shared<ViewPanelState>();
    return *desk.viewPanel;
}

ImU32 color(const std::array<float, 3>& srgb) {
    return ImGui::ColorConvertFloat4ToU32({srgb[0], srgb[1], srgb[2], 1.0f});
}

// A label on the left, a value on the right.
void valueRow(const char* label, const std::string& value, const char* unit = "") {
    ImGui::TextDisabled("%s", label);
    const std::string text = *unit ? value + " " + unit : value;
    ImGui::SameLine();
    const float x = ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(text.c_str()).x;
    if (x > ImGui::GetCursorPosX()) ImGui::SetCursorPosX(x);
    ImGui::TextUnformatted(value.c_str());
    if (!*unit) return;
    ImGui::SameLine(0, ImGui::CalcTextSize(" ").x);
    ImGui::TextDisabled("%s", unit);
}

void drawBar(Desk& desk, const Legend& legend, const std::optional<double>& marked) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, height = px(desk, 14);
    ImDrawList& canvas = *ImGui::GetWindowDrawList();
    constexpr int kSteps = 64;
    for (int i = 0; i < kSteps; ++i) {
        const float from = corner.x + width * float(i) / kSteps,
                    to = corner.x + width * float(i + 1) / kSteps;
        canvas.AddRectFilled({from, corner.y}, {to + 0.5f, corner.y + height},
                             color(legendColor(legend, (i + 0.5) / kSteps)));
    }
    ImGui::PushFont(theme::smallFont());
    for (const LegendTick& tick : legendTicks(legend, 5)) {
        const float x = corner.x + width * float(tick.position);
        canvas.AddLine({x, corner.y + height}, {x, corner.y + height + px(desk, 3)}, theme::kDim);
        const float textWidth = ImGui::CalcTextSize(tick.text.c_str()).x;
        const float at = std::clamp(x - 0.5f * textWidth, corner.x, corner.x + width - textWidth);
        canvas.AddText({at, corner.y + height + px(desk, 4)}, theme::kDim, tick.text.c_str());
    }
    if (marked) {
        const float x = corner.x + width * float(legendPosition(legend, *marked));
        canvas.AddTriangleFilled({x - px(desk, 4), corner.y - px(desk, 2)},
                                 {x + px(desk, 4), corner.y - px(desk, 2)}, {x, corner.y + px(desk, 5)},
                                 theme::kAccent);
    }
    ImGui::Dummy({width, height + px(desk, 4) + ImGui::GetTextLineHeight()});
    mark(desk, "view.legend");
    ImGui::PopFont();
}

void drawKeys(Desk& desk, const Legend& legend) {
    for (const LegendKey& key : legend.keys) {
        const float side = ImGui::GetTextLineHeight();
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        ImGui::GetWindowDrawList()->AddRectFilled(corner, {corner.x + side, corner.y + side},
                                                  color(key.srgb));
        ImGui::Dummy({side, side});
        ImGui::SameLine(0, px(desk, 6));
        ImGui::TextUnformatted(key.meaning.data(), key.meaning.data() + key.meaning.size());
    }
}

// The ends of the scale can be typed.
void drawRange(Desk& desk, const Legend& legend) {
    ViewPanelState& panel = state(desk);
    if (legend.scale == LegendScale::Depth || desk.view.starts_with("pass:")) return;
    double ends[2] = {legend.range.low, legend.range.high};
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("Scale");
    ImGui::SameLine(px(desk, 64));
    const float width = px(desk, 72);
    bool typed = false;
    for (int i = 0; i < 2; ++i) {
        if (i == 1) ImGui::SameLine();
        ImGui::SetNextItemWidth(width);
        ImGui::InputDouble(i == 0 ? "##low" : "##high", &ends[i], 0.0, 0.0, "%.5g");
        mark(desk, i == 0 ? "view.low" : "view.high");
        typed = typed || ImGui::IsItemDeactivatedAfterEdit();
    }
    if (panel.range) {
        ImGui::SameLine();
        if (textButton(desk, "view.ownScale", "Reset")) {
            panel.range.reset();
            desk.renderThread->setView(desk.view);
        }
    }
    // Endless numbers can be typed, and those that a shader cannot hold.
    const auto usable = [](double end) { return std::abs(end) <= double(std::numeric_limits<float>::max()); };
    if (!typed || !(ends[1] > ends[0]) || !usable(ends[0]) || !usable(ends[1])) return;
    panel.range = ViewRange{ends[0], ends[1]};
    desk.renderThread->setView(desk.view, panel.range);
}

void drawLegend(Desk& desk) {
    const FrameStatistics& statistics = desk.shown->statistics;
    const Legend& legend = statistics.legend;
    if (!statistics.viewProblem.empty()) ImGui::TextWrapped("%s", statistics.viewProblem.c_str());
    const bool scale =
        legend.map == ColorMap::Amount || legend.map == ColorMap::Signed || legend.map == ColorMap::Grey;
    if (scale) {
        const ViewPanelState& panel = state(desk);
        std::optional<double> marked;
        if (panel.pointerPx && panel.pointer.answer() && panel.pointer.answer()->view == statistics.view)
            marked = panel.pointer.answer()->viewValue.x;
        drawBar(desk, legend, marked);
        drawRange(desk, legend);
    }
    ImGui::PushFont(theme::smallFont());
    ImGui::PushTextWrapPos(0.0f);
    if (!legend.unit.empty()) valueRow("Unit", std::string(legend.unit));
    if (scale || legend.map == ColorMap::Ids)
        ImGui::TextDisabled("%s", std::string(colorMapName(legend.map)).c_str());
    if (!legend.channels.empty()) ImGui::TextDisabled("%s", std::string(legend.channels).c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopFont();
    drawKeys(desk, legend);
}

void drawViews(Desk& desk) {
    for (const ViewGroup& group : viewGroups()) {
        ImGui::Spacing();
        ImGui::PushFont(theme::smallFont());
        ImGui::TextDisabled("%s", std::string(group.title).c_str());
        ImGui::PopFont();
        for (const NamedChoice& view : group.views) {
            const std::string name(view.name), key = viewKey(view.name);
            const bool chosen = view.name == (desk.view.empty() ? "final" : desk.view);
            if (chosen) ImGui::PushStyleColor(ImGuiCol_Text, theme::kAccent);
            if (ImGui::Selectable(name.c_str(), chosen)) setView(desk, name == "final" ? "" : name);
            if (chosen) ImGui::PopStyleColor();
            mark(desk, "view." + name);
            tooltip(std::string(view.help).c_str());
            if (key.empty()) continue;
            ImGui::SameLine(ImGui::GetContentRegionMax().x - px(desk, 16));
            ImGui::TextDisabled("%s", key.c_str());
        }
    }
}

// Asks for the pixel under the pointer when it, or the picture, has changed.
void followPointer(Desk& desk) {
    ViewPanelState& panel = state(desk);
    panel.pointer.update(*desk.renderThread);
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const auto pixel =
        pixelUnder({mouse.x, mouse.y}, desk.viewport.rect, {desk.shown->width, desk.shown->height});
    if (ImGui::GetIO().WantCaptureMouse && !desk.pointerTaken) return;
    if (!pixel || panel.pointer.isAsking()) return;
    if (panel.pointerPx == pixel && panel.pointerFrame == desk.shown->number) return;
    panel.pointerPx = pixel;
    panel.pointerFrame = desk.shown->number;
    panel.pointer.ask(*desk.renderThread, *pixel, ProbeDepth::Surface);
}

void drawPointer(Desk& desk) {
    followPointer(desk);
    const ViewPanelState& panel = state(desk);
    const std::optional<Probe>& found = panel.pointer.answer();
    if (!found) {
        ImGui::TextDisabled("Point at the picture for its values");
        return;
    }
    const Probe& probe = *found;
    const auto three = [](const glm::dvec3& v) {
        return fmt::format("{}  {}  {}", valueText(v.x), valueText(v.y), valueText(v.z));
    };
    valueRow("Pixel", fmt::format("{}, {}", probe.pixel.x, probe.pixel.y));
    const FrameStatistics& statistics = desk.shown->statistics;
    if (probe.view == statistics.view && probe.view != "final") {
        const bool number = statistics.legend.map != ColorMap::None && statistics.legend.map != ColorMap::Ids;
        valueRow("View's value", number ? valueText(probe.viewValue.x) : three(probe.viewValue));
    }
    valueRow("Luminance", valueText(luminanceOf(probe.pictureNit)), "nit");
    valueRow("From middle grey", fmt::format("{:+.2f}", probe.stops), "stops");
    if (!probe.surface) return;
    valueRow("Light on it", valueText(probe.illuminanceLux), "lux");
    valueRow("Surface", probe.node.empty() ? probe.mesh : probe.node);
    valueRow("Distance", valueText(probe.depthM), "m");
}

void drawExport(Desk& desk) {
    ViewPanelState& panel = state(desk);
    if (panel.exportPath.empty() || panel.exportView != desk.view) {
        panel.exportPath = exportPathFor(desk.session->path(), desk.view);
        panel.exportView = desk.view;
    }
    ImGui::SetNextItemWidth(-px(desk, 68));
    ImGui::InputText("##export", &panel.exportPath);
    mark(desk, "view.exportPath");
    tooltip("PNG as on the screen; EXR or HDR with the raw values");
    ImGui::SameLine();
    const bool writing = panel.exported && !panel.exported->done;
    if (textButton(desk, "view.export", "Export", writing ? ButtonLook::Disabled : ButtonLook::Plain))
        panel.exported = exportPicture(*desk.renderThread, panel.exportPath);
    if (panel.exported && panel.exported->done) {
        notify(desk, panel.exported->failed ? Notice::Kind::Error : Notice::Kind::Info, panel.exported->text);
        panel.exported.reset();
    }
}

} // namespace

void drawViewPanel(Desk& desk) {
    if (!desk.session || !desk.shown) return;
    ViewPanelState& panel = state(desk);
    if (panel.rangeView != desk.view) panel.range.reset();
    panel.rangeView = desk.view;
    ImGui::TextUnformatted(desk.view.empty() ? "final" : desk.view.c_str());
    drawLegend(desk);
    ImGui::Separator();
    drawPointer(desk);
    ImGui::Separator();
    drawReferencePart(desk);
    drawErrorPlot(desk);
    ImGui::Separator();
    drawExport(desk);
    ImGui::Separator();
    drawViews(desk);
}

void handleViewKeys(Desk& desk) {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.KeyCtrl || io.KeyAlt || desk.flying) return;
    for (std::size_t i = 0; i < kViewKeys.size(); ++i) {
        if (ImGui::IsKeyPressed('1' + int(i), false)) setView(desk, i == 0 ? "" : std::string(kViewKeys[i]));
    }
    if (ImGui::IsKeyPressed('P', false)) toggleProbe(desk);
    if (ImGui::IsKeyPressed('B', false)) toggleStored(desk);
}

nlohmann::json viewPanelState(const Desk& desk) {
    if (!desk.shown) return nlohmann::json::object();
    const Legend& legend = desk.shown->statistics.legend;
    nlohmann::json json{{"shown", desk.shown->statistics.view},
                        {"low", legend.range.low},
                        {"high", legend.range.high},
                        {"unit", std::string(legend.unit)},
                        {"problem", desk.shown->statistics.viewProblem}};
    if (desk.viewPanel && desk.viewPanel->pointer.answer()) {
        const auto& probe = desk.viewPanel->pointer.answer();
        json["pointer"] = {{"x", probe->pixel.x}, {"y", probe->pixel.y}, {"value", probe->viewValue.x}};
    }
    json["picking"] = desk.probe && desk.probe->picking;
    if (desk.probe && desk.probe->probe.answer()) {
        const Probe& probe = *desk.probe->probe.answer();
        json["probe"] = {{"x", probe.pixel.x}, {"y", probe.pixel.y}, {"lux", probe.lux}, {"nit", probe.nit}};
        json["probe"]["lights"] = nlohmann::json::array();
        for (const ProbedLight& light : probe.lights)
            json["probe"]["lights"].push_back(light.id);
    }
    if (const ReferenceState* ref = desk.reference.get()) {
        json["comparing"] = int(ref->mode);
        json["referenceFrames"] = ref->live ? ref->live->state().frames : 0;
        if (ref->report)
            json["error"] = {{"flip", ref->report->flipMean},
                             {"relativeMse", ref->report->relativeMse},
                             {"frames", ref->report->frames}};
    }
    json["quality"] = qualityState(desk);
    return json;
}

} // namespace kilolux
