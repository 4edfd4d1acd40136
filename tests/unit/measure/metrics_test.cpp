// Squared errors, PSNR, block energy and percentiles on pictures whose numbers are known by hand.
#include "renderer/measure/metrics.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace kilolux::measure {
namespace {

struct Picture {
    int width, height;
    std::vector<float> rgb;
    Picture(int w, int h, float value)
        : width(w), height(h), rgb(static_cast<std::size_t>(3) * w * h, value) {}
    ImageView view() const { return {width, height, rgb}; }
    void set(int x, int y, float r, float g, float b) {
        float* p = rgb.data() + 3 * (y * width + x);
        p[0] = r;
        p[1] = g;
        p[2] = b;
    }
};

TEST(Metrics, SquaredErrorByHand) {
    const Picture reference(4, 2, 0.5f);
    Picture test(4, 2, 0.5f);
    EXPECT_EQ(meanSquaredError(reference.view(), test.view()), 0.0);
    EXPECT_EQ(peakSignalToNoiseDb(reference.view(), test.view()), std::numeric_limits<double>::infinity());
    test.set(1, 1, 0.75f, 0.5f, 0.25f);
    EXPECT_NEAR(meanSquaredError(reference.view(), test.view()), 2.0 * 0.0625 / 24.0, 1e-12);
    EXPECT_NEAR(relativeMeanSquaredError(reference.view(), test.view(), 0.0), 2.0 * 0.25 / 24.0, 1e-12);
    EXPECT_NEAR(relativeMeanSquaredError(reference.view(), test.view(), 0.25), 2.0 * 0.125 / 24.0, 1e-12);
    EXPECT_NEAR(peakSignalToNoiseDb(Picture(2, 2, 0.0f).view(), Picture(2, 2, 0.1f).view()), 20.0, 1e-5);
    EXPECT_NEAR(peakSignalToNoiseDb(Picture(2, 2, 0.0f).view(), Picture(2, 2, 0.1f).view(), 10.0), 40.0,
                1e-5);
}

TEST(Metrics, BlockEnergyFindsTheBlock) {
    Picture reference(10, 6, 1.0f); // blocks of 4: 3 x 2, the last column 2 wide, the last row 2 high
    Picture test(10, 6, 1.0f);
    BlockEnergy same = blockEnergy(reference.view(), test.view(), 4, 0.01);
    EXPECT_EQ(same.litBlocks, 6);
    EXPECT_EQ(same.withinShare, 1.0);
    EXPECT_EQ(same.meanRatio, 1.0);
    EXPECT_EQ(same.worstRatio, 1.0);
    for (int y = 4; y < 6; ++y)
        for (int x = 8; x < 10; ++x)
            test.set(x, y, 0.5f, 0.5f, 0.5f);
    const BlockEnergy result = blockEnergy(reference.view(), test.view(), 4, 0.01);
    EXPECT_NEAR(result.meanRatio, 58.0 / 60.0, 1e-6);
    EXPECT_NEAR(result.withinShare, 5.0 / 6.0, 1e-12);
    EXPECT_NEAR(result.worstRatio, 0.5, 1e-6);
    EXPECT_EQ(result.worstX, 2);
    EXPECT_EQ(result.worstY, 1);
    test.set(0, 0, std::numeric_limits<float>::quiet_NaN(), 0.0f, 0.0f);
    const BlockEnergy broken = blockEnergy(reference.view(), test.view(), 4, 0.01);
    EXPECT_EQ(broken.worstX, 0) << "a NaN is the worst block";
    EXPECT_NEAR(broken.withinShare, 4.0 / 6.0, 1e-12);
}

TEST(Metrics, NoiseOfOneBlockCancelsAndDarkBlocksAreLeftOut) {
    Picture reference(8, 4, 1.0f);
    Picture test(8, 4, 1.0f);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 8; ++x) {
            const float noisy = (x + y) % 2 == 0 ? 1.5f : 0.5f;
            test.set(x, y, noisy, noisy, noisy);
            if (x >= 4) { // a block of one thousandth
                reference.set(x, y, 0.001f, 0.001f, 0.001f);
                test.set(x, y, 0.004f, 0.004f, 0.004f);
            }
        }
    const BlockEnergy result = blockEnergy(reference.view(), test.view(), 4, 1e-5);
    EXPECT_EQ(result.litBlocks, 1);
    EXPECT_EQ(result.withinShare, 1.0);
}

TEST(Metrics, Percentile) {
    const std::vector<float> values = {5, 1, 3, 2, 4};
    EXPECT_EQ(percentile(values, 0.0), 1.0);
    EXPECT_EQ(percentile(values, 0.5), 3.0);
    EXPECT_EQ(percentile(values, 1.0), 5.0);
    EXPECT_NEAR(percentile(values, 0.95), 4.8, 1e-6);
    EXPECT_EQ(percentile({}, 0.5), 0.0);
}

} // namespace
} // namespace kilolux::measure
