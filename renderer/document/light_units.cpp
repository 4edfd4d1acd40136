#include "renderer/document/light_units.h"

#include "renderer/document/ies_profile.h"
#include "renderer/document/light_shapes.h"
#include "renderer/document/made_once.h"

#include <algorithm>
#include <cmath>

namespace kilolux {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kEv100Nit = 0.125; // luminance of EV100 0: L = 2^EV * K / S with K = 12.5, S = 100

bool hasArea(const LightDef& def) {
    return shapeOf(def.type).projectedM2(def) > 0.0;
}

// Of a profile, which has thousands of values, while lights ask every frame.
struct ProfileTotals {
    double maxCandela = 0.0, fluxLm = 0.0;
};
ProfileTotals totalsOf(const std::shared_ptr<const IesProfile>& profile) {
    static MadeOnce<IesProfile, ProfileTotals> totals;
    return *totals.get(profile, [](const IesProfile& made) {
        return ProfileTotals{made.maxCandela(), made.fluxLm()};
    });
}

// Flux per candela on the axis.
double fluxPerCandela(const LightDef& def) {
    if (isShapedByProfile(def)) return totalsOf(def.ies).fluxLm / totalsOf(def.ies).maxCandela;
    return shapeOf(def.type).fluxPerCandela(def);
}

double wymanLobe(double x, double center, double inverseBelow, double inverseAbove) {
    const double t = (x - center) * (x < center ? inverseBelow : inverseAbove);
    return std::exp(-0.5 * t * t);
}

// Wyman et al. 2013, section 2.2 (multi-lobe fit of the 1931 observer), wavelength in nm.
glm::dvec3 colorMatching(double nm) {
    return {0.362 * wymanLobe(nm, 442.0, 0.0624, 0.0374) + 1.056 * wymanLobe(nm, 599.8, 0.0264, 0.0323) -
                0.065 * wymanLobe(nm, 501.1, 0.0490, 0.0382),
            0.821 * wymanLobe(nm, 568.8, 0.0213, 0.0247) + 0.286 * wymanLobe(nm, 530.9, 0.0613, 0.0322),
            1.217 * wymanLobe(nm, 437.0, 0.0845, 0.0278) + 0.681 * wymanLobe(nm, 459.0, 0.0385, 0.0725)};
}

// XYZ of a black body, Y = 1.
glm::dvec3 blackBodyXyz(double temperatureK) {
    constexpr double kSecondRadiationNmK = 1.438776877e7; // h c / k
    glm::dvec3 xyz(0.0);
    for (double nm = 360.0; nm <= 830.0; nm += 5.0) {
        const double exponent = kSecondRadiationNmK / (nm * temperatureK);
        xyz += colorMatching(nm) / (std::pow(nm / 560.0, 5.0) * std::expm1(exponent));
    }
    return xyz / xyz.y;
}

glm::dmat3 fromRows(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    return glm::transpose(glm::dmat3(a, b, c));
}

} // namespace

bool unitApplies(const LightDef& def, LightUnit unit) {
    const bool isDirectional = def.type == LightType::Directional;
    if (unit == LightUnit::Lumen || unit == LightUnit::Candela) return !isDirectional;
    return unit == LightUnit::Lux || hasArea(def);
}

double emitterAreaM2(const LightDef& def) {
    return shapeOf(def.type).emitterM2(def);
}

bool usesProfile(const LightDef& def) {
    return def.ies && def.iesUse != IesUse::None && def.type != LightType::Directional &&
           totalsOf(def.ies).maxCandela > 0.0;
}

bool isShapedByProfile(const LightDef& def) {
    return def.iesUse == IesUse::Shape && usesProfile(def);
}

double baseIntensity(const LightDef& def) {
    if (isShapedByProfile(def) && def.iesIntensity) return totalsOf(def.ies).maxCandela * def.iesMultiplier;
    if (!unitApplies(def, def.unit)) return 0.0;
    switch (def.unit) {
    case LightUnit::Lumen:
        return def.intensity / fluxPerCandela(def);
    case LightUnit::Candela:
    case LightUnit::Lux:
        return def.intensity;
    case LightUnit::Nit:
        return def.intensity * shapeOf(def.type).projectedM2(def);
    case LightUnit::Ev100:
        return kEv100Nit * std::exp2(def.intensity) * shapeOf(def.type).projectedM2(def);
    }
    return 0.0;
}

double fromBaseIntensity(const LightDef& def, double baseValue, LightUnit unit) {
    if (!unitApplies(def, unit)) return 0.0;
    switch (unit) {
    case LightUnit::Lumen:
        return baseValue * fluxPerCandela(def);
    case LightUnit::Candela:
    case LightUnit::Lux:
        return baseValue;
    case LightUnit::Nit:
        return baseValue / shapeOf(def.type).projectedM2(def);
    case LightUnit::Ev100:
        return std::log2(baseValue / shapeOf(def.type).projectedM2(def) / kEv100Nit);
    }
    return 0.0;
}

double intensityIn(const LightDef& def, LightUnit unit) {
    return fromBaseIntensity(def, baseIntensity(def), unit);
}

double fluxLumen(const LightDef& def) {
    return def.type == LightType::Directional ? 0.0 : baseIntensity(def) * fluxPerCandela(def);
}

glm::dvec3 temperatureColor(double temperatureK) {
    // Bradford cone response and linear Rec. 709 from XYZ (D65), from their published primaries and white.
    static const glm::dmat3 kBradford =
        fromRows({0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296});
    static const glm::dmat3 kRec709FromXyz = glm::inverse(
        fromRows({0.4123907993, 0.3575843394, 0.1804807884}, {0.2126390059, 0.7151686788, 0.0721923154},
                 {0.0193308187, 0.1191947798, 0.9505321522}));
    static const glm::dvec3 kWhiteXyz = glm::inverse(kRec709FromXyz) * glm::dvec3(1.0);
    static const glm::dvec3 kNeutralCones = kBradford * blackBodyXyz(6500.0);
    static const glm::dvec3 kWhiteCones = kBradford * kWhiteXyz;
    const glm::dvec3 cones = kBradford * blackBodyXyz(std::clamp(temperatureK, 1000.0, 40000.0));
    const glm::dvec3 xyz = glm::inverse(kBradford) * (cones * kWhiteCones / kNeutralCones);
    const glm::dvec3 color = glm::max(kRec709FromXyz * xyz, glm::dvec3(0.0));
    return color / luminanceOf(color);
}

glm::dvec2 blackBodyChromaticity(double temperatureK) {
    const glm::dvec3 xyz = blackBodyXyz(temperatureK);
    return glm::dvec2(xyz) / (xyz.x + xyz.y + xyz.z);
}

glm::dvec3 emittedColor(const LightDef& def) {
    const glm::dvec3 tint = def.color * std::exp2(def.exposureEv);
    return def.temperatureK ? tint * temperatureColor(*def.temperatureK) : tint;
}

double luminanceOf(const glm::dvec3& linearRec709) {
    return glm::dot(linearRec709, glm::dvec3(0.2126390059, 0.7151686788, 0.0721923154));
}

} // namespace kilolux
