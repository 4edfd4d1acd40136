// HDR-FLIP over LDR-FLIP: exposures, the tone curve, and the largest value per pixel.
#include "renderer/measure/flip.h"
#include "renderer/measure/metrics.h"

#include <algorithm>
#include <cmath>

namespace kilolux::measure {

namespace {

// (k0 x^2 + k1 x) / (k3 x^2 + k4 x + k5): Narkowicz' fit, "ACES Filmic Tone Mapping Curve", 2015, with its
// pre-exposure of 0.6 taken into the numbers, as the paper has it.
constexpr double k0 = 0.6 * 0.6 * 2.51, k1 = 0.6 * 0.03, k3 = 0.6 * 0.6 * 2.43, k4 = 0.6 * 0.59, k5 = 0.14;
constexpr double kShownAt = 0.85;

double toned(double x) {
    return std::clamp((k0 * x * x + k1 * x) / (k3 * x * x + k4 * x + k5), 0.0, 1.0);
}

// Where the curve is at kShownAt.
double inputOfShown() {
    const double a = k0 - kShownAt * k3, b = k1 - kShownAt * k4, c = -kShownAt * k5;
    return (-b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
}

double srgb(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

std::vector<float> shown(const ImageView& picture, double factor) {
    std::vector<float> result;
    result.reserve(picture.rgb.size());
    for (const float value : picture.rgb)
        result.push_back(float(srgb(toned(std::max(factor * double(value), 0.0)))));
    return result;
}

} // namespace

HdrExposures hdrFlipExposures(const ImageView& reference) {
    HdrExposures result;
    std::vector<float> light;
    for (std::size_t i = 0; i < reference.pixelCount(); ++i)
        light.push_back(float(luminance(&reference.rgb[3 * i])));
    if (light.empty()) return result;
    std::sort(light.begin(), light.end());
    // Black has no exposure that shows it.
    const double least = 1e-6, most = std::max(double(light.back()), least);
    const double median = std::max(percentile(light, 0.5), std::min(least, most));
    result.startStops = std::log2(inputOfShown() / most);
    result.stopStops = std::log2(inputOfShown() / median);
    result.count = std::max(2, int(std::ceil(result.stopStops - result.startStops)));
    return result;
}

FlipResult hdrFlip(const ImageView& reference, const ImageView& test, double pixelsPerDegree) {
    FlipResult result;
    const HdrExposures exposures = hdrFlipExposures(reference);
    for (int i = 0; i < exposures.count; ++i) {
        const double stops =
            std::lerp(exposures.startStops, exposures.stopStops, double(i) / (exposures.count - 1));
        const std::vector<float> a = shown(reference, std::exp2(stops)), b = shown(test, std::exp2(stops));
        const FlipResult one =
            flip({reference.width, reference.height, a}, {test.width, test.height, b}, pixelsPerDegree);
        result.map.resize(one.map.size(), 0.0f);
        for (std::size_t k = 0; k < one.map.size(); ++k)
            result.map[k] = std::max(result.map[k], one.map[k]);
    }
    double sum = 0.0;
    for (const float value : result.map)
        sum += double(value);
    result.mean = result.map.empty() ? 0.0 : sum / double(result.map.size());
    result.percentile95 = percentile(result.map, 0.95);
    return result;
}

} // namespace kilolux::measure
