// The table of presets, see settings_presets.h.
#include "renderer/settings_presets.h"

#include "renderer/nearest_name.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <fmt/format.h>

namespace kilolux {

namespace {

using Values = std::string_view;

constexpr Values kDraft[] = {"renderScale=0.5",   "raysPerPixel=0.5", "sampling=rooks",
                             "penumbraScale=0.5", "cellCandidates=4", "missCandidates=12"};
constexpr Values kBalanced[] = {"renderScale=0.75", "sampling=rooks", "cellCandidates=6"};
constexpr Values kReference[] = {"raysPerPixel=4", "cellCandidates=16", "missCandidates=64",
                                 "listLength=24",  "diffuseFrames=48",  "specularFrames=32",
                                 "spatialRadius=5"};

constexpr std::array kPresets = {
    SettingsPreset{"draft", "half the resolution and half a ray per pixel: for placing lights",
                   "shadows have half their softness and lose contact detail; fine texture is blurred",
                   kDraft},
    SettingsPreset{"balanced", "three quarters of the resolution, one pixel of four chooses the lights",
                   "edges of shadows and texture are a little softer", kBalanced},
    SettingsPreset{"high", "one ray per pixel, every pixel chooses its lights (default)", "none", {}},
    SettingsPreset{"reference", "four rays per pixel, longer lists and histories: for stills",
                   "none; light that has changed takes longer to settle", kReference},
};

std::string_view keyOf(Values value) {
    return value.substr(0, value.find('='));
}

// Of all settings that any preset names.
template<typename Visit>
void forEachKey(Visit&& visit) {
    for (const SettingRow& row : settingRows()) {
        const bool named = std::any_of(kPresets.begin(), kPresets.end(), [&](const SettingsPreset& preset) {
            return std::any_of(preset.values.begin(), preset.values.end(),
                               [&](Values value) { return keyOf(value) == row.name; });
        });
        if (named) visit(row);
    }
}

} // namespace

std::span<const SettingsPreset> settingsPresets() {
    return kPresets;
}

const SettingsPreset* findPreset(std::string_view name) {
    const auto* found =
        std::find_if(kPresets.begin(), kPresets.end(), [&](const auto& each) { return each.name == name; });
    return found == kPresets.end() ? nullptr : found;
}

void applyPreset(Settings& settings, const SettingsPreset& preset) {
    const auto apply = [&](const std::string& keyValue) {
        [[maybe_unused]] const std::optional<Error> error = applySetting(settings, keyValue);
        assert(!error && "the table holds what the settings accept");
    };
    forEachKey([&](const SettingRow& row) {
        apply(fmt::format("{}={}", row.name, settingValueText(row, Settings{})));
    });
    for (const Values value : preset.values)
        apply(std::string(value));
}

std::optional<Error> applyPreset(Settings& settings, std::string_view name) {
    if (const SettingsPreset* preset = findPreset(name)) {
        applyPreset(settings, *preset);
        return std::nullopt;
    }
    std::vector<std::string_view> names;
    for (const SettingsPreset& preset : kPresets)
        names.push_back(preset.name);
    return Error{fmt::format("unknown preset '{}'; {}", name, namesHint(names))};
}

const SettingsPreset* presetOf(const Settings& settings) {
    for (const SettingsPreset& preset : kPresets) {
        Settings same = settings;
        applyPreset(same, preset);
        if (same == settings) return &preset;
    }
    return nullptr;
}

} // namespace kilolux
