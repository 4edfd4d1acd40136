// Settings as text and JSON: what is accepted, what the refusal says, and that the hash is stable.
#include "renderer/settings.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>

namespace kilolux {
namespace {

std::string refusal(std::string_view keyValue) {
    Settings settings;
    const std::optional<Error> error = applySetting(settings, keyValue);
    EXPECT_EQ(settings, Settings{}) << "a refused setting must change nothing";
    return error ? error->message : "";
}

TEST(Settings, TableNamesAreUniqueAndExplained) {
    std::set<std::string_view> names;
    for (const SettingRow& row : settingRows()) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        EXPECT_FALSE(row.help.empty()) << row.name;
        const ChoiceMember* choice = std::get_if<ChoiceMember>(&row.member);
        EXPECT_TRUE(!choice || choice->words.size() >= 2) << row.name;
        EXPECT_LT(row.min, row.max) << row.name;
        EXPECT_EQ(findSetting(row.name), &row);
    }
}

TEST(Settings, EveryValueReadsBackFromItsText) {
    const Settings settings{.exposureEv100 = {false, 9.25},
                            .raysPerPixel = 0.1 + 0.2, // has no short decimal form
                            .jitter = false,
                            .pixelFilter = PixelFilter::Box,
                            .toneMap = ToneMap::None,
                            .tracer = TracerChoice::RayQuery,
                            .gbuffer = GBufferChoice::Compute};
    Settings read;
    for (const SettingRow& row : settingRows()) {
        const std::string text = std::string(row.name) + "=" + settingValueText(row, settings);
        EXPECT_FALSE(applySetting(read, text)) << text;
    }
    EXPECT_EQ(read, settings);
}

TEST(Settings, DefaultsReadBackFromTheirText) {
    Settings read{.exposureEv100 = {false, 3.0}, .jitter = false, .toneMap = ToneMap::None};
    for (const SettingRow& row : settingRows())
        EXPECT_FALSE(applySetting(read, std::string(row.name) + "=" + settingValueText(row, Settings{})));
    EXPECT_EQ(read, Settings{});
}

TEST(Settings, FractionsAndBooleanWords) {
    Settings settings;
    EXPECT_FALSE(applySetting(settings, "raysPerPixel=1/4"));
    EXPECT_EQ(settings.raysPerPixel, 0.25);
    for (const char* word : {"false", "off", "no", "0"}) {
        settings.jitter = true;
        EXPECT_FALSE(applySetting(settings, std::string("jitter=") + word));
        EXPECT_FALSE(settings.jitter) << word;
    }
}

TEST(Settings, AutoNumberTakesBoth) {
    Settings settings;
    EXPECT_FALSE(applySetting(settings, "exposureEv100=-3.5"));
    EXPECT_EQ(settings.exposureEv100.valueOr(7.0), -3.5);
    EXPECT_FALSE(applySetting(settings, "exposureEv100=auto"));
    EXPECT_EQ(settings.exposureEv100.valueOr(7.0), 7.0);
}

TEST(Settings, RangeEndsAreInside) {
    Settings settings;
    EXPECT_FALSE(applySetting(settings, "raysPerPixel=0.25"));
    EXPECT_FALSE(applySetting(settings, "raysPerPixel=16"));
    EXPECT_NE(refusal("raysPerPixel=16.0001"), "");
    EXPECT_NE(refusal("raysPerPixel=0.2499"), "");
}

TEST(Settings, RefusalsSayWhatWasExpected) {
    EXPECT_EQ(refusal("jiter=true"), "unknown setting 'jiter'; did you mean 'jitter'?");
    EXPECT_EQ(refusal("TONEMAP=none"), "unknown setting 'TONEMAP'; did you mean 'toneMap'?");
    EXPECT_EQ(refusal("jitter"), "setting 'jitter': expected key=value");
    EXPECT_EQ(refusal("=1"), "setting '=1': expected key=value");
    EXPECT_EQ(refusal("jitter=maybe"), "setting 'jitter': 'maybe' is not true|false");
    EXPECT_EQ(refusal("toneMap=filmic"), "setting 'toneMap': 'filmic' is not neutral|none");
    EXPECT_EQ(refusal("raysPerPixel=99"),
              "setting 'raysPerPixel': '99' is not a number from 0.25 to 16 rays per pixel and frame");
    EXPECT_EQ(refusal("exposureEv100=bright"),
              "setting 'exposureEv100': 'bright' is not auto or a number from -20 to 30 EV100");
    // A line that can still be read: the first names, and how many more there are.
    const std::string all = refusal("zzzzzzzzzzzz=1");
    constexpr std::size_t kNamed = 40;
    for (const SettingRow& row : settingRows().first(std::min(kNamed, settingRows().size())))
        EXPECT_NE(all.find(row.name), std::string::npos) << row.name;
    if (settingRows().size() > kNamed)
        EXPECT_TRUE(all.ends_with("and " + std::to_string(settingRows().size() - kNamed) + " more")) << all;
}

TEST(Settings, NumbersThatAreNoneAreRefused) {
    for (const char* text :
         {"", " 1", "1 ", "1x", "nan", "inf", "1e999", "1/0", "1/", "/2", "1/2/3", "0x1", "1,5"})
        EXPECT_NE(refusal(std::string("raysPerPixel=") + text), "") << "'" << text << "'";
}

TEST(Settings, JsonRoundTripAndAllOrNothing) {
    Settings settings;
    ASSERT_FALSE(applySetting(settings, "exposureEv100=11"));
    ASSERT_FALSE(applySetting(settings, "tracer=compute"));
    Settings read;
    EXPECT_FALSE(applySettings(read, settingsJson(settings)));
    EXPECT_EQ(read, settings);

    Settings untouched;
    EXPECT_TRUE(applySettings(untouched, {{"jitter", false}, {"toneMap", "filmic"}}));
    EXPECT_EQ(untouched, Settings{});
    EXPECT_TRUE(applySettings(untouched, nlohmann::json::array()));
    EXPECT_TRUE(applySettings(untouched, {{"jitter", nullptr}}));
}

TEST(Settings, HashFollowsValuesOnly) {
    Settings a;
    Settings b;
    EXPECT_EQ(settingsHash(a), settingsHash(b));
    std::set<std::uint64_t> hashes{settingsHash(a)};
    for (const char* set : {"exposureEv100=0", "raysPerPixel=2", "jitter=off", "pixelFilter=box",
                            "toneMap=none", "tracer=compute", "gbuffer=raster"}) {
        Settings changed;
        ASSERT_FALSE(applySetting(changed, set)) << set;
        EXPECT_TRUE(hashes.insert(settingsHash(changed)).second) << set;
    }
    // The automatic exposure has no value of its own to tell apart.
    b.exposureEv100.value = 5.0;
    EXPECT_EQ(settingsHash(a), settingsHash(b));
}

TEST(Settings, HashIsFnv1aOfTheCanonicalText) {
    const Settings settings;
    std::uint64_t expected = 14695981039346656037ull;
    for (const unsigned char c : settingsJson(settings).dump())
        expected = (expected ^ c) * 1099511628211ull;
    EXPECT_EQ(settingsHash(settings), expected);
}

} // namespace
} // namespace kilolux
