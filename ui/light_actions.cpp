#include "ui/light_actions.h"

#include "renderer/document/light_shapes.h"
#include "ui/change_builder.h"
#include "ui/light_place.h"

#include <algorithm>
#include <fmt/format.h>

namespace kilolux {

namespace {

// The turn that makes -Z look along `dir`, with X kept level.
glm::dquat lookingAlong(const glm::dvec3& dir) {
    const glm::dvec3 z = -dir;
    const glm::dvec3 up = std::abs(z.y) > 0.999 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
    const glm::dvec3 x = glm::normalize(glm::cross(up, z));
    return glm::normalize(glm::quat_cast(glm::dmat3(x, glm::cross(z, x), z)));
}

// How far the light's centre hangs off a surface that it is put on.
double clearanceM(const LightDef& def) {
    constexpr double kGapM = 0.02; // past the depth errors of a coarse floor
    return shapeOf(def.type).isFlat ? kGapM : def.radiusM + 0.1;
}

} // namespace

std::string_view typeName(LightType type) {
    return shapeOf(type).title;
}

std::string countedLights(std::size_t count) {
    return count == 1 ? "1 light" : fmt::format("{} lights", count);
}

FreeNames::FreeNames(const Scene& scene) {
    for (const LightNode& light : scene.lights)
        taken_.insert(scene.nodes[std::size_t(light.node)].name);
}

std::string FreeNames::take(std::string base) {
    if (base.empty()) base = "Light";
    if (taken_.insert(base).second) return base;
    // 'Lamp 2' goes on as 'Lamp 3'.
    const std::size_t end = base.find_last_not_of("0123456789");
    if (end != std::string::npos && end + 1 < base.size() && base[end] == ' ') base.resize(end);
    int& next = next_.try_emplace(base, 2).first->second;
    std::string name;
    do {
        name = fmt::format("{} {}", base, next++);
    } while (!taken_.insert(name).second);
    return name;
}

LightDef defaultLight(LightType type) {
    LightDef def;
    def.type = type;
    def.temperatureK = 3000.0;
    def.unit = LightUnit::Lumen;
    def.intensity = 800.0; // a household bulb
    shapeOf(type).begin(def);
    return def;
}

Edits addLightAt(const Scene& scene, EditIds& ids, LightType type, const LightPlace& place) {
    const LightDef def = defaultLight(type);
    Trs trs;
    trs.translation = place.pointWs + place.dirWs * clearanceM(def);
    trs.rotation = lookingAlong(place.dirWs);
    return addLight(scene, ids, def, trs, FreeNames(scene).take(std::string(typeName(type))));
}

Result<Edits> duplicateLights(const Scene& scene, EditIds& ids, std::span<const std::uint64_t> lights) {
    ChangeBuilder builder(scene);
    FreeNames names(scene);
    for (const std::uint64_t light : lights) {
        builder.take(duplicateLight(builder.scene(), ids, light));
        const std::uint64_t copy = builder.scene().lights.read().back().id; // ids only grow
        builder.set(EditTarget::Light, copy, "name", names.take(nodeOf(scene, light).name));
    }
    return builder.finish();
}

std::vector<std::uint64_t> newLights(std::span<const Edit> edits) {
    std::vector<std::uint64_t> ids;
    for (const Edit& edit : edits) {
        const bool appears = !edit.field && std::holds_alternative<std::monostate>(edit.before);
        if (appears && edit.target == EditTarget::Light) ids.push_back(edit.id);
    }
    std::sort(ids.begin(), ids.end());
    return ids;
}

Result<Edits> deleteLights(const Scene& scene, std::span<const std::uint64_t> lights) {
    ChangeBuilder builder(scene);
    for (const std::uint64_t light : lights)
        builder.take(deleteLight(builder.scene(), light));
    return builder.finish();
}

bool allMuted(const Scene& scene, std::span<const std::uint64_t> lights) {
    return std::all_of(lights.begin(), lights.end(),
                       [&](std::uint64_t light) { return lightOf(scene, light).muted; });
}

Result<Edits> muteLights(const Scene& scene, std::span<const std::uint64_t> lights, bool muted) {
    ChangeBuilder builder(scene);
    for (const std::uint64_t light : lights)
        builder.set(EditTarget::Light, light, "muted", muted);
    return builder.finish();
}

Result<Edits> makeLightsUnique(const Scene& scene, std::span<const std::uint64_t> lights) {
    ChangeBuilder builder(scene);
    for (const std::uint64_t light : lights)
        builder.take(makeUnique(builder.scene(), light));
    return builder.finish();
}

Result<Edits> groupLights(const Scene& scene, EditIds& ids, std::span<const std::uint64_t> lights,
                          std::string base) {
    std::set<std::string, std::less<>> names;
    for (const LightGroup& group : scene.groups)
        names.insert(group.name);
    LightGroup group;
    group.name = FreeNames(std::move(names)).take(std::move(base));
    ChangeBuilder builder(scene);
    builder.take(addGroup(ids, group));
    const std::uint64_t id = builder.scene().groups.read().back().id; // ids only grow
    for (const std::uint64_t light : lights)
        builder.set(EditTarget::Light, light, "group", id);
    return builder.finish();
}

Result<Edits> assignGroup(const Scene& scene, std::span<const std::uint64_t> lights, std::uint64_t group) {
    ChangeBuilder builder(scene);
    for (const std::uint64_t light : lights)
        builder.set(EditTarget::Light, light, "group", group);
    return builder.finish();
}

Result<Edits> deleteGroups(const Scene& scene, std::span<const std::uint64_t> groups) {
    ChangeBuilder builder(scene);
    for (const std::uint64_t group : groups)
        builder.take(deleteGroup(builder.scene(), group));
    return builder.finish();
}

std::vector<std::uint64_t> membersOf(const Scene& scene, std::uint64_t group) {
    std::vector<std::uint64_t> ids;
    for (const LightNode& light : scene.lights)
        if (light.group == group) ids.push_back(light.id);
    return ids;
}

Scene withSolo(const Scene& scene, std::span<const std::uint64_t> lights) {
    Scene result = scene;
    const bool any = std::any_of(scene.lights.begin(), scene.lights.end(), [&](const LightNode& light) {
        return std::binary_search(lights.begin(), lights.end(), light.id);
    });
    if (!any) return result;
    for (LightNode& light : result.lights.write())
        if (!std::binary_search(lights.begin(), lights.end(), light.id)) light.muted = true;
    return result;
}

} // namespace kilolux
