// What the shaders of stochastic sampling get from the settings.
#include "renderer/visible_lists.h"
#include "shaders/shared/sampling.h"

#include <gtest/gtest.h>

namespace kilolux {
namespace {

shared::SamplingConstants constantsOf(double raysPerPixel, Sampling sampling = Sampling::Full) {
    Settings settings;
    settings.raysPerPixel = raysPerPixel;
    settings.sampling = sampling;
    return samplingConstants(settings);
}

TEST(SamplingConstants, RaysPerPixelFromAQuarterToSixteen) {
    struct Row {
        double raysPerPixel;
        std::uint32_t rays, pixelsPerRay;
    };
    for (const Row& row : {Row{0.25, 1, 4}, Row{0.4, 1, 2}, Row{0.5, 1, 2}, Row{0.75, 1, 1}, Row{1.0, 1, 1},
                           Row{2.0, 2, 1}, Row{3.0, 3, 1}, Row{16.0, 16, 1}}) {
        for (const Sampling sampling : {Sampling::Full, Sampling::HalfCheckerboard, Sampling::HalfRooks}) {
            const shared::SamplingConstants c = constantsOf(row.raysPerPixel, sampling);
            EXPECT_EQ(c.rays, row.rays) << row.raysPerPixel;
            EXPECT_EQ(c.pixelsPerRay, row.pixelsPerRay) << row.raysPerPixel;
            EXPECT_EQ(c.choices, sampling == Sampling::Full ? row.rays : 4 * row.rays) << row.raysPerPixel;
            EXPECT_LE(c.choices, 64u) << "the shader's largest room for reservoirs";
        }
    }
}

// Luminances of the display become log2(1 + x); small ones keep their digits.
TEST(SamplingConstants, ThresholdsBecomeWeights) {
    Settings settings;
    settings.dimThreshold = 1.0;
    settings.hiddenRelaxedBelow = 3.0;
    settings.directionalFreeBelow = 1e-6;
    shared::SamplingConstants c = samplingConstants(settings);
    EXPECT_FLOAT_EQ(c.dimThreshold, 1.0f);
    EXPECT_FLOAT_EQ(c.hiddenRelaxedBelow, 2.0f);
    EXPECT_FLOAT_EQ(c.directionalFreeBelow, 1.4426943e-6f);
    settings.dimThreshold = 0.0;
    EXPECT_EQ(samplingConstants(settings).dimThreshold, 0.0f);
}

TEST(SamplingConstants, TheRestIsPassedOn) {
    Settings settings;
    settings.guiding = false;
    settings.areaMasks = false;
    settings.maskHiddenShare = 0.05;
    settings.maskSize = 2.0;
    settings.maskSamples = 9.0;
    settings.hiddenShare = 0.3;
    settings.missHiddenShare = 0.6;
    settings.hiddenSeenShare = 0.7;
    settings.directionalShare = 0.7;
    settings.cellCandidates = 11;
    settings.missCandidates = 12;
    settings.dimLights = DimLights::Drop;
    settings.listLength = 13;
    settings.listMemory = 14;
    const shared::SamplingConstants c = samplingConstants(settings);
    EXPECT_EQ(c.guiding, 0u);
    EXPECT_EQ(c.areaMasks, 0u);
    EXPECT_FLOAT_EQ(c.maskHiddenShare, 0.05f);
    EXPECT_FLOAT_EQ(c.maskSizeTiles, 2.0f);
    EXPECT_FLOAT_EQ(c.maskSamples, 9.0f);
    EXPECT_FLOAT_EQ(c.hiddenShare, 0.3f);
    EXPECT_FLOAT_EQ(c.missHiddenShare, 0.6f);
    EXPECT_FLOAT_EQ(c.hiddenSeenShare, 0.7f);
    EXPECT_FLOAT_EQ(c.directionalShare, 0.7f);
    EXPECT_EQ(c.cellCandidates, 11u);
    EXPECT_EQ(c.missCandidates, 12u);
    EXPECT_EQ(c.dimMode, 1u) << "DIM_DROP of math/selection_types.glsl";
    EXPECT_EQ(c.listLength, 13u);
    EXPECT_EQ(c.listMemory, 14u);
}

} // namespace
} // namespace kilolux
