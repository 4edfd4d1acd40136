// Error metrics in linear light.
#include "renderer/measure/metrics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

namespace kilolux::measure {

namespace {

void assertSameSize(const ImageView& a, const ImageView& b) {
    assert(a.width == b.width && a.height == b.height);
    assert(a.rgb.size() == 3 * a.pixelCount() && b.rgb.size() == 3 * b.pixelCount());
    (void)a;
    (void)b;
}

double blockMean(const ImageView& image, int x0, int y0, int x1, int y1) {
    double sum = 0.0;
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x)
            sum += luminance(image.at(x, y));
    return sum / (static_cast<double>(x1 - x0) * (y1 - y0));
}

} // namespace

double luminance(const float* rgb) {
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

double meanSquaredError(const ImageView& reference, const ImageView& test) {
    assertSameSize(reference, test);
    double sum = 0.0;
    for (std::size_t i = 0; i < reference.rgb.size(); ++i) {
        const double difference = static_cast<double>(test.rgb[i]) - reference.rgb[i];
        sum += difference * difference;
    }
    return reference.rgb.empty() ? 0.0 : sum / static_cast<double>(reference.rgb.size());
}

double relativeMeanSquaredError(const ImageView& reference, const ImageView& test, double epsilon) {
    assertSameSize(reference, test);
    double sum = 0.0;
    for (std::size_t i = 0; i < reference.rgb.size(); ++i) {
        const double value = reference.rgb[i];
        const double difference = test.rgb[i] - value;
        sum += difference * difference / (value * value + epsilon);
    }
    return reference.rgb.empty() ? 0.0 : sum / static_cast<double>(reference.rgb.size());
}

double peakSignalToNoiseDb(const ImageView& reference, const ImageView& test, double peak) {
    const double error = meanSquaredError(reference, test);
    return error > 0.0 ? 10.0 * std::log10(peak * peak / error) : std::numeric_limits<double>::infinity();
}

BlockEnergy blockEnergy(const ImageView& reference, const ImageView& test, int blockPx, double tolerance,
                        double floorShare) {
    assertSameSize(reference, test);
    assert(blockPx > 0);
    BlockEnergy result;
    if (reference.pixelCount() == 0) return result;
    const double referenceMean = blockMean(reference, 0, 0, reference.width, reference.height);
    const double testMean = blockMean(test, 0, 0, test.width, test.height);
    result.meanRatio = referenceMean > 0.0 ? testMean / referenceMean : 0.0;
    int within = 0;
    double worst = 0.0;
    for (int y = 0; y < reference.height; y += blockPx)
        for (int x = 0; x < reference.width; x += blockPx) {
            const int x1 = std::min(x + blockPx, reference.width);
            const int y1 = std::min(y + blockPx, reference.height);
            const double expected = blockMean(reference, x, y, x1, y1);
            if (!(expected > floorShare * referenceMean)) continue;
            const double ratio = blockMean(test, x, y, x1, y1) / expected;
            ++result.litBlocks;
            within += std::abs(ratio - 1.0) <= tolerance ? 1 : 0;
            // In proportion: half and double are equally far. A dead block is farthest of all.
            const double distance =
                ratio > 0.0 ? std::abs(std::log(ratio)) : std::numeric_limits<double>::infinity();
            if (!(distance <= worst)) { // a NaN is the worst there is
                worst = distance;
                result.worstRatio = ratio;
                result.worstX = x / blockPx;
                result.worstY = y / blockPx;
            }
        }
    result.withinShare = result.litBlocks > 0 ? static_cast<double>(within) / result.litBlocks : 0.0;
    return result;
}

double percentile(std::span<const float> values, double p) {
    if (values.empty()) return 0.0;
    std::vector<float> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    const double at = std::clamp(p, 0.0, 1.0) * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] +
           (at - static_cast<double>(below)) * (static_cast<double>(sorted[above]) - sorted[below]);
}

} // namespace kilolux::measure
