// What extras.kilolux says on the default scene (see extras.md): exposure, light groups, camera bookmarks,
// dome.
#include "renderer/document/gltf_fields.h"
#include "renderer/document/scene_files.h"

#include <algorithm>

namespace kilolux::gltf {

namespace {

constexpr double kPi = 3.14159265358979323846;

// The objects of the array under `key`, each with its place.
std::vector<std::pair<const Json*, std::string>> objectsOf(ImportContext& context, const Fields& fields,
                                                           const char* key) {
    std::vector<std::pair<const Json*, std::string>> objects;
    const Json* array = fields.find(key);
    const std::string place = fields.place() + "/" + key;
    if (array && !array->is_array()) context.warn(place, "expected an array; ignored");
    if (!array || !array->is_array()) return objects;
    for (std::size_t i = 0; i < array->size(); ++i) {
        const std::string at = fmt::format("{}/{}", place, i);
        if ((*array)[i].is_object()) {
            objects.emplace_back(&(*array)[i], at);
        } else {
            context.warn(at, "expected an object; ignored");
        }
    }
    return objects;
}

void importGroups(ImportContext& context, const Fields& fields) {
    for (const auto& [json, place] : objectsOf(context, fields, "groups")) {
        const Fields each(context, *json, place);
        LightGroup group;
        each.text("name", group.name);
        const auto& groups = context.scene.groups.read();
        const bool taken = std::any_of(groups.begin(), groups.end(),
                                       [&](const LightGroup& other) { return other.name == group.name; });
        if (group.name.empty() || taken) {
            context.warn(place, "expected a group with a name of its own; ignored");
            continue;
        }
        each.number("intensity", 0.0, kHuge, group.intensity);
        each.number("exposureEv", -100.0, 100.0, group.exposureEv);
        if (each.numbers("tint", {&group.tint.x, 3})) group.tint = glm::max(group.tint, glm::dvec3(0.0));
        each.flag("muted", group.muted);
        group.id = groups.size() + 1;
        context.scene.groups.push_back(std::move(group));
    }
}

void importBookmarks(ImportContext& context, const Fields& fields) {
    for (const auto& [json, place] : objectsOf(context, fields, "bookmarks")) {
        const Fields each(context, *json, place);
        Camera camera;
        each.text("name", camera.name);
        double rotation[4] = {0.0, 0.0, 0.0, 1.0};
        glm::dvec3 position(0.0);
        if (!each.numbers("positionM", {&position.x, 3})) {
            context.warn(place, "expected a bookmark with 'positionM'; ignored");
            continue;
        }
        each.numbers("rotation", rotation);
        glm::dquat turn(rotation[3], rotation[0], rotation[1], rotation[2]);
        if (!(glm::length(turn) > 1e-12)) turn = glm::dquat(1.0, 0.0, 0.0, 0.0);
        camera.worldFromCamera = matrixFrom({position, turn / glm::length(turn), glm::dvec3(1.0)});
        each.number("yfovRad", 1e-4, kPi - 1e-4, camera.yfovRad);
        each.number("znearM", 1e-9, kHuge, camera.znearM);
        if (each.number("orthographicHalfHeightM", 1e-9, kHuge, camera.ymagM)) {
            camera.orthographic = true;
            camera.xmagM = camera.ymagM;
        }
        camera.id = context.scene.bookmarks.size() + 1;
        context.scene.bookmarks.push_back(std::move(camera));
    }
}

// The members that saving writes as well.
void importDome(ImportContext& context, const Fields& fields) {
    Dome& dome = context.scene.dome;
    fields.text("domeImage", dome.imageUri);
    for (const auto& [name, color] : {std::pair{"domeColor", &dome.color}, {"fillColor", &dome.fillColor}})
        if (fields.numbers(name, {&color->x, 3})) *color = glm::max(*color, glm::dvec3(0.0));
    fields.number("domeNit", 0.0, kHuge, dome.intensityNit);
    fields.number("domeRotationRad", -1e3, 1e3, dome.rotationRad);
    fields.flag("domeVisible", dome.visible);
    fields.number("fillNit", 0.0, kHuge, dome.fillNit);
    keepLightFiles(context, dome);
    for (const Error& error : loadFiles(context.scene.files.get(), dome))
        context.warn(fields.place(), "{}; the dome shines without it", error.message);
}

} // namespace

void importSceneExtras(ImportContext& context) {
    const int index = defaultScene(context.json);
    if (index < 0) return;
    const Json* extras = findObject(context.json["scenes"][index], "extras");
    const Json* ours = extras ? findObject(*extras, "kilolux") : nullptr;
    if (!ours) return;
    const Fields fields(context, *ours, fmt::format("/scenes/{}/extras/kilolux", index));
    context.scene.hasExposure = fields.number("exposureEv100", -30.0, 40.0, context.scene.exposureEv100);
    importGroups(context, fields);
    importBookmarks(context, fields);
    importDome(context, fields);
}

} // namespace kilolux::gltf
