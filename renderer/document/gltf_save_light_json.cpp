#include "renderer/document/gltf_save_light_json.h"

#include "renderer/document/light_properties.h"
#include "renderer/document/light_shapes.h"
#include "renderer/document/light_units.h"

#include <cmath>

namespace kilolux::gltf {

namespace {

LightUnit nativeUnit(LightExtension extension, LightType type) {
    if (extension == LightExtension::Area) return LightUnit::Nit;
    return type == LightType::Directional ? LightUnit::Lux : LightUnit::Candela;
}

bool holds(LightExtension extension, LightType type) {
    return extension == (shapeOf(type).isFlat ? LightExtension::Area : LightExtension::Punctual);
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
    if (retyped) setMember(json, "type", shapeOf(def.type).nativeWord);
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
    if (retyped) setMember(json, "type", shapeOf(def.type).nativeWord);
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

// The profile as the extension refers to it: a URI, or bytes of the file.
void setProfile(Json& json, const LightDef& def) {
    if (profileUri(json) == def.iesUri) return;
    for (const char* key : {"uri", "bufferView", "mimeType"})
        json.erase(key);
    constexpr std::string_view kView = "#/bufferViews/";
    if (def.iesUri.starts_with(kView)) {
        json["bufferView"] = std::strtoul(def.iesUri.c_str() + kView.size(), nullptr, 10);
        json["mimeType"] = "application/x-ies-lm-63";
    } else {
        json["uri"] = def.iesUri;
    }
}

// What a property is in the extras.
Json extrasJson(const auto& value) {
    using T = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<T, std::optional<double>>) {
        return value ? Json(*value) : Json();
    } else if constexpr (std::is_enum_v<T>) {
        return wordOf(value);
    } else {
        return value;
    }
}

bool sameDoors(const LightDef& def) {
    return std::all_of(def.barnDoors.begin(), def.barnDoors.end(),
                       [&](const BarnDoor& door) { return door == def.barnDoors[0]; });
}

constexpr const char* kDoorNames[] = {"barnDoorAngleRad", "barnDoorLengthM"};

// Four equal doors are written as one pair.
void fitDoors(Json& extras, const LightDef& now, const LightDef& def) {
    if (now.barnDoors == def.barnDoors || !sameDoors(def)) return;
    for (const char* key : kDoorNames)
        extras.erase(key);
    forEachLightProperty([&](const auto& each) {
        if (std::string_view(each.name).starts_with("barnDoor")) extras.erase(each.name);
    });
    if (def.barnDoors[0].angleRad != BarnDoor{}.angleRad) extras[kDoorNames[0]] = def.barnDoors[0].angleRad;
    if (def.barnDoors[0].lengthM != BarnDoor{}.lengthM) extras[kDoorNames[1]] = def.barnDoors[0].lengthM;
}

} // namespace

LightExtension extensionFor(const LightDef& def) {
    if (def.type == LightType::Sphere && emitsAsProfile(def)) return LightExtension::Ies;
    return shapeOf(def.type).isFlat ? LightExtension::Area : LightExtension::Punctual;
}

bool emitsAsProfile(const LightDef& def) {
    return def.iesUse == IesUse::Shape && def.iesIntensity && !def.iesUri.empty();
}

void fitUse(Json& use, const LightDef& native, const LightDef& def) {
    if (native.iesMultiplier != def.iesMultiplier) setMember(use, "multiplier", def.iesMultiplier);
    if (native.color != def.color) use["color"] = colorJson(def.color);
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
    if (extension == LightExtension::Ies) {
        setProfile(json, def);
        return json;
    }
    if (before ? before->color != def.color : def.color != glm::dvec3(1.0))
        json["color"] = colorJson(def.color);
    // A type that the extension does not know stands in the extras, and the definition for other readers.
    if (holds(extension, def.type)) {
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
    LightDef now = read();
    if (now.type != def.type) {
        extras.erase("type");
        if (native.type != def.type) extras["type"] = wordOf(def.type);
        now = read();
    }
    if (def.type == LightType::Rect) {
        fitDoors(extras, now, def);
        now = read();
    }
    forEachLightProperty([&](const auto& each) {
        if (!(each.types & typeBit(def.type))) return;
        const auto& wanted = each.access(def);
        const auto fits = [&] {
            // Sizes that passed through a node's scale.
            const bool isScaled = &each.access(def) == static_cast<const void*>(&def.widthM) ||
                                  &each.access(def) == static_cast<const void*>(&def.heightM);
            if constexpr (std::is_same_v<std::decay_t<decltype(wanted)>, double>)
                if (isScaled) return near(each.access(now), wanted);
            return each.access(now) == wanted;
        };
        if (fits()) return;
        extras.erase(each.name);
        now = read();
        if (fits()) return;
        if (Json value = extrasJson(wanted); !value.is_null()) extras[each.name] = std::move(value);
        now = read();
    });
    const auto fits = [&] { return now.intensity == def.intensity && now.unit == def.unit; };
    if (fits()) return;
    extras.erase("intensity");
    extras.erase("unit");
    now = read();
    if (fits()) return;
    extras["intensity"] = def.intensity;
    extras["unit"] = wordOf(def.unit);
}

void eraseLightExtras(Json& extras) {
    for (const char* name : {"type", "intensity", "unit", "muted", "group", kDoorNames[0], kDoorNames[1]})
        extras.erase(name);
    forEachLightProperty([&](const auto& each) { extras.erase(each.name); });
}

} // namespace kilolux::gltf
