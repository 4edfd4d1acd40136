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

struct IesUseWord {
    const char* name;
    IesUse use;
};
inline constexpr IesUseWord kIesUseWords[] = {
    {"none", IesUse::None}, {"shape", IesUse::Shape}, {"mask", IesUse::Mask}};

struct LightFunctionWord {
    const char* name;
    LightFunctionKind kind;
};
inline constexpr LightFunctionWord kLightFunctionWords[] = {
    {"none", LightFunctionKind::None},         {"image", LightFunctionKind::Image},
    {"grid", LightFunctionKind::Grid},         {"blinds", LightFunctionKind::Blinds},
    {"caustics", LightFunctionKind::Caustics}, {"flicker", LightFunctionKind::Flicker}};

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
constexpr const char* wordOf(IesUse use) {
    for (const IesUseWord& word : kIesUseWords)
        if (word.use == use) return word.name;
    return "";
}
constexpr const char* wordOf(LightFunctionKind kind) {
    for (const LightFunctionWord& word : kLightFunctionWords)
        if (word.kind == kind) return word.name;
    return "";
}

// The value that a word names; nothing where it names none.
template<typename Word, std::size_t N, typename T>
std::optional<T> fromWord(const Word (&words)[N], T Word::*member, std::string_view name) {
    for (const Word& word : words)
        if (word.name == name) return word.*member;
    return std::nullopt;
}
inline std::optional<IesUse> parseWord(std::string_view name, const IesUse&) {
    return fromWord(kIesUseWords, &IesUseWord::use, name);
}
inline std::optional<LightFunctionKind> parseWord(std::string_view name, const LightFunctionKind&) {
    return fromWord(kLightFunctionWords, &LightFunctionWord::kind, name);
}

} // namespace kilolux
