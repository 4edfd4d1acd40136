// Flicker, arrival and correlation on pictures with known answers.
#include "renderer/measure/temporal.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace kilolux::measure {
namespace {

struct Picture {
    int width, height;
    std::vector<float> rgb;
    Picture(int w, int h, float grey) : width(w), height(h), rgb(std::size_t(3 * w * h), grey) {}
    ImageView view() const { return {width, height, rgb}; }
    void set(int x, int y, float grey) {
        for (int c = 0; c < 3; ++c)
            rgb[std::size_t(3 * (y * width + x) + c)] = grey;
    }
};

TEST(Temporal, FlickerByHand) {
    const Picture reference(4, 2, 1.0f), before(4, 2, 1.0f);
    EXPECT_EQ(flicker(before.view(), before.view(), reference.view()), 0.0);
    Picture now = before;
    now.set(1, 1, 1.5f); // one of eight changes by half
    EXPECT_NEAR(flicker(before.view(), now.view(), reference.view(), 0.0), std::sqrt(0.25 / 8.0), 1e-7);
    const Picture dark(4, 2, 0.0f);
    EXPECT_NEAR(flicker(dark.view(), Picture(4, 2, 0.1f).view(), dark.view(), 0.01), 1.0, 1e-6);
}

TEST(Temporal, ArrivalByHand) {
    const Picture before(3, 3, 1.0f);
    Picture after = before, half = before;
    after.set(0, 0, 3.0f);
    half.set(0, 0, 2.0f);
    half.set(2, 2, 9.0f); // noise where nothing changes does not count
    EXPECT_NEAR(arrivedShare(before.view(), after.view(), half.view()).value(), 0.5, 1e-7);
    EXPECT_NEAR(arrivedShare(before.view(), after.view(), after.view()).value(), 1.0, 1e-7);
    EXPECT_FALSE(arrivedShare(before.view(), before.view(), after.view())) << "nothing changes";
}

TEST(Temporal, LagIsUntilItStays) {
    EXPECT_EQ(lagFrames({0.95, 0.97, 1.0}), 1);
    EXPECT_EQ(lagFrames({0.2, 0.95, 0.6, 0.92, 1.1}), 4) << "it fell back once";
    EXPECT_FALSE(lagFrames({0.95, 0.5}));
    EXPECT_FALSE(lagFrames({}));
    EXPECT_EQ(lagFrames({0.2, 0.6}, 0.5), 2);
}

// Values are +-1 about a reference of 10: `blockPx` x `blockPx` pixels share one, frames are new or all the
// same.
Correlation correlationOf(int blockPx, bool sameFrames) {
    constexpr int kSize = 96;
    const Picture reference(kSize, kSize, 10.0f);
    std::mt19937 random(3);
    std::vector<Picture> pictures;
    for (int frame = 0; frame < 4; ++frame) {
        if (frame > 0 && sameFrames) {
            pictures.push_back(pictures.back());
            continue;
        }
        Picture picture = reference;
        for (int y = 0; y < kSize; y += blockPx)
            for (int x = 0; x < kSize; x += blockPx) {
                const float value = random() % 2 ? 11.0f : 9.0f;
                for (int i = 0; i < blockPx * blockPx; ++i)
                    picture.set(x + i % blockPx, y + i / blockPx, value);
            }
        pictures.push_back(std::move(picture));
    }
    std::vector<ImageView> views;
    for (const Picture& picture : pictures)
        views.push_back(picture.view());
    return sampleCorrelation(reference.view(), views);
}

TEST(Temporal, CorrelationOfKnownNoise) {
    const Correlation independent = correlationOf(1, false);
    EXPECT_NEAR(independent.inTime, 0.0, 0.02);
    EXPECT_NEAR(independent.inSpace, 0.0, 0.02);
    const Correlation kept = correlationOf(1, true);
    EXPECT_NEAR(kept.inTime, 1.0, 1e-9);
    EXPECT_NEAR(kept.inSpace, 0.0, 0.04);
    // Of blocks of 2 x 2, half of the neighbours are in the same one.
    EXPECT_NEAR(correlationOf(2, false).inSpace, 0.5, 0.04);
    EXPECT_NEAR(correlationOf(2, false).inTime, 0.0, 0.04);
}

// One sample a thousand times too bright must not decide.
TEST(Temporal, CorrelationLimitsErrors) {
    const Picture reference(32, 32, 1.0f);
    Picture a = reference, b = reference;
    for (int i = 0; i < 32 * 32; ++i) {
        a.set(i % 32, i / 32, i % 3 ? 2.0f : 0.0f);
        b.set(i % 32, i / 32, i % 5 ? 0.5f : 3.0f);
    }
    const double without = sampleCorrelation(reference.view(), {a.view(), b.view()}).inTime;
    a.set(5, 5, 1000.0f);
    b.set(5, 5, 1000.0f);
    EXPECT_NEAR(sampleCorrelation(reference.view(), {a.view(), b.view()}).inTime, without, 0.05);
}

} // namespace
} // namespace kilolux::measure
