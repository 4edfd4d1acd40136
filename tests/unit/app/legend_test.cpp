// Legends: numbers stand where the colours are, maps rise evenly in lightness, and every view has one.
#include "renderer/legend.h"
#include "renderer/pass_output.h"
#include "renderer/views.h"

#include <cmath>
#include <gtest/gtest.h>

namespace kilolux {
namespace {

// Lightness L* of an sRGB colour.
double lightness(const std::array<float, 3>& srgb) {
    const auto linear = [](float c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
    const double y = 0.2126 * linear(srgb[0]) + 0.7152 * linear(srgb[1]) + 0.0722 * linear(srgb[2]);
    return y > 0.008856 ? 116.0 * std::cbrt(y) - 16.0 : 903.3 * y;
}

TEST(Legend, PositionsAndValuesAreInverse) {
    const ViewRange range{0.5, 50.0};
    for (const LegendScale scale :
         {LegendScale::Linear, LegendScale::Decades, LegendScale::Stops, LegendScale::Depth}) {
        const Legend legend{ColorMap::Amount, scale, range, "", "", {}};
        for (const double t : {0.1, 0.25, 0.5, 0.9})
            EXPECT_NEAR(legendPosition(legend, legendValue(legend, t)), t, 1e-9);
    }
    const Legend depth{ColorMap::Amount, LegendScale::Depth, {4.0, 4.0}, "m", "", {}};
    EXPECT_DOUBLE_EQ(legendValue(depth, 0.5), 4.0);
    EXPECT_EQ(legendPosition(depth, INFINITY), 1.0);
}

TEST(Legend, AmountsRiseEvenlyInLightness) {
    const Legend legend{ColorMap::Amount, LegendScale::Linear, {0, 1}, "", "", {}};
    double last = lightness(legendColor(legend, 0.0));
    const double whole = lightness(legendColor(legend, 1.0)) - last;
    for (int i = 1; i <= 20; ++i) {
        const double now = lightness(legendColor(legend, i / 20.0));
        EXPECT_GT(now - last, 0.4 * whole / 20.0) << i;
        EXPECT_LT(now - last, 2.0 * whole / 20.0) << i;
        last = now;
    }
}

TEST(Legend, SignedIsLightestInTheMiddleAndAsDarkOnBothSides) {
    const Legend legend{ColorMap::Signed, LegendScale::Linear, {-1, 1}, "", "", {}};
    const double middle = lightness(legendColor(legend, 0.5));
    for (const double t : {0.1, 0.25, 0.4}) {
        const double low = lightness(legendColor(legend, t)), high = lightness(legendColor(legend, 1.0 - t));
        EXPECT_LT(std::max(low, high), middle);
        EXPECT_NEAR(low, high, 10.0) << t;
    }
}

TEST(Legend, TicksAreRoundNumbersInTheirPlaces) {
    const auto texts = [](const Legend& legend, int wanted) {
        std::string all;
        for (const LegendTick& tick : legendTicks(legend, wanted))
            all += tick.text + " ";
        return all;
    };
    EXPECT_EQ(texts({ColorMap::Amount, LegendScale::Linear, {0, 64}, "lights", "", {}}, 4), "0 20 40 60 ");
    EXPECT_EQ(texts({ColorMap::Amount, LegendScale::Decades, {0.1, 1000}, "nit", "", {}}, 5),
              "0.1 1 10 100 1000 ");
    EXPECT_EQ(texts({ColorMap::Signed, LegendScale::Stops, {-6, 6}, "stops", "", {}}, 6),
              "-6 -4 -2 0 +2 +4 +6 ");
    EXPECT_EQ(texts({ColorMap::Amount, LegendScale::Depth, {3, 3}, "m", "", {}}, 4), "0 1 3 9 far ");
    const Legend legend{ColorMap::Amount, LegendScale::Decades, {0.1, 1000}, "nit", "", {}};
    EXPECT_NEAR(legendTicks(legend, 5)[2].position, 0.5, 1e-9);
    EXPECT_TRUE(legendTicks({ColorMap::Amount, LegendScale::Linear, {1, 1}, "", "", {}}, 5).empty());
}

TEST(Legend, ValuesHaveFourDigits) {
    EXPECT_EQ(valueText(0.0), "0");
    EXPECT_EQ(valueText(12.3456), "12.35");
    EXPECT_EQ(valueText(1234.56), "1235");
    EXPECT_EQ(valueText(123456.0), "123456");
    EXPECT_EQ(valueText(0.5), "0.5");
    EXPECT_EQ(valueText(-0.012345), "-0.01235");
    EXPECT_EQ(valueText(1.5e-7), "1.5e-07");
    EXPECT_EQ(valueText(NAN), "-");
}

TEST(Legend, EveryViewSaysWhatItsColoursMean) {
    for (std::size_t view = 1; view < viewChoices().size(); ++view) {
        const Legend legend = viewLegend(int(view), 0.01, 5.0, std::nullopt);
        if (legend.map == ColorMap::Amount || legend.map == ColorMap::Signed) {
            EXPECT_GE(legendTicks(legend, 5).size(), 3u) << viewChoices()[view].name;
        }
    }
}

TEST(Legend, FalseColourFollowsTheExposureAndWhatIsAskedFor) {
    const int lux = *indexOfChoice(viewChoices(), "illuminance");
    const Legend bright = viewLegend(lux, 1e-4, 5.0, std::nullopt),
                 dark = viewLegend(lux, 1.0, 5.0, std::nullopt);
    EXPECT_NEAR(bright.range.low / dark.range.low, 1e4, 1.0);
    EXPECT_NEAR(bright.range.high / bright.range.low, 1e4, 1.0);
    EXPECT_EQ(viewLegend(lux, 1.0, 5.0, ViewRange{1, 10}).range, (ViewRange{1, 10}));
    EXPECT_EQ(viewLegend(lux, 1.0, 5.0, ViewRange{-1, 10}).range, dark.range) << "no decades below 0";
    EXPECT_EQ(viewLegend(lux, 1.0, 5.0, ViewRange{10, 1}).range, dark.range);
}

TEST(PassOutputName, IsReadFromTheView) {
    EXPECT_FALSE(passOutputName("normal"));
    EXPECT_EQ(passOutputName("pass:tone_map")->pass, "tone_map");
    EXPECT_EQ(passOutputName("pass:tone_map")->output, "");
    EXPECT_EQ(passOutputName("pass:a/bOut")->pass, "a");
    EXPECT_EQ(passOutputName("pass:a/bOut")->output, "bOut");
}

} // namespace
} // namespace kilolux
