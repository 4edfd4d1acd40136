// Quality presets: every value is one that its setting takes, and choosing one leaves no trace of what was
// there before.
#include "renderer/settings_presets.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>

namespace kilolux {
namespace {

TEST(Presets, EveryValueIsWithinItsSettingAndNotTheDefault) {
    std::set<std::string_view> names;
    for (const SettingsPreset& preset : settingsPresets()) {
        EXPECT_TRUE(names.insert(preset.name).second) << preset.name;
        EXPECT_FALSE(preset.help.empty() || preset.look.empty()) << preset.name;
        EXPECT_EQ(findPreset(preset.name), &preset);
        for (const std::string_view value : preset.values) {
            Settings settings;
            const auto error = applySetting(settings, value);
            EXPECT_FALSE(error) << preset.name << ": " << (error ? error->message : "");
            EXPECT_NE(settings, Settings{}) << preset.name << ": " << value << " is the default";
        }
    }
    EXPECT_GE(names.size(), 4u);
    EXPECT_EQ(findPreset("none of these"), nullptr);
}

TEST(Presets, OneOfThemIsTheDefault) {
    const SettingsPreset* preset = presetOf(Settings{});
    ASSERT_TRUE(preset);
    EXPECT_TRUE(preset->values.empty());
    EXPECT_EQ(preset->look, "none");
}

TEST(Presets, ChoosingOneLeavesNoTraceOfTheOthers) {
    for (const SettingsPreset& first : settingsPresets()) {
        for (const SettingsPreset& second : settingsPresets()) {
            Settings direct, byWay;
            applyPreset(direct, second);
            applyPreset(byWay, first);
            applyPreset(byWay, second);
            EXPECT_EQ(direct, byWay) << first.name << ", " << second.name;
            EXPECT_EQ(presetOf(byWay), &second);
        }
    }
}

TEST(Presets, WhatTheyDoNotNameStaysAndWhatWasChangedByHandGoes) {
    Settings settings;
    settings.exposureEv100 = {false, 7.0};
    settings.toneMap = ToneMap::None;
    settings.timeS = 3.0;
    const Settings own = settings;
    EXPECT_EQ(presetOf(settings), presetOf(Settings{})) << "these are no matter of quality";
    settings.raysPerPixel = 3.0;
    EXPECT_EQ(presetOf(settings), nullptr);
    applyPreset(settings, *findPreset("draft"));
    EXPECT_EQ(settings.toneMap, ToneMap::None);
    EXPECT_EQ(settings.exposureEv100, own.exposureEv100);
    EXPECT_NE(settings.raysPerPixel, 3.0);
    applyPreset(settings, *presetOf(Settings{}));
    EXPECT_EQ(settings, own);
}

TEST(Presets, ASettingOfThatNameChoosesOne) {
    Settings settings, wanted;
    EXPECT_FALSE(applySetting(settings, "preset=draft"));
    applyPreset(wanted, *findPreset("draft"));
    EXPECT_EQ(settings, wanted);
    const auto error = applySetting(settings, "preset=drift");
    ASSERT_TRUE(error);
    EXPECT_NE(error->message.find("'drift'"), std::string::npos);
    for (const SettingsPreset& preset : settingsPresets())
        EXPECT_NE(error->message.find(preset.name), std::string::npos) << error->message;
    EXPECT_EQ(settings, wanted) << "a refused preset must change nothing";
}

} // namespace
} // namespace kilolux
