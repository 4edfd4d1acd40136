// The one list of a light's properties that extras.kilolux can hold (extras.md). Import, saving, edits,
// comparing and copying as text all walk it; a further property is a further row.
#pragma once

#include "renderer/document/light_words.h"

#include <tuple>

namespace kilolux {

constexpr std::uint32_t typeBit(LightType type) {
    return 1u << static_cast<unsigned>(type);
}

namespace properties {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kHuge = 1e18; // the largest length or intensity that a file may hold
using enum LightType;
inline constexpr std::uint32_t kAll = 0x3f, kLocal = kAll & ~typeBit(Directional), kRect = typeBit(Rect);
inline constexpr std::uint32_t kRound = typeBit(Sphere) | typeBit(Spot) | typeBit(Tube);

// What the text of a property names.
enum class Names : std::uint8_t { Nothing, Profile, Picture };

template<typename Access>
struct Property {
    const char* name;
    Access access;             // of the member in a LightDef&
    std::uint32_t types = 0;   // typeBit() of those that have it
    double min = 0.0, max = 0; // of numbers
    const char* unit = "";
    const char* help = "";
    Names names = Names::Nothing;
};

// Clang 14 deduces no aggregates by itself.
template<typename Access>
Property(const char*, Access, std::uint32_t, double, double, const char*, const char*, Names = Names::Nothing)
    -> Property<Access>;

#define KILOLUX_MEMBER(path)                                                                                 \
    [](auto& def) -> auto& {                                                                                 \
        return def.path;                                                                                     \
    }

inline constexpr auto kList = std::tuple{
    Property{"temperatureK", KILOLUX_MEMBER(temperatureK), kAll, 1000, 40000, "K", "colour temperature"},
    Property{"rangeM", KILOLUX_MEMBER(rangeM), kLocal, 1e-6, kHuge, "m", "where the light ends smoothly"},
    Property{"radiusM", KILOLUX_MEMBER(radiusM), kRound, 0, kHuge, "m", "sphere, spot, tube: source radius"},
    Property{"lengthM", KILOLUX_MEMBER(lengthM), typeBit(Tube), 0, kHuge, "m", "tube: between its end caps"},
    Property{"widthM", KILOLUX_MEMBER(widthM), kRect | typeBit(Disk), 1e-6, kHuge, "m",
             "rect: local X; disk: diameter"},
    Property{"heightM", KILOLUX_MEMBER(heightM), kRect, 1e-6, kHuge, "m", "rect: local Y"},
    Property{"angularDiameterRad", KILOLUX_MEMBER(angularDiameterRad), typeBit(Directional), 0, kPi, "rad",
             "directional: size in the sky"},
    Property{"barnDoorLeftAngleRad", KILOLUX_MEMBER(barnDoors[0].angleRad), kRect, 0, kPi / 2, "rad",
             "rect, the flap at local -X: pi/2 is open"},
    Property{"barnDoorLeftLengthM", KILOLUX_MEMBER(barnDoors[0].lengthM), kRect, 0, kHuge, "m",
             "rect, the flap at local -X: 0 is without"},
    Property{"barnDoorRightAngleRad", KILOLUX_MEMBER(barnDoors[1].angleRad), kRect, 0, kPi / 2, "rad",
             "rect, the flap at local +X"},
    Property{"barnDoorRightLengthM", KILOLUX_MEMBER(barnDoors[1].lengthM), kRect, 0, kHuge, "m",
             "rect, the flap at local +X"},
    Property{"barnDoorTopAngleRad", KILOLUX_MEMBER(barnDoors[2].angleRad), kRect, 0, kPi / 2, "rad",
             "rect, the flap at local +Y"},
    Property{"barnDoorTopLengthM", KILOLUX_MEMBER(barnDoors[2].lengthM), kRect, 0, kHuge, "m",
             "rect, the flap at local +Y"},
    Property{"barnDoorBottomAngleRad", KILOLUX_MEMBER(barnDoors[3].angleRad), kRect, 0, kPi / 2, "rad",
             "rect, the flap at local -Y"},
    Property{"barnDoorBottomLengthM", KILOLUX_MEMBER(barnDoors[3].lengthM), kRect, 0, kHuge, "m",
             "rect, the flap at local -Y"},
    Property{"iesProfile", KILOLUX_MEMBER(iesUri), kLocal, 0, 0, "",
             "photometric profile: a file in the scene's folder", Names::Profile},
    Property{"iesUse", KILOLUX_MEMBER(iesUse), kLocal, 0, 0, "",
             "shape: emits as the profile says; mask: the profile dims what it emits; none"},
    Property{"iesIntensity", KILOLUX_MEMBER(iesIntensity), kLocal, 0, 0, "",
             "shape: the profile's candela in place of the light's intensity"},
    Property{"iesMultiplier", KILOLUX_MEMBER(iesMultiplier), kLocal, 0, kHuge, "",
             "of the profile's candela"},
    Property{"sourceTexture", KILOLUX_MEMBER(sourceUri), kRect, 0, 0, "",
             "rect: picture on its face, a file in the scene's folder", Names::Picture},
    Property{"lightFunction", KILOLUX_MEMBER(function.kind), kAll, 0, 0, "",
             "mask that it shines through: none, image, grid, blinds, caustics or flicker"},
    Property{"lightFunctionImage", KILOLUX_MEMBER(function.imageUri), kAll, 0, 0, "",
             "image of that mask, a file in the scene's folder", Names::Picture},
    Property{"lightFunctionScale", KILOLUX_MEMBER(function.scale), kAll, 1e-4, 1e6, "m",
             "size of the mask's pattern 1 m ahead"},
    Property{"lightFunctionAngleRad", KILOLUX_MEMBER(function.angleRad), kAll, -1e3, 1e3, "rad",
             "turn of the mask about the light's axis"},
    Property{"lightFunctionSoftness", KILOLUX_MEMBER(function.softness), kAll, 0, 1, "",
             "of the mask's edges"},
    Property{"lightFunctionStrength", KILOLUX_MEMBER(function.strength), kAll, 0, 1, "",
             "0 is without the mask"},
    Property{"lightFunctionSeed", KILOLUX_MEMBER(function.seed), kAll, 0, 65535, "",
             "caustics, flicker: which of them"},
    Property{"lightFunctionSpeed", KILOLUX_MEMBER(function.speed), kAll, 0, 1e3, "",
             "caustics, flicker: of their motion"},
    Property{"exposureEv", KILOLUX_MEMBER(exposureEv), kAll, -100, 100, "EV", "a factor, 2^exposureEv"},
    Property{"rayEndBiasM", KILOLUX_MEMBER(rayEndBiasM), kAll, 0, kHuge, "m",
             "shadow rays end this far before the light"},
    Property{"penumbraScale", KILOLUX_MEMBER(penumbraScale), kAll, 0, 100, "",
             "of the source's size as shadows see it"},
    Property{"channels", KILOLUX_MEMBER(channels), kAll, 0, 255, "",
             "bits 1 to 128: reaches meshes that share one"},
    Property{"channelsCast", KILOLUX_MEMBER(channelsCast), kAll, 0, 0, "",
             "meshes that it does not reach cast its shadow"}};

#undef KILOLUX_MEMBER

} // namespace properties

inline constexpr std::size_t kLightPropertyCount = std::tuple_size_v<decltype(properties::kList)>;

// visit(property) for each row.
template<typename Visit>
void forEachLightProperty(Visit&& visit) {
    std::apply([&](const auto&... each) { (visit(each), ...); }, properties::kList);
}

} // namespace kilolux
