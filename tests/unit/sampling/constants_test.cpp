// Numbers of the table of settings arrive in what the shaders read.
#include "renderer/frame.h"
#include "renderer/visible_lists.h"

#include <cstring>
#include <gtest/gtest.h>
#include <set>

namespace kilolux {
namespace {

template<typename T>
bool differ(const T& a, const T& b) {
    return std::memcmp(&a, &b, sizeof(T)) != 0;
}

TEST(Constants, EveryNumberOfSamplingAndFiltersArrives) {
    // What other parts of the frame take: the plan, the light slots, the scene.
    const std::set<std::string_view> elsewhere = {
        "exposureEv100",    "raysPerLight",       "penumbraScale", "shadowMapSize",   "shadowSamples",
        "gridThreadLights", "resampleCandidates", "reuseFrames",   "reuseNeighbours", "reuseRadius",
        "editFrames",       "editFirstFrames",    "freshLights",   "renderScale",     "timeS",
        "timeStepS",        "cameraTurn",         "cameraDolly",   "lightsSway",      "freezeFrame"};
    const Settings defaults;
    for (const SettingRow& row : settingRows()) {
        if (std::holds_alternative<bool Settings::*>(row.member) ||
            std::holds_alternative<ChoiceMember>(row.member) || elsewhere.contains(row.name))
            continue;
        for (const double value : {row.min, row.max}) {
            Settings changed;
            ASSERT_FALSE(applySetting(changed, std::string(row.name) + "=" + std::to_string(value)));
            if (changed == defaults) continue;
            EXPECT_TRUE(differ(samplingConstants(changed), samplingConstants(defaults)) ||
                        differ(denoisingConstants(changed), denoisingConstants(defaults)))
                << row.name << " = " << value;
        }
    }
}

} // namespace
} // namespace kilolux
