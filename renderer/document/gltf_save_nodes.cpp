// Saving nodes: names and transforms of those that the file has, and those that the tool made.
#include "renderer/document/gltf_save_context.h"

namespace kilolux::gltf {

namespace {

Json numbers(const double* values, int count) {
    Json array = Json::array();
    for (int i = 0; i < count; ++i)
        array.push_back(values[i]);
    return array;
}

Json rotationJson(const glm::dquat& rotation) {
    return Json::array({rotation.x, rotation.y, rotation.z, rotation.w});
}

// Only the parts that differ from `before`, so that the digits of the others stay.
void saveTransform(const Node& before, const Node& node, Json& json) {
    if (!node.restTrs) {
        if (node.localFromNode != before.localFromNode)
            json["matrix"] = numbers(&node.localFromNode[0][0], 16);
        return;
    }
    const Trs old = before.restTrs.value_or(Trs{}), &now = *node.restTrs;
    if (now.translation != old.translation) json["translation"] = numbers(&now.translation.x, 3);
    if (now.rotation != old.rotation) json["rotation"] = rotationJson(now.rotation);
    if (now.scale != old.scale) json["scale"] = numbers(&now.scale.x, 3);
}

// Nodes that the tool made are saved where a light or a saved node needs them.
std::vector<bool> neededNodes(const SaveContext& context) {
    std::vector<bool> needed(context.scene.nodes.size(), false);
    for (const LightNode& light : context.scene.lights) {
        for (int node = light.node; node >= 0 && !needed[node]; node = context.scene.nodes[node].parent)
            needed[node] = true;
    }
    return needed;
}

// The nodes without a parent, as glTF means them.
Json rootsOf(const Json& document) {
    const auto nodes = document.find("nodes");
    if (nodes == document.end()) return Json::array();
    std::vector<bool> isChild(nodes->size(), false);
    for (const Json& node : *nodes) {
        for (const Json& child : node.value("children", Json::array()))
            isChild.at(child.get<std::size_t>()) = true;
    }
    Json roots = Json::array();
    for (std::size_t i = 0; i < isChild.size(); ++i)
        if (!isChild[i]) roots.push_back(i);
    return roots;
}

void appendNode(SaveContext& context, std::size_t index) {
    const Node& node = context.scene.nodes[index];
    Json& nodes = context.after["nodes"];
    const std::size_t place = nodes.is_array() ? nodes.size() : 0;
    Json json = Json::object();
    if (!node.name.empty()) json["name"] = node.name;
    Node standing; // at the origin, in the same form
    if (node.restTrs) standing.restTrs = Trs{};
    saveTransform(standing, node, json);
    nodes.push_back(std::move(json));
    context.nodeIndices[index] = static_cast<int>(place);
    if (node.parent >= 0) {
        nodes[context.nodeIndices[node.parent]]["children"].push_back(place);
    } else if (const int scene = defaultScene(context.after); scene >= 0) {
        context.after["scenes"][scene]["nodes"].push_back(place);
    }
}

Json poseJson(const Camera& camera) {
    Json json;
    json["positionM"] = numbers(&camera.worldFromCamera[3].x, 3);
    json["rotation"] = rotationJson(glm::normalize(glm::quat_cast(glm::dmat3(camera.worldFromCamera))));
    return json;
}

// The entry that the file has for an object of that name; an empty one otherwise, so that unknown members
// stay.
Json entryNamed(const Json* extras, const char* key, const std::string& name) {
    const Json* array = extras && extras->contains(key) ? &extras->at(key) : nullptr;
    if (!array || !array->is_array()) return Json::object();
    for (const Json& entry : *array) {
        const auto it = entry.is_object() ? entry.find("name") : entry.end();
        if (entry.is_object() && it != entry.end() && *it == name) return entry;
    }
    return Json::object();
}

template<typename Array>
const typename Array::value_type* withId(const Array& array, std::uint64_t id) {
    for (const auto& each : array)
        if (each.id == id) return &each;
    return nullptr;
}

Json groupsJson(const SaveContext& context, const Json* extras) {
    Json array = Json::array();
    for (const LightGroup& group : context.scene.groups) {
        const LightGroup* old = withId(context.opened.groups.read(), group.id);
        Json json = old ? entryNamed(extras, "groups", old->name) : Json::object();
        const LightGroup before = old ? *old : LightGroup{};
        if (group.name != before.name) json["name"] = group.name;
        if (group.intensity != before.intensity) json["intensity"] = group.intensity;
        if (group.exposureEv != before.exposureEv) json["exposureEv"] = group.exposureEv;
        if (group.tint != before.tint) json["tint"] = colorJson(group.tint);
        if (group.muted != before.muted) json["muted"] = group.muted;
        array.push_back(std::move(json));
    }
    return array;
}

Json bookmarksJson(const SaveContext& context, const Json* extras) {
    Json array = Json::array();
    for (const Camera& camera : context.scene.bookmarks) {
        const Camera* old = withId(context.opened.bookmarks, camera.id);
        Json json = old ? entryNamed(extras, "bookmarks", old->name) : Json::object();
        if (!old || camera.name != old->name) json["name"] = camera.name;
        if (!old || camera.worldFromCamera != old->worldFromCamera) json.update(poseJson(camera));
        if (!old || camera.yfovRad != old->yfovRad) json["yfovRad"] = camera.yfovRad;
        if (camera.znearM != (old ? old->znearM : Camera{}.znearM)) json["znearM"] = camera.znearM;
        if (camera.orthographic && (!old || camera.ymagM != old->ymagM))
            json["orthographicHalfHeightM"] = camera.ymagM;
        array.push_back(std::move(json));
    }
    return array;
}

bool sameGroups(const Scene& a, const Scene& b) {
    return std::equal(a.groups.begin(), a.groups.end(), b.groups.begin(), b.groups.end(),
                      [](const LightGroup& x, const LightGroup& y) {
                          return x.id == y.id && x.name == y.name && x.intensity == y.intensity &&
                                 x.exposureEv == y.exposureEv && x.tint == y.tint && x.muted == y.muted;
                      });
}

bool sameBookmarks(const Scene& a, const Scene& b) {
    return std::equal(a.bookmarks.begin(), a.bookmarks.end(), b.bookmarks.begin(), b.bookmarks.end(),
                      [](const Camera& x, const Camera& y) {
                          return x.id == y.id && x.name == y.name && x.worldFromCamera == y.worldFromCamera &&
                                 x.yfovRad == y.yfovRad && x.znearM == y.znearM && x.ymagM == y.ymagM;
                      });
}

// Its members as the extras have them; null where they are what reading assumes.
Json domeJson(const Dome& dome) {
    const Dome standard;
    const auto unless = [](const Json& value, const Json& same) { return value == same ? Json() : value; };
    return {{"domeImage", unless(dome.imageUri, standard.imageUri)},
            {"domeColor", unless(colorJson(dome.color), colorJson(standard.color))},
            {"domeNit", unless(dome.intensityNit, standard.intensityNit)},
            {"domeRotationRad", unless(dome.rotationRad, standard.rotationRad)},
            {"domeVisible", unless(dome.visible, standard.visible)},
            {"fillColor", unless(colorJson(dome.fillColor), colorJson(standard.fillColor))},
            {"fillNit", unless(dome.fillNit, standard.fillNit)}};
}

void setOrErase(Json& object, const char* key, Json value) {
    if (value.is_null() || (value.is_array() && value.empty())) {
        object.erase(key);
    } else {
        object[key] = std::move(value);
    }
}

} // namespace

void saveNodes(SaveContext& context) {
    for (std::size_t i = 0; i < context.opened.nodes.size(); ++i)
        context.openedNodes[context.opened.nodes[i].id] = static_cast<int>(i);
    const std::vector<bool> needed = neededNodes(context);
    context.nodeIndices.assign(context.scene.nodes.size(), -1);
    for (std::size_t i = 0; i < context.scene.nodes.size(); ++i) {
        const Node& node = context.scene.nodes[i];
        const auto found = context.openedNodes.find(node.id);
        if (found == context.openedNodes.end()) {
            if (needed[i]) appendNode(context, i);
            continue;
        }
        context.nodeIndices[i] = found->second;
        const Node& before = context.opened.nodes[found->second];
        Json& json = context.after["nodes"][found->second];
        if (node.name != before.name) json["name"] = node.name;
        saveTransform(before, node, json);
        if (node.meshChannels == before.meshChannels) continue;
        Json& extras = kiloluxExtras(json);
        extras.erase("meshChannels");
        if (node.meshChannels != Node{}.meshChannels) extras["meshChannels"] = node.meshChannels;
        dropEmptyExtras(json);
    }
}

void saveSceneExtras(SaveContext& context) {
    const Scene &opened = context.opened, &scene = context.scene;
    const bool keepsExposure = scene.hasExposure == opened.hasExposure &&
                               (!scene.hasExposure || scene.exposureEv100 == opened.exposureEv100);
    const bool keepsGroups = sameGroups(opened, scene), keepsBookmarks = sameBookmarks(opened, scene);
    const Json dome = domeJson(scene.dome), openedDome = domeJson(opened.dome);
    if (keepsExposure && keepsGroups && keepsBookmarks && dome == openedDome) return;
    if (defaultScene(context.after) < 0) {
        const Json roots = rootsOf(context.after);
        context.after["scenes"] = Json::array({Json::object()});
        context.after["scene"] = 0;
        if (!roots.empty()) context.after["scenes"][0]["nodes"] = roots;
    }
    Json& owner = context.after["scenes"][defaultScene(context.after)];
    Json& extras = kiloluxExtras(owner);
    if (!keepsExposure)
        setOrErase(extras, "exposureEv100", scene.hasExposure ? Json(scene.exposureEv100) : Json());
    if (!keepsGroups) setOrErase(extras, "groups", groupsJson(context, &extras));
    if (!keepsBookmarks) setOrErase(extras, "bookmarks", bookmarksJson(context, &extras));
    for (const auto& [key, value] : dome.items())
        if (value != openedDome[key]) setOrErase(extras, key.c_str(), value);
    dropEmptyExtras(owner);
}

} // namespace kilolux::gltf
