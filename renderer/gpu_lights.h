// Document lights to the records of shaders/shared/gpu_light.h, with derived ranges.
#pragma once

#include "renderer/document/scene.h"
#include "renderer/lights_cpp/light_tables.h"
#include "shaders/shared/gpu_light.h"

#include <vector>

namespace kilolux {

// What a light without a range of its own gets. Light beyond it is lost; `lostLux` bounds it per point.
struct DerivedRange {
    double rangeM = 0.0;
    double lostLux = 0.0;
};

// Where the light's illuminance falls under 1/1000 of what `exposureEv100` shows as middle grey: E = pi * L
// with L = 0.18 / exposure over a reflectance of 0.18.
DerivedRange deriveRange(const LightDef& def, double exposureEv100);

// Display value of one nit: 1 / (1.2 * 2^EV100), saturation-based (ISO 12232, as in Lagarde and de Rousiers,
// "Moving Frostbite to Physically Based Rendering", 2014, section 5.1.1).
double exposureFromEv100(double ev100);

// An exposure that shows the surfaces lit by the scene's lights in the middle of the scale: from the
// unshadowed illuminance at points spread over the geometry. EV100 of 0 for scenes without light.
double deriveExposureEv100(const Scene& scene);

// What names the dome among lights; no LightNode::id is as high.
inline constexpr std::uint64_t kDomeLightId = std::uint64_t(1) << 62;

struct GpuLights {
    std::vector<shared::LightHot> hot; // Scene::lights in order, then the dome where it shines
    std::vector<shared::LightCold> cold;
    std::vector<char> rangeDerived; // of each: its range follows from the exposure
    LightTables tables;             // whose shapings some of the hot records point to
    int derivedRanges = 0;
};
// `timeS` moves light functions.
GpuLights makeGpuLights(const Scene& scene, const glm::dvec3& anchor, double exposureEv100,
                        double timeS = 0.0);

} // namespace kilolux
