// The plot of error against time: which points it holds, and where they stand.
#include "ui/speed_error.h"

#include <gtest/gtest.h>

namespace kilolux {
namespace {

ErrorPoint point(std::uint32_t frames, double seconds, double error, std::uint32_t reference = 512) {
    return {frames, seconds, error, 0.1, reference};
}

TEST(SpeedError, AViewHasACurveForEachPresetAndABeginningReplacesIt) {
    SpeedError plot;
    plot.setView(1);
    plot.begin("draft");
    plot.add(point(4, 1.0, 0.5), 250.0);
    plot.add(point(8, 2.0, 0.25), 250.0);
    plot.begin("high");
    plot.add(point(4, 4.0, 0.2), 1000.0);
    ASSERT_EQ(plot.curves().size(), 2u);
    EXPECT_EQ(plot.present()->preset, "high");
    EXPECT_EQ(plot.curveOf("draft")->points.size(), 2u);
    EXPECT_EQ(plot.curveOf("draft")->frameMs, 250.0);
    plot.begin("draft");
    EXPECT_TRUE(plot.curveOf("draft")->points.empty());
    plot.add(point(4, 1.0, 0.4), 250.0);
    EXPECT_EQ(plot.present()->points.size(), 1u);
    plot.setView(1);
    EXPECT_EQ(plot.curves().size(), 2u) << "the same view";
    plot.setView(2);
    EXPECT_TRUE(plot.curves().empty());
    EXPECT_EQ(plot.present(), nullptr);
}

TEST(SpeedError, PointsRiseByFramesAndANewerOneTakesItsPlace) {
    SpeedError plot;
    plot.begin("high");
    plot.add(point(4, 1.0, 0.5, 2), 250.0);
    EXPECT_FALSE(plot.present()->points[0].isCertain()) << "the reference has fewer frames";
    plot.add(point(4, 1.0, 0.4, 64), 250.0);
    plot.add(point(16, 4.0, 0.1, 64), 250.0);
    ASSERT_EQ(plot.present()->points.size(), 2u);
    EXPECT_EQ(plot.present()->points[0].flip, 0.4);
    EXPECT_TRUE(plot.present()->points[0].isCertain());
}

TEST(SpeedError, AxesSpanWholeDecades) {
    SpeedError plot;
    SpeedError::Axes axes;
    EXPECT_FALSE(plot.axes(axes));
    plot.begin("high");
    plot.add(point(4, 0.3, 0.05), 75.0);
    ASSERT_TRUE(plot.axes(axes));
    EXPECT_NEAR(axes.seconds[0], 0.1, 1e-12);
    EXPECT_NEAR(axes.seconds[1], 1.0, 1e-12);
    plot.add(point(64, 20.0, 0.0), 75.0); // no error at all has a place as well
    ASSERT_TRUE(plot.axes(axes));
    EXPECT_NEAR(axes.seconds[1], 100.0, 1e-9);
    EXPECT_NEAR(axes.error[0], 1e-6, 1e-15);
    EXPECT_NEAR(axisPosition({0.1, 10.0}, 1.0), 0.5, 1e-12);
    EXPECT_EQ(axisPosition({0.1, 10.0}, 0.0), 0.0);
    EXPECT_EQ(axisPosition({0.1, 10.0}, 1e9), 1.0);
}

} // namespace
} // namespace kilolux
