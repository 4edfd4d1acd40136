// What the values of the committed masks are: evenly spread in every layer, over layers and at every pixel,
// and independent between channels; low in power where the filters pass.
#include "tests/unit/noise/noise_kit.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace kilolux::test {
namespace {

constexpr int kSize = NoiseMask::kWidth;
constexpr int kArea = kSize * kSize;
constexpr int kLayers = NoiseMask::kLayers;
const char* const kChannels[4] = {"visible", "hidden", "point u", "point v"};

double value(int channel, int pixel, int layer) {
    return (committedMask().at(pixel % kSize, pixel / kSize, layer)[channel] + 0.5) / 65536.0;
}

TEST(NoiseMaskValues, EveryStratumOfALayerHasOneNumber) {
    for (int channel = 0; channel < 4; ++channel)
        for (int layer = 0; layer < kLayers; ++layer) {
            std::set<int> strata;
            for (int pixel = 0; pixel < kArea; ++pixel)
                strata.insert(static_cast<int>(value(channel, pixel, layer) * kArea));
            ASSERT_EQ(strata.size(), static_cast<std::size_t>(kArea))
                << kChannels[channel] << " layer " << layer;
        }
}

// So that nothing of 16 bits is left out in the long run.
TEST(NoiseMaskValues, SixteenLayersHoldEvery16BitNumberOnce) {
    for (int channel = 0; channel < 4; ++channel)
        for (int first = 0; first < kLayers; first += 16) {
            std::vector<bool> seen(65536);
            for (int layer = first; layer < first + 16; ++layer)
                for (int pixel = 0; pixel < kArea; ++pixel)
                    seen[static_cast<int>(value(channel, pixel, layer) * 65536)] = true;
            EXPECT_EQ(std::count(seen.begin(), seen.end(), true), 65536)
                << kChannels[channel] << " from " << first;
        }
}

// All 13 ways to cut the square into 4096 equal boxes of powers of two: one point in each, in every layer.
TEST(NoiseMaskValues, PointsOfALayerAreANet) {
    for (int layer = 0; layer < kLayers; ++layer)
        for (int bitsU = 0; bitsU <= 12; ++bitsU) {
            std::set<int> boxes;
            for (int pixel = 0; pixel < kArea; ++pixel) {
                const int column = static_cast<int>(value(2, pixel, layer) * (1 << bitsU));
                const int row = static_cast<int>(value(3, pixel, layer) * (1 << (12 - bitsU)));
                boxes.insert(column << (12 - bitsU) | row);
            }
            ASSERT_EQ(boxes.size(), static_cast<std::size_t>(kArea)) << "layer " << layer << ", " << bitsU;
        }
}

// Largest gap between the share of values below x and x itself.
double starDiscrepancy(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    double worst = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double n = static_cast<double>(values.size());
        worst = std::max({worst, values[i] - i / n, (i + 1) / n - values[i]});
    }
    return worst;
}

// White noise of 32 numbers has a mean discrepancy of 0.150, of 8 numbers 0.29.
TEST(NoiseMaskValues, APixelsNumbersAreSpreadInTime) {
    for (int channel = 0; channel < 4; ++channel) {
        double cycle = 0.0, eighths = 0.0;
        for (int pixel = 0; pixel < kArea; ++pixel) {
            std::vector<double> numbers;
            for (int layer = 0; layer < kLayers; ++layer)
                numbers.push_back(value(channel, pixel, layer));
            cycle += starDiscrepancy(numbers) / kArea;
            for (int first = 0; first < kLayers; first += 8)
                eighths +=
                    starDiscrepancy({numbers.begin() + first, numbers.begin() + first + 8}) / kArea / 4;
        }
        std::printf("mean discrepancy of a pixel's numbers, %s: 32 frames %.4f, 8 frames %.4f\n",
                    kChannels[channel], cycle, eighths);
        EXPECT_LT(cycle, channel < 2 ? 0.05 : 0.08);
        EXPECT_LT(eighths, channel < 2 ? 0.20 : 0.225);
    }
}

// The spread of a correlation of 131,072 independent pairs is 0.0028.
TEST(NoiseMaskValues, ChannelsAreIndependent) {
    const auto correlation = [](const auto& f, const auto& g) {
        double fg = 0.0, ff = 0.0, gg = 0.0;
        for (int layer = 0; layer < kLayers; ++layer)
            for (int pixel = 0; pixel < kArea; ++pixel) {
                const double a = f(pixel, layer), b = g(pixel, layer);
                fg += a * b, ff += a * a, gg += b * b;
            }
        return fg / std::sqrt(ff * gg);
    };
    for (int a = 0; a < 4; ++a)
        for (int b = a + 1; b < 4; ++b) {
            const auto straight = [](int channel) {
                return [channel](int pixel, int layer) { return value(channel, pixel, layer) - 0.5; };
            };
            const auto folded = [](int channel) { // finds what is tied symmetrically
                return
                    [channel](int p, int layer) { return std::abs(value(channel, p, layer) - 0.5) - 0.25; };
            };
            EXPECT_LT(std::abs(correlation(straight(a), straight(b))), 0.012)
                << kChannels[a] << ' ' << kChannels[b];
            EXPECT_LT(std::abs(correlation(folded(a), folded(b))), 0.012)
                << kChannels[a] << ' ' << kChannels[b];
        }
}

using Complex = std::complex<double>;

// Power of `count` numbers per frequency 0 .. count - 1; white noise of variance 1/12 has 1 everywhere.
void transform(std::vector<Complex>& line) {
    const std::size_t count = line.size();
    std::vector<Complex> turns(count), result(count);
    for (std::size_t i = 0; i < count; ++i)
        turns[i] = std::polar(1.0, -2.0 * M_PI * static_cast<double>(i) / static_cast<double>(count));
    for (std::size_t k = 0; k < count; ++k)
        for (std::size_t i = 0; i < count; ++i)
            result[k] += line[i] * turns[i * k % count];
    line = result;
}

// Mean power over layers by distance from the origin in whole cycles per tile, 0 to 45.
std::vector<double> radialPower(int channel) {
    std::vector<double> power(46), counts(46);
    for (int layer = 0; layer < kLayers; ++layer) {
        std::vector<std::vector<Complex>> rows(kSize, std::vector<Complex>(kSize));
        for (int pixel = 0; pixel < kArea; ++pixel)
            rows[pixel / kSize][pixel % kSize] = value(channel, pixel, layer) - 0.5;
        for (auto& row : rows)
            transform(row);
        for (int x = 0; x < kSize; ++x) {
            std::vector<Complex> column(kSize);
            for (int y = 0; y < kSize; ++y)
                column[y] = rows[y][x];
            transform(column);
            for (int y = 0; y < kSize; ++y) {
                const auto bin = static_cast<std::size_t>(
                    std::lround(std::hypot(std::min(x, kSize - x), std::min(y, kSize - y))));
                power[bin] += std::norm(column[y]) * 12.0 / kArea;
                counts[bin] += 1.0;
            }
        }
    }
    for (std::size_t bin = 0; bin < power.size(); ++bin)
        power[bin] /= std::max(1.0, counts[bin]);
    return power;
}

double meanOf(const std::vector<double>& power, int first, int last) {
    double sum = 0.0;
    for (int i = first; i <= last; ++i)
        sum += power[i];
    return sum / (last - first + 1);
}

TEST(NoiseSpectrum, LayersHaveLittlePowerAtLowFrequencies) {
    for (int channel = 0; channel < 4; ++channel) {
        const std::vector<double> power = radialPower(channel);
        std::printf("power of a layer against white, %s:", kChannels[channel]);
        for (int bin : {1, 2, 4, 8, 12, 16, 20, 24, 28, 32, 40})
            std::printf(" %d:%.3f", bin, power[bin]);
        std::printf("  (1 to 8: %.4f, 24 to 32: %.2f)\n", meanOf(power, 1, 8), meanOf(power, 24, 32));
        EXPECT_LT(meanOf(power, 1, 8), 0.008); // measured 0.005 to 0.006
        EXPECT_GT(meanOf(power, 24, 32), 1.3);
        EXPECT_LT(power[0], 0.001); // the layer's mean is right
    }
}

TEST(NoiseSpectrum, APixelHasLittlePowerAtLowFrequenciesInTime) {
    for (int channel = 0; channel < 4; ++channel) {
        std::vector<double> power(kLayers);
        for (int pixel = 0; pixel < kArea; ++pixel) {
            std::vector<Complex> line(kLayers);
            for (int layer = 0; layer < kLayers; ++layer)
                line[layer] = value(channel, pixel, layer) - 0.5;
            transform(line);
            for (int k = 0; k < kLayers; ++k)
                power[k] += std::norm(line[k]) * 12.0 / kLayers / kArea;
        }
        std::printf("power of a pixel in time against white, %s:", kChannels[channel]);
        for (int k = 0; k <= kLayers / 2; ++k)
            std::printf(" %.3f", power[k]);
        std::printf("\n");
        EXPECT_LT(meanOf(power, 0, 2), 0.1); // measured 0.075 to 0.09
        EXPECT_GT(power[kLayers / 2], 1.2);
    }
}

} // namespace
} // namespace kilolux::test
