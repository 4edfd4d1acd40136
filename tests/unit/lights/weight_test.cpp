// How well the cheap weight of candidate lights follows the analytic light. What is chosen with a weight k
// times too low counts k times too much when it is chosen: the distribution of light over weight is printed
// and bounded, far from lights, near them, and right beside large ones.
#include "renderer/lights_cpp/lights_f32.h"
#include "tests/unit/lights/random_lights.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

namespace kilolux::test {
namespace {

struct Weight : testing::TestWithParam<shared::uint> {
    static void SetUpTestSuite() { bindCommittedTable(); }
};

// The receiver beside or under the light: 1/1000 to 1 of its size away from its plane or axis, under it or a
// little past its edges, on a wall that stands to it anyhow.
Configuration besideLight(Random& random, shared::uint type) {
    Configuration c = randomConfiguration(random, type);
    const bool flat = type == shared::LIGHT_RECT || type == shared::LIGHT_DISK;
    const double width = type == shared::LIGHT_RECT ? c.emitter.size.y : c.emitter.size.x;
    const double length = type == shared::LIGHT_TUBE ? c.emitter.size.y : c.emitter.size.x;
    const double away =
        flat ? length * random.logUniform(1e-3, 1.0) : width * (1.0 + random.logUniform(1e-2, 10.0));
    const dvec3 across = glm::normalize(random.direction() - c.emitter.z * 1e-3);
    const double turn = flat ? 0.0 : random.uniform(0.0, 2.0 * kPi);
    c.emitter.center = c.emitter.x * (length * random.uniform(-1.3, 1.3)) +
                       (c.emitter.z * std::cos(turn) + c.emitter.y * std::sin(turn)) * away;
    if (flat) c.emitter.center += c.emitter.y * (width * random.uniform(-1.3, 1.3));
    if (type == shared::LIGHT_SPHERE || type == shared::LIGHT_SPOT) c.emitter.center = across * away;
    return c;
}

double correlation(const std::vector<dvec2>& pairs) {
    dvec2 mean(0.0);
    for (const dvec2& p : pairs)
        mean += p / static_cast<double>(pairs.size());
    double xy = 0.0;
    dvec2 xx(0.0);
    for (const dvec2& p : pairs) {
        xy += (p.x - mean.x) * (p.y - mean.y);
        xx += (p - mean) * (p - mean);
    }
    return xy / std::sqrt(xx.x * xx.y);
}

// Analytic luminance and weight of a case; a metal reflects by its lobe only.
dvec2 lightAndWeight(const Configuration& c, bool metal) {
    const shared::LightHot light = hotRecord(c.emitter, {3.0f, 2.0f, 1.0f});
    const f32::ShadingPoint point =
        f32::makeShadingPoint(glm::vec3(0.0f), glm::vec3(c.surface.normal), glm::vec3(c.surface.view),
                              static_cast<float>(c.surface.roughness));
    const f32::LightIrradiance lit = f32::lightIrradiance(light, point, f32::makeLtcLobe(point));
    const float albedo = metal ? 0.0f : 0.5f;
    const float f0 = metal ? 0.8f : 0.04f;
    return {f32::luminance(lit.emission) *
                (albedo / float(kPi) * lit.diffuse + f0 * lit.specular.x + lit.specular.y),
            f32::lightWeight(light, point, albedo, f0)};
}

TEST_P(Weight, FollowsTheAnalyticLight) {
    for (const bool beside : {false, true}) {
        if (beside && GetParam() == shared::LIGHT_DIRECTIONAL) continue;
        for (const bool metal : {false, true}) {
            Random random{std::mt19937(55 + GetParam())};
            std::vector<dvec2> logs;
            std::vector<double> ratios;
            for (int i = 0; i < 40000; ++i) {
                const Configuration c =
                    beside ? besideLight(random, GetParam()) : randomConfiguration(random, GetParam());
                const dvec2 pair = lightAndWeight(c, metal);
                if (pair.x <= 1e-12) continue;
                ASSERT_GT(pair.y, 0.0);
                logs.push_back(glm::log2(pair));
                ratios.push_back(pair.x / pair.y);
            }
            std::sort(ratios.begin(), ratios.end());
            const auto at = [&](double share) {
                return ratios[static_cast<std::size_t>(share * static_cast<double>(ratios.size() - 1))];
            };
            std::printf(
                "%-12s %s %s light over weight: p1 %.3f p50 %.3f p90 %.3f p99 %.3f p99.9 %.2f max %.1f, "
                "correlation of log2 %.4f\n",
                kTypeNames[GetParam()], beside ? "beside" : "away  ", metal ? "metal" : "matte", at(0.01),
                at(0.5), at(0.9), at(0.99), at(0.999), at(1.0), correlation(logs));
            EXPECT_GT(correlation(logs), beside ? 0.86 : 0.9);
            EXPECT_LT(at(0.99), metal ? 100.0 : (beside ? 10.0 : 2.0));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Types, Weight, testing::ValuesIn(kAllTypes),
                         [](const auto& type) { return std::string(kTypeNames[type.param]); });

} // namespace
} // namespace kilolux::test
