// FLIP on pictures for which the paper's formulas can be followed by hand.
#include "renderer/measure/flip.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace kilolux::measure {
namespace {

struct Picture {
    int width, height;
    std::vector<float> rgb;
    Picture(int w, int h, float r, float g, float b) : width(w), height(h) {
        for (int i = 0; i < w * h; ++i)
            rgb.insert(rgb.end(), {r, g, b});
    }
    Picture(int w, int h, float grey) : Picture(w, h, grey, grey, grey) {}
    ImageView view() const { return {width, height, rgb}; }
    void fill(int x0, int y0, int x1, int y1, float grey) {
        for (int y = y0; y < y1; ++y)
            std::fill_n(rgb.begin() + 3 * (y * width + x0), 3 * (x1 - x0), grey);
    }
    Picture transposed() const {
        Picture result(height, width, 0.0f);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                std::copy_n(rgb.begin() + 3 * (y * width + x), 3, result.rgb.begin() + 3 * (x * height + y));
        return result;
    }
};

double flat(const Picture& a, const Picture& b) {
    return flip(a.view(), b.view()).mean;
}

TEST(Flip, EqualPicturesGiveZero) {
    Picture p(40, 30, 0.4f, 0.7f, 0.1f);
    p.fill(10, 10, 20, 12, 0.9f);
    const FlipResult result = flip(p.view(), p.view());
    EXPECT_EQ(result.mean, 0.0);
    EXPECT_EQ(result.percentile95, 0.0);
    EXPECT_EQ(result.map.size(), 1200u);
}

// Flat pictures have no features and survive filtering, so the value is the redistributed HyAB distance
// alone. Lab of sRGB green (87.737, -86.185, 83.181) and blue (32.297, 79.188, -107.860) give, Hunt-adjusted,
// cmax = |dL| + |d(a,b)| = 203.6..., which to the power 0.7 is 41.3: the knee is at 16.51.
TEST(Flip, FlatPicturesByHand) {
    const double ga = 0.01 * 87.737 * -86.185, gb = 0.01 * 87.737 * 83.181;
    const double ba = 0.01 * 32.297 * 79.188, bb = 0.01 * 32.297 * -107.860;
    const double largest = std::pow(87.737 - 32.297 + std::hypot(ga - ba, gb - bb), 0.7);
    const double knee = 0.4 * largest;
    const auto value = [&](double distance) {
        const double d = std::pow(distance, 0.7);
        return d < knee ? 0.95 * d / knee : 0.95 + 0.05 * (d - knee) / (largest - knee);
    };
    EXPECT_NEAR(flat(Picture(24, 24, 0.0f), Picture(24, 24, 1.0f)), value(100.0), 1e-4);
    // sRGB 119/255 has L* 50.034; 128/255 has 53.585.
    EXPECT_NEAR(flat(Picture(24, 24, 119 / 255.0f), Picture(24, 24, 128 / 255.0f)), value(53.585 - 50.034),
                1e-3);
    EXPECT_NEAR(flat(Picture(24, 24, 0, 1, 0), Picture(24, 24, 0, 0, 1)), 1.0, 1e-6)
        << "the largest distance";
    // Red (53.241, 80.092, 67.203) against black.
    EXPECT_NEAR(flat(Picture(24, 24, 1, 0, 0), Picture(24, 24, 0.0f)),
                value(53.241 + 0.53241 * std::hypot(80.092, 67.203)), 1e-4);
}

TEST(Flip, SymmetricAndWithinBounds) {
    Picture a(50, 40, 0.3f);
    Picture b(50, 40, 0.35f);
    a.fill(10, 5, 30, 25, 0.9f);
    b.fill(14, 5, 30, 31, 0.7f);
    const FlipResult ab = flip(a.view(), b.view());
    const FlipResult ba = flip(b.view(), a.view());
    for (std::size_t i = 0; i < ab.map.size(); ++i) {
        EXPECT_FLOAT_EQ(ab.map[i], ba.map[i]);
        EXPECT_GE(ab.map[i], 0.0f);
        EXPECT_LE(ab.map[i], 1.0f);
    }
    const FlipResult turned = flip(a.transposed().view(), b.transposed().view());
    EXPECT_NEAR(turned.mean, ab.mean, 1e-9);
    EXPECT_GT(ab.percentile95, ab.mean);
}

// A checkerboard and its inverse: from afar both are the same grey, close up every pixel differs.
TEST(Flip, DistanceHidesDetail) {
    Picture a(64, 64, 0.4f);
    Picture b(64, 64, 0.4f);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            ((x + y) % 2 == 0 ? a : b).fill(x, y, x + 1, y + 1, 0.6f);
    const auto middle = [&](double pixelsPerDegree) {
        return flip(a.view(), b.view(), pixelsPerDegree).map[32 * 64 + 32];
    };
    EXPECT_GT(middle(15.0), 0.3);
    EXPECT_LT(middle(200.0), 0.01);
    EXPECT_GT(middle(30.0), middle(67.0));
}

// A new edge makes the same colour difference worse: the feature term lies in the exponent.
TEST(Flip, FeaturesRaiseTheError) {
    const Picture reference(80, 80, 0.5f);
    Picture step = reference;
    step.fill(40, 0, 80, 80, 0.6f);
    const FlipResult result = flip(reference.view(), step.view());
    const double inside = result.map[40 * 80 + 75];
    const double atEdge = result.map[40 * 80 + 41];
    EXPECT_NEAR(inside, flat(reference, Picture(80, 80, 0.6f)), 1e-3) << "far from the edge: colour alone";
    EXPECT_GT(atEdge, inside);
    EXPECT_NEAR(result.map[40 * 80 + 4], 0.0, 1e-4) << "far on the unchanged side";
}

// At 1 pixel per degree every kernel shrinks to its neighbours, so a pixel can be followed by hand: colour is
// that of the flat pictures, the edge kernel is (1, 0, -1) and its response the step's height in luminance Y,
// the feature difference sqrt(height / sqrt 2), the value colour^(1 - feature).
TEST(Flip, FeatureExponentByHand) {
    const auto linear = [](double v) { return std::pow((v + 0.055) / 1.055, 2.4); };
    const Picture reference(9, 9, 0.5f);
    Picture step = reference;
    step.fill(5, 0, 9, 9, 0.6f);
    const FlipResult result = flip(reference.view(), step.view(), 1.0);
    const double color = flat(reference, Picture(9, 9, 0.6f));
    const double feature = std::sqrt((linear(0.6) - linear(0.5)) / std::sqrt(2.0));
    EXPECT_NEAR(result.map[4 * 9 + 5], std::pow(color, 1.0 - feature), 1e-5);
    EXPECT_NEAR(result.map[4 * 9 + 6], color, 1e-5);
    EXPECT_EQ(result.map[4 * 9 + 4], 0.0f) << "no colour difference, no error";
    // A line one pixel wide: the point kernel (1/2, -1, 1/2) answers with the full height, the edge kernel
    // not.
    Picture line = reference;
    line.fill(4, 0, 5, 9, 0.6f);
    EXPECT_NEAR(flip(reference.view(), line.view(), 1.0).map[4 * 9 + 4], std::pow(color, 1.0 - feature),
                1e-5);
}

} // namespace
} // namespace kilolux::measure
