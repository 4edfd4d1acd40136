// The whole chain over random scenes: walk-like candidates with strides and thresholds, selection, weights.
// The mean over all random decisions, enumerated, must be the sum over all lights.
#include "tests/unit/selection/selection_kit.h"

#include <cmath>
#include <gtest/gtest.h>

namespace kilolux::test {
namespace {

struct SceneLight {
    uint list;
    double light;  // what it contributes, linear
    double weight; // by which it is chosen: related to light, but not equal
};

struct Scene {
    std::vector<SceneLight> lights;
    uint stride;
    double threshold;
    f64::SelectionBudget budget;
    double sum = 0.0;
};

double uniform(std::mt19937& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

Scene randomScene(uint seed) {
    std::mt19937 random(seed);
    Scene scene;
    scene.stride = 1 + seed % 4;
    scene.threshold = 0.02;
    scene.budget = {.hiddenShare = seed % 2 ? 0.2 : 0.5,
                    .hiddenRelaxedBelow = uniform(random, 0.0, 0.5),
                    .directionalShare = 0.5,
                    .directionalFreeBelow = uniform(random, 0.0, 2.0)};
    const uint counts[] = {static_cast<uint>(random() % 4), static_cast<uint>(random() % 6),
                           static_cast<uint>(random() % 3)};
    int dim = 0;
    for (uint list = 0; list < 3; ++list)
        for (uint i = 0; i < counts[list]; ++i) {
            const bool isDim = dim < 3 && random() % 3 == 0;
            dim += isDim ? 1 : 0;
            const double light = isDim ? uniform(random, 0.002, 0.01) : uniform(random, 0.1, 4.0);
            const double weight = f64::perceptualWeight(light * uniform(random, 0.7, 1.4), 1.0);
            scene.lights.push_back({list, light, weight});
            scene.sum += light;
        }
    return scene;
}

struct Mean {
    double byProbability = 0.0; // every outcome counted with its reported probability
    double byNumbers = 0.0;     // over evenly spread numbers
    double variance = 0.0;      // of byNumbers, had these been independent
};

// Of light x contribution over the numbers of the selection, for one set of candidates. The reported
// probabilities must sum to 1, else an outcome was not found.
Mean meanOfSelection(const Scene& scene, const std::vector<f64::Candidate>& candidates) {
    Mean mean;
    double probability = 0.0;
    bool any = false;
    for (const f64::Candidate& candidate : candidates)
        any = any || candidate.weight > 0.0;
    if (!any) return mean;
    for (const auto& [item, choice] : outcomes(candidates, scene.budget)) {
        mean.byProbability += choice.probability * choice.contribution * scene.lights[item].light;
        probability += choice.probability;
    }
    EXPECT_NEAR(probability, 1.0, 1e-9);
    const uint points = 16384; // of a Kronecker sequence (the plastic number's generalization to 3D)
    for (uint i = 0; i < points; ++i) {
        const f64::vec3 numbers = glm::fract(f64::vec3(0.81917251, 0.67104361, 0.54970048) * (i + 0.5));
        const f64::LightChoice c = f64::selectionSample(select(candidates, numbers), scene.budget, 0);
        const double value = c.contribution * scene.lights[c.item].light;
        mean.byNumbers += value / points;
        mean.variance += value * value / points / points;
    }
    mean.variance -= mean.byNumbers * mean.byNumbers / points;
    return mean;
}

TEST(Estimator, MeanIsTheSumOverAllLights) {
    for (uint seed = 0; seed < 40; ++seed) {
        const Scene scene = randomScene(seed);
        Mean mean;
        std::vector<uint> dimLights;
        for (uint i = 0; i < scene.lights.size(); ++i)
            if (scene.lights[i].weight < scene.threshold) dimLights.push_back(i);
        for (uint offset = 0; offset < scene.stride; ++offset)
            for (uint survivors = 0; survivors < 1u << dimLights.size(); ++survivors) {
                double chance = 1.0 / scene.stride; // of this offset and these survivors of the roulette
                std::vector<double> numbers(scene.lights.size(), 0.5);
                for (uint d = 0; d < dimLights.size(); ++d) {
                    const bool survives = (survivors >> d & 1u) != 0;
                    const double survival = scene.lights[dimLights[d]].weight / scene.threshold;
                    chance *= survives ? survival : 1.0 - survival;
                    numbers[dimLights[d]] = survives ? 0.999 * survival : 1.001 * survival;
                }
                std::vector<f64::Candidate> candidates;
                uint entry = 0; // of the cell
                for (uint i = 0; i < scene.lights.size(); ++i) {
                    const SceneLight& light = scene.lights[i];
                    if (light.list == f64::LIST_HIDDEN && entry++ % scene.stride != offset) continue;
                    candidates.push_back(f64::makeCandidate(i, light.list, light.weight, scene.stride,
                                                            scene.threshold, f64::DIM_ROULETTE, numbers[i]));
                }
                const Mean part = meanOfSelection(scene, candidates);
                mean.byProbability += chance * part.byProbability;
                mean.byNumbers += chance * part.byNumbers;
                mean.variance += chance * chance * part.variance;
            }
        EXPECT_NEAR(mean.byProbability, scene.sum, 1e-9 * scene.sum + 1e-12) << "scene " << seed;
        EXPECT_NEAR(mean.byNumbers, scene.sum, 4.0 * std::sqrt(std::max(mean.variance, 0.0)) + 1e-9)
            << "scene " << seed;
    }
}

// Several samples with a point each: a light's points must be even whatever made the sample choose it. Six
// lights whose contribution depends on the point, by 1 + (2 x - 1) + (2 y - 1), seen through a mask.
TEST(Estimator, PointsAreIndependentOfTheChoice) {
    const Lights lights = {{1.0, 2.0, 1.0}, {5.0, 9.0}, {4.0}};
    const std::vector<f64::Candidate> candidates = lights.candidates();
    for (const uint count : {1u, 2u, 4u, 5u}) {
        std::vector<double> mean(candidates.size());
        const uint pixels = 40000;
        for (uint i = 0; i < pixels; ++i) {
            const f64::vec3 numbers = glm::fract(f64::vec3(0.88127150, 0.77663940, 0.68443020) * (i + 0.5));
            const f64::vec2 point = glm::fract(f64::vec2(0.60316880, 0.53155400) * (i + 0.5));
            const f64::LightSelection s = select(candidates, numbers, count);
            for (uint k = 0; k < count; ++k) {
                const f64::LightChoice c = f64::selectionSample(s, defaultBudget(), k);
                const f64::MaskedPoint p = f64::areaMaskWarp(f64::rotatedPoint(point, k, count), 0x33, 0.1);
                const double light = 1.0 + (2.0 * p.uv.x - 1.0) + (2.0 * p.uv.y - 1.0);
                mean[c.item] += light * c.contribution / p.pdf / (count * pixels);
            }
        }
        for (uint item = 0; item < mean.size(); ++item)
            EXPECT_NEAR(mean[item], 1.0, 0.05) << "light " << item << ", " << count << " samples";
    }
}

// The same in float, with white noise for everything, over many pixels of a larger scene.
TEST(Estimator, WhiteNoiseInFloatConverges) {
    std::mt19937 random(5);
    std::vector<SceneLight> lights;
    double sum = 0.0;
    for (uint i = 0; i < 60; ++i) {
        const uint list = i < 8 ? f32::LIST_VISIBLE : i < 58 ? f32::LIST_HIDDEN : f32::LIST_DIRECTIONAL;
        const double light =
            std::pow(10.0, uniform(random, -4.0, 1.0)) * (list == f32::LIST_HIDDEN ? 0.2 : 1.0);
        lights.push_back({list, light, f64::perceptualWeight(light * uniform(random, 0.7, 1.4), 1.0)});
        sum += light;
    }
    const f32::SelectionBudget budget = {0.2f, 0.0f, 0.8f, 0.05f, 0.5f, 0.05f, 0.5f};
    const uint stride = 3;
    const uint pixels = 400000;
    double mean = 0.0;
    double square = 0.0;
    for (uint pixel = 0; pixel < pixels; ++pixel) {
        const uint seed = f32::hashUint(pixel + 1);
        f32::LightSelection s = f32::beginSelection(
            {f32::whiteNoise1(seed, 0), f32::whiteNoise1(seed, 1), f32::whiteNoise1(seed, 2)}, 1);
        const uint offset = f32::cellOffset(f32::whiteNoise1(seed, 3), stride);
        for (uint i = 0; i < lights.size(); ++i) {
            if (lights[i].list == f32::LIST_HIDDEN && i % stride != offset) continue;
            f32::selectionAdd(s, f32::makeCandidate(i, lights[i].list, static_cast<float>(lights[i].weight),
                                                    stride, 0.01f, f32::DIM_ROULETTE,
                                                    f32::whiteNoise1(seed, 10 + i)));
        }
        const f32::LightChoice c = f32::selectionSample(s, budget, 0);
        const double value = c.item == f32::KX_NO_ITEM ? 0.0 : double(c.contribution) * lights[c.item].light;
        mean += value / pixels;
        square += value * value / pixels;
    }
    const double standardError = std::sqrt((square - mean * mean) / pixels);
    EXPECT_LT(standardError, 0.004 * sum) << "the test is blunt";
    EXPECT_NEAR(mean, sum, 4.0 * standardError);
}

} // namespace
} // namespace kilolux::test
