// FLIP, step by step as the paper orders it; constants are its own.
#include "renderer/measure/flip.h"

#include "renderer/measure/metrics.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace kilolux::measure {

namespace {

using Color = std::array<double, 3>;

constexpr double kPi = 3.14159265358979323846;

// A channel picture with edge replication.
struct Plane {
    int width, height;
    std::vector<double> values;
    double at(int x, int y) const {
        return values[static_cast<std::size_t>(std::clamp(y, 0, height - 1)) * width +
                      std::clamp(x, 0, width - 1)];
    }
};

// ----- colour spaces: sRGB primaries with D65 as the reference white (the white is RGB (1,1,1) itself)

constexpr double kXyzFromRgb[3][3] = {
    {10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
    {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
    {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0}};

Color multiply(const double (&m)[3][3], const Color& v) {
    Color r{};
    for (int i = 0; i < 3; ++i)
        r[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    return r;
}

const Color& whiteXyz() {
    static const Color white = multiply(kXyzFromRgb, {1.0, 1.0, 1.0});
    return white;
}

// Linear RGB of an XYZ colour by Cramer's rule.
Color rgbFromXyz(const Color& xyz) {
    const auto& m = kXyzFromRgb;
    const auto minor = [&](int r, int c) {
        const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
        return m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
    };
    const double determinant = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
    Color rgb{};
    for (int i = 0; i < 3; ++i)
        rgb[i] = (minor(0, i) * xyz[0] + minor(1, i) * xyz[1] + minor(2, i) * xyz[2]) / determinant;
    return rgb;
}

double decodeSrgb(double v) {
    const double c = std::clamp(v, 0.0, 1.0);
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

// The linearized CIELab of the paper, section 4.1: opponent axes in which filtering is meaningful.
Color opponentFromRgb(const Color& rgb) {
    const Color xyz = multiply(kXyzFromRgb, rgb);
    const double x = xyz[0] / whiteXyz()[0], y = xyz[1] / whiteXyz()[1], z = xyz[2] / whiteXyz()[2];
    return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

Color rgbFromOpponent(const Color& c) {
    const double y = (c[0] + 16.0) / 116.0;
    return rgbFromXyz(
        {(c[1] / 500.0 + y) * whiteXyz()[0], y * whiteXyz()[1], (y - c[2] / 200.0) * whiteXyz()[2]});
}

Color labFromRgb(const Color& rgb) {
    constexpr double kDelta = 6.0 / 29.0;
    const Color xyz = multiply(kXyzFromRgb, rgb);
    Color f{};
    for (int i = 0; i < 3; ++i) {
        const double t = xyz[i] / whiteXyz()[i];
        f[i] = t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
    }
    return {116.0 * f[1] - 16.0, 500.0 * (f[0] - f[1]), 200.0 * (f[1] - f[2])};
}

// Hunt: colours of dark pixels differ less.
Color huntAdjusted(const Color& lab) {
    return {lab[0], 0.01 * lab[0] * lab[1], 0.01 * lab[0] * lab[2]};
}

double hyab(const Color& a, const Color& b) {
    return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

// ----- 4.1 colour

// Contrast sensitivity, as a sum of two Gaussians per opponent channel (the paper's table 1).
struct Sensitivity {
    double a1, b1, a2, b2;
};
constexpr Sensitivity kSensitivity[3] = {
    {1.0, 0.0047, 0.0, 1e-5}, {1.0, 0.0053, 0.0, 1e-5}, {34.1, 0.04, 13.5, 0.025}};

// exp(-x^2 / (2 sigma^2)) for -radius..radius, summing to 1. All filters of FLIP are separable.
std::vector<double> gaussian(int radius, double sigmaPx) {
    std::vector<double> kernel;
    double sum = 0.0;
    for (int x = -radius; x <= radius; ++x) {
        kernel.push_back(std::exp(-static_cast<double>(x) * x / (2.0 * sigmaPx * sigmaPx)));
        sum += kernel.back();
    }
    for (double& value : kernel)
        value /= sum;
    return kernel;
}

double gaussianSum(int radius, double sigmaPx) {
    double sum = 0.0;
    for (int x = -radius; x <= radius; ++x)
        sum += std::exp(-static_cast<double>(x) * x / (2.0 * sigmaPx * sigmaPx));
    return sum;
}

// Edges are replicated.
Plane convolve(const Plane& in, const std::vector<double>& kernelX, const std::vector<double>& kernelY) {
    const int radius = static_cast<int>(kernelX.size() / 2);
    Plane middle{in.width, in.height, std::vector<double>(in.values.size())};
    Plane out = middle;
    for (int y = 0; y < in.height; ++y)
        for (int x = 0; x < in.width; ++x) {
            double sum = 0.0;
            for (int d = -radius; d <= radius; ++d)
                sum += kernelX[d + radius] * in.at(x + d, y);
            middle.values[static_cast<std::size_t>(y) * in.width + x] = sum;
        }
    for (int y = 0; y < in.height; ++y)
        for (int x = 0; x < in.width; ++x) {
            double sum = 0.0;
            for (int d = -radius; d <= radius; ++d)
                sum += kernelY[d + radius] * middle.at(x, y + d);
            out.values[static_cast<std::size_t>(y) * in.width + x] = sum;
        }
    return out;
}

// The sum a1 sqrt(pi/b1) exp(-pi^2 r^2 / b1) + (the same with a2, b2) of r in degrees, normalized over the
// window.
Plane filterBySensitivity(const Plane& in, const Sensitivity& s, int radius, double pixelsPerDegree) {
    const double sigma1 = std::sqrt(s.b1 / (2.0 * kPi * kPi)) * pixelsPerDegree;
    const double sigma2 = std::sqrt(s.b2 / (2.0 * kPi * kPi)) * pixelsPerDegree;
    const double sum1 = s.a1 * std::sqrt(kPi / s.b1) * std::pow(gaussianSum(radius, sigma1), 2.0);
    const double sum2 = s.a2 * std::sqrt(kPi / s.b2) * std::pow(gaussianSum(radius, sigma2), 2.0);
    Plane out = convolve(in, gaussian(radius, sigma1), gaussian(radius, sigma1));
    if (s.a2 == 0.0) return out;
    const Plane second = convolve(in, gaussian(radius, sigma2), gaussian(radius, sigma2));
    for (std::size_t i = 0; i < out.values.size(); ++i)
        out.values[i] = (sum1 * out.values[i] + sum2 * second.values[i]) / (sum1 + sum2);
    return out;
}

using Planes = std::array<Plane, 3>;

Planes opponentPlanes(const ImageView& image) {
    Planes planes;
    for (Plane& plane : planes)
        plane = {image.width, image.height, std::vector<double>(image.pixelCount())};
    for (std::size_t i = 0; i < image.pixelCount(); ++i) {
        const float* p = image.rgb.data() + 3 * i;
        const Color c = opponentFromRgb({decodeSrgb(p[0]), decodeSrgb(p[1]), decodeSrgb(p[2])});
        for (int channel = 0; channel < 3; ++channel)
            planes[channel].values[i] = c[channel];
    }
    return planes;
}

// What the eye resolves, in Hunt-adjusted Lab.
std::vector<Color> perceived(const Planes& opponent, double pixelsPerDegree) {
    constexpr double kWidestB = 0.04;
    const int radius =
        static_cast<int>(std::ceil(3.0 * std::sqrt(kWidestB / (2.0 * kPi * kPi)) * pixelsPerDegree));
    Planes filtered;
    for (int channel = 0; channel < 3; ++channel)
        filtered[channel] =
            filterBySensitivity(opponent[channel], kSensitivity[channel], radius, pixelsPerDegree);
    std::vector<Color> result(opponent[0].values.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        Color rgb = rgbFromOpponent({filtered[0].values[i], filtered[1].values[i], filtered[2].values[i]});
        for (double& value : rgb)
            value = std::clamp(value, 0.0, 1.0);
        result[i] = huntAdjusted(labFromRgb(rgb));
    }
    return result;
}

// Compresses large differences: up to pc of the largest distance maps linearly to pt, the rest to what is
// left.
double redistributed(double distance) {
    constexpr double kQc = 0.7, kPc = 0.4, kPt = 0.95;
    static const double largest =
        std::pow(hyab(huntAdjusted(labFromRgb({0, 1, 0})), huntAdjusted(labFromRgb({0, 0, 1}))), kQc);
    const double value = std::pow(distance, kQc);
    const double knee = kPc * largest;
    return value < knee ? kPt / knee * value : kPt + (value - knee) / (largest - knee) * (1.0 - kPt);
}

// ----- 4.2 features

enum class Feature { Edge, Point };

// First or second derivative of a Gaussian, negative and positive weights each summing to 1.
std::vector<double> featureKernel(Feature feature, int radius, double sigmaPx) {
    std::vector<double> kernel;
    double negative = 0.0, positive = 0.0;
    for (int x = -radius; x <= radius; ++x) {
        const double g = std::exp(-static_cast<double>(x) * x / (2.0 * sigmaPx * sigmaPx));
        const double value = feature == Feature::Edge ? -x * g : (x * x / (sigmaPx * sigmaPx) - 1.0) * g;
        kernel.push_back(value);
        (value < 0.0 ? negative : positive) += std::abs(value);
    }
    for (double& value : kernel)
        value /= value < 0.0 ? negative : positive;
    return kernel;
}

std::vector<double> featureStrength(const Plane& achromatic, Feature feature, double pixelsPerDegree) {
    constexpr double kWidthDegrees = 0.082; // of the features that matter
    const double sigmaPx = 0.5 * kWidthDegrees * pixelsPerDegree;
    const int radius = static_cast<int>(std::ceil(3.0 * sigmaPx));
    const std::vector<double> along = featureKernel(feature, radius, sigmaPx);
    const std::vector<double> across = gaussian(radius, sigmaPx);
    const Plane x = convolve(achromatic, along, across);
    const Plane y = convolve(achromatic, across, along);
    std::vector<double> strength(x.values.size());
    for (std::size_t i = 0; i < strength.size(); ++i)
        strength[i] = std::hypot(x.values[i], y.values[i]);
    return strength;
}

Plane normalizedAchromatic(const Planes& opponent) {
    Plane plane = opponent[0];
    for (double& value : plane.values)
        value = (value + 16.0) / 116.0;
    return plane;
}

} // namespace

FlipResult flip(const ImageView& referenceSrgb, const ImageView& testSrgb, double pixelsPerDegree) {
    assert(referenceSrgb.width == testSrgb.width && referenceSrgb.height == testSrgb.height);
    FlipResult result;
    if (referenceSrgb.pixelCount() == 0) return result;
    const Planes reference = opponentPlanes(referenceSrgb);
    const Planes test = opponentPlanes(testSrgb);
    const std::vector<Color> seenReference = perceived(reference, pixelsPerDegree);
    const std::vector<Color> seenTest = perceived(test, pixelsPerDegree);
    const Plane achromaticReference = normalizedAchromatic(reference);
    const Plane achromaticTest = normalizedAchromatic(test);
    const auto edgeReference = featureStrength(achromaticReference, Feature::Edge, pixelsPerDegree);
    const auto edgeTest = featureStrength(achromaticTest, Feature::Edge, pixelsPerDegree);
    const auto pointReference = featureStrength(achromaticReference, Feature::Point, pixelsPerDegree);
    const auto pointTest = featureStrength(achromaticTest, Feature::Point, pixelsPerDegree);
    double sum = 0.0;
    for (std::size_t i = 0; i < seenReference.size(); ++i) {
        const double color = redistributed(hyab(seenReference[i], seenTest[i]));
        const double feature = std::sqrt(
            std::max(std::abs(edgeReference[i] - edgeTest[i]), std::abs(pointReference[i] - pointTest[i])) /
            std::sqrt(2.0));
        const double value = std::pow(color, 1.0 - feature); // 4.3
        result.map.push_back(static_cast<float>(value));
        sum += value;
    }
    result.mean = sum / static_cast<double>(result.map.size());
    result.percentile95 = percentile(result.map, 0.95);
    return result;
}

} // namespace kilolux::measure
