// The reader of photometric profiles: every revision and type, symmetries against directions computed by
// hand, flux against quadrature over directions, factors counted once, and one message with line and
// expectation for what is wrong.
#include "renderer/document/ies_profile.h"

#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>

namespace kilolux::test {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Midpoint rule over the sphere, which knows directions only.
double quadratureLm(const IesProfile& profile) {
    constexpr int kSteps = 720;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        const double theta = (i + 0.5) * kPi / kSteps;
        for (int j = 0; j < 2 * kSteps; ++j) {
            const double phi = (j + 0.5) * kPi / kSteps;
            sum += profile.candelaAt(
                       {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), -std::cos(theta)}) *
                   std::sin(theta);
        }
    }
    return sum * (kPi / kSteps) * (kPi / kSteps);
}

IesProfile parsed(const std::string& text) {
    Result<IesProfile> result = parseIes(text, "test.ies");
    EXPECT_TRUE(result) << (result ? "" : result.error());
    return result ? result.value() : IesProfile{"", "", IesPhotometry::C, {0, 180}, {0}, {0, 0}, {}, 0, {}};
}

std::string errorOf(const std::string& text) {
    const Result<IesProfile> result = parseIes(text, "test.ies");
    return result ? "no error" : result.error();
}

// A file of 2 vertical angles and any horizontal ones; intensity 100 + 10 * plane ahead, half of it at the
// end.
std::string planes(const std::string& standard, int type, const std::vector<double>& vertical,
                   const std::vector<double>& horizontal) {
    std::string text = standard + "\nTILT=NONE\n1 -1 1 " +
                       fmt::format("{} {} {} 2 0 0 0\n1 1 0\n", vertical.size(), horizontal.size(), type);
    text += fmt::format("{}\n{}\n", fmt::join(vertical, " "), fmt::join(horizontal, " "));
    for (std::size_t h = 0; h < horizontal.size(); ++h)
        for (std::size_t v = 0; v < vertical.size(); ++v)
            text += fmt::format("{} ", 100 + 10 * int(h) + int(v));
    return text + "\n";
}

glm::dvec3 directionC(double verticalDeg, double horizontalDeg) {
    const double v = glm::radians(verticalDeg), h = glm::radians(horizontalDeg);
    return {std::sin(v) * std::cos(h), std::sin(v) * std::sin(h), -std::cos(v)};
}

// Of B and A, where horizontal angles run clockwise about +X.
glm::dvec3 directionB(double verticalDeg, double horizontalDeg) {
    const double v = glm::radians(verticalDeg), h = glm::radians(horizontalDeg);
    return {std::sin(v), -std::cos(v) * std::sin(h), -std::cos(v) * std::cos(h)};
}

TEST(Ies, TypeCMirrorsWhatSymmetryLeavesOut) {
    const IesProfile axial = parsed(planes("IESNA91", 1, {0, 90}, {0}));
    const IesProfile quadrant = parsed(planes("IESNA91", 1, {0, 90}, {0, 45, 90}));
    const IesProfile bilateral = parsed(planes("IESNA:LM-63-1995", 1, {0, 90}, {0, 90, 180}));
    const IesProfile across = parsed(planes("IESNA:LM-63-1995", 1, {0, 90}, {90, 180, 270}));
    const IesProfile full = parsed(planes("IESNA:LM-63-2002", 1, {0, 90}, {0, 90, 180, 270, 360}));
    const IesProfile open = parsed(planes("IESNA:LM-63-2002", 1, {0, 90}, {0, 90, 180, 270}));
    for (const double h : {0.0, 30.0, 135.0, 200.0, 300.0})
        EXPECT_NEAR(axial.candelaAt(directionC(90, h)), 101.0, 1e-9);
    for (const double h : {45.0, 135.0, 225.0, 315.0})
        EXPECT_NEAR(quadrant.candelaAt(directionC(90, h)), 111.0, 1e-9) << h;
    EXPECT_NEAR(quadrant.candelaAt(directionC(90, 270)), 121.0, 1e-9);
    EXPECT_NEAR(bilateral.candelaAt(directionC(90, 135)), 116.0, 1e-9);
    EXPECT_NEAR(bilateral.candelaAt(directionC(90, 225)), 116.0, 1e-9);
    EXPECT_NEAR(bilateral.candelaAt(directionC(90, 315)), 106.0, 1e-9);
    EXPECT_NEAR(across.candelaAt(directionC(90, 0)), 111.0, 1e-9);   // as 180
    EXPECT_NEAR(across.candelaAt(directionC(90, 45)), 106.0, 1e-9);  // as 135
    EXPECT_NEAR(across.candelaAt(directionC(90, 315)), 116.0, 1e-9); // as 225
    EXPECT_NEAR(full.candelaAt(directionC(90, 225)), 126.0, 1e-9);
    EXPECT_NEAR(open.candelaAt(directionC(90, 315)), 116.0, 1e-9); // between 270 and 0
    EXPECT_EQ(full.candelaAt(directionC(91, 0)), 0.0);
}

TEST(Ies, TypesBAndATurnAboutX) {
    for (const int type : {2, 3}) {
        const IesProfile full = parsed(planes("IESNA:LM-63-2002", type, {-90, 0, 90}, {-90, 0, 90}));
        EXPECT_NEAR(full.candelaAt({0, 0, -1}), 111.0, 1e-9) << type; // straight ahead
        EXPECT_NEAR(full.candelaAt(directionB(0, 90)), 121.0, 1e-9);
        EXPECT_NEAR(full.candelaAt({0, -1, 0}), 121.0, 1e-9); // clockwise
        EXPECT_NEAR(full.candelaAt(directionB(45, -45)), 0.25 * (101 + 102 + 111 + 112), 1e-9);
        EXPECT_EQ(full.candelaAt({0, 0, 1}), 0.0); // behind
        const IesProfile half = parsed(planes("IESNA:LM-63-2002", type, {0, 90}, {0, 90}));
        for (const double v : {-30.0, 30.0})
            for (const double h : {-60.0, 60.0})
                EXPECT_NEAR(half.candelaAt(directionB(v, h)), 100.0 + 10.0 * 60 / 90 + 30.0 / 90, 1e-9);
    }
}

TEST(Ies, FluxIsThatOfQuadrature) {
    for (const std::vector<double>& h : std::vector<std::vector<double>>{
             {0}, {0, 20, 90}, {0, 50, 180}, {90, 100, 270}, {0, 360}, {0, 100, 200, 300}}) {
        const IesProfile p = parsed(planes("IESNA91", 1, {0, 10, 50, 120, 180}, h));
        EXPECT_NEAR(p.fluxLm() / quadratureLm(p), 1.0, 1e-3) << h.back();
    }
    for (const std::vector<double>& angles : std::vector<std::vector<double>>{{-90, 5, 90}, {0, 30, 90}}) {
        const IesProfile p = parsed(planes("IESNA91", 2, angles, angles));
        EXPECT_NEAR(p.fluxLm() / quadratureLm(p), 1.0, 1e-3) << angles.front();
    }
    // A uniform sphere of 1 cd and a Lambert disk of 1 cd, by hand.
    EXPECT_NEAR(parsed("IESNA91\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 0\n0 180\n0\n1 1\n").fluxLm(), 4 * kPi,
                1e-9);
}

TEST(Ies, FactorsAreAppliedOnce) {
    const std::string tail = " 2 1 1 2 0 0 0\n0.5 0.8 70\n0 90\n0\n100 100\n";
    const IesProfile p = parsed("IESNA:LM-63-2002\n[LUMINAIRE] Spot\nTILT=NONE\n2 1000 3" + tail);
    EXPECT_NEAR(p.maxCandela(), 100 * 3 * 0.5 * 0.8, 1e-9);
    EXPECT_NEAR(*p.efficiency(), 2 * kPi * 120 / 2000, 1e-9);
    EXPECT_EQ(p.name, "Spot");
    EXPECT_EQ(p.inputWatts, 70.0);
    // From 2019 on the second number of that line is no factor, and negative lumens mean absolute photometry.
    const IesProfile absolute = parsed("IES:LM-63-2019\nTILT=NONE\n1 -1 3" + tail);
    EXPECT_NEAR(absolute.maxCandela(), 150.0, 1e-9);
    EXPECT_FALSE(absolute.efficiency());
    // Tilt factors count at tilt 0, wherever that stands in the list.
    const IesProfile tilted = parsed("IESNA:LM-63-1995\nTILT=INCLUDE\n1\n3\n0 45 90\n0.9 0.8 0.7\n1 -1 1 2 1 "
                                     "1 2 0 0 0\n1 1 0\n0 90\n0\n100 50\n");
    EXPECT_NEAR(tilted.maxCandela(), 90.0, 1e-9);
}

TEST(Ies, RealFilesDifferInLabelsAndSeparators) {
    const IesProfile p =
        parsed("\xef\xbb\xbfMaker \xe4\r\n  second line\r\n  TILT=NONE\r\n 1\r\n 5200,+2.2, 2\r\n1 1 1\r\n"
               "-.5 -0.5 0\r\n1 1 100\r\n0\t90\r\n0\r\n681.8 .4888E+2\r\nEND\r\nstray 12 tokens\r\n");
    EXPECT_EQ(p.standard, "LM-63-1986");
    EXPECT_NEAR(p.maxCandela(), 681.8 * 2.2, 1e-9);
    EXPECT_NEAR(p.widthLengthHeightM.x, -0.5 * 0.3048, 1e-12); // feet; negative: a diameter
    EXPECT_EQ(*p.lampLumens, 5200.0);
}

TEST(Ies, MessagesNameLineAndExpectation) {
    EXPECT_EQ(errorOf("IESNA91\nno tilt\n"),
              "test.ies:2: expected a line that begins with TILT=, the file ends");
    EXPECT_EQ(errorOf("IESNA91\nTILT=lamp.tlt\n"),
              "test.ies:2: TILT=lamp.tlt: expected NONE or INCLUDE; factors in another file are not read");
    const std::string head = "IESNA91\nTILT=NONE\n";
    EXPECT_EQ(errorOf(head + "file\n"), "test.ies:3: expected the number of lamps, found 'file'");
    EXPECT_EQ(errorOf(head + "1 -1 nan"), "test.ies:3: expected the candela multiplier, found 'nan'");
    EXPECT_EQ(errorOf(head + "1 -1 1 2.5 1"),
              "test.ies:3: the number of vertical angles is 2.5, expected a whole number");
    EXPECT_EQ(errorOf(head + "1 -1 1 2 1 4"), "test.ies:3: the photometric type is 4, expected 1 to 3");
    const std::string numbers = head + "1 -1 1 2 1 1 2 0 0 0\n1 1 0\n";
    EXPECT_EQ(errorOf(numbers + "90 0"),
              "test.ies:5: vertical angle 2 is 0, expected more than the 90 before it");
    EXPECT_EQ(errorOf(numbers + "0 90\n0\n1"), "test.ies:7: expected intensity 2 of 2, the file ends");
    EXPECT_EQ(errorOf(numbers + "0 90\n0\n1 -2"), "test.ies:7: intensity 2 of 2 is -2, expected 0 to 1e+12");
    EXPECT_EQ(errorOf(planes("IESNA91", 1, {0, 90}, {0, 45})),
              "test.ies:7: horizontal angles go from 0 to 45, expected 0 to 90, 180 or 360, or 90 to 270");
    EXPECT_EQ(errorOf("IESNA91\nTILT=NONE\n1 100 1 2 1 1 2 0 0 0\n1 1 0\n0 90\n0\n100 100\n"),
              "test.ies: 628 lm come out of lamps of 100 lm; expected at most as many");
    EXPECT_FALSE(readIes("/nowhere/at.ies"));
}

TEST(Ies, EveryFileOfTheCorpus) {
    const std::filesystem::path folder = std::filesystem::path(KILOLUX_SOURCE_DIR) / "../shared/content/ies";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no corpus beside the project";
    int read = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const Result<IesProfile> result = readIes(entry.path());
        const bool malformed = entry.path().filename().string().find("error") != std::string::npos;
        EXPECT_EQ(bool(result), !malformed) << (result ? entry.path().string() : result.error());
        if (!result) continue;
        ++read;
        EXPECT_NEAR(result.value().fluxLm() / quadratureLm(result.value()), 1.0, 1e-3) << entry.path();
        EXPECT_LE(result.value().efficiency().value_or(0.0), 1.0) << entry.path();
    }
    EXPECT_GE(read, 17);
}

} // namespace
} // namespace kilolux::test
