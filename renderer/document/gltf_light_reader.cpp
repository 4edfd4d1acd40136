// Definitions of lights, see gltf_light_reader.h. A broken light costs a warning, not the scene.
#include "renderer/document/gltf_light_reader.h"

#include "renderer/document/light_properties.h"
#include "renderer/document/light_units.h"
#include "renderer/document/scene_files.h"

#include <algorithm>
#include <cmath>

namespace kilolux::gltf {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kMinTubeRadiusM = 0.001; // a line has no luminance
constexpr double kDefaultAreaNit = 1000.0;

template<typename Row>
void readProperty(const Fields& fields, const Row& row, double& target) {
    fields.number(row.name, row.min, row.max, target);
}
template<typename Row>
void readProperty(const Fields& fields, const Row& row, std::optional<double>& target) {
    if (double number = 0.0; fields.number(row.name, row.min, row.max, number)) target = number;
}
template<typename Row>
void readProperty(const Fields& fields, const Row& row, bool& target) {
    fields.flag(row.name, target);
}
template<typename Row>
void readProperty(const Fields& fields, const Row& row, std::string& target) {
    fields.text(row.name, target);
}
template<typename Row>
void readProperty(const Fields& fields, const Row& row, std::uint8_t& target) {
    if (double bits = 0.0; fields.number(row.name, row.min, row.max, bits))
        target = static_cast<std::uint8_t>(bits);
}
template<typename Row>
void readProperty(const Fields& fields, const Row& row, IesUse& target) {
    if (const IesUseWord* word = fields.name(row.name, kIesUseWords)) target = word->use;
}
template<typename Row>
void readProperty(const Fields& fields, const Row& row, LightFunctionKind& target) {
    if (const LightFunctionWord* word = fields.name(row.name, kLightFunctionWords)) target = word->kind;
}

constexpr LightTypeWord kPunctualTypes[] = {
    {"directional", LightType::Directional}, {"point", LightType::Sphere}, {"spot", LightType::Spot}};
constexpr LightTypeWord kAreaTypes[] = {{"rect", LightType::Rect}, {"disk", LightType::Disk}};

} // namespace

void LightReader::readCommon(const Fields& fields, LightDef& def) {
    def.pointer = fields.place();
    if (const Json* name = fields.find("name"); name && name->is_string()) def.name = *name;
    fields.number("intensity", 0.0, kHuge, def.intensity);
    readColor(fields, def);
}

void LightReader::readColor(const Fields& fields, LightDef& def) {
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

void LightReader::readSpot(const Fields& fields, LightDef& def) {
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

std::optional<LightDef> LightReader::readPunctual(const Json& light, const std::string& pointer) {
    const Fields fields(context_, light, pointer);
    LightDef def;
    const LightTypeWord* type = fields.name("type", kPunctualTypes);
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

std::optional<LightDef> LightReader::readArea(const Json& light, const std::string& pointer,
                                              double nodeScale) {
    const Fields fields(context_, light, pointer);
    LightDef def;
    const LightTypeWord* type = fields.name("type", kAreaTypes);
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
    if (!(nodeScale > 0.0)) {
        context_.warn(pointer, "expected a node with a scale above 0; the light is left out");
        return std::nullopt;
    }
    def.heightM = size * nodeScale;
    def.widthM = def.type == LightType::Rect ? size * nodeScale * aspect : size * nodeScale;
    return def;
}

std::string profileUri(const Json& light) {
    if (const auto uri = light.find("uri"); uri != light.end() && uri->is_string()) return *uri;
    const auto view = light.find("bufferView");
    const bool has = view != light.end() && view->is_number_unsigned() && *view < INT32_MAX;
    return has ? fmt::format("#/bufferViews/{}", view->get<int>()) : "";
}

// A light of its own, with the candela of its profile. One whose profile is missing stays, as a point.
std::optional<LightDef> LightReader::readIes(const Json& light, const std::string& pointer,
                                             const Fields& use) {
    LightDef def;
    def.pointer = pointer;
    if (const auto name = light.find("name"); name != light.end() && name->is_string()) def.name = *name;
    def.iesUri = profileUri(light);
    if (def.iesUri.empty()) context_.warnOnce("uri " + pointer, pointer, "expected 'uri' or 'bufferView'");
    const auto type = light.find("mimeType");
    if (type != light.end() && *type != "application/x-ies-lm-63") {
        context_.warnOnce("mime " + pointer, pointer + "/mimeType",
                          "expected 'application/x-ies-lm-63'; it is read as such");
    }
    def.iesUse = IesUse::Shape;
    use.number("multiplier", 0.0, kHuge, def.iesMultiplier);
    readColor(use, def);
    return def;
}

// `before` is the light as the extension alone describes it.
void LightReader::applyIntensity(const Fields& extras, const LightDef& before, LightDef& def) {
    const LightUnitWord* unit = extras.name("unit", kLightUnitWords);
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

void LightReader::applyExtras(const Fields& extras, LightDef& def) {
    const LightDef before = def;
    if (const LightTypeWord* type = extras.name("type", kLightTypeWords)) def.type = type->type;
    // One pair of doors for all sides; a side of its own comes after it.
    for (BarnDoor& door : def.barnDoors) {
        extras.number("barnDoorAngleRad", 0.0, kPi / 2.0, door.angleRad);
        extras.number("barnDoorLengthM", 0.0, kHuge, door.lengthM);
    }
    forEachLightProperty([&](const auto& each) {
        if (extras.find(each.name)) readProperty(extras, each, each.access(def));
    });
    if (def.type == LightType::Tube) def.radiusM = std::max(def.radiusM, kMinTubeRadiusM);
    // A type for which the extension's unit means nothing takes over the base value (candela or lux).
    applyIntensity(extras, before, def);
}

double largestScale(const glm::dmat4& matrix) {
    return std::max({glm::length(glm::dvec3(matrix[0])), glm::length(glm::dvec3(matrix[1])),
                     glm::length(glm::dvec3(matrix[2]))});
}

void LightReader::loadFiles(LightDef& def, const std::string& place) {
    keepLightFiles(context_, def);
    for (const Error& error : kilolux::loadFiles(context_.scene.files.get(), def))
        context_.warnOnce(error.message, place, "{}; the light shines without it", error.message);
}

std::optional<LightDef> LightReader::read(LightExtension extension, const Json& light,
                                          const std::string& pointer, const Fields& use, double nodeScale) {
    if (extension == LightExtension::Ies) return readIes(light, pointer, use);
    return extension == LightExtension::Area ? readArea(light, pointer, nodeScale)
                                             : readPunctual(light, pointer);
}

} // namespace kilolux::gltf
