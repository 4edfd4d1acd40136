#include "ui/light_commands.h"

#include "ui/light_actions.h"
#include "ui/light_fields.h"
#include "ui/light_place.h"
#include "ui/scene_ray.h"
#include "ui/text_case.h"
#include "ui/viewport_tools.h"

#include <algorithm>
#include <fmt/format.h>
#include <imgui.h>
#include <set>

namespace kilolux {

namespace {

// Nothing selected is nothing to do, said once.
bool hasSelection(Desk& desk, const char* what) {
    if (!desk.session) return false;
    if (!desk.selection.empty()) return true;
    notify(desk, Notice::Kind::Info, fmt::format("Select a light to {}", what));
    return false;
}

// Applies edits that make lights, and selects those.
bool makeLights(Desk& desk, const Result<Edits>& edits, const std::string& name) {
    const std::vector<std::uint64_t> made = edits ? newLights(edits.value()) : std::vector<std::uint64_t>{};
    if (!applyEdits(desk, edits, name)) return false;
    select(desk, made);
    return true;
}

// Turns membership over for all: in when one is missing, else out.
std::vector<std::uint64_t> toggled(const std::vector<std::uint64_t>& set, std::vector<std::uint64_t> lights) {
    std::sort(lights.begin(), lights.end());
    std::vector<std::uint64_t> result;
    if (std::includes(set.begin(), set.end(), lights.begin(), lights.end())) {
        std::set_difference(set.begin(), set.end(), lights.begin(), lights.end(), std::back_inserter(result));
    } else {
        std::set_union(set.begin(), set.end(), lights.begin(), lights.end(), std::back_inserter(result));
    }
    return result;
}

} // namespace

void addLightAtPixel(Desk& desk, LightType type, glm::dvec2 px) {
    if (!desk.session) return;
    const Scene& scene = desk.session->scene();
    const ViewRay ray = desk.viewport.ray(px);
    const std::optional<SurfaceHit> hit = nearestSurface(scene, ray);
    LightPlace place{ray.originWs + desk.camera.pivotDistanceM() * ray.dirWs, ray.dirWs};
    if (hit) place = {hit->pointWs, hit->normalWs};
    // A sun shines down, whatever it was clicked on.
    if (type == LightType::Directional) place.dirWs = glm::normalize(glm::dvec3(-0.4, -1.0, -0.3));
    const Edits edits = addLightAt(scene, desk.session->ids(), type, place);
    if (makeLights(desk, edits, "Add " + withinSentence(typeName(type))) && desk.tool == Tool::Select)
        desk.tool = Tool::Move;
}

void duplicateSelection(Desk& desk) {
    if (!hasSelection(desk, "duplicate it")) return;
    makeLights(desk, duplicateLights(desk.session->scene(), desk.session->ids(), desk.selection),
               "Duplicate " + countedLights(desk.selection.size()));
}

void deleteSelection(Desk& desk) {
    if (!hasSelection(desk, "delete it")) return;
    applyEdits(desk, deleteLights(desk.session->scene(), desk.selection),
               "Delete " + countedLights(desk.selection.size()));
}

void toggleMute(Desk& desk, const std::vector<std::uint64_t>& lights) {
    if (!desk.session || lights.empty()) return;
    const bool mute = !allMuted(desk.session->scene(), lights);
    applyEdits(desk, muteLights(desk.session->scene(), lights, mute),
               (mute ? "Mute " : "Unmute ") + countedLights(lights.size()));
}

void copySelection(Desk& desk) {
    if (!hasSelection(desk, "copy it")) return;
    ImGui::SetClipboardText(lightsToText(desk.session->scene(), desk.selection).c_str());
    notify(desk, Notice::Kind::Info, "Copied " + countedLights(desk.selection.size()) + " as text");
}

void cutSelection(Desk& desk) {
    if (!hasSelection(desk, "cut it")) return;
    ImGui::SetClipboardText(lightsToText(desk.session->scene(), desk.selection).c_str());
    applyEdits(desk, deleteLights(desk.session->scene(), desk.selection),
               "Cut " + countedLights(desk.selection.size()));
}

void pasteLights(Desk& desk) {
    if (!desk.session) return;
    const char* text = ImGui::GetClipboardText();
    const Result<Edits> edits = lightsFromText(desk.session->scene(), desk.session->ids(), text ? text : "");
    if (!edits) return notify(desk, Notice::Kind::Warning, edits.error());
    makeLights(desk, edits, "Paste " + countedLights(newLights(edits.value()).size()));
}

void groupSelection(Desk& desk) {
    if (!hasSelection(desk, "group it")) return;
    applyEdits(desk, groupLights(desk.session->scene(), desk.session->ids(), desk.selection, "Group"),
               "Group " + countedLights(desk.selection.size()));
}

void dissolveGroup(Desk& desk, std::uint64_t group) {
    if (!desk.session) return;
    const Scene& scene = desk.session->scene();
    const int at = findGroup(scene, group);
    if (at < 0) return;
    applyEdits(desk, deleteGroups(scene, {&group, 1}),
               fmt::format("Dissolve '{}'", scene.groups[std::size_t(at)].name));
}

void ungroupSelection(Desk& desk) {
    if (!hasSelection(desk, "dissolve its group")) return;
    const Scene& scene = desk.session->scene();
    std::set<std::uint64_t> groups;
    for (const std::uint64_t id : desk.selection)
        if (const std::uint64_t group = lightOf(scene, id).group; group != 0) groups.insert(group);
    if (groups.empty()) return notify(desk, Notice::Kind::Info, "The selected lights are in no group");
    if (groups.size() == 1) return dissolveGroup(desk, *groups.begin());
    const std::vector<std::uint64_t> all(groups.begin(), groups.end());
    applyEdits(desk, deleteGroups(scene, all), fmt::format("Dissolve {} groups", all.size()));
}

void renameLights(Desk& desk, const std::vector<std::uint64_t>& lights, const std::string& name) {
    if (!desk.session || lights.empty()) return;
    applyEdits(desk, editsForName(desk.session->scene(), lights, name),
               "Rename " + countedLights(lights.size()));
}

void lookThroughLight(Desk& desk) {
    if (!desk.session) return;
    GizmoState& state = viewportTools(desk);
    if (state.before) {
        cutCamera(desk, *state.before);
        state.before.reset();
        return;
    }
    if (!hasSelection(desk, "look through it")) return;
    const Scene& scene = desk.session->scene();
    Camera camera = desk.camera.camera();
    state.before = camera;
    camera.worldFromCamera = rigidFrame(nodeOf(scene, desk.selection.front()).worldFromNode);
    cutCamera(desk, camera);
    notify(desk, Notice::Kind::Info, "Looking through the light; L again goes back");
}

void toggleSolo(Desk& desk, const std::vector<std::uint64_t>& lights) {
    if (!desk.session) return;
    const bool same = desk.solo == lights;
    setSolo(desk, same || lights.empty() ? std::vector<std::uint64_t>{} : lights);
}

void toggleLock(Desk& desk, const std::vector<std::uint64_t>& lights) {
    desk.locked = toggled(desk.locked, lights);
}

bool isLocked(const Desk& desk, std::uint64_t light) {
    return std::binary_search(desk.locked.begin(), desk.locked.end(), light);
}

} // namespace kilolux
