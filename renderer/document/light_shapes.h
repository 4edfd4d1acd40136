// What is particular to each type of light outside of the shaders: a row per type of its names, measures and
// the sizes that a new one begins with.
#pragma once

#include "renderer/document/scene.h"

namespace kilolux {

struct LightShape {
    const char* title;      // "Disk light"
    const char* nativeWord; // its type to readers of glTF that know nothing of extras.kilolux
    bool isFlat;            // shines to one side of a plane, by the cosine; EXT_lights_area holds it
    // Area that is seen from the axis, m2: intensity per luminance. Directional: projected solid angle, sr.
    double (*projectedM2)(const LightDef&);
    double (*emitterM2)(const LightDef&);      // what emits; directional: 0
    double (*fluxPerCandela)(const LightDef&); // lumens per candela on the axis, sr; directional: 0
    double (*extentM)(const LightDef&);        // half of the largest extent; directional: 0
    glm::dvec2 (*halfSizes)(const LightDef&);  // LightHot::sizeM
    void (*begin)(LightDef&);                  // a new one: what is not as in a bulb of 800 lm and 3000 K
};

const LightShape& shapeOf(LightType type);

} // namespace kilolux
