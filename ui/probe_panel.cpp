// The probe: a pixel is chosen by a click, its lights stand in a table by what they give, and the rays to
// them in the viewport. A row selects its light.
#include "ui/probe_panel.h"

#include "renderer/document/edit.h"
#include "renderer/document/light_units.h"
#include "ui/panels.h"
#include "ui/theme.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>
#include <nlohmann/json.hpp>
#include <utility>

namespace kilolux {

namespace {

constexpr double kAskEveryS = 0.5; // while pictures come
constexpr int kLinesPerLight = 4;
constexpr ImU32 kSeenRay = IM_COL32(130, 190, 140, 170), kHiddenRay = IM_COL32(120, 120, 120, 70);

ProbeState& state(Desk& desk) {
    if (!desk.probe) desk.probe = std::make_shared<ProbeState>();
    return *desk.probe;
}

void ask(Desk& desk) {
    ProbeState& panel = state(desk);
    panel.askedFrame = desk.shown->number;
    panel.askedS = desk.nowS;
    panel.probe.ask(*desk.renderThread, *panel.pixel, ProbeDepth::Lights);
}

void keepUp(Desk& desk) {
    ProbeState& panel = state(desk);
    panel.probe.update(*desk.renderThread);
    if (!panel.pixel || panel.probe.isAsking()) return;
    const bool due = desk.nowS - panel.askedS > kAskEveryS || desk.shown->settled;
    if (panel.askedFrame != desk.shown->number && due) ask(desk);
}

void row(Desk& desk, const char* label, const std::string& value) {
    ImGui::TextDisabled("%s", label);
    ImGui::SameLine(px(desk, 84));
    textWithin(value, ImGui::GetContentRegionAvail().x);
}

std::string three(const glm::dvec3& v) {
    return fmt::format("{}  {}  {}", valueText(v.x), valueText(v.y), valueText(v.z));
}

void drawSurface(Desk& desk, const Probe& probe) {
    const double nit = luminanceOf(probe.pictureNit);
    row(desk, "Pixel", fmt::format("{}, {}", probe.pixel.x, probe.pixel.y));
    row(desk, "Picture", fmt::format("{} nit, {:+.2f} stops", valueText(nit), probe.stops));
    if (!probe.surface) {
        ImGui::TextDisabled("No surface here");
        return;
    }
    row(desk, "Light on it", fmt::format("{} lux", valueText(probe.lux)));
    row(desk, "Light from it", fmt::format("{} nit", valueText(probe.nit)));
    row(desk, "Surface", probe.node.empty() ? probe.mesh : probe.node);
    row(desk, "Material",
        fmt::format("{}: rough {}, metal {}", probe.material.empty() ? "default" : probe.material,
                    valueText(probe.roughness), valueText(probe.metallic)));
    row(desk, "Base colour", three(probe.baseColor));
    row(desk, "Position", three(probe.positionWs) + " m");
    row(desk, "Normal", three(probe.normalWs));
    row(desk, "Lights",
        fmt::format("{} of {} in range are seen; {} count", probe.lightsSeen, probe.lightsInRange,
                    valueText(probe.effectiveLights)));
    if (probe.candidates == 0) return;
    row(desk, "Choice",
        fmt::format("{} weighed: {} of tile {}, {}; every {} of {} in the cell", probe.candidates,
                    probe.listLights, probe.listTile.x, probe.listTile.y, probe.stride, probe.cellLights));
    const double total = probe.visibleWeight + probe.hiddenBudget + probe.directionalBudget;
    const auto share = [&](double part) { return total > 0.0 ? 100.0 * part / total : 0.0; };
    row(desk, "Samples",
        fmt::format("{:.0f} % visible, {:.0f} % hidden, {:.0f} % directional{}", share(probe.visibleWeight),
                    share(probe.hiddenBudget), share(probe.directionalBudget),
                    probe.missed ? "; not found before" : ""));
}

void cell(const std::string& text) {
    ImGui::TableNextColumn();
    const float x =
        ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
    ImGui::SetCursorPosX(std::max(ImGui::GetCursorPosX(), x));
    ImGui::TextUnformatted(text.c_str());
}

std::string whyOf(const ProbedLight& light) {
    std::string text =
        fmt::format("{}{}{} {}\nweight {}, probability {:.4f}", light.name, light.name.empty() ? "" : ": ",
                    light.type, light.id, valueText(light.weight), light.probability);
    text +=
        light.candidate ? fmt::format("\nweighed as a {} light", light.list) : "\nnot weighed in this frame";
    if (light.listed) text += fmt::format("\non the visible list, unseen for {} frames", light.unseenFrames);
    if (light.fresh) text += "\njust edited";
    if (!light.reaches) text += "\nout of its range, cone or side";
    text += fmt::format("\nwithout shadows {} lux, {} nit", valueText(light.irradianceLux.g),
                        valueText(light.reflectedNit.g));
    if (light.chosen > 0) text += fmt::format("\nchosen by {} of this frame's rays", light.chosen);
    return text;
}

// The dome is no light of the list.
bool canSelect(const Desk& desk, const ProbedLight& light) {
    return findLight(desk.session->scene(), light.id) >= 0;
}

void drawLights(Desk& desk, const Probe& probe) {
    constexpr ImGuiTableFlags kFlags =
        ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit;
    if (!ImGui::BeginTable("lights", 5, kFlags, {0, ImGui::GetContentRegionAvail().y})) return;
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("Light", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("lux", ImGuiTableColumnFlags_WidthFixed, px(desk, 48));
    for (const char* title : {"share", "seen", "prob."})
        ImGui::TableSetupColumn(title, ImGuiTableColumnFlags_WidthFixed, px(desk, 40));
    ImGui::TableHeadersRow();
    ImGui::PushFont(theme::smallFont());
    for (const ProbedLight& light : probe.lights) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::PushID(int(light.id));
        const bool selected = desk.isSelected(light.id);
        const bool dim = light.nit <= 0.0;
        if (selected || dim) ImGui::PushStyleColor(ImGuiCol_Text, selected ? theme::kAccent : theme::kDim);
        const std::string name = light.name.empty() ? fmt::format("light {}", light.id) : light.name;
        if (ImGui::Selectable(name.c_str(), selected, ImGuiSelectableFlags_SpanAllColumns) &&
            canSelect(desk, light))
            select(desk, {light.id}, ImGui::GetIO().KeyShift ? Selecting::Add : Selecting::Replace);
        mark(desk, fmt::format("probe.light.{}", light.id));
        tooltip(whyOf(light).c_str());
        cell(valueText(light.lux));
        cell(fmt::format("{:.1f} %", 100.0 * light.share));
        cell(fmt::format("{:.0f} %", 100.0 * light.visibility));
        cell(fmt::format("{:.3f}", light.probability));
        if (selected || dim) ImGui::PopStyleColor();
        ImGui::PopID();
    }
    ImGui::PopFont();
    ImGui::EndTable();
}

} // namespace

void drawProbePanel(Desk& desk) {
    if (!desk.session || !desk.shown) return;
    ProbeState& panel = state(desk);
    keepUp(desk);
    if (textButton(desk, "probe.pick", "Pick a pixel",
                   panel.picking ? ButtonLook::Active : ButtonLook::Plain))
        panel.picking = !panel.picking;
    tooltip("Then click in the picture (P)");
    const std::optional<Probe>& found = panel.probe.answer();
    if (found && !found->lights.empty() && canSelect(desk, found->lights.front())) {
        ImGui::SameLine();
        if (textButton(desk, "probe.strongest", "Select the strongest"))
            select(desk, {found->lights.front().id});
        tooltip("The light that gives this pixel most, shadows counted");
    }
    if (!panel.probe.problem().empty()) ImGui::TextWrapped("%s", panel.probe.problem().c_str());
    if (!found) {
        ImGui::TextDisabled("%s", panel.pixel ? "Looking..."
                                              : "Shows every light at a pixel: what it gives, whether\n"
                                                "it is seen, and how likely a ray goes to it.");
        return;
    }
    ImGui::PushFont(theme::smallFont());
    drawSurface(desk, *found);
    ImGui::PopFont();
    ImGui::Spacing();
    if (found->surface) drawLights(desk, *found);
}

void toggleProbe(Desk& desk) {
    state(desk).picking = !state(desk).picking;
    if (state(desk).picking) showTab(desk, RightTab::Probe); // where the answer will stand
}

bool cancelProbePick(Desk& desk) {
    return std::exchange(state(desk).picking, false);
}

void drawProbeOverlay(Desk& desk, ImDrawList& canvas) {
    ProbeState& panel = state(desk);
    const ImGuiIO& io = ImGui::GetIO();
    const glm::dvec2 mouse(io.MousePos.x, io.MousePos.y);
    const auto under = pixelUnder(mouse, desk.viewport.rect, {desk.shown->width, desk.shown->height});
    const bool free = !io.WantCaptureMouse && !desk.pointerTaken && !desk.flying;
    if (panel.picking && under && free) {
        canvas.AddCircle({io.MousePos.x, io.MousePos.y}, px(desk, 7), theme::kAccent, 0, px(desk, 1.5));
        canvas.AddCircleFilled({io.MousePos.x, io.MousePos.y}, px(desk, 1.5), theme::kAccent);
        if (ImGui::IsMouseClicked(0) && !io.KeyAlt) {
            panel.pixel = under;
            panel.pressed = true;
            ask(desk);
        }
    }
    if (panel.pressed) {
        desk.pointerTaken = true;
        if (!ImGui::IsMouseDown(0)) panel.pressed = panel.picking = false;
    }
    const std::optional<Probe>& found = panel.probe.answer();
    if (!panel.pixel || !found || !found->surface) return;
    for (const ProbeLine& line : probeLines(*found, kLinesPerLight)) {
        const auto segment = desk.viewport.project(line.fromWs, line.toWs);
        if (!segment) continue;
        const bool selected = desk.isSelected(line.light);
        const ImU32 color = !line.visible ? kHiddenRay : (selected ? theme::kAccent : kSeenRay);
        canvas.AddLine({float(segment->from.x), float(segment->from.y)},
                       {float(segment->to.x), float(segment->to.y)}, color,
                       selected ? px(desk, 2) : px(desk, 1));
    }
    if (const auto at = desk.viewport.project(found->positionWs)) {
        const ImVec2 centre(float(at->x), float(at->y));
        canvas.AddCircle(centre, px(desk, 5), theme::kAccent, 0, px(desk, 1.5));
    }
}

} // namespace kilolux
