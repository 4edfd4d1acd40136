// Analytic irradiance against quadrature over random configurations, per light type: the Reach of the lighting
// mathematics. Prints a table with the worst inputs.
#include "renderer/lights_cpp/ltc_table.h"
#include "tests/unit/lights/quadrature.h"

#include <algorithm>
#include <cstdio>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace kilolux::test {
namespace {

constexpr const char* kTypeNames[] = {"directional", "sphere", "spot", "tube", "rect", "disk"};

struct Errors {
    struct One {
        double error;
        std::string inputs;
    };
    std::vector<One> all;

    void add(double error, std::string inputs) { all.push_back({error, std::move(inputs)}); }
    double at(double share) {
        std::sort(all.begin(), all.end(), [](const One& a, const One& b) { return a.error < b.error; });
        return all.empty() ? 0.0 : all[static_cast<std::size_t>(share * static_cast<double>(all.size() - 1))].error;
    }
    void print(const char* name, const char* lobe) {
        std::printf("%-12s %-9s %5zu configurations: median %8.4f %%  p95 %8.4f %%  p99 %8.3f %%  worst %8.3f %%  (%s)\n", name,
                    lobe, all.size(), at(0.5) * 100.0, at(0.95) * 100.0, at(0.99) * 100.0, at(1.0) * 100.0,
                    all.empty() ? "" : all.back().inputs.c_str());
    }
};

struct Random {
    std::mt19937 engine;
    double uniform(double low, double high) { return low + (high - low) * (engine() / 4294967296.0); }
    double logUniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
    dvec3 direction() { return f64::sphereFromSquare({uniform(0, 1), uniform(0, 1)}); }
};

struct Configuration {
    Emitter emitter;
    Surface surface;
};

// Half of the lights are aimed at the lobe (within a few of its widths), the others anywhere above the surface;
// sizes from 1/1000 of the distance to wider than it; roughness and viewing angle even over their ranges.
Configuration randomConfiguration(Random& random, shared::uint type) {
    Configuration c;
    c.surface.roughness = random.uniform(0.05, 1.0);
    const double noV = random.uniform(0.05, 1.0);
    const double turn = random.uniform(0.0, 2.0 * kPi);
    c.surface.view = {std::sqrt(1 - noV * noV) * std::cos(turn), std::sqrt(1 - noV * noV) * std::sin(turn), noV};
    const dvec3 mirror(-c.surface.view.x, -c.surface.view.y, noV);
    dvec3 toLight = random.direction();
    if (random.uniform(0, 1) < 0.5)
        toLight = glm::normalize(mirror + toLight * (c.surface.roughness * c.surface.roughness * random.uniform(0.0, 3.0)));
    toLight.z = std::abs(toLight.z);
    c.emitter.type = type;
    const double distance = random.uniform(1.0, 4.0);
    c.emitter.center = toLight * distance;
    const bool sphere = type == shared::LIGHT_SPHERE || type == shared::LIGHT_SPOT;
    const bool flat = type == shared::LIGHT_RECT || type == shared::LIGHT_DISK;
    const double largest = type == shared::LIGHT_DIRECTIONAL ? 0.5 : sphere ? 0.9 * distance : 2.0 * distance;
    c.emitter.size = {random.logUniform(1e-3 * distance, largest), 0.0};
    if (type == shared::LIGHT_RECT)
        c.emitter.size.y = c.emitter.size.x * random.logUniform(0.1, 1.0);
    if (type == shared::LIGHT_TUBE)
        c.emitter.size = {std::min(c.emitter.size.x * 0.1, 0.3 * distance), c.emitter.size.x};
    if (flat) // looks roughly at the receiver
        c.emitter.z = glm::normalize(toLight * 1.2 + random.direction());
    else
        c.emitter.z = type == shared::LIGHT_DIRECTIONAL ? toLight : random.direction();
    const glm::dmat3 frame = f64::basisFromNormalTangent(c.emitter.z, random.direction());
    c.emitter.x = frame[0];
    c.emitter.y = frame[1];
    return c;
}

double radianceOf(const f64::LightHot& light, const dvec3& receiver) {
    return f64::lightEvaluate(light, receiver).x;
}

// Radius of a sphere about the centre that holds the emitter, over its distance.
double sineOf(const Emitter& e) {
    if (e.type == shared::LIGHT_DIRECTIONAL)
        return e.size.x;
    const double radius = e.type == shared::LIGHT_TUBE ? e.size.x + e.size.y : glm::length(e.size);
    return radius / glm::length(e.center);
}

class Accuracy : public testing::TestWithParam<shared::uint> {
  protected:
    static void SetUpTestSuite() {
        auto table = loadLtcTable(KILOLUX_SOURCE_DIR "/content/ltc_ggx.bin");
        ASSERT_TRUE(table) << table.error();
        useLtcTable(table.value());
    }
};

TEST_P(Accuracy, AnalyticIrradianceAgreesWithQuadrature) {
    const shared::uint type = GetParam();
    Random random{std::mt19937(1234 + type)};
    Errors diffuse;
    Errors horizon;
    Errors metal;
    Errors plastic;
    for (int i = 0; i < 1500; ++i) {
        Configuration c = randomConfiguration(random, type);
        const f64::LightHot light = f64::fromF32(hotRecord(c.emitter, glm::vec3(1.0f)));
        c.emitter = emitterOf(light);
        const f64::ShadingPoint point = f64::makeShadingPoint(c.surface.position, c.surface.normal, c.surface.view, c.surface.roughness);
        const f64::LightIrradiance analytic = f64::lightIrradiance(light, point, f64::makeLtcLobe(point));
        if (radianceOf(light, c.surface.position) <= 0.0)
            continue;
        const Reflected truth = integrate(c.emitter, c.surface);
        const std::string inputs = describe(c.emitter, c.surface);
        const dvec3 toCenter = type == shared::LIGHT_DIRECTIONAL ? c.emitter.z : glm::normalize(c.emitter.center);
        const double solidAngle = truth.diffuse / std::max(toCenter.z, 0.05);
        const bool cut = toCenter.z < sineOf(c.emitter);
        (cut ? horizon : diffuse).add(std::abs(analytic.diffuse - truth.diffuse) / std::max(truth.diffuse, 1e-3 * solidAngle), inputs);
        for (const double f0 : {1.0, 0.04}) {
            const double value = f0 * truth.specular.x + truth.specular.y;
            const double found = f0 * analytic.specular.x + analytic.specular.y;
            const f64::LtcLobe lobe = f64::makeLtcLobe(point);
            const double most = std::min(lobePeak(c.surface, f0) * solidAngle, f0 * lobe.albedo.x + lobe.albedo.y);
            (f0 == 1.0 ? metal : plastic).add(std::abs(found - value) / std::max(value, 0.01 * most), inputs);
        }
    }
    diffuse.print(kTypeNames[type], "diffuse");
    horizon.print(kTypeNames[type], "d.cut");
    metal.print(kTypeNames[type], "F0=1");
    plastic.print(kTypeNames[type], "F0=0.04");
    EXPECT_LT(diffuse.at(1.0), 0.005);
    EXPECT_LT(metal.at(0.5), 0.01);
    EXPECT_LT(metal.at(0.95), 0.05);
    EXPECT_LT(plastic.at(0.5), 0.01);
    EXPECT_LT(plastic.at(0.95), 0.05);
}

INSTANTIATE_TEST_SUITE_P(Types, Accuracy,
                         testing::Values(shared::LIGHT_DIRECTIONAL, shared::LIGHT_SPHERE, shared::LIGHT_TUBE,
                                         shared::LIGHT_RECT, shared::LIGHT_DISK),
                         [](const auto& info) { return std::string(kTypeNames[info.param]); });

} // namespace
} // namespace kilolux::test
