// Rows of the properties panel about meshes, see mesh_rows.h.
#include "ui/mesh_rows.h"

#include "ui/light_list_model.h"
#include "ui/light_place.h"
#include "ui/property_rows.h"
#include "ui/shaping_rows.h"
#include "ui/theme.h"
#include "ui/widgets.h"

#include <algorithm>
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

namespace kilolux {

namespace {

// Of all selected lights together.
std::uint8_t selectedChannels(const Desk& desk) {
    std::uint8_t bits = 0;
    for (const std::uint64_t light : desk.selection)
        bits |= defOf(desk.session->scene(), light).channels;
    return bits;
}

std::string nameOf(const Scene& scene, const Node& node) {
    if (!node.name.empty()) return node.name;
    const std::string& mesh = scene.meshes[std::size_t(node.mesh)]->name;
    return mesh.empty() ? fmt::format("mesh {}", node.mesh + 1) : mesh;
}

void setChannels(Desk& desk, std::span<const int> nodes, std::uint64_t bits, const std::string& of) {
    const EditField& field = *findEditField(EditTarget::Node, "meshChannels");
    Edits all;
    for (const int node : nodes) {
        const Result<Edits> edits =
            setField(desk.session->scene(), EditTarget::Node, std::uint64_t(node), field, bits);
        if (!edits) return (void)applyEdits(desk, edits, ""); // tells
        all.insert(all.end(), edits.value().begin(), edits.value().end());
    }
    applyEdits(desk, all, "Channels of " + of);
}

// One row of buttons for all that are listed.
void drawAll(Desk& desk, const PropertiesState& state) {
    const Scene& scene = desk.session->scene();
    const auto bitsOf = [&](int node) { return scene.nodes[std::size_t(node)].meshChannels; };
    CommonValue value{std::uint64_t{bitsOf(state.meshNodes[0])}, false};
    value.mixed = std::any_of(state.meshNodes.begin(), state.meshNodes.end(),
                              [&](int node) { return bitsOf(node) != bitsOf(state.meshNodes[0]); });
    const std::string label = fmt::format("All {} here", state.meshNodes.size());
    const float width = rowLabel(desk, label.c_str(), value.mixed ? "These meshes differ" : nullptr);
    if (const auto bits = channelButtons(desk, "mesh.all", value, width))
        setChannels(desk, std::vector<int>(state.meshNodes), *bits,
                    fmt::format("{} meshes", state.meshNodes.size()));
}

} // namespace

void countMeshes(Desk& desk) {
    PropertiesState& state = propertiesOf(desk);
    const Scene& scene = desk.session->scene();
    const std::uint8_t channels = selectedChannels(desk);
    state.meshNodes.clear();
    state.meshes = state.reached = 0;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        if (node.mesh < 0 || !node.visible) continue;
        ++state.meshes;
        state.reached += (node.meshChannels & channels) != 0;
        if (containsWords(nameOf(scene, node), state.meshSearch)) state.meshNodes.push_back(int(i));
    }
}

void drawReach(Desk& desk) {
    const PropertiesState& state = propertiesOf(desk);
    rowLabel(desk, "Reaches", "Meshes that share a channel; those of each mesh stand below");
    const bool all = state.reached == state.meshes;
    const std::string text = all ? fmt::format("all {} meshes", state.meshes)
                                 : fmt::format("{} of {} meshes", state.reached, state.meshes);
    ImGui::TextColored(ImColor(all ? theme::kDim : theme::kText), "%s", text.c_str());
    mark(desk, "channels.reach");
}

void drawMeshRows(Desk& desk) {
    PropertiesState& state = propertiesOf(desk);
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
    if (ImGui::InputTextWithHint("##meshes", "Search meshes", &state.meshSearch)) countMeshes(desk);
    mark(desk, "mesh.search");
    if (state.meshNodes.empty()) return ImGui::TextDisabled("No mesh of that name");
    if (state.meshNodes.size() > 1) drawAll(desk, state);
    const std::uint8_t channels = selectedChannels(desk);
    ImGuiListClipper clipper;
    clipper.Begin(int(state.meshNodes.size()), ImGui::GetFrameHeightWithSpacing());
    while (clipper.Step()) {
        for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row) {
            const Scene& scene = desk.session->scene();
            const int index = state.meshNodes[std::size_t(row)];
            const Node& node = scene.nodes[std::size_t(index)];
            const std::string name = nameOf(scene, node);
            const bool missed = !desk.selection.empty() && (node.meshChannels & channels) == 0;
            ImGui::PushStyleColor(ImGuiCol_Text, missed ? theme::kDim : theme::kText);
            const float width =
                rowLabel(desk, name.c_str(), missed ? "The selected lights do not reach it" : nullptr);
            ImGui::PopStyleColor();
            const CommonValue value{std::uint64_t{node.meshChannels}, false};
            if (const auto bits = channelButtons(desk, fmt::format("mesh.{}", index), value, width))
                setChannels(desk, {&index, 1}, *bits, name);
        }
    }
}

} // namespace kilolux
