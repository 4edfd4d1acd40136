// What the browser tells of profiles, presets made of them, and bringing one beside a scene.
#include "ui/luminaires.h"
#include "ui/profile_facts.h"

#include "renderer/document/light_units.h"
#include "tests/unit/edits/edits_kit.h"

#include <set>

namespace kilolux {
namespace {

const std::filesystem::path kShipped = KILOLUX_SOURCE_DIR "/content/ies";

TEST(ProfileFacts, BeamAndFieldOfTheShippedLobes) {
    const Result<IesProfile> round = readIes(kShipped / "downlight_36.ies");
    ASSERT_TRUE(round) << round.error();
    const ProfileFacts facts = factsOf(round.value());
    EXPECT_EQ(facts.symmetry, "round");
    EXPECT_NEAR(facts.lumens, 1200 * 0.86, 1.0);
    for (int plane = 0; plane < 2; ++plane) {
        EXPECT_NEAR(facts.beamDeg[plane], 36.0, 0.5);
        // 0.5^((x / 18)^2) is a tenth at 18 * sqrt(log2(10)).
        EXPECT_NEAR(facts.fieldDeg[plane], 36.0 * std::sqrt(std::log2(10.0)), 0.5);
    }
    EXPECT_NEAR(relativeAt(round.value(), 30.0, 18.0), 0.5, 0.01);
}

TEST(ProfileFacts, TheWebReachesOneAtTheMaximumAndNowhereFurther) {
    std::set<std::string> symmetries;
    const std::vector<ProfileEntry> entries = profilesIn(kShipped);
    EXPECT_GE(entries.size(), 12u);
    for (const ProfileEntry& entry : entries) {
        ASSERT_TRUE(entry.profile) << entry.error;
        symmetries.insert(entry.facts.symmetry);
        double furthest = 0.0;
        for (const auto& line : webOf(*entry.profile))
            for (const glm::dvec3& point : line)
                furthest = std::max(furthest, glm::length(point));
        EXPECT_LE(furthest, 1.0 + 1e-9) << entry.name;
        EXPECT_GT(furthest, 0.7) << entry.name;
    }
    EXPECT_EQ(symmetries, (std::set<std::string>{"round", "quadrants", "two halves", "none"}));
}

TEST(ProfileFacts, AProfileFromElsewhereIsCopiedOnce) {
    const test::TempFolder folder;
    const std::filesystem::path from = kShipped / "globe.ies";
    for (int i = 0; i < 2; ++i) {
        const Result<std::string> uri = bringProfile(from, folder.path());
        ASSERT_TRUE(uri) << uri.error();
        EXPECT_EQ(uri.value(), "profiles/globe.ies");
    }
    EXPECT_EQ(test::readBytes(folder.path() / "profiles/globe.ies"), test::readBytes(from));
    folder.write("other/globe.ies", "something else");
    const Result<std::string> other = bringProfile(folder.path() / "other/globe.ies", folder.path());
    EXPECT_EQ(other.value(), "other/globe.ies") << "what lies below the scene stays where it is";
    const test::TempFolder away;
    const Result<std::string> second = bringProfile(away.write("globe.ies", "third"), folder.path());
    EXPECT_EQ(second.value(), "profiles/globe_2.ies");
    EXPECT_FALSE(bringProfile(away.path() / "none.ies", folder.path()));
}

TEST(ProfileFacts, PresetsEmitTheirLumens) {
    const test::TempFolder folder;
    const auto session = test::openSession(test::everyLight().write(folder));
    ASSERT_TRUE(session);
    for (const Luminaire& luminaire : luminaires()) {
        const std::vector<std::uint64_t> lights = {test::lightNamed(session->scene(), "Point"),
                                                   test::lightNamed(session->scene(), "Rect")};
        std::string uri;
        if (*luminaire.profile) {
            const Result<std::string> brought = bringProfile(kShipped / luminaire.profile, folder.path());
            ASSERT_TRUE(brought) << brought.error();
            uri = brought.value();
        }
        const Result<Edits> edits =
            editsForLuminaire(session->scene(), lights, luminaire, uri, Sharing::MakeUnique);
        ASSERT_TRUE(edits) << luminaire.name << ": " << edits.error();
        ASSERT_FALSE(session->apply("preset", edits.value())) << luminaire.name;
        for (const char* name : {"Point", "Rect"}) {
            const LightDef& def = test::defOf(session->scene(), name);
            EXPECT_EQ(def.type, luminaire.type);
            EXPECT_EQ(def.temperatureK, luminaire.temperatureK);
            EXPECT_NEAR(fluxLumen(def), luminaire.lumens, 1e-6 * luminaire.lumens) << luminaire.name;
            EXPECT_EQ(def.ies != nullptr, *luminaire.profile != 0) << luminaire.name;
            // What leaves the luminaire is what its profile states.
            if (def.ies) {
                EXPECT_NEAR(def.ies->fluxLm() / luminaire.lumens, 1.0, 2e-3) << luminaire.name;
            }
        }
    }
}

} // namespace
} // namespace kilolux
