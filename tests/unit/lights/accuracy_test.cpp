// Analytic irradiance against quadrature over random configurations, per light type: the Reach of the
// lighting mathematics. Prints a table with the worst inputs. GGX errors are relative to max(value, 1 % of
// what the light would give at the lobe's peak), for a mirror-coloured metal (F0 = 1) and a dielectric (F0 =
// 0.04), horizon-cut lights included.
#include "tests/unit/lights/random_lights.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <vector>

namespace kilolux::test {
namespace {

struct Errors {
    struct One {
        double error;
        std::string inputs;
    };
    std::vector<One> all;

    void add(double error, const std::string& inputs) { all.push_back({error, inputs}); }
    void sort() {
        std::sort(all.begin(), all.end(), [](const One& a, const One& b) { return a.error < b.error; });
    }
    double at(double share) const {
        return all.empty() ? 0.0
                           : all[static_cast<std::size_t>(share * static_cast<double>(all.size() - 1))].error;
    }
    void print(const char* name, const char* lobe) {
        sort();
        std::printf(
            "%-12s %-11s %4zu lights: median %7.4f %%  p95 %7.4f %%  p99 %7.3f %%  worst %7.3f %%: %s\n",
            name, lobe, all.size(), at(0.5) * 100.0, at(0.95) * 100.0, at(0.99) * 100.0, at(1.0) * 100.0,
            all.empty() ? "" : all.back().inputs.c_str());
    }
};

struct Accuracy : testing::TestWithParam<shared::uint> {
    static void SetUpTestSuite() { bindCommittedTable(); }

    Errors diffuse; // wholly above the horizon
    Errors cut;     // diffuse, the rest
    Errors metal;
    Errors plastic;

    void compare(const Configuration& c, const f64::LightHot& light) {
        const Surface& surface = c.surface;
        const f64::ShadingPoint point =
            f64::makeShadingPoint(surface.position, surface.normal, surface.view, surface.roughness);
        const f64::LtcLobe lobe = f64::makeLtcLobe(point);
        const f64::LightIrradiance found = f64::lightIrradiance(light, point, lobe);
        if (found.emission.x <= 0.0) return;
        const Reflected truth = integrate(c.emitter, surface);
        const std::string inputs = describe(c.emitter, surface);
        const double cosine = directionTo(c.emitter).z;
        const double solidAngle = truth.diffuse / std::max(cosine, 0.05);
        Errors& errors = cosine < sineOf(c.emitter) ? cut : diffuse;
        errors.add(std::abs(found.diffuse - truth.diffuse) / std::max(truth.diffuse, 1e-3 * solidAngle),
                   inputs);
        for (const double f0 : {1.0, 0.04}) {
            const double value = f0 * truth.specular.x + truth.specular.y;
            const double analytic = f0 * found.specular.x + found.specular.y;
            const double most =
                std::min(lobePeak(surface, f0) * solidAngle, f0 * lobe.albedo.x + lobe.albedo.y);
            (f0 == 1.0 ? metal : plastic)
                .add(std::abs(analytic - value) / std::max(value, 0.01 * most), inputs);
        }
    }
};

TEST_P(Accuracy, AnalyticIrradianceAgreesWithQuadrature) {
    const shared::uint type = GetParam();
    Random random{std::mt19937(99 + type)};
    for (int i = 0; i < 800; ++i) {
        Configuration c = randomConfiguration(random, type);
        const double side =
            glm::length(c.emitter.center - c.emitter.x * std::clamp(glm::dot(c.emitter.center, c.emitter.x),
                                                                    -c.emitter.size.y, c.emitter.size.y));
        if (type == shared::LIGHT_TUBE && side < 1.05 * c.emitter.size.x)
            continue; // the receiver is inside or touches it
        const f64::LightHot light = f64::fromF32(hotRecord(c.emitter, glm::vec3(1.0f)));
        c.emitter = emitterOf(light);
        compare(c, light);
    }
    diffuse.print(kTypeNames[type], "diffuse");
    cut.print(kTypeNames[type], "diffuse cut");
    metal.print(kTypeNames[type], "F0 = 1");
    plastic.print(kTypeNames[type], "F0 = 0.04");
    ASSERT_GT(diffuse.all.size(), 300u);
    ASSERT_GT(cut.all.size(), 50u);
    EXPECT_LT(diffuse.at(1.0), 0.005);
    EXPECT_LT(cut.at(0.95), 0.005);
    for (const Errors* errors : {&metal, &plastic}) {
        EXPECT_LT(errors->at(0.5), 0.01);
        EXPECT_LT(errors->at(0.95), 0.05);
    }
}

INSTANTIATE_TEST_SUITE_P(Types, Accuracy,
                         testing::Values(shared::LIGHT_DIRECTIONAL, shared::LIGHT_SPHERE, shared::LIGHT_TUBE,
                                         shared::LIGHT_RECT, shared::LIGHT_DISK),
                         [](const auto& type) { return std::string(kTypeNames[type.param]); });

} // namespace
} // namespace kilolux::test
