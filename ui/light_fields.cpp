#include "ui/light_fields.h"

#include "renderer/document/light_properties.h"
#include "renderer/document/light_units.h"
#include "ui/change_builder.h"
#include "ui/light_place.h"

#include <algorithm>
#include <fmt/format.h>

namespace kilolux {

namespace {

constexpr std::uint32_t bit(LightType type) {
    return typeBit(type);
}
using properties::kAll, properties::kLocal, properties::kRound;
constexpr std::uint32_t kRect = properties::kRect;
constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kMinTubeRadiusM = 0.001;

using enum Quantity;

bool hasProfile(const LightDef& def) {
    return !def.iesUri.empty();
}
bool hasProfileIntensity(const LightDef& def) {
    return isShapedByProfile(def) && def.iesIntensity;
}
bool hasFunction(const LightDef& def) {
    return def.function.kind != LightFunctionKind::None;
}
bool hasImage(const LightDef& def) {
    return def.function.kind == LightFunctionKind::Image;
}
bool hasMotion(const LightDef& def) {
    return def.function.kind == LightFunctionKind::Caustics ||
           def.function.kind == LightFunctionKind::Flicker;
}

// One pixel of dragging: half a centimetre, a quarter of a degree, 10 K.
constexpr LightField kFields[] = {
    {LightSection::Light, "Intensity", "intensity", Intensity, kAll, 0.0,
     "Kept as typed, with its unit: 800 lm, 2.5k cd, *2, +10 %"},
    {LightSection::Shape, "Source radius", "radiusM", Length, kRound, 0.005, "0 is a point"},
    {LightSection::Shape, "Source length", "lengthM", Length, bit(LightType::Tube), 0.005,
     "Between the centres of the end caps, along local X"},
    {LightSection::Shape, "Source width", "widthM", Length, bit(LightType::Rect), 0.005, "Along local X"},
    {LightSection::Shape, "Diameter", "widthM", Length, bit(LightType::Disk), 0.005, "Of the disk"},
    {LightSection::Shape, "Source height", "heightM", Length, bit(LightType::Rect), 0.005, "Along local Y"},
    {LightSection::Shape, "Angular diameter", "angularDiameterRad", Angle, bit(LightType::Directional),
     0.02 * kDegree, "Size in the sky; the sun has 0.53\u00b0"},
    {LightSection::Shaping, "Inner cone", "innerConeRad", Angle, bit(LightType::Spot), 0.25 * kDegree,
     "Half angle up to which the light is full"},
    {LightSection::Shaping, "Outer cone", "outerConeRad", Angle, bit(LightType::Spot), 0.25 * kDegree,
     "Half angle from which it is dark, at most 90\u00b0"},
    {LightSection::Shaping, "Range", "rangeM", Length, kLocal, 0.05,
     "Where the light ends smoothly; 'auto': by its intensity"},
    {LightSection::Shaping, "Barn doors", "barnDoorAngleRad", Angle, kRect, 0.25 * kDegree,
     "Angle of all four flaps: 0\u00b0 is along the beam, 90\u00b0 open"},
    {LightSection::Shaping, "Door length", "barnDoorLengthM", Length, kRect, 0.005,
     "Of all four flaps; 0 is without doors"},
    {LightSection::Shaping, "Left flap", "barnDoorLeftAngleRad", Angle, kRect, 0.25 * kDegree,
     "At local -X; 90\u00b0 is open"},
    {LightSection::Shaping, "Left length", "barnDoorLeftLengthM", Length, kRect, 0.005,
     "0 is without this flap"},
    {LightSection::Shaping, "Right flap", "barnDoorRightAngleRad", Angle, kRect, 0.25 * kDegree,
     "At local +X; 90\u00b0 is open"},
    {LightSection::Shaping, "Right length", "barnDoorRightLengthM", Length, kRect, 0.005,
     "0 is without this flap"},
    {LightSection::Shaping, "Top flap", "barnDoorTopAngleRad", Angle, kRect, 0.25 * kDegree,
     "At local +Y; 90\u00b0 is open"},
    {LightSection::Shaping, "Top length", "barnDoorTopLengthM", Length, kRect, 0.005,
     "0 is without this flap"},
    {LightSection::Shaping, "Bottom flap", "barnDoorBottomAngleRad", Angle, kRect, 0.25 * kDegree,
     "At local -Y; 90\u00b0 is open"},
    {LightSection::Shaping, "Bottom length", "barnDoorBottomLengthM", Length, kRect, 0.005,
     "0 is without this flap"},
    {LightSection::Shaping, "Source texture", "sourceTexture", Number, kRect, 0.0,
     "A picture on its face, top towards local +Y"},
    {LightSection::Profile, "IES profile", "iesProfile", Number, kLocal, 0.0,
     "Where the light goes, as measured of a luminaire"},
    {LightSection::Profile, "Used as", "iesUse", Number, kLocal, 0.0,
     "Shape: the light emits as the profile says; mask: the profile dims what it emits", hasProfile},
    {LightSection::Profile, "Its intensity", "iesIntensity", Number, kLocal, 0.0,
     "The profile's candela in place of the light's own intensity", isShapedByProfile},
    {LightSection::Profile, "Multiplier", "iesMultiplier", Number, kLocal, 0.0, "Of the profile's candela",
     hasProfileIntensity},
    {LightSection::Function, "Light function", "lightFunction", Number, kAll, 0.0,
     "A mask that the light shines through"},
    {LightSection::Function, "Image", "lightFunctionImage", Number, kAll, 0.0, "The mask's image", hasImage},
    {LightSection::Function, "Scale", "lightFunctionScale", Length, kAll, 0.0, "Of the pattern, 1 m ahead",
     hasFunction},
    {LightSection::Function, "Turn", "lightFunctionAngleRad", Angle, kAll, 0.5 * kDegree,
     "About the light's axis", hasFunction},
    {LightSection::Function, "Softness", "lightFunctionSoftness", Number, kAll, 0.005, "Of its edges, 0 to 1",
     hasFunction},
    {LightSection::Function, "Strength", "lightFunctionStrength", Number, kAll, 0.005,
     "0 is without the mask, 1 is all of it", hasFunction},
    {LightSection::Function, "Seed", "lightFunctionSeed", Number, kAll, 0.1, "Which of the patterns",
     hasMotion},
    {LightSection::Function, "Speed", "lightFunctionSpeed", Number, kAll, 0.01, "0 stands still", hasMotion},
    {LightSection::Colour, "Temperature", "temperatureK", Temperature, kAll, 10.0,
     "1000 to 40000 K, 6500 K is neutral; 'none': the tint alone"},
    {LightSection::Colour, "Exposure", "exposureEv", Exposure, kAll, 0.01,
     "A factor on all that it emits, in stops"},
    {LightSection::Shadow, "Ray end bias", "rayEndBiasM", Length, kLocal, 0.002,
     "Shadow rays end this far before the light, past its fixture"},
    {LightSection::Shadow, "Penumbra", "penumbraScale", Number, kAll, 0.005,
     "Of the source's size as shadows see it: below 1 they are sharper, above softer"},
    {LightSection::Visibility, "Channels", "channels", Number, kAll, 0.0,
     "The light reaches meshes that share one of them"},
    {LightSection::Visibility, "Others cast", "channelsCast", Number, kAll, 0.0,
     "Meshes that it does not reach cast its shadow all the same"},
};

struct Target {
    std::uint64_t light;
    Sharing sharing;
};

// One light per definition where it can be edited for all at once, else each light.
std::vector<Target> targetsOf(const Scene& scene, std::span<const std::uint64_t> lights, Sharing sharing) {
    std::vector<int> users(scene.lightDefs.size(), 0), chosen(scene.lightDefs.size(), 0);
    for (const LightNode& light : scene.lights)
        ++users[std::size_t(light.def)];
    const auto indexOf = [&](std::uint64_t light) { return std::size_t(lightOf(scene, light).def); };
    for (const std::uint64_t light : lights)
        ++chosen[indexOf(light)];
    std::vector<bool> done(scene.lightDefs.size(), false);
    std::vector<Target> targets;
    for (const std::uint64_t light : lights) {
        const std::size_t def = indexOf(light);
        if (sharing == Sharing::MakeUnique && chosen[def] != users[def]) {
            targets.push_back({light, Sharing::MakeUnique});
        } else if (!done[def]) {
            targets.push_back({light, Sharing::EditAll});
            done[def] = true;
        }
    }
    return targets;
}

// The bounds that hold for a number on this light, those of other fields included.
double clampedFor(const LightDef& def, const EditField& field, double value) {
    double least = field.min, most = field.max;
    const std::string_view name = field.name;
    if (name == "innerConeRad") most = def.outerConeRad;
    if (name == "radiusM" && def.type == LightType::Tube) least = kMinTubeRadiusM;
    // A source without area has no luminance: in nit and EV it keeps some.
    if (name == "radiusM" && (def.unit == LightUnit::Nit || def.unit == LightUnit::Ev100))
        least = std::max(least, kMinTubeRadiusM);
    if (name == "intensity" && def.unit != LightUnit::Ev100) least = 0.0;
    if (name == "intensity" && def.unit == LightUnit::Ev100) most = 100.0;
    return std::clamp(value, least, most);
}

std::optional<Error> setEntry(ChangeBuilder& builder, const LightDef& from, const Target& target,
                              const LightField& row, const ValueEntry& entry, OutOfRange outOfRange) {
    const EditField& field = *findLightField(row.field);
    const auto set = [&](std::string_view name, EditValue value) {
        if (double* number = std::get_if<double>(&value); number && outOfRange == OutOfRange::Clamp)
            *number = clampedFor(defOf(builder.scene(), target.light), *findLightField(name), *number);
        builder.set(EditTarget::Light, target.light, name, std::move(value), target.sharing);
    };
    if (row.quantity == Intensity) {
        const Result<TypedIntensity> typed = withIntensity(from, entry);
        if (!typed) return Error{typed.error()};
        // The unit first: setting it converts the number.
        set("unit", typed.value().unit);
        set("intensity", typed.value().value);
        return std::nullopt;
    }
    if (entry.how == ValueEntry::How::Clear) {
        if (field.kind != FieldKind::OptionalNumber) return Error{"expected a number: it cannot be left out"};
        set(row.field, EditValue());
        return std::nullopt;
    }
    Scene one;
    one.lightDefs = {from};
    const EditValue before = field.get(one, 0);
    const double* number = std::get_if<double>(&before);
    if (!number && entry.how != ValueEntry::How::Set)
        return Error{"expected a number: there is none to change yet"};
    set(row.field, changed(number ? *number : 0.0, entry));
    return std::nullopt;
}

} // namespace

std::span<const LightField> lightFields() {
    return kFields;
}

std::optional<DoorNumbers> doorNumbersOf(const LightField& field) {
    if (!std::string_view(field.field).starts_with("barnDoor")) return std::nullopt;
    return findLightField(field.field)->isShorthand ? DoorNumbers::OnePair : DoorNumbers::FourFlaps;
}

bool doorsAreEven(const Scene& scene, std::span<const std::uint64_t> lights) {
    return std::all_of(lights.begin(), lights.end(), [&](std::uint64_t light) {
        const auto& doors = defOf(scene, light).barnDoors;
        return std::all_of(doors.begin() + 1, doors.end(),
                           [&](const BarnDoor& door) { return door == doors[0]; });
    });
}

bool allHave(const Scene& scene, std::span<const std::uint64_t> lights, const LightField& field) {
    return std::all_of(lights.begin(), lights.end(), [&](std::uint64_t light) {
        const LightDef& def = defOf(scene, light);
        return (field.types & bit(def.type)) && (!field.shows || field.shows(def));
    });
}

CommonValue commonValue(const Scene& scene, std::span<const std::uint64_t> lights, std::string_view name) {
    const EditField* field = findLightField(name);
    CommonValue common;
    if (!field || lights.empty()) return common;
    const auto valueOf = [&](std::uint64_t light) {
        const bool ofDefinition = field->target == EditTarget::Definition;
        return field->get(scene, ofDefinition ? std::uint64_t(lightOf(scene, light).def) : light);
    };
    common.value = valueOf(lights[0]);
    // One pair of doors stands for four flaps, which may differ.
    if (field->isShorthand) {
        common.mixed = std::any_of(lights.begin(), lights.end(), [&](std::uint64_t light) {
            const auto& doors = defOf(scene, light).barnDoors;
            return std::any_of(doors.begin(), doors.end(), [&](const BarnDoor& door) {
                return name == "barnDoorAngleRad" ? door.angleRad != doors[0].angleRad
                                                  : door.lengthM != doors[0].lengthM;
            });
        });
    }
    common.mixed = common.mixed || std::any_of(lights.begin() + 1, lights.end(), [&](std::uint64_t light) {
                       return !sameValue(common.value, valueOf(light));
                   });
    return common;
}

Result<Edits> editsForEntry(const Scene& scene, const Scene& from, std::span<const std::uint64_t> lights,
                            const LightField& field, const ValueEntry& entry, Sharing sharing,
                            OutOfRange outOfRange) {
    ChangeBuilder builder(scene);
    for (const Target& target : targetsOf(scene, lights, sharing)) {
        const std::optional<Error> error =
            setEntry(builder, defOf(from, target.light), target, field, entry, outOfRange);
        if (error) {
            return Error{fmt::format("{}, {}: {}", describeTarget(scene, EditTarget::Light, target.light),
                                     field.field, error->message)};
        }
    }
    return builder.finish();
}

Result<Edits> editsForSize(const Scene& scene, const Scene& from, std::span<const std::uint64_t> lights,
                           const glm::dvec3& factors, Sharing sharing) {
    ChangeBuilder builder(scene);
    const double any =
        factors.x == factors.y && factors.y == factors.z ? factors.x : factors.x * factors.y * factors.z;
    for (const Target& target : targetsOf(scene, lights, sharing)) {
        const LightDef& def = defOf(from, target.light);
        const auto scale = [&](const char* name, double before, double factor) {
            const double after = clampedFor(def, *findLightField(name), before * factor);
            builder.set(EditTarget::Light, target.light, name, after, target.sharing);
        };
        const bool isTube = def.type == LightType::Tube;
        const double across = factors.x == factors.y ? factors.x : factors.y * factors.z;
        if (def.type == LightType::Rect) {
            scale("widthM", def.widthM, factors.x);
            scale("heightM", def.heightM, factors.y);
        } else if (def.type == LightType::Disk) {
            scale("widthM", def.widthM, any);
        } else if (def.type == LightType::Directional) {
            scale("angularDiameterRad", def.angularDiameterRad, any);
        } else {
            scale("radiusM", def.radiusM, isTube ? across : any);
            if (isTube) scale("lengthM", def.lengthM, factors.x);
        }
    }
    return builder.finish();
}

Result<Edits> editsForValue(const Scene& scene, std::span<const std::uint64_t> lights, std::string_view field,
                            const EditValue& value, Sharing sharing) {
    ChangeBuilder builder(scene);
    const EditField* found = findLightField(field);
    if (!found) return Error{fmt::format("expected a field that exists, found '{}'", field)};
    if (found->target == EditTarget::Light) {
        for (const std::uint64_t light : lights)
            builder.set(EditTarget::Light, light, field, value);
    } else {
        for (const Target& target : targetsOf(scene, lights, sharing))
            builder.set(EditTarget::Light, target.light, field, value, target.sharing);
    }
    return builder.finish();
}

Result<Edits> editsForEvenDoors(const Scene& scene, std::span<const std::uint64_t> lights, Sharing sharing) {
    ChangeBuilder builder(scene);
    for (const Target& target : targetsOf(scene, lights, sharing)) {
        const auto& doors = defOf(scene, target.light).barnDoors;
        const BarnDoor& longest =
            *std::max_element(doors.begin(), doors.end(),
                              [](const BarnDoor& a, const BarnDoor& b) { return a.lengthM < b.lengthM; });
        builder.set(EditTarget::Light, target.light, "barnDoorAngleRad", longest.angleRad, target.sharing);
        builder.set(EditTarget::Light, target.light, "barnDoorLengthM", longest.lengthM, target.sharing);
    }
    return builder.finish();
}

Result<Edits> editsForName(const Scene& scene, std::span<const std::uint64_t> lights,
                           const std::string& name) {
    ChangeBuilder builder(scene);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        builder.set(EditTarget::Light, lights[i], "name",
                    lights.size() == 1 ? name : fmt::format("{} {}", name, i + 1));
    }
    return builder.finish();
}

int othersSharing(const Scene& scene, std::span<const std::uint64_t> lights) {
    std::vector<bool> theirs(scene.lightDefs.size(), false);
    for (const std::uint64_t light : lights)
        theirs[std::size_t(lightOf(scene, light).def)] = true;
    const auto others = std::count_if(scene.lights.begin(), scene.lights.end(), [&](const LightNode& light) {
        return theirs[std::size_t(light.def)] && !std::binary_search(lights.begin(), lights.end(), light.id);
    });
    return int(others);
}

} // namespace kilolux
