#include "content/make/noise/optimize.h"

#include "content/make/noise/point_sets.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

namespace kilolux {
namespace {

// Sums are taken in this many lanes, in an order that does not depend on the compiler's vector width.
constexpr int kLanes = 4;

// Tuned on 32 x 32 x 32 at 400 proposals a pixel: thresholds of 0.5 to 1 tie, 0.2 leaves 4 % more error after
// one blurred frame and 6 leaves 9 % more. Least shares of the value range from 0.02 to 0.05 tie.
constexpr double kFirstThreshold = 0.7;
constexpr double kLeastReach = 0.03;

// A mask while it is optimized. D numbers a pixel; a site is (y * width + x) * layers + layer, so that a
// pixel's layers are contiguous.
template<std::size_t D>
class Annealer {
  public:
    Annealer(NoiseSize size, const NoiseKernel& kernel, const std::vector<NoiseValue<D>>& values,
             NoiseEffort effort);
    void run();
    std::vector<NoiseValue<D>> values() const; // [layer][y][x]

  private:
    int site(int x, int y, int layer) const {
        return ((y & (size_.height - 1)) * size_.width + (x & (size_.width - 1))) * size_.layers + layer;
    }
    int proposePartner(int layer, int stratum, int reach);
    double energyChange(int siteA, int siteB) const;
    float sumAround(int center, const std::array<float, D>& to, const std::array<float, D>& from) const;
    float kernelBetween(int siteA, int siteB) const;
    void swapSites(int siteA, int siteB);

    NoiseSize size_;
    const NoiseKernel& kernel_;
    NoiseEffort effort_;
    NoiseRandom random_;
    std::array<std::vector<float>, D> coordinates_; // of each site, [0, 1)
    std::vector<NoiseValue<D>> values_;             // the same in 16 bits
    std::vector<int> siteOfStratum_;                // [layer][stratum]
};

template<std::size_t D>
Annealer<D>::Annealer(NoiseSize size, const NoiseKernel& kernel, const std::vector<NoiseValue<D>>& values,
                      NoiseEffort effort)
    : size_(size), kernel_(kernel), effort_(effort), random_(effort.seed), values_(values.size()),
      siteOfStratum_(values.size()) {
    for (std::vector<float>& coordinate : coordinates_)
        coordinate.resize(values.size());
    std::vector<int> order(static_cast<std::size_t>(size.area()));
    for (int layer = 0; layer < size.layers; ++layer) {
        for (int i = 0; i < size.area(); ++i)
            order[i] = i;
        for (int i = size.area() - 1; i > 0; --i)
            std::swap(order[i], order[random_.below(i + 1)]);
        for (int i = 0; i < size.area(); ++i) {
            const int at = order[i] * size.layers + layer;
            values_[at] = values[layer * size.area() + i];
            siteOfStratum_[layer * size.area() + noiseStratum(values_[at], size.area())] = at;
            for (std::size_t d = 0; d < D; ++d)
                coordinates_[d][at] = (values_[at][d] + 0.5f) / 65536.0f;
        }
    }
}

template<std::size_t D>
float distance(const std::array<float, D>& a, const std::array<const float*, D>& b, int index) {
    if constexpr (D == 1) return std::fabs(a[0] - b[0][index]);
    float sum = 0.0f;
    for (std::size_t d = 0; d < D; ++d)
        sum += (a[d] - b[d][index]) * (a[d] - b[d][index]);
    return std::sqrt(sum);
}

// Sum over all sites around the centre of the kernel times how much farther they are from `to` than from
// `from`.
template<std::size_t D>
float Annealer<D>::sumAround(int center, const std::array<float, D>& to,
                             const std::array<float, D>& from) const {
    const int layer = center % size_.layers;
    const int x = center / size_.layers % size_.width, y = center / size_.layers / size_.width;
    std::array<float, kLanes> sums{};
    for (int dy = -NoiseKernel::kRadiusPx; dy <= NoiseKernel::kRadiusPx; ++dy)
        for (int dx = -NoiseKernel::kRadiusPx; dx <= NoiseKernel::kRadiusPx; ++dx) {
            const float* weights = kernel_.row(dx, dy, layer);
            std::array<const float*, D> others;
            for (std::size_t d = 0; d < D; ++d)
                others[d] = &coordinates_[d][site(x + dx, y + dy, 0)];
            for (int first = 0; first < size_.layers; first += kLanes)
                for (int lane = 0; lane < kLanes; ++lane) {
                    const int i = first + lane;
                    sums[lane] += weights[i] * (distance<D>(to, others, i) - distance<D>(from, others, i));
                }
        }
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

template<std::size_t D>
float Annealer<D>::kernelBetween(int siteA, int siteB) const {
    const auto apart = [](int a, int b, int size) {
        const int d = (b - a) & (size - 1);
        return d > size / 2 ? d - size : d;
    };
    const int pixelA = siteA / size_.layers, pixelB = siteB / size_.layers;
    const int dx = apart(pixelA % size_.width, pixelB % size_.width, size_.width);
    const int dy = apart(pixelA / size_.width, pixelB / size_.width, size_.height);
    if (std::max(std::abs(dx), std::abs(dy)) > NoiseKernel::kRadiusPx) return 0.0f;
    return kernel_.at(dx, dy, 0); // both are of one layer
}

// The error is minus half the sum over ordered pairs of kernel times distance, up to a constant that swaps
// keep. A pair's own distance stays when the two change places, which the last term takes out of the sums.
template<std::size_t D>
double Annealer<D>::energyChange(int siteA, int siteB) const {
    std::array<float, D> a, b;
    std::array<const float*, D> atB;
    for (std::size_t d = 0; d < D; ++d) {
        a[d] = coordinates_[d][siteA];
        b[d] = coordinates_[d][siteB];
        atB[d] = &b[d];
    }
    const float own = 2.0f * distance<D>(a, atB, 0) * (kernel_.at(0, 0, 0) - kernelBetween(siteA, siteB));
    return own - sumAround(siteA, b, a) - sumAround(siteB, a, b);
}

template<std::size_t D>
void Annealer<D>::swapSites(int siteA, int siteB) {
    const int layerStart = siteA % size_.layers * size_.area();
    std::swap(siteOfStratum_[layerStart + noiseStratum(values_[siteA], size_.area())],
              siteOfStratum_[layerStart + noiseStratum(values_[siteB], size_.area())]);
    std::swap(values_[siteA], values_[siteB]);
    for (std::vector<float>& coordinate : coordinates_)
        std::swap(coordinate[siteA], coordinate[siteB]);
}

// A stratum at most `reach` (of 1) away along each axis; -1 where that falls outside.
template<std::size_t D>
int Annealer<D>::proposePartner(int layer, int stratum, int reach) {
    const int side = noiseStrataSide<D>(size_.area());
    int partner = 0;
    for (std::size_t d = 0, scale = 1; d < D; ++d, scale *= side) {
        const int at = stratum / static_cast<int>(scale) % side;
        const int moved = at - reach + random_.below(2 * reach + 1);
        if (moved < 0 || moved >= side) return -1;
        partner += moved * static_cast<int>(scale);
    }
    return partner == stratum ? -1 : siteOfStratum_[layer * size_.area() + partner];
}

// The threshold falls to 0, and with it how far apart in value the swapped ones may be: late in the search,
// when pixels are in place, exchanges of near values are those that still gain.
template<std::size_t D>
void Annealer<D>::run() {
    const int side = noiseStrataSide<D>(size_.area());
    const std::int64_t sites = static_cast<std::int64_t>(values_.size());
    const std::int64_t proposals = sites * effort_.proposalsPerPixel;
    for (std::int64_t i = 0; i < proposals; ++i) {
        const double left = 1.0 - static_cast<double>(i) / static_cast<double>(proposals);
        const int siteA = static_cast<int>(random_.below(static_cast<int>(sites)));
        const int layer = siteA % size_.layers;
        const int reach = std::max(1, static_cast<int>(side * std::max(left * left, kLeastReach)));
        const int siteB = proposePartner(layer, noiseStratum(values_[siteA], size_.area()), reach);
        if (siteB < 0) continue;
        if (energyChange(siteA, siteB) < kFirstThreshold * left * left * left) swapSites(siteA, siteB);
    }
}

template<std::size_t D>
std::vector<NoiseValue<D>> Annealer<D>::values() const {
    std::vector<NoiseValue<D>> ordered;
    for (int layer = 0; layer < size_.layers; ++layer)
        for (int pixel = 0; pixel < size_.area(); ++pixel)
            ordered.push_back(values_[pixel * size_.layers + layer]);
    return ordered;
}

template<std::size_t D>
std::vector<NoiseValue<D>> optimize(NoiseSize size, const std::vector<NoiseFilter>& filters,
                                    const std::vector<NoiseValue<D>>& values, NoiseEffort effort) {
    assert(size.layers % kLanes == 0);
    assert(D == 1 || noiseStrataSide<D>(size.area()) * noiseStrataSide<D>(size.area()) == size.area());
    const NoiseKernel kernel = makeNoiseKernel(filters, size.layers);
    Annealer<D> annealer(size, kernel, values, effort);
    annealer.run();
    return annealer.values();
}

} // namespace

std::vector<std::uint16_t> optimizeScalarMask(NoiseSize size, const std::vector<NoiseFilter>& filters,
                                              NoiseEffort effort) {
    std::vector<std::uint16_t> numbers;
    for (const NoiseValue<1>& value :
         optimize(size, filters, spreadNumbers(size.area(), size.layers, effort.seed), effort))
        numbers.push_back(value[0]);
    return numbers;
}

std::vector<std::array<std::uint16_t, 2>>
optimizePointMask(NoiseSize size, const std::vector<NoiseFilter>& filters, NoiseEffort effort) {
    return optimize(size, filters, spreadPoints(size.area(), size.layers, effort.seed), effort);
}

// Each filter alone would gain at the cost of the others: adapted to one blurred frame only, masks leave 0.13
// of white noise's error there instead of 0.20, but 1.1 of it in a pixel's long history instead of 0.29 (32 x
// 32 x 32, 100 proposals a pixel).
std::vector<NoiseFilter> renderingFilters() {
    return {NoiseFilter{.weight = 1.0, .blurs = true, .alpha = 1.0},
            NoiseFilter{.weight = 1.0, .blurs = true, .alpha = 0.3},
            NoiseFilter{.weight = 1.0, .blurs = false, .alpha = 0.1},
            NoiseFilter{.weight = 1.0, .blurs = true, .alpha = 0.1}};
}

} // namespace kilolux
