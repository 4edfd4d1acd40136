// Lights: KHR_lights_punctual, the draft EXT_lights_area, and what extras.kilolux adds (see extras.md). A
// broken light costs a warning, not the scene. Read from the JSON, since a node's extras decide which
// definitions are shared.
#include "renderer/document/gltf_context.h"
#include "renderer/document/light_units.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace kilolux::gltf {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kHuge = 1e18;
constexpr double kMinTubeRadiusM = 0.001; // a line has no luminance
constexpr double kDefaultAreaNit = 1000.0;

struct NamedType {
    const char* name;
    LightType type;
};
constexpr NamedType kPunctualTypes[] = {
    {"directional", LightType::Directional}, {"point", LightType::Sphere}, {"spot", LightType::Spot}};
constexpr NamedType kAreaTypes[] = {{"rect", LightType::Rect}, {"disk", LightType::Disk}};
constexpr NamedType kExtrasTypes[] = {{"directional", LightType::Directional},
                                      {"sphere", LightType::Sphere},
                                      {"spot", LightType::Spot},
                                      {"tube", LightType::Tube},
                                      {"rect", LightType::Rect},
                                      {"disk", LightType::Disk}};
struct NamedUnit {
    const char* name;
    LightUnit unit;
};
constexpr NamedUnit kUnits[] = {{"lm", LightUnit::Lumen},
                                {"cd", LightUnit::Candela},
                                {"lux", LightUnit::Lux},
                                {"nit", LightUnit::Nit},
                                {"ev100", LightUnit::Ev100}};

// Reads properties of one JSON object; what is wrong is reported under `place` and counts as absent.
class Fields {
  public:
    Fields(ImportContext& context, const Json& object, std::string place)
        : context_(context), object_(object), place_(std::move(place)) {}

    const std::string& place() const { return place_; }

    const Json* find(const char* key) const {
        const auto it = object_.find(key);
        return it == object_.end() ? nullptr : &*it;
    }

    // False if absent or not a number; a number out of range is moved to its nearest bound.
    bool number(const char* key, double min, double max, double& target) const {
        const Json* value = find(key);
        if (!value) return false;
        if (!value->is_number()) {
            context_.warn(place_ + "/" + key, "expected a number; ignored");
            return false;
        }
        const double typed = value->get<double>();
        target = std::clamp(typed, min, max);
        if (target != typed) {
            context_.warn(place_ + "/" + key, "expected a number from {} to {}, found {}; {} is used", min,
                          max, typed, target);
        }
        return true;
    }

    template<typename Named, std::size_t N>
    const Named* name(const char* key, const Named (&names)[N]) const {
        const Json* value = find(key);
        if (!value) return nullptr;
        std::string expected;
        for (const Named& each : names) {
            if (value->is_string() && value->get_ref<const std::string&>() == each.name) return &each;
            expected += (expected.empty() ? "" : ", ") + std::string(each.name);
        }
        context_.warn(place_ + "/" + key, "expected one of {}; ignored", expected);
        return nullptr;
    }

  private:
    ImportContext& context_;
    const Json& object_;
    std::string place_;
};

const Json* findObject(const Json& parent, const char* key) {
    const auto it = parent.find(key);
    return it == parent.end() || !it->is_object() ? nullptr : &*it;
}

const Json* findExtension(const Json& parent, const char* name) {
    const Json* extensions = findObject(parent, "extensions");
    return extensions ? findObject(*extensions, name) : nullptr;
}

class LightImporter {
  public:
    explicit LightImporter(ImportContext& context) : context_(context) {}

    void run();

  private:
    void importNode(int node);
    std::optional<LightDef> readReferred(int node, const char* extension);
    std::optional<LightDef> readPunctual(const Json& light, const std::string& pointer);
    std::optional<LightDef> readArea(const Json& light, const std::string& pointer, int node);
    void readCommon(const Fields& fields, LightDef& def);
    void readSpot(const Fields& fields, LightDef& def);
    void applyExtras(const Fields& extras, LightDef& def);
    void applyIntensity(const Fields& extras, const LightDef& before, LightDef& def);
    double largestScale(int node) const;
    int shareDef(LightDef def);

    ImportContext& context_;
    std::map<std::string, int> defs_; // by everything that a definition holds
};

void LightImporter::readCommon(const Fields& fields, LightDef& def) {
    def.pointer = fields.place();
    if (const Json* name = fields.find("name"); name && name->is_string()) def.name = *name;
    fields.number("intensity", 0.0, kHuge, def.intensity);
    const Json* color = fields.find("color");
    if (!color) return;
    const bool good = color->is_array() && color->size() == 3 &&
                      std::all_of(color->begin(), color->end(), [](const Json& c) { return c.is_number(); });
    if (!good) {
        context_.warn(fields.place() + "/color", "expected an array of 3 numbers; white is used");
        return;
    }
    for (int i = 0; i < 3; ++i) {
        const double typed = (*color)[i].get<double>();
        def.color[i] = std::clamp(typed, 0.0, kHuge);
        if (typed < 0.0) context_.warn(fields.place() + "/color", "expected no negative numbers; 0 is used");
    }
}

void LightImporter::readSpot(const Fields& fields, LightDef& def) {
    const Json* spot = fields.find("spot");
    if (!spot || !spot->is_object()) {
        context_.warn(fields.place(), "expected the property 'spot'; its default cone is used");
        return;
    }
    const Fields cone(context_, *spot, fields.place() + "/spot");
    cone.number("outerConeAngle", 1e-4, kPi / 2.0, def.outerConeRad);
    cone.number("innerConeAngle", 0.0, kPi / 2.0, def.innerConeRad);
    if (def.innerConeRad > def.outerConeRad) {
        context_.warn(cone.place(), "expected innerConeAngle up to outerConeAngle {}, found {}; {} is used",
                      def.outerConeRad, def.innerConeRad, def.outerConeRad);
        def.innerConeRad = def.outerConeRad;
    }
}

std::optional<LightDef> LightImporter::readPunctual(const Json& light, const std::string& pointer) {
    const Fields fields(context_, light, pointer);
    LightDef def;
    const NamedType* type = fields.name("type", kPunctualTypes);
    if (!type) {
        context_.warnOnce("type " + pointer, pointer, "expected a light with a known 'type'; it is left out");
        return std::nullopt;
    }
    def.type = type->type;
    def.unit = def.type == LightType::Directional ? LightUnit::Lux : LightUnit::Candela;
    readCommon(fields, def);
    if (double range = 0.0; fields.number("range", 0.0, kHuge, range)) {
        if (range > 0.0) {
            def.rangeM = range;
        } else {
            context_.warn(pointer + "/range", "expected a number above 0; no range is used");
        }
    }
    if (def.type == LightType::Spot) readSpot(fields, def);
    return def;
}

double LightImporter::largestScale(int node) const {
    const glm::dmat4& matrix = context_.scene.nodes[node].worldFromNode;
    return std::max({glm::length(glm::dvec3(matrix[0])), glm::length(glm::dvec3(matrix[1])),
                     glm::length(glm::dvec3(matrix[2]))});
}

std::optional<LightDef> LightImporter::readArea(const Json& light, const std::string& pointer, int node) {
    const Fields fields(context_, light, pointer);
    LightDef def;
    const NamedType* type = fields.name("type", kAreaTypes);
    if (!type) {
        context_.warnOnce("type " + pointer, pointer, "expected a light with a known 'type'; it is left out");
        return std::nullopt;
    }
    def.type = type->type;
    def.unit = LightUnit::Nit;
    def.intensity = kDefaultAreaNit;
    fields.number("luminance", 0.0, kHuge, def.intensity); // the older name; 'intensity' wins
    readCommon(fields, def);
    double size = 1.0, aspect = 1.0;
    fields.number("size", 1e-6, kHuge, size);
    if (const Json* rect = fields.find("rect"); rect && rect->is_object()) {
        Fields(context_, *rect, pointer + "/rect").number("aspect", 1e-6, 1e6, aspect);
    }
    const double scale = largestScale(node);
    if (!(scale > 0.0)) {
        context_.warn(pointer, "expected a node with a scale above 0; the light is left out");
        return std::nullopt;
    }
    def.heightM = size * scale;
    def.widthM = def.type == LightType::Rect ? size * scale * aspect : size * scale;
    return def;
}

// The light that a node's extension refers to, as the file's definition says it.
std::optional<LightDef> LightImporter::readReferred(int node, const char* extension) {
    const Json* reference = findExtension(context_.json["nodes"][node], extension);
    if (!reference) return std::nullopt;
    const std::string place = fmt::format("/nodes/{}/extensions/{}/light", node, extension);
    const Json* root = findExtension(context_.json, extension);
    const auto lights = root ? root->find("lights") : Json::const_iterator();
    const std::size_t count = root && lights != root->end() && lights->is_array() ? lights->size() : 0;
    const auto index = reference->find("light");
    if (index == reference->end() || !index->is_number_unsigned() || index->get<std::uint64_t>() >= count) {
        context_.warn(place, "expected an index under {}, the number of lights; the light is left out",
                      count);
        return std::nullopt;
    }
    const Json& light = (*lights)[index->get<std::size_t>()];
    const std::string pointer = fmt::format("/extensions/{}/lights/{}", extension, index->get<std::size_t>());
    if (!light.is_object()) {
        context_.warnOnce("type " + pointer, pointer, "expected an object; the light is left out");
        return std::nullopt;
    }
    return extension == std::string_view("EXT_lights_area") ? readArea(light, pointer, node)
                                                            : readPunctual(light, pointer);
}

// `before` is the light as the extension alone describes it.
void LightImporter::applyIntensity(const Fields& extras, const LightDef& before, LightDef& def) {
    const NamedUnit* unit = extras.name("unit", kUnits);
    const LightUnit wanted = unit ? unit->unit : def.unit;
    double typed = 0.0;
    const bool hasValue = extras.number("intensity", wanted == LightUnit::Ev100 ? -100.0 : 0.0,
                                        wanted == LightUnit::Ev100 ? 100.0 : kHuge, typed);
    if (!unitApplies(def, wanted)) {
        context_.warn(extras.place(), "expected a unit that suits the light's type and size; ignored");
        def.unit = def.type == LightType::Directional ? LightUnit::Lux : LightUnit::Candela;
        def.intensity = hasValue ? typed : baseIntensity(before);
        return;
    }
    def.intensity = hasValue                ? typed
                    : wanted != before.unit ? fromBaseIntensity(def, baseIntensity(before), wanted)
                                            : before.intensity;
    if (!std::isfinite(def.intensity)) def.intensity = wanted == LightUnit::Ev100 ? -100.0 : 0.0;
    def.unit = wanted;
}

void LightImporter::applyExtras(const Fields& extras, LightDef& def) {
    const LightDef before = def;
    if (const NamedType* type = extras.name("type", kExtrasTypes)) def.type = type->type;
    double temperatureK = 0.0;
    if (extras.number("temperatureK", 1000.0, 40000.0, temperatureK)) def.temperatureK = temperatureK;
    extras.number("radiusM", 0.0, kHuge, def.radiusM);
    extras.number("lengthM", 0.0, kHuge, def.lengthM);
    extras.number("widthM", 1e-6, kHuge, def.widthM);
    extras.number("heightM", 1e-6, kHuge, def.heightM);
    extras.number("angularDiameterRad", 0.0, kPi, def.angularDiameterRad);
    extras.number("barnDoorAngleRad", 0.0, kPi / 2.0, def.barnDoorAngleRad);
    extras.number("barnDoorLengthM", 0.0, kHuge, def.barnDoorLengthM);
    extras.number("rayEndBiasM", 0.0, kHuge, def.rayEndBiasM);
    if (double rangeM = 0.0; extras.number("rangeM", 1e-6, kHuge, rangeM)) def.rangeM = rangeM;
    if (def.type == LightType::Tube) def.radiusM = std::max(def.radiusM, kMinTubeRadiusM);
    // A type for which the extension's unit means nothing takes over the base value (candela or lux).
    applyIntensity(extras, before, def);
}

int LightImporter::shareDef(LightDef def) {
    const std::string key =
        fmt::format("{} {} {} {} {},{},{} {} {} {} {} {} {} {} {} {} {} {} {}", def.pointer,
                    static_cast<int>(def.type), def.intensity, static_cast<int>(def.unit), def.color.r,
                    def.color.g, def.color.b, def.temperatureK.value_or(0.0), def.rangeM.value_or(0.0),
                    def.radiusM, def.lengthM, def.widthM, def.heightM, def.innerConeRad, def.outerConeRad,
                    def.angularDiameterRad, def.barnDoorAngleRad, def.barnDoorLengthM, def.rayEndBiasM);
    const auto [it, isNew] = defs_.emplace(key, static_cast<int>(context_.scene.lightDefs.size()));
    if (isNew) context_.scene.lightDefs.push_back(std::move(def));
    return it->second;
}

void LightImporter::importNode(int node) {
    const Json& json = context_.json["nodes"][node];
    const std::string place = fmt::format("/nodes/{}", node);
    std::optional<LightDef> def = readReferred(node, "EXT_lights_area");
    if (def && findExtension(json, "KHR_lights_punctual")) {
        context_.warn(place, "expected one light, found two; the area light is used");
    }
    if (!def) def = readReferred(node, "KHR_lights_punctual");
    const Json* allExtras = findObject(json, "extras");
    const Json* ours = allExtras ? findObject(*allExtras, "kilolux") : nullptr;
    if (!def) return;
    LightNode light;
    light.id = context_.scene.lights.size() + 1;
    light.node = node;
    if (ours) {
        const Fields extras(context_, *ours, place + "/extras/kilolux");
        applyExtras(extras, *def);
        if (const Json* muted = extras.find("muted")) {
            if (!muted->is_boolean())
                context_.warn(extras.place() + "/muted", "expected true or false; ignored");
            light.muted = muted->is_boolean() && muted->get<bool>();
        }
    }
    light.def = shareDef(std::move(*def));
    context_.scene.lights.push_back(light);
}

void LightImporter::run() {
    for (std::size_t i = 0; i < context_.scene.nodes.size(); ++i) {
        if (context_.scene.nodes[i].visible) importNode(static_cast<int>(i));
    }
    const auto scenes = context_.json.find("scenes");
    if (scenes == context_.json.end() || scenes->empty()) return;
    const auto index = context_.json.value("scene", std::size_t{0});
    const Json* extras = findObject((*scenes)[index], "extras");
    const Json* ours = extras ? findObject(*extras, "kilolux") : nullptr;
    if (!ours) return;
    const Fields fields(context_, *ours, fmt::format("/scenes/{}/extras/kilolux", index));
    context_.scene.hasExposure = fields.number("exposureEv100", -30.0, 40.0, context_.scene.exposureEv100);
}

} // namespace

void importLights(ImportContext& context) {
    LightImporter(context).run();
}

} // namespace kilolux::gltf
