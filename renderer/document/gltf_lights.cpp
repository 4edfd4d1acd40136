// Lights: KHR_lights_punctual, EXT_lights_ies, the draft EXT_lights_area, and what extras.kilolux adds (see
// extras.md). A broken light costs a warning, not the scene. Read from the JSON, since a node's extras decide
// which definitions are shared.
#include "renderer/document/gltf_light_reader.h"
#include "renderer/document/light_properties.h"

#include <algorithm>
#include <cstdio>
#include <map>

namespace kilolux::gltf {

namespace {

// A property's value as text.
template<typename T>
std::string keyOf(const T& value) {
    if constexpr (std::is_same_v<T, std::optional<double>>) {
        return value ? fmt::format("{}", *value) : "";
    } else if constexpr (std::is_enum_v<T>) {
        return wordOf(value);
    } else {
        return fmt::format("{}", value);
    }
}

class LightImporter {
  public:
    explicit LightImporter(ImportContext& context) : context_(context), reader_(context) {}

    void run();

  private:
    void importNode(int node);
    std::optional<LightDef> readReferred(int node, LightExtension extension);
    std::uint64_t groupNamed(const std::string& name, const std::string& place);
    int shareDef(LightDef def);

    ImportContext& context_;
    LightReader reader_;
    std::map<std::string, int> defs_; // by everything that a definition holds
};

// The light that a node's extension refers to, as the file's definition says it.
std::optional<LightDef> LightImporter::readReferred(int node, LightExtension extension) {
    const char* name = nameOf(extension);
    const Json* reference = findExtension(context_.json["nodes"][node], name);
    if (!reference) return std::nullopt;
    const std::string place = fmt::format("/nodes/{}/extensions/{}/light", node, name);
    const Json* root = findExtension(context_.json, name);
    const auto lights = root ? root->find("lights") : Json::const_iterator();
    const std::size_t count = root && lights != root->end() && lights->is_array() ? lights->size() : 0;
    const auto index = reference->find("light");
    if (index == reference->end() || !index->is_number_unsigned() || index->get<std::uint64_t>() >= count) {
        context_.warn(place, "expected an index under {}, the number of lights; the light is left out",
                      count);
        return std::nullopt;
    }
    const Json& light = (*lights)[index->get<std::size_t>()];
    const std::string pointer = fmt::format("/extensions/{}/lights/{}", name, index->get<std::size_t>());
    if (!light.is_object()) {
        context_.warnOnce("type " + pointer, pointer, "expected an object; the light is left out");
        return std::nullopt;
    }
    const Fields use(context_, *reference, fmt::format("/nodes/{}/extensions/{}", node, name));
    return reader_.read(extension, light, pointer, use,
                        largestScale(context_.scene.nodes[node].worldFromNode));
}

int LightImporter::shareDef(LightDef def) {
    static const LightDef kDefault;
    std::string key = fmt::format("{} {} {} {} {},{},{} {} {}", def.pointer, static_cast<int>(def.type),
                                  def.intensity, static_cast<int>(def.unit), def.color.r, def.color.g,
                                  def.color.b, def.innerConeRad, def.outerConeRad);
    forEachLightProperty([&](const auto& each) {
        if (each.access(def) == each.access(kDefault)) return;
        key += fmt::format("\n{} {}", each.name, keyOf(each.access(def)));
    });
    const auto [it, isNew] = defs_.emplace(key, static_cast<int>(context_.scene.lightDefs.size()));
    if (isNew) context_.scene.lightDefs.push_back(std::move(def));
    return it->second;
}

std::uint64_t LightImporter::groupNamed(const std::string& name, const std::string& place) {
    for (const LightGroup& group : context_.scene.groups.read())
        if (group.name == name) return group.id;
    context_.warn(place + "/group", "expected the name of one of the scene's groups; ignored");
    return 0;
}

void LightImporter::importNode(int node) {
    const Json& json = context_.json["nodes"][node];
    const std::string place = fmt::format("/nodes/{}", node);
    // What says more than a point comes first.
    std::optional<LightDef> def;
    for (const LightExtension extension :
         {LightExtension::Area, LightExtension::Ies, LightExtension::Punctual}) {
        if (!def) {
            def = readReferred(node, extension);
        } else if (findExtension(json, nameOf(extension))) {
            context_.warn(place, "expected one light, found {} beside another one, which is used",
                          nameOf(extension));
        }
    }
    const Json* allExtras = findObject(json, "extras");
    const Json* ours = allExtras ? findObject(*allExtras, "kilolux") : nullptr;
    if (!def) return;
    LightNode light;
    light.id = context_.scene.lights.size() + 1;
    light.node = node;
    if (ours) {
        const Fields extras(context_, *ours, place + "/extras/kilolux");
        reader_.applyExtras(extras, *def);
        reader_.loadFiles(*def, extras.place());
        extras.flag("muted", light.muted);
        if (std::string group; extras.text("group", group)) light.group = groupNamed(group, extras.place());
    }
    if (!ours) reader_.loadFiles(*def, def->pointer);
    light.def = shareDef(std::move(*def));
    context_.scene.lights.push_back(light);
}

// Blender's exporter has three modes since 3.6 and writes none of them down: candela and lux ('standard', its
// default), those without 683 lm/W ('unitless'), and its own watts ('raw'). Older ones knew watts alone. The
// numbers are taken as glTF means them; what is sure to be watts is told.
void warnOfWatts(ImportContext& context) {
    const Json* asset = findObject(context.json, "asset");
    const std::string generator = asset ? asset->value("generator", Json()).dump() : "";
    int major = 0, minor = 0;
    const bool isBlender =
        std::sscanf(generator.c_str(), "\"Khronos glTF Blender I/O v%d.%d", &major, &minor) == 2;
    if (!isBlender || major > 3 || (major == 3 && minor >= 6)) return;
    const auto& lights = context.scene.lights.read();
    const auto isWatts = [&](const LightNode& light) {
        return context.scene.lightDefs.read()[static_cast<std::size_t>(light.def)].type !=
               LightType::Directional;
    };
    if (std::none_of(lights.begin(), lights.end(), isWatts)) return;
    context.warn("/asset/generator",
                 "expected lights in candela, this version of Blender's exporter writes watts; 54.35 times "
                 "the number is the candela of a point");
}

void LightImporter::run() {
    for (std::size_t i = 0; i < context_.scene.nodes.size(); ++i) {
        if (context_.scene.nodes[i].visible) importNode(static_cast<int>(i));
    }
    warnOfWatts(context_);
}

} // namespace

void importLights(ImportContext& context) {
    LightImporter(context).run();
}

} // namespace kilolux::gltf
