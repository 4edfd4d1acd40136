#include "renderer/document/light_shapes.h"

#include "renderer/document/light_words.h"

#include <algorithm>
#include <cmath>

namespace kilolux {

namespace {

constexpr double kPi = 3.14159265358979323846;

double none(const LightDef&) {
    return 0.0;
}
double cosineSr(const LightDef&) {
    return kPi;
}
double radiusOf(const LightDef& def) {
    return def.radiusM;
}
glm::dvec2 radiusSize(const LightDef& def) {
    return {def.radiusM, 0.0};
}
double circleM2(const LightDef& def) {
    return kPi * def.radiusM * def.radiusM;
}
double ballM2(const LightDef& def) {
    return 4.0 * circleM2(def);
}

double skySr(const LightDef& def) {
    const double sine = std::sin(std::min(def.angularDiameterRad * 0.5, kPi / 2.0));
    return kPi * sine * sine;
}

// Integral of saturate((c - cosOuter) * scale)^2 over the directions of the cone, c = cos(angle).
double coneSr(const LightDef& def) {
    const double cosInner = std::cos(def.innerConeRad), cosOuter = std::cos(def.outerConeRad);
    const double width = std::max(0.001, cosInner - cosOuter);
    const double full = std::min(1.0, cosOuter + width); // from here on the falloff is 1
    const double rise = (full - cosOuter) / width;
    return 2.0 * kPi * (rise * rise * rise * width / 3.0 + (1.0 - full));
}

double capsuleSideM2(const LightDef& def) {
    return 2.0 * def.radiusM * def.lengthM + kPi * def.radiusM * def.radiusM;
}
double capsuleM2(const LightDef& def) {
    return 2.0 * kPi * def.radiusM * def.lengthM + ballM2(def);
}

double rectM2(const LightDef& def) {
    return def.widthM * def.heightM;
}
double diskM2(const LightDef& def) {
    return kPi * def.widthM * def.widthM * 0.25;
}

// In the order of LightType.
constexpr LightShape kShapes[] = {
    {"Directional light", "directional", false, skySr, none, none, none,
     [](const LightDef& def) { return glm::dvec2(std::tan(0.5 * def.angularDiameterRad), 0.0); },
     [](LightDef& def) {
         def.unit = LightUnit::Lux;
         def.intensity = 1000.0; // an overcast day
         def.temperatureK = 5500.0;
         def.angularDiameterRad = glm::radians(0.53);
     }},
    {"Sphere light", "point", false, circleM2, ballM2, [](const LightDef&) { return 4.0 * kPi; }, radiusOf,
     radiusSize, [](LightDef& def) { def.radiusM = 0.04; }},
    {"Spot light", "spot", false, circleM2, ballM2, coneSr, radiusOf, radiusSize,
     [](LightDef& def) {
         def.radiusM = 0.02;
         def.innerConeRad = glm::radians(20.0);
         def.outerConeRad = glm::radians(30.0);
     }},
    {"Tube light", "point", false, capsuleSideM2, capsuleM2,
     [](const LightDef& def) { return kPi * capsuleM2(def) / capsuleSideM2(def); },
     [](const LightDef& def) { return 0.5 * def.lengthM + def.radiusM; },
     [](const LightDef& def) { return glm::dvec2(def.radiusM, 0.5 * def.lengthM); },
     [](LightDef& def) {
         def.intensity = 2000.0;
         def.radiusM = 0.013; // T8
         def.lengthM = 1.2;
         def.temperatureK = 4000.0;
     }},
    {"Rectangle light", "rect", true, rectM2, rectM2, cosineSr,
     [](const LightDef& def) { return 0.5 * std::hypot(def.widthM, def.heightM); },
     [](const LightDef& def) { return 0.5 * glm::dvec2(def.widthM, def.heightM); },
     [](LightDef& def) {
         def.intensity = 3000.0;
         def.temperatureK = 4000.0;
         def.widthM = 1.0;
         def.heightM = 0.5;
     }},
    {"Disk light", "disk", true, diskM2, diskM2, cosineSr,
     [](const LightDef& def) { return 0.5 * def.widthM; },
     [](const LightDef& def) { return glm::dvec2(0.5 * def.widthM, 0.0); },
     [](LightDef& def) {
         def.intensity = 1500.0;
         def.widthM = 0.3;
     }}};
static_assert(std::size(kShapes) == std::size(kLightTypeWords), "a row for each type of light");

} // namespace

const LightShape& shapeOf(LightType type) {
    return kShapes[std::size_t(type)];
}

} // namespace kilolux
