// Saving lights: which definition of the file each one refers to, which definitions are changed, added and
// removed. A definition of the file is changed in place where everything that refers to it agrees; otherwise
// it stays, and the changed one becomes a new definition.
#include "renderer/document/gltf_save_light_json.h"

#include <algorithm>

namespace kilolux::gltf {

namespace {

struct Place {
    LightExtension extension = LightExtension::Punctual;
    int index = -1; // in the extension's lights; -1: not in the file
    bool operator==(const Place&) const = default;
};

// A definition as it is wanted in the file.
struct Wanted {
    int def = -1; // into Scene::lightDefs
    Place origin; // where it was
    Json before;  // there
    Json json;    // wanted
    Place place;  // where it will be; indices from the old count on are new
};

Place placeOf(const std::string& pointer) {
    for (const LightExtension extension : kLightExtensions) {
        const std::string start = fmt::format("/extensions/{}/lights/", nameOf(extension));
        if (pointer.starts_with(start)) return {extension, std::atoi(pointer.c_str() + start.size())};
    }
    return {};
}

const Json* lightsOf(const Json& document, LightExtension extension) {
    const Json* root = findExtension(document, nameOf(extension));
    const auto it = root ? root->find("lights") : Json::const_iterator();
    return root && it != root->end() && it->is_array() ? &*it : nullptr;
}

// The index that a node refers to; -1 where it refers to nothing that can be.
int reference(const Json& node, LightExtension extension) {
    const Json* object = node.is_object() ? findExtension(node, nameOf(extension)) : nullptr;
    const auto it = object ? object->find("light") : Json::const_iterator();
    const bool good = object && it != object->end() && it->is_number_unsigned() && *it < INT32_MAX;
    return good ? it->get<int>() : -1;
}

class LightSaver {
  public:
    explicit LightSaver(SaveContext& context) : context_(context) { reading_.scene.nodes.resize(1); }

    void run();

  private:
    const LightDef* openedDef(const LightNode& light) const;
    Wanted want(const LightNode& light);
    void placeWanted();
    void addNew(Wanted& wanted);
    void writeLight(const LightNode& light);
    void writeExtras(const LightNode& light, const Wanted& wanted, Json& node);
    void removeDeleted();
    void finishDefinitions(LightExtension extension);
    void listExtension(LightExtension extension, bool isUsed);
    double scaleOf(const LightNode& light) const {
        return largestScale(context_.scene.nodes[light.node].worldFromNode);
    }
    int oldCount(LightExtension extension) const {
        const Json* lights = lightsOf(context_.before, extension);
        return lights ? static_cast<int>(lights->size()) : 0;
    }
    std::vector<Json>& added(LightExtension extension) { return added_[static_cast<int>(extension)]; }
    LightDef nativeOf(const LightNode& light, const Wanted& wanted, const Json& node);

    SaveContext& context_;
    ImportContext reading_; // collects warnings that nobody needs
    std::vector<Wanted> wanted_;
    std::vector<int> wantedOfDef_;                           // per Scene::lightDefs
    std::vector<Json> added_[std::size(kLightExtensions)];   // new definitions, per extension
    std::unordered_map<int, const LightNode*> openedLights_; // by node of the file
};

// The definition as it was opened, of this light or, for a new light, of one that came from the same place.
const LightDef* LightSaver::openedDef(const LightNode& light) const {
    const LightDef& def = context_.scene.lightDefs[light.def];
    const Scene& opened = context_.opened;
    if (def.pointer.empty()) return nullptr;
    const auto own = openedLights_.find(context_.nodeIndices[light.node]);
    if (own != openedLights_.end() && opened.lightDefs[own->second->def].pointer == def.pointer)
        return &opened.lightDefs[own->second->def];
    for (const LightDef& each : opened.lightDefs)
        if (each.pointer == def.pointer) return &each;
    return nullptr;
}

Wanted LightSaver::want(const LightNode& light) {
    const LightDef& def = context_.scene.lightDefs[light.def];
    const LightDef* before = openedDef(light);
    Wanted wanted;
    wanted.def = light.def;
    if (before) wanted.origin = placeOf(def.pointer);
    const Json* lights = lightsOf(context_.before, wanted.origin.extension);
    if (wanted.origin.index >= 0 && lights && wanted.origin.index < static_cast<int>(lights->size()))
        wanted.before = (*lights)[wanted.origin.index];
    // Authors may hold a type in the extras that the extension does not know; it stays there until it
    // changes.
    const bool isProfile = wanted.origin.extension == LightExtension::Ies;
    const bool stays = before && (extensionFor(def) == wanted.origin.extension ||
                                  (before->type == def.type && isProfile == emitsAsProfile(def)));
    Json start = wanted.before.is_object() ? wanted.before : Json::object();
    if (before && !stays) {
        Json kept = Json::object();
        for (const char* key : {"name", "extras"})
            if (start.contains(key)) kept[key] = start[key];
        start = std::move(kept);
        wanted.origin = {extensionFor(def), -1};
        before = nullptr;
    } else if (!before) {
        wanted.origin = {extensionFor(def), -1};
    }
    wanted.place = wanted.origin;
    wanted.json = definitionJson(wanted.origin.extension, std::move(start), before, def, scaleOf(light));
    return wanted;
}

void LightSaver::addNew(Wanted& wanted) {
    std::vector<Json>& list = added(wanted.origin.extension);
    wanted.place = {wanted.origin.extension,
                    oldCount(wanted.origin.extension) + static_cast<int>(list.size())};
    list.push_back(wanted.json);
}

void LightSaver::placeWanted() {
    // Definitions that nodes refer to whose lights the document does not have (of other scenes) must stay.
    std::set<std::pair<LightExtension, int>> foreign;
    const auto nodes = context_.before.find("nodes");
    for (std::size_t i = 0; nodes != context_.before.end() && i < nodes->size(); ++i) {
        if (openedLights_.contains(static_cast<int>(i))) continue;
        for (const LightExtension extension : kLightExtensions)
            foreign.emplace(extension, reference((*nodes)[i], extension));
    }
    std::map<std::pair<LightExtension, int>, std::vector<Wanted*>> owners;
    for (Wanted& wanted : wanted_) {
        if (wanted.origin.index >= 0) {
            owners[{wanted.origin.extension, wanted.origin.index}].push_back(&wanted);
        } else {
            addNew(wanted);
        }
    }
    for (auto& [place, list] : owners) {
        const bool keeps =
            foreign.contains(place) ||
            std::any_of(list.begin(), list.end(), [](const Wanted* w) { return w->json == w->before; });
        // What already stands at a place for this origin.
        std::vector<std::pair<Json, Place>> standing;
        standing.emplace_back(keeps ? list.front()->before : list.front()->json, list.front()->origin);
        for (Wanted* wanted : list) {
            const auto same = std::find_if(standing.begin(), standing.end(),
                                           [&](const auto& each) { return each.first == wanted->json; });
            if (same != standing.end()) {
                wanted->place = same->second;
            } else {
                addNew(*wanted);
                standing.emplace_back(wanted->json, wanted->place);
            }
        }
        if (!keeps) {
            Json& lights = context_.after["extensions"][nameOf(place.first)]["lights"];
            lights[place.second] = list.front()->json;
        }
    }
}

// What the extensions of the node will say by themselves.
LightDef LightSaver::nativeOf(const LightNode& light, const Wanted& wanted, const Json& node) {
    const LightDef& def = context_.scene.lightDefs[light.def];
    const Fields use(reading_, node["extensions"][nameOf(wanted.place.extension)], "");
    const std::optional<LightDef> native =
        LightReader(reading_).read(wanted.place.extension, wanted.json, def.pointer, use, scaleOf(light));
    if (!native)
        fail(fmt::format("light '{}'", context_.scene.nodes[light.node].name), "expected a usable node");
    return *native;
}

void LightSaver::writeExtras(const LightNode& light, const Wanted& wanted, Json& node) {
    const LightDef& def = context_.scene.lightDefs[light.def];
    LightDef native = nativeOf(light, wanted, node);
    if (wanted.place.extension == LightExtension::Ies) {
        fitUse(node["extensions"][nameOf(LightExtension::Ies)], native, def);
        native = nativeOf(light, wanted, node);
    }
    native.ies = def.ies; // as it will be read from the file
    const Json* found = findKiloluxExtras(node);
    Json extras = found ? *found : Json::object();
    fitExtras(reading_, extras, native, def);
    const auto muted = extras.find("muted");
    if ((muted != extras.end() && muted->is_boolean() && muted->get<bool>()) != light.muted) {
        extras.erase("muted");
        if (light.muted) extras["muted"] = true;
    }
    const int group = findGroup(context_.scene, light.group);
    const std::string name = group >= 0 ? context_.scene.groups[group].name : "";
    const auto old = extras.find("group");
    const bool hadGroup = old != extras.end() && old->is_string();
    // A name that no group has stays as the file has it.
    const auto opened = openedLights_.find(context_.nodeIndices[light.node]);
    const bool hasNone = name.empty() && (opened == openedLights_.end() || opened->second->group == 0);
    if (!hasNone && (!hadGroup || *old != name)) {
        extras.erase("group");
        if (!name.empty()) extras["group"] = name;
    }
    if (found ? extras == *found : extras.empty()) return;
    kiloluxExtras(node) = std::move(extras);
    dropEmptyExtras(node);
}

void LightSaver::writeLight(const LightNode& light) {
    const Wanted& wanted = wanted_[wantedOfDef_[light.def]];
    Json& node = context_.after["nodes"][context_.nodeIndices[light.node]];
    const LightExtension own = wanted.place.extension;
    if (reference(node, own) != wanted.place.index) {
        Json& extensions = memberObject(node, "extensions", "nodes");
        for (const LightExtension other : kLightExtensions)
            if (other != own) extensions.erase(nameOf(other));
        memberObject(extensions, nameOf(own), "nodes")["light"] =
            static_cast<std::size_t>(wanted.place.index);
    }
    writeExtras(light, wanted, node);
}

void LightSaver::removeDeleted() {
    std::set<int> carriers; // nodes of the file that carry a light of the document
    for (const LightNode& light : context_.scene.lights)
        carriers.insert(context_.nodeIndices[light.node]);
    for (const auto& [index, light] : openedLights_) {
        if (carriers.contains(index)) continue;
        Json& node = context_.after["nodes"][index];
        for (const LightExtension extension : kLightExtensions)
            node["extensions"].erase(nameOf(extension));
        if (node["extensions"].empty()) node.erase("extensions");
        if (!findKiloluxExtras(node)) continue;
        eraseLightExtras(kiloluxExtras(node));
        dropEmptyExtras(node);
    }
}

// Definitions that have lost their last user are removed, the others move up, and so do the references to
// them.
void LightSaver::finishDefinitions(LightExtension extension) {
    const char* name = nameOf(extension);
    const int old = oldCount(extension);
    const std::vector<Json>& news = added(extension);
    Json& document = context_.after;
    std::set<int> before, used;
    const auto collect = [&](const Json& from, std::set<int>& into) {
        const auto nodes = from.find("nodes");
        for (std::size_t i = 0; nodes != from.end() && i < nodes->size(); ++i)
            into.insert(reference((*nodes)[i], extension));
    };
    collect(context_.before, before);
    collect(document, used);
    // Pointers into the array would point at a neighbour.
    const auto listed = document.find("extensionsUsed");
    const bool fixed = listed != document.end() && listed->is_array() &&
                       std::find(listed->begin(), listed->end(), "KHR_animation_pointer") != listed->end();
    std::vector<int> newIndex(static_cast<std::size_t>(old) + news.size(), -1);
    Json lights = Json::array();
    const Json* current = lightsOf(document, extension);
    for (int i = 0; i < static_cast<int>(newIndex.size()); ++i) {
        if (i < old && !fixed && before.contains(i) && !used.contains(i)) continue;
        newIndex[i] = static_cast<int>(lights.size());
        lights.push_back(i < old ? (*current)[i] : news[i - old]);
    }
    if (!news.empty() || static_cast<int>(lights.size()) != old) {
        for (Json& node : document["nodes"]) {
            const int index = reference(node, extension);
            if (index >= 0 && index < static_cast<int>(newIndex.size()) && newIndex[index] != index)
                node["extensions"][name]["light"] = static_cast<std::size_t>(newIndex[index]);
        }
        Json& extensions = memberObject(document, "extensions", "/");
        Json& root = memberObject(extensions, name, "/extensions");
        root["lights"] = lights;
        if (lights.empty()) root.erase("lights");
        if (root.empty()) extensions.erase(name);
        if (extensions.empty()) document.erase("extensions");
        listExtension(extension, !lights.empty());
    }
    for (const Wanted& wanted : wanted_) {
        if (wanted.place.extension != extension) continue;
        context_.defPointers[wanted.def] =
            fmt::format("/extensions/{}/lights/{}", name, newIndex[wanted.place.index]);
    }
}

void LightSaver::listExtension(LightExtension extension, bool isUsed) {
    Json& document = context_.after;
    const std::string name = nameOf(extension);
    if (isUsed) {
        Json& list = document["extensionsUsed"];
        if (!list.is_array()) list = Json::array();
        if (std::find(list.begin(), list.end(), name) == list.end()) list.push_back(name);
        return;
    }
    for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
        const auto list = document.find(key);
        if (list == document.end() || !list->is_array()) continue;
        Json kept = Json::array();
        for (const Json& each : *list)
            if (each != name) kept.push_back(each);
        if (kept.empty()) {
            document.erase(key);
        } else {
            *list = std::move(kept);
        }
    }
}

void LightSaver::run() {
    for (const LightNode& light : context_.opened.lights)
        openedLights_[light.node] = &light;
    context_.defPointers.assign(context_.scene.lightDefs.size(), "");
    wantedOfDef_.assign(context_.scene.lightDefs.size(), -1);
    for (const LightNode& light : context_.scene.lights) {
        if (wantedOfDef_[light.def] >= 0) continue;
        wantedOfDef_[light.def] = static_cast<int>(wanted_.size());
        wanted_.push_back(want(light));
    }
    placeWanted();
    removeDeleted();
    for (const LightNode& light : context_.scene.lights)
        writeLight(light);
    for (const LightExtension extension : kLightExtensions)
        finishDefinitions(extension);
}

} // namespace

void saveLights(SaveContext& context) {
    LightSaver(context).run();
}

} // namespace kilolux::gltf
