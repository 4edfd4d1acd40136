// The words that files and edits use for types and units of lights.
#pragma once

#include "renderer/document/scene.h"

#include <string_view>

namespace kilolux {

struct LightTypeWord {
    const char* name;
    LightType type;
};
inline constexpr LightTypeWord kLightTypeWords[] = {{"directional", LightType::Directional},
                                                    {"sphere", LightType::Sphere},
                                                    {"spot", LightType::Spot},
                                                    {"tube", LightType::Tube},
                                                    {"rect", LightType::Rect},
                                                    {"disk", LightType::Disk}};

struct LightUnitWord {
    const char* name;
    LightUnit unit;
};
inline constexpr LightUnitWord kLightUnitWords[] = {{"lm", LightUnit::Lumen},
                                                    {"cd", LightUnit::Candela},
                                                    {"lux", LightUnit::Lux},
                                                    {"nit", LightUnit::Nit},
                                                    {"ev100", LightUnit::Ev100}};

constexpr const char* wordOf(LightType type) {
    for (const LightTypeWord& word : kLightTypeWords)
        if (word.type == type) return word.name;
    return "";
}
constexpr const char* wordOf(LightUnit unit) {
    for (const LightUnitWord& word : kLightUnitWords)
        if (word.unit == unit) return word.name;
    return "";
}

} // namespace kilolux
