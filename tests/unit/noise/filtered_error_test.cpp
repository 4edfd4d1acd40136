// What the masks are for: the error left after the renderer's filters, against white noise, for one decision,
// for points behind an edge, and for lights chosen from whole lists by one number. Bounds are 1.15 times what
// was measured; white noise has 1.
#include "tests/unit/noise/noise_kit.h"

#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <random>

namespace kilolux::test {
namespace {

// Bounds in the order of rendererFilters().
void expectRatios(const std::string& what, const std::vector<Signal>& signals,
                  const std::vector<double>& means, const std::vector<double>& bounds) {
    const std::vector<double> ratios = errorRatios(signals, means);
    ASSERT_EQ(bounds.size(), ratios.size());
    std::printf("squared error against white, %s:", what.c_str());
    for (std::size_t i = 0; i < ratios.size(); ++i) {
        std::printf("%s %s %.3f", i > 0 ? "," : "", rendererFilters()[i].name.c_str(), ratios[i]);
        EXPECT_LT(ratios[i], bounds[i]) << what << ", " << rendererFilters()[i].name;
    }
    std::printf("\n");
}

TEST(FilteredError, StepsOfANumber) {
    for (int channel : {0, 1}) {
        std::vector<Signal> signals;
        const std::vector<double> means = {0.05, 0.2, 0.5, 0.8, 0.95};
        for (double mean : means)
            signals.push_back(
                [=](const f32::PixelNoise& noise) { return noise.numbers[channel] < mean ? 1.0 : 0.0; });
        expectRatios(channel == 0 ? "steps, visible" : "steps, hidden", signals, means,
                     {0.213, 0.394, 0.066, 0.256, 0.045, 0.348, 0.059});
    }
}

// Edges of occluders cross a light at any angle.
TEST(FilteredError, PointsBehindAnEdge) {
    std::vector<Signal> signals;
    std::vector<double> means;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform;
    for (int i = 0; i < 8; ++i) {
        const double angle = 2.0 * M_PI * uniform(random), u = 0.2 + 0.6 * uniform(random),
                     v = 0.2 + 0.6 * uniform(random);
        const auto hidden = [=](double x, double y) {
            return (x - u) * std::cos(angle) + (y - v) * std::sin(angle) < 0.0 ? 1.0 : 0.0;
        };
        double area = 0.0;
        for (int k = 0; k < 1 << 20; ++k)
            area += hidden((k % 1024 + 0.5) / 1024, (k / 1024 + 0.5) / 1024) / (1 << 20);
        signals.push_back([=](const f32::PixelNoise& noise) { return hidden(noise.point.x, noise.point.y); });
        means.push_back(area);
    }
    expectRatios("half-planes", signals, means, {0.246, 0.409, 0.112, 0.293, 0.085, 0.377, 0.103});
}

TEST(FilteredError, PointsWithinAnArea) {
    const std::vector<Signal> signals = {
        [](const f32::PixelNoise& n) { return n.point.x > 0.5f && n.point.y > 0.5f ? 1.0 : 0.0; },
        [](const f32::PixelNoise& n) {
            return n.point.x > 0.3f && n.point.x < 0.6f && n.point.y < 0.7f ? 1.0 : 0.0;
        },
        [](const f32::PixelNoise& n) {
            return std::hypot(n.point.x - 0.5, n.point.y - 0.5) < 0.3 ? 1.0 : 0.0;
        },
        [](const f32::PixelNoise& n) { return n.point.x * n.point.y; }};
    expectRatios("areas", signals, {0.25, 0.21, M_PI * 0.09, 0.25},
                 {0.363, 0.546, 0.170, 0.390, 0.127, 0.485, 0.155});
}

// Lights of unlike weight, of which about a third is hidden: what a pixel shows is its chosen light's
// contribution over the probability, 0 where hidden.
void listOfLights(uint count, std::vector<Signal>& signals, std::vector<double>& means) {
    for (uint scene = 0; scene < 3; ++scene) {
        std::mt19937 random(100 * count + scene);
        std::uniform_real_distribution<double> uniform;
        std::vector<float> weights;
        std::vector<double> shown;
        double sum = 0.0;
        for (uint i = 0; i < count; ++i) {
            weights.push_back(static_cast<float>(std::exp2(4.0 * uniform(random))));
            shown.push_back(uniform(random) < 0.35 ? 0.0 : weights.back() * (0.7 + 0.6 * uniform(random)));
            sum += weights.back();
        }
        double mean = 0.0;
        for (double light : shown)
            mean += light / sum; // in units of the sum of weights
        signals.push_back([=](const f32::PixelNoise& noise) {
            f32::Reservoir reservoir = f32::emptyReservoir(noise.numbers.x);
            float before = 0.0f;
            for (uint i = 0; i < count; ++i) {
                f32::reservoirAdd(reservoir, before, i, weights[i], 1.0f);
                before += weights[i];
            }
            return shown[reservoir.item] / weights[reservoir.item];
        });
        means.push_back(mean);
    }
}

TEST(FilteredError, LightsChosenFromLists) {
    const std::map<uint, std::vector<double>> bounds = {
        {4, {0.139, 0.302, 0.046, 0.204, 0.030, 0.282, 0.040}},
        {16, {0.813, 0.914, 0.467, 0.767, 0.352, 0.843, 0.422}},
        {64, {0.970, 0.970, 0.797, 0.970, 0.700, 0.970, 0.750}}};
    for (const auto& [count, bound] : bounds) {
        std::vector<Signal> signals;
        std::vector<double> means;
        listOfLights(count, signals, means);
        expectRatios(std::to_string(count) + " lights", signals, means, bound);
    }
}

// A second decision by what the first has left of the number: a point's edge by the rest after 4 lights.
TEST(FilteredError, TheRestOfTheNumberStaysBlue) {
    const auto rest = [](const f32::PixelNoise& noise) {
        f32::Reservoir reservoir = f32::emptyReservoir(noise.numbers.x);
        for (uint i = 0; i < 4; ++i)
            f32::reservoirAdd(reservoir, static_cast<float>(i), i, 1.0f, 1.0f);
        return reservoir.number < 0.5f ? 1.0 : 0.0;
    };
    expectRatios("second decision after 4 lights", {rest}, {0.5},
                 {0.536, 0.736, 0.202, 0.511, 0.133, 0.632, 0.178});
}

} // namespace
} // namespace kilolux::test
