// HDR-FLIP by its definition, and LDR-FLIP against a second implementation: the paper's two-dimensional
// kernels, added up pixel by pixel without any of the program's short cuts.
#include "renderer/measure/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <random>

namespace kilolux::measure {
namespace {

using Color = std::array<double, 3>;
using Colors = std::vector<Color>;
constexpr double kPi = 3.14159265358979323846;

double decoded(double v) {
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

// With the matrix of sRGB to six digits; xyz over that of white.
Color xyzOverWhite(const Color& c) {
    const Color x{0.412391, 0.357584, 0.180481}, y{0.212639, 0.715169, 0.072192},
        z{0.019331, 0.119195, 0.950532};
    const auto dot = [&](const Color& row) {
        return (row[0] * c[0] + row[1] * c[1] + row[2] * c[2]) / (row[0] + row[1] + row[2]);
    };
    return {dot(x), dot(y), dot(z)};
}

Color rgbOf(const Color& overWhite) {
    const double x = overWhite[0] * 0.950456, y = overWhite[1], z = overWhite[2] * 1.089058;
    return {3.240970 * x - 1.537383 * y - 0.498611 * z, -0.969244 * x + 1.875968 * y + 0.041555 * z,
            0.055630 * x - 0.203977 * y + 1.056972 * z};
}

Color huntLab(const Color& rgb) {
    Color f = xyzOverWhite(rgb);
    for (double& t : f)
        t = t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
    const double lightness = 116.0 * f[1] - 16.0;
    return {lightness, 0.01 * lightness * 500.0 * (f[0] - f[1]), 0.01 * lightness * 200.0 * (f[1] - f[2])};
}

double hyab(const Color& a, const Color& b) {
    return std::abs(a[0] - b[0]) + std::sqrt(std::pow(a[1] - b[1], 2.0) + std::pow(a[2] - b[2], 2.0));
}

// Sum over a square window of kernel(dx, dy) * value; `normalize`: over the sum of the kernel.
double filtered(const std::vector<double>& values, int width, int height, int x, int y, int radius,
                bool normalize, const std::function<double(int, int)>& kernel) {
    double sum = 0.0, whole = 0.0;
    for (int dy = -radius; dy <= radius; ++dy)
        for (int dx = -radius; dx <= radius; ++dx) {
            const int px = std::clamp(x + dx, 0, width - 1), py = std::clamp(y + dy, 0, height - 1);
            const double weight = kernel(dx, dy);
            sum += weight * values[std::size_t(py * width + px)];
            whole += weight;
        }
    return normalize ? sum / whole : sum;
}

struct Prepared {
    Colors seen;
    std::vector<double> edge, point;
};

// Positive and negative weights each add up to 1.
std::function<double(int, int)> featureKernel(bool isPoint, bool alongY, int radius, double sigma) {
    const auto raw = [=](int dx, int dy) {
        const double along = alongY ? dy : dx;
        const double gauss = std::exp(-(dx * dx + dy * dy) / (2.0 * sigma * sigma));
        return isPoint ? (along * along / (sigma * sigma) - 1.0) * gauss : -along * gauss;
    };
    double positive = 0.0, negative = 0.0;
    for (int dy = -radius; dy <= radius; ++dy)
        for (int dx = -radius; dx <= radius; ++dx)
            (raw(dx, dy) > 0.0 ? positive : negative) += raw(dx, dy);
    return [=](int dx, int dy) {
        const double value = raw(dx, dy);
        return value > 0.0 ? value / positive : -value / negative;
    };
}

Prepared prepare(const std::vector<float>& srgb, int width, int height, double ppd) {
    std::array<std::vector<double>, 3> opponent;
    std::vector<double> grey;
    for (std::size_t i = 0; i < srgb.size(); i += 3) {
        const Color t = xyzOverWhite({decoded(srgb[i]), decoded(srgb[i + 1]), decoded(srgb[i + 2])});
        opponent[0].push_back(116.0 * t[1] - 16.0);
        opponent[1].push_back(500.0 * (t[0] - t[1]));
        opponent[2].push_back(200.0 * (t[1] - t[2]));
        grey.push_back(t[1]);
    }
    const double parts[3][4] = {
        {1.0, 0.0047, 0.0, 1e-5}, {1.0, 0.0053, 0.0, 1e-5}, {34.1, 0.04, 13.5, 0.025}};
    const int radius = int(std::ceil(3.0 * std::sqrt(0.04 / (2.0 * kPi * kPi)) * ppd));
    const double sigma = 0.5 * 0.082 * ppd;
    const int featureRadius = int(std::ceil(3.0 * sigma));
    Prepared result;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            Color c{};
            for (std::size_t k = 0; k < 3; ++k) {
                const auto& s = parts[k];
                c[k] = filtered(opponent[k], width, height, x, y, radius, true, [&](int dx, int dy) {
                    const double r2 = (dx * dx + dy * dy) / (ppd * ppd);
                    return s[0] * std::sqrt(kPi / s[1]) * std::exp(-kPi * kPi * r2 / s[1]) +
                           s[2] * std::sqrt(kPi / s[3]) * std::exp(-kPi * kPi * r2 / s[3]);
                });
            }
            const double ty = (c[0] + 16.0) / 116.0;
            Color rgb = rgbOf({ty + c[1] / 500.0, ty, ty - c[2] / 200.0});
            for (double& value : rgb)
                value = std::clamp(value, 0.0, 1.0);
            result.seen.push_back(huntLab(rgb));
            for (const bool isPoint : {false, true}) {
                double squares = 0.0;
                for (const bool alongY : {false, true})
                    squares += std::pow(filtered(grey, width, height, x, y, featureRadius, false,
                                                 featureKernel(isPoint, alongY, featureRadius, sigma)),
                                        2.0);
                (isPoint ? result.point : result.edge).push_back(std::sqrt(squares));
            }
        }
    return result;
}

std::vector<double> secondFlip(const std::vector<float>& a, const std::vector<float>& b, int width,
                               int height, double ppd) {
    const Prepared pa = prepare(a, width, height, ppd), pb = prepare(b, width, height, ppd);
    const double most = std::pow(hyab(huntLab({0.0, 1.0, 0.0}), huntLab({0.0, 0.0, 1.0})), 0.7),
                 knee = 0.4 * most;
    std::vector<double> result;
    for (std::size_t i = 0; i < pa.seen.size(); ++i) {
        const double d = std::pow(hyab(pa.seen[i], pb.seen[i]), 0.7);
        const double color = d < knee ? 0.95 / knee * d : 0.95 + (d - knee) / (most - knee) * 0.05;
        const double feature = std::pow(
            std::max(std::abs(pa.edge[i] - pb.edge[i]), std::abs(pa.point[i] - pb.point[i])) / std::sqrt(2.0),
            0.5);
        result.push_back(std::pow(color, 1.0 - feature));
    }
    return result;
}

// Smooth colours with edges and noise.
std::vector<float> testPicture(int width, int height, unsigned seed, float noise) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> number(-noise, noise);
    std::vector<float> rgb;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float step = x > width / 2 ? 0.3f : 0.0f;
            for (const float value : {0.2f + step, 0.6f * float(y) / float(height), 0.5f - 0.5f * step})
                rgb.push_back(std::clamp(value + number(random), 0.0f, 1.0f));
        }
    return rgb;
}

TEST(Flip, AgreesWithASecondImplementation) {
    constexpr int kWidth = 20, kHeight = 14;
    const std::vector<float> a = testPicture(kWidth, kHeight, 1, 0.02f),
                             b = testPicture(kWidth, kHeight, 2, 0.2f);
    for (const double ppd : {12.0, 40.0}) {
        const FlipResult ours = flip({kWidth, kHeight, a}, {kWidth, kHeight, b}, ppd);
        const std::vector<double> other = secondFlip(a, b, kWidth, kHeight, ppd);
        for (std::size_t i = 0; i < other.size(); ++i)
            ASSERT_NEAR(ours.map[i], other[i], 2e-4) << "pixel " << i << ", " << ppd << " pixels a degree";
        EXPECT_GT(ours.mean, 0.05);
    }
}

// Of light from 0.02 to 16 the exposures go from the brightest pixel to the median, both shown at 0.85: the
// curve is there where 0.9036 x^2 + 0.018 x = 0.85 (0.8748 x^2 + 0.354 x + 0.14), x = 1.8938.
TEST(HdrFlip, ExposuresByHand) {
    std::vector<float> rgb;
    for (const float value : {0.02f, 0.25f, 0.25f, 0.5f, 16.0f})
        rgb.insert(rgb.end(), {value, value, value});
    const HdrExposures exposures = hdrFlipExposures({5, 1, rgb});
    const double a = 0.9036 - 0.85 * 0.8748, b = 0.018 - 0.85 * 0.354, c = -0.85 * 0.14;
    const double x = (-b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
    EXPECT_NEAR(exposures.startStops, std::log2(x / 16.0), 1e-6);
    EXPECT_NEAR(exposures.stopStops, std::log2(x / 0.25), 1e-6);
    EXPECT_EQ(exposures.count, 6) << "six stops apart";
}

TEST(HdrFlip, TakesTheWorstExposureOfEachPixel) {
    // A difference in the dark and one in the bright: no single exposure shows both.
    std::vector<float> a(std::size_t(3 * 48 * 8), 0.05f);
    for (std::size_t i = 0; i < a.size(); ++i)
        if (i / 3 % 48 >= 32) a[i] = 20.0f; // the median is dark
    std::vector<float> b = a;
    for (std::size_t i = 0; i < b.size(); ++i)
        b[i] *= 0.6f;
    const FlipResult hdr = hdrFlip({48, 8, a}, {48, 8, b}, 10.0);
    ASSERT_EQ(hdr.map.size(), 48u * 8u);
    EXPECT_GT(hdr.map[4 * 48 + 4], 0.2f);
    EXPECT_GT(hdr.map[4 * 48 + 44], 0.1f);
    EXPECT_EQ(hdrFlip({48, 8, a}, {48, 8, a}).mean, 0.0);
    const std::vector<float> black(a.size(), 0.0f);
    EXPECT_TRUE(std::isfinite(hdrFlip({48, 8, black}, {48, 8, a}).mean)) << "black has no exposure";
}

} // namespace
} // namespace kilolux::measure
