// What the parts of saving share: the JSON that grows, and which node of the file is which of the document.
// Internal to renderer/document.
#pragma once

#include "renderer/document/gltf_light_reader.h"
#include "renderer/document/gltf_save.h"

#include "renderer/document/edit.h"

#include <algorithm>
#include <unordered_map>

namespace kilolux::gltf {

struct SaveContext {
    const Scene& opened;
    const Scene& scene;
    const Json& before;                                      // the file's JSON as opened
    Json& after;                                             // as it will be saved
    std::unordered_map<std::uint64_t, int> openedNodes = {}; // by Node::id: index in the file
    std::vector<int> nodeIndices = {};                       // per Scene::nodes; -1: not saved
    std::vector<std::string> defPointers = {};
};

// The member object of that name, made where it is missing; fails where something else stands in its place.
Json& memberObject(Json& parent, const char* key, std::string_view place);

// The same for extras.kilolux of a node or scene. Extras that are no object, which glTF allows, move into the
// member `value` of one.
Json& kiloluxExtras(Json& owner);

// extras.kilolux for reading; null where there is none.
const Json* findKiloluxExtras(const Json& owner);

// Removes the object, and what holds it, as far as they are empty.
void dropEmptyExtras(Json& owner);

// Sets or removes a member only where that changes it.
template<typename T>
void setMember(Json& object, const char* key, const T& value) {
    const auto it = object.find(key);
    if (it == object.end() || *it != Json(value)) object[key] = value;
}
Json colorJson(const glm::dvec3& color);

// --- the steps, in their order ---

void saveNodes(SaveContext& context);       // sets nodeIndices
void saveLights(SaveContext& context);      // needs them; sets defPointers
void saveSceneExtras(SaveContext& context); // exposure, groups, bookmarks

} // namespace kilolux::gltf
