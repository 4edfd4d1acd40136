// The profiles that the project ships: all are read, cover what readers must know, and hold what their
// program states.
#include "renderer/document/ies_profile.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace kilolux {
namespace {

std::map<std::string, IesProfile> shipped() {
    std::map<std::string, IesProfile> profiles;
    for (const auto& entry : std::filesystem::directory_iterator(KILOLUX_SOURCE_DIR "/content/ies")) {
        const Result<IesProfile> profile = readIes(entry.path());
        EXPECT_TRUE(profile) << (profile ? "" : profile.error());
        if (profile) profiles[entry.path().filename().string()] = profile.value();
    }
    return profiles;
}

TEST(IesContent, RelativePhotometryLosesLight) {
    int relative = 0;
    for (const auto& [name, profile] : shipped()) {
        if (!profile.efficiency()) continue;
        ++relative;
        EXPECT_GT(*profile.efficiency(), 0.5) << name;
        EXPECT_LE(*profile.efficiency(), 1.0) << name;
    }
    EXPECT_GE(relative, 11);
}

TEST(IesContent, EveryTypeSymmetryAndRevision) {
    std::set<IesPhotometry> types;
    std::set<std::string> standards, symmetries;
    for (const auto& [name, profile] : shipped()) {
        types.insert(profile.photometry);
        standards.insert(profile.standard);
        if (profile.photometry == IesPhotometry::C)
            symmetries.insert(std::to_string(int(profile.horizontalDeg.front())) + "-" +
                              std::to_string(int(profile.horizontalDeg.back())));
    }
    EXPECT_EQ(types.size(), 3u);
    EXPECT_TRUE(standards.contains("IES:LM-63-2019"));
    EXPECT_TRUE(standards.contains("IESNA:LM-63-2002") && standards.contains("IESNA:LM-63-1995"));
    EXPECT_EQ(symmetries, (std::set<std::string>{"0-0", "0-90", "0-180", "90-270"}));
}

// The program states what each emits; factors of ballast, multiplier and tilt are in it once.
TEST(IesContent, FluxIsWhatTheProgramStates) {
    const auto profiles = shipped();
    const std::map<std::string, double> stated = {
        {"downlight_36.ies", 1200 * 0.86},  {"track_spot_15.ies", 1500 * 0.72},
        {"wall_washer.ies", 2400 * 0.78},   {"batwing_linear.ies", 4200 * 0.83},
        {"street_light.ies", 9000 * 0.88},  {"globe.ies", 806 * 0.75},
        {"floodlight_b.ies", 12000 * 0.81}, {"headlamp_a.ies", 1100 * 0.6},
        {"tilted_lamp.ies", 22000 * 0.77},  {"panel_absolute.ies", 3600.0}};
    for (const auto& [name, lumens] : stated) {
        ASSERT_TRUE(profiles.contains(name)) << name;
        EXPECT_NEAR(profiles.at(name).fluxLm() / lumens, 1.0, 1e-3) << name;
    }
}

} // namespace
} // namespace kilolux
