#include "content/make/noise/filter_kernel.h"

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdlib>

namespace kilolux {
namespace {

// Row 8 of Pascal's triangle is the autocorrelation of row 4, here over its centre.
constexpr std::array<double, 5> kBinomialAutocorrelation = {1.0, 56.0 / 70.0, 28.0 / 70.0, 8.0 / 70.0,
                                                            1.0 / 70.0};

double spatial(const NoiseFilter& filter, int dx, int dy) {
    if (!filter.blurs) return dx == 0 && dy == 0 ? 1.0 : 0.0;
    return kBinomialAutocorrelation[static_cast<std::size_t>(std::abs(dx))] *
           kBinomialAutocorrelation[static_cast<std::size_t>(std::abs(dy))];
}

// An exponential mean's autocorrelation is (1 - alpha)^|d|; all periods of the cycle summed, 1 at d = 0. By
// products only, so that every machine gets the same bits.
double temporal(const NoiseFilter& filter, int dLayer, int layers) {
    const auto power = [&](int exponent) {
        double product = 1.0;
        for (int i = 0; i < exponent; ++i)
            product *= 1.0 - filter.alpha;
        return product;
    };
    return (power(dLayer) + power(layers - dLayer)) / (1.0 + power(layers));
}

} // namespace

const float* NoiseKernel::row(int dx, int dy, int from) const {
    const int tap = (dy + kRadiusPx) * kWidthPx + dx + kRadiusPx;
    return taps.data() + static_cast<std::size_t>(tap) * 2 * layers + (layers - from);
}

NoiseKernel makeNoiseKernel(const std::vector<NoiseFilter>& filters, int layers) {
    assert(layers > 0);
    NoiseKernel kernel{.layers = layers};
    for (int dy = -NoiseKernel::kRadiusPx; dy <= NoiseKernel::kRadiusPx; ++dy)
        for (int dx = -NoiseKernel::kRadiusPx; dx <= NoiseKernel::kRadiusPx; ++dx)
            for (int d = 0; d < 2 * layers; ++d) {
                double sum = 0.0;
                for (const NoiseFilter& filter : filters)
                    sum += filter.weight * spatial(filter, dx, dy) * temporal(filter, d % layers, layers);
                kernel.taps.push_back(static_cast<float>(sum));
            }
    return kernel;
}

} // namespace kilolux
