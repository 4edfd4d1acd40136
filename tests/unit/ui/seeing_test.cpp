// The logic behind the panels that show why, without a window: views and their keys, rows of the times,
// pixels under the pointer, split pictures, the words on what is slow, lines of a probe.
#include "ui/cost_notes.h"
#include "ui/picture_export.h"
#include "ui/pixel_probe.h"
#include "ui/probe_panel.h"
#include "ui/reference_image.h"
#include "ui/view_choice.h"

#include <gtest/gtest.h>
#include <set>

namespace kilolux {
namespace {

TEST(ViewChoice, EveryViewIsInOneGroupOfItsKind) {
    std::set<std::string_view> seen;
    for (const ViewGroup& group : viewGroups()) {
        EXPECT_NE(group.title, "Others") << group.views.front().name;
        for (const NamedChoice& view : group.views)
            EXPECT_TRUE(seen.insert(view.name).second) << view.name;
    }
    EXPECT_EQ(seen.size(), Renderer::views().size());
}

TEST(ViewChoice, NineKeysNameViewsThatExist) {
    std::set<std::string_view> all;
    for (const NamedChoice& view : Renderer::views())
        all.insert(view.name);
    for (const std::string_view view : kViewKeys)
        EXPECT_TRUE(all.contains(view)) << view;
    EXPECT_EQ(viewKey(""), "1");
    EXPECT_EQ(viewKey("normal"), "9");
    EXPECT_EQ(viewKey("roughness"), "");
}

TEST(ViewChoice, RowsOfTheTimesLeadToPictures) {
    const std::vector<std::string> outputs{"aOut", "bOut"};
    EXPECT_EQ(viewOfPass("shade", "final", {}), "pass:shade");
    EXPECT_EQ(viewOfPass("shade", "pass:shade/aOut", outputs), "pass:shade/bOut");
    EXPECT_EQ(viewOfPass("shade", "pass:shade/bOut", outputs), "pass:shade/aOut");
    EXPECT_EQ(viewOfPass("other", "pass:shade/bOut", outputs), "pass:other");
    EXPECT_EQ(viewOfPass("visible_list", "final", {}), "list-length") << "it writes buffers only";
    EXPECT_EQ(passOfView("pass:shade/aOut"), "shade");
    EXPECT_EQ(passOfView("normal"), "");
}

TEST(PixelUnder, FollowsThePictureInItsViewport) {
    const ViewportRect rect{100, 50, 800, 400};
    EXPECT_EQ(pixelUnder({100, 50}, rect, {800, 400}), glm::ivec2(0, 0));
    EXPECT_EQ(pixelUnder({899.5, 449.5}, rect, {800, 400}), glm::ivec2(799, 399));
    EXPECT_EQ(pixelUnder({500, 250}, rect, {400, 200}), glm::ivec2(200, 100)) << "shown enlarged";
    EXPECT_FALSE(pixelUnder({99, 50}, rect, {800, 400}));
    // A narrower picture stands in the middle.
    EXPECT_FALSE(pixelUnder({110, 250}, rect, {400, 400}));
    EXPECT_EQ(pixelUnder({300, 50}, rect, {400, 400}), glm::ivec2(0, 0));
}

ShownFrame plain(int width, int height, int level) {
    ShownFrame frame;
    frame.width = width;
    frame.height = height;
    frame.rgba8.assign(std::size_t(width) * std::size_t(height) * 4, std::byte(level));
    return frame;
}

TEST(ComparePictures, SplitTakesEachSideFromItsPicture) {
    for (const int leftWidth : {8, 4}) {
        const auto split = splitPicture(plain(leftWidth, leftWidth / 2, 10), plain(8, 4, 20), 0.25);
        ASSERT_EQ(split->rgba8.size(), 8u * 4u * 4u);
        for (std::size_t i = 0; i < split->rgba8.size(); ++i)
            EXPECT_EQ(split->rgba8[i], std::byte(i / 4 % 8 < 2 ? 10 : 20)) << i;
    }
    EXPECT_EQ(splitPicture(plain(8, 4, 10), plain(8, 4, 20), 0.0)->rgba8, plain(8, 4, 20).rgba8);
    EXPECT_EQ(splitPicture(plain(8, 4, 10), plain(8, 4, 20), 1.0)->rgba8, plain(8, 4, 10).rgba8);
}

TEST(ComparePictures, ErrorOfEqualPicturesIsNothing) {
    Picture a{16, 8, std::vector<float>(16 * 8 * 3, 0.5f), std::vector<std::uint8_t>(16 * 8 * 3, 128)};
    const ErrorReport none = measureError(a, a);
    EXPECT_EQ(none.relativeMse, 0.0);
    EXPECT_EQ(none.flipMean, 0.0);
    Picture b = a;
    for (std::size_t i = 0; i < 3 * 64; ++i)
        b.rgb[i] = 0.6f, b.srgb8[i] = 160;
    const ErrorReport some = measureError(a, b);
    // Half of the pixels are off by 0.1 of 0.5; epsilon is a hundredth of the mean's square.
    EXPECT_NEAR(some.relativeMse, 0.5 * 0.01 / (0.25 * 1.01), 1e-6);
    EXPECT_GT(some.flipMean, 0.0);
    EXPECT_EQ(errorPicture(some)->rgba8.size(), 16u * 8u * 4u);
}

TEST(CostNotes, NameWhatIsSlowOrWrong) {
    FrameStatistics s;
    s.frameMs = 10.0;
    s.passes = {{"fast", 2.0, 2.0}, {"slow", 8.0, 9.0}};
    ASSERT_EQ(costNotes(s).size(), 1u);
    EXPECT_NE(costNotes(s)[0].text.find("'slow' takes 80 %"), std::string::npos);
    EXPECT_FALSE(costNotes(s)[0].wrong);
    s.passes[1].medianMs = 3.0;
    EXPECT_TRUE(costNotes(s).empty());
    s.gridCoarseCells = 3;
    s.listOverflowMean = 2.0;
    s.raysPerPixelMean = 1.0;
    s.usefulRaysPerPixelMean = 0.1;
    s.viewProblem = "no pass 'x'";
    const std::vector<CostNote> notes = costNotes(s);
    ASSERT_EQ(notes.size(), 4u);
    EXPECT_EQ(notes[0].text, "no pass 'x'");
    EXPECT_TRUE(notes[0].wrong && notes[1].wrong && notes[2].wrong && !notes[3].wrong);
}

TEST(ProbeLines, GoToTheStrongestLightsLast) {
    Probe probe;
    for (const double nit : {5.0, 1.0}) {
        ProbedLight& light = probe.lights.emplace_back();
        light.id = std::uint64_t(nit);
        light.nit = nit;
        for (int i = 0; i < 16; ++i)
            light.rays.push_back({glm::dvec3(i, 0, 0), i < 8});
    }
    const std::vector<ProbeLine> lines = probeLines(probe, 4);
    ASSERT_EQ(lines.size(), 8u);
    EXPECT_EQ(lines.front().light, 1u);
    EXPECT_EQ(lines.back().light, 5u);
    EXPECT_TRUE(lines[0].visible);
    EXPECT_FALSE(lines[3].visible);
    EXPECT_EQ(lines[3].toWs.x, 12.0);
    probe.lights[0].rays.resize(1);
    EXPECT_EQ(probeLines(probe, 4).size(), 5u);
}

TEST(PictureExport, NamesStandBesideTheScene) {
    EXPECT_EQ(exportPathFor("/nowhere/hall.glb", ""), "/nowhere/hall-picture.png");
    EXPECT_EQ(exportPathFor("/nowhere/hall.glb", "pass:a/bOut"), "/nowhere/hall-pass-a-bOut.png");
    EXPECT_TRUE(writePictureFile("/nowhere/a.png", Picture{1, 1, {0, 0, 0}, {0, 0, 0}}));
    EXPECT_TRUE(writePictureFile("a.bmp", Picture{1, 1, {0, 0, 0}, {0, 0, 0}}));
}

} // namespace
} // namespace kilolux
