#include "renderer/document/gltf_save_light_json.h"

#include "renderer/document/light_units.h"
#include "renderer/document/light_words.h"

#include <cmath>

namespace kilolux::gltf {

namespace {

const char* nativeWord(LightType type) {
    switch (type) {
    case LightType::Directional:
        return "directional";
    case LightType::Spot:
        return "spot";
    case LightType::Sphere:
    case LightType::Tube:
        return "point";
    case LightType::Rect:
    case LightType::Disk:
        break;
    }
    return wordOf(type);
}

LightUnit nativeUnit(LightExtension extension, LightType type) {
    if (extension == LightExtension::Area) return LightUnit::Nit;
    return type == LightType::Directional ? LightUnit::Lux : LightUnit::Candela;
}

bool sameShape(const LightDef& a, const LightDef& b) {
    return a.radiusM == b.radiusM && a.lengthM == b.lengthM && a.widthM == b.widthM &&
           a.heightM == b.heightM && a.innerConeRad == b.innerConeRad && a.outerConeRad == b.outerConeRad &&
           a.angularDiameterRad == b.angularDiameterRad;
}

// Sizes that passed through a node's scale.
bool near(double a, double b) {
    return std::abs(a - b) <= 1e-12 * std::max(std::abs(a), std::abs(b));
}

void setIntensity(LightExtension extension, Json& json, const LightDef* before, const LightDef& def) {
    const LightUnit native = nativeUnit(extension, def.type);
    const bool typed =
        !before || before->intensity != def.intensity || before->unit != def.unit || before->type != def.type;
    // In another unit, what other readers see follows the size.
    if (!typed && (def.unit == native || sameShape(*before, def))) return;
    double value = def.unit == native ? def.intensity : intensityIn(def, native);
    if (!std::isfinite(value) || value < 0.0) value = 0.0;
    json.erase("luminance"); // the older name of 'intensity'
    setMember(json, "intensity", value);
}

// `range` is not for directional lights.
void setRange(Json& json, const LightDef* before, const LightDef& def) {
    const bool retyped = !before || before->type != def.type;
    const bool isDirectional = def.type == LightType::Directional;
    if (!retyped && (isDirectional || before->rangeM == def.rangeM)) return;
    if (def.rangeM && !isDirectional) {
        setMember(json, "range", *def.rangeM);
    } else {
        json.erase("range");
    }
}

void setPunctual(Json& json, const LightDef* before, const LightDef& def) {
    const bool retyped = !before || before->type != def.type;
    if (retyped) setMember(json, "type", nativeWord(def.type));
    const bool isSpot = json["type"] == "spot";
    if (!isSpot) {
        if (retyped) json.erase("spot");
        return;
    }
    if (!retyped && before->innerConeRad == def.innerConeRad && before->outerConeRad == def.outerConeRad)
        return;
    Json& spot = json["spot"];
    if (!spot.is_object()) spot = Json::object();
    // The validator wants the inner cone below the outer one.
    const double inner = std::min(def.innerConeRad, std::nextafter(def.outerConeRad, 0.0));
    if (!before || before->innerConeRad != def.innerConeRad || spot.contains("innerConeAngle"))
        setMember(spot, "innerConeAngle", inner);
    setMember(spot, "outerConeAngle", def.outerConeRad);
}

void setArea(Json& json, const LightDef* before, const LightDef& def, double nodeScale) {
    const bool retyped = !before || before->type != def.type;
    const bool isRect = def.type == LightType::Rect;
    if (retyped) setMember(json, "type", nativeWord(def.type));
    if (retyped && !isRect) json.erase("rect");
    const double side = isRect ? def.heightM : def.widthM;
    // Against what the file's own size gives at this scale, which may have changed as well.
    const double oldSide = json.contains("size") && json["size"].is_number()
                               ? json["size"].get<double>() * nodeScale
                               : nodeScale;
    if (!near(side, oldSide)) setMember(json, "size", side / nodeScale);
    if (!isRect) return;
    const Json* rect = findObject(json, "rect");
    const double oldAspect = rect && rect->contains("aspect") && (*rect)["aspect"].is_number()
                                 ? (*rect)["aspect"].get<double>()
                                 : 1.0;
    if (near(def.widthM, def.heightM * oldAspect)) return;
    if (!rect) json["rect"] = Json::object();
    json["rect"]["aspect"] = def.widthM / def.heightM;
}

struct NumberProperty {
    const char* name;
    double LightDef::*member;
    std::initializer_list<LightType> types; // that have it
};
using enum LightType;
const NumberProperty kNumberProperties[] = {
    {"radiusM", &LightDef::radiusM, {Sphere, Spot, Tube}},
    {"lengthM", &LightDef::lengthM, {Tube}},
    {"widthM", &LightDef::widthM, {Rect, Disk}},
    {"heightM", &LightDef::heightM, {Rect}},
    {"angularDiameterRad", &LightDef::angularDiameterRad, {Directional}},
    {"barnDoorAngleRad", &LightDef::barnDoorAngleRad, {Rect}},
    {"barnDoorLengthM", &LightDef::barnDoorLengthM, {Rect}},
    {"rayEndBiasM", &LightDef::rayEndBiasM, {Directional, Sphere, Spot, Tube, Rect, Disk}},
};
struct OptionalProperty {
    const char* name;
    std::optional<double> LightDef::*member;
};
constexpr OptionalProperty kOptionalProperties[] = {{"temperatureK", &LightDef::temperatureK},
                                                    {"rangeM", &LightDef::rangeM}};

} // namespace

LightExtension extensionFor(LightType type) {
    return type == LightType::Rect || type == LightType::Disk ? LightExtension::Area
                                                              : LightExtension::Punctual;
}

Json definitionJson(LightExtension extension, Json json, const LightDef* before, const LightDef& def,
                    double nodeScale) {
    if (before ? before->name != def.name : !def.name.empty()) {
        if (def.name.empty()) {
            json.erase("name");
        } else {
            json["name"] = def.name;
        }
    }
    if (before ? before->color != def.color : def.color != glm::dvec3(1.0))
        json["color"] = colorJson(def.color);
    // A type that the extension does not know stands in the extras, and the definition for other readers.
    if (extension == extensionFor(def.type)) {
        if (extension == LightExtension::Area) {
            setArea(json, before, def, nodeScale);
        } else {
            setPunctual(json, before, def);
        }
    }
    if (extension == LightExtension::Punctual) setRange(json, before, def);
    setIntensity(extension, json, before, def);
    return json;
}

void fitExtras(ImportContext& context, Json& extras, const LightDef& native, const LightDef& def) {
    // What reading gives with the extras as they are at this step.
    const auto read = [&] {
        LightDef result = native;
        LightReader(context).applyExtras(Fields(context, extras, ""), result);
        return result;
    };
    if (read().type != def.type) {
        extras.erase("type");
        if (native.type != def.type) extras["type"] = wordOf(def.type);
    }
    for (const NumberProperty& property : kNumberProperties) {
        const auto& types = property.types;
        if (std::find(types.begin(), types.end(), def.type) == types.end()) continue;
        const double wanted = def.*property.member;
        const bool scaled = property.member == &LightDef::widthM || property.member == &LightDef::heightM;
        const auto fits = [&](double value) { return scaled ? near(value, wanted) : value == wanted; };
        if (fits(read().*property.member)) continue;
        extras.erase(property.name);
        if (!fits(read().*property.member)) extras[property.name] = wanted;
    }
    for (const OptionalProperty& property : kOptionalProperties) {
        const std::optional<double> wanted = def.*property.member;
        const bool hasRange = def.type != LightType::Directional || property.member != &LightDef::rangeM;
        if (!hasRange || read().*property.member == wanted) continue;
        extras.erase(property.name);
        if (wanted && read().*property.member != wanted) extras[property.name] = *wanted;
    }
    const auto fits = [&] {
        const LightDef now = read();
        return now.intensity == def.intensity && now.unit == def.unit;
    };
    if (fits()) return;
    extras.erase("intensity");
    extras.erase("unit");
    if (fits()) return;
    extras["intensity"] = def.intensity;
    extras["unit"] = wordOf(def.unit);
}

void eraseLightExtras(Json& extras) {
    for (const char* name : {"type", "intensity", "unit", "temperatureK", "rangeM", "muted", "group"})
        extras.erase(name);
    for (const NumberProperty& property : kNumberProperties)
        extras.erase(property.name);
}

} // namespace kilolux::gltf
