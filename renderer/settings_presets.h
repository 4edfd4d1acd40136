// Quality presets: named values of settings, from one table that the command line, the bench and the window
// read. A preset changes how a picture is made, never the scene's lights.
#pragma once

#include "renderer/settings.h"

namespace kilolux {

struct SettingsPreset {
    std::string_view name, help;
    std::string_view look;                    // what of the picture changes beside its noise
    std::span<const std::string_view> values; // "key=value", as applySetting() reads them
};

// The fastest first. One of them is the default settings.
std::span<const SettingsPreset> settingsPresets();
const SettingsPreset* findPreset(std::string_view name); // null: there is none

// Every setting that some preset names takes this one's value, or else its default: what was changed by hand
// before leaves no trace there, and the other settings stay as they are.
void applyPreset(Settings& settings, const SettingsPreset& preset);
std::optional<Error> applyPreset(Settings& settings, std::string_view name); // tells unknown names

// The preset that these settings are, whatever those say that no preset names; null: none.
const SettingsPreset* presetOf(const Settings& settings);

} // namespace kilolux
