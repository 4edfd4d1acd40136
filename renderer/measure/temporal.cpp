#include "renderer/measure/temporal.h"

#include "renderer/measure/metrics.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace kilolux::measure {

namespace {

// Relative errors of luminance, limited.
std::vector<double> limitedErrors(const ImageView& reference, const ImageView& picture, double limit,
                                  double epsilon) {
    assert(reference.rgb.size() == picture.rgb.size());
    std::vector<double> errors(picture.pixelCount());
    for (std::size_t i = 0; i < errors.size(); ++i) {
        const double wanted = luminance(&reference.rgb[3 * i]);
        const double error = luminance(&picture.rgb[3 * i]) - wanted;
        errors[i] = std::clamp(error / std::sqrt(wanted * wanted + epsilon), -limit, limit);
    }
    return errors;
}

// Sums of products of pairs, for a correlation coefficient of numbers about 0.
struct Pairs {
    double both = 0.0, squares = 0.0;
    void add(double a, double b) {
        both += a * b;
        squares += 0.5 * (a * a + b * b);
    }
    double coefficient() const { return squares > 0.0 ? both / squares : 0.0; }
};

} // namespace

double flicker(const ImageView& before, const ImageView& now, const ImageView& reference, double epsilon) {
    assert(before.rgb.size() == now.rgb.size() && reference.rgb.size() == now.rgb.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < now.pixelCount(); ++i) {
        const double wanted = luminance(&reference.rgb[3 * i]);
        const double change = luminance(&now.rgb[3 * i]) - luminance(&before.rgb[3 * i]);
        sum += change * change / (wanted * wanted + epsilon);
    }
    return now.pixelCount() ? std::sqrt(sum / double(now.pixelCount())) : 0.0;
}

Correlation sampleCorrelation(const ImageView& reference, const std::vector<ImageView>& frames, double limit,
                              double epsilon) {
    Pairs time, space;
    std::vector<double> last;
    const auto width = std::size_t(reference.width);
    for (const ImageView& frame : frames) {
        std::vector<double> errors = limitedErrors(reference, frame, limit, epsilon);
        for (std::size_t i = 0; i < errors.size(); ++i) {
            if (!last.empty()) time.add(last[i], errors[i]);
            if (i % width + 1 < width) space.add(errors[i], errors[i + 1]);
            if (i + width < errors.size()) space.add(errors[i], errors[i + width]);
        }
        last = std::move(errors);
    }
    return {time.coefficient(), space.coefficient()};
}

std::optional<double> arrivedShare(const ImageView& before, const ImageView& after,
                                   const ImageView& picture) {
    assert(before.rgb.size() == after.rgb.size() && picture.rgb.size() == after.rgb.size());
    double along = 0.0, whole = 0.0;
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
        const double change = double(after.rgb[i]) - double(before.rgb[i]);
        along += change * (double(picture.rgb[i]) - double(before.rgb[i]));
        whole += change * change;
    }
    if (!(whole > 0.0)) return std::nullopt;
    return along / whole;
}

std::optional<int> lagFrames(const std::vector<double>& arrived, double share) {
    std::size_t first = arrived.size();
    while (first > 0 && arrived[first - 1] >= share)
        --first;
    if (first == arrived.size()) return std::nullopt;
    return int(first) + 1;
}

} // namespace kilolux::measure
