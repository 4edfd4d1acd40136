// Hard inputs: the same source in float and in double, and no NaN, infinity or negative number anywhere. The
// difference is the numerical error of what shaders compute; it is printed per type and bounded.
#include "renderer/lights_cpp/lights_f32.h"
#include "tests/unit/lights/random_lights.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

namespace kilolux::test {
namespace {

struct Robustness : testing::TestWithParam<shared::uint> {
    static void SetUpTestSuite() { bindCommittedTable(); }
};

struct Case {
    shared::LightHot light;
    glm::vec3 receiver;
    glm::vec3 normal;
    glm::vec3 view;
    float roughness;
};

// Tiny and huge, near and far, in the light's plane, on its axis, inside it, grazing, 10 km from the origin.
Case hardCase(Random& random, shared::uint type) {
    Configuration c = randomConfiguration(random, type);
    const double scale = random.logUniform(1e-3, 1e4);
    c.emitter.size *= scale * (random.uniform(0, 1) < 0.5 ? random.logUniform(1e-5, 1.0) : 1.0);
    dvec3 receiver = -c.emitter.center * scale * random.logUniform(0.01, 1.0);
    c.emitter.center = dvec3(0.0);
    const int kind = static_cast<int>(random.uniform(0.0, 8.0));
    if (kind == 0) // in the plane of the light, or on the tube's axis
        receiver = c.emitter.x * glm::length(receiver);
    if (kind == 1) receiver = c.emitter.z * glm::length(receiver);
    if (kind == 2) receiver *= 1e-6;
    if (kind == 3) receiver -= c.emitter.z * glm::dot(receiver, c.emitter.z) * (1.0 - 1e-5);
    dvec3 normal = c.surface.normal;
    dvec3 view = c.surface.view;
    if (kind == 4) // grazing view
        view = glm::normalize(dvec3(view.x, view.y, random.logUniform(1e-6, 1e-2)));
    if (kind == 5) // light about at the horizon
        normal = glm::normalize(glm::cross(glm::normalize(receiver), random.direction()) +
                                receiver * (1e-4 / glm::length(receiver)));
    if (kind == 5) view = glm::normalize(normal + random.direction() * 0.9);
    const dvec3 shift = random.uniform(0, 1) < 0.2 ? dvec3(6000.0, 100.0, -8000.0) : dvec3(0.0);
    c.emitter.center += shift;
    const float roughness = random.uniform(0, 1) < 0.3 ? 0.0f : static_cast<float>(c.surface.roughness);
    return {hotRecord(c.emitter, {3.0f, 2.0f, 1.0f}), glm::vec3(receiver + shift), glm::vec3(normal),
            glm::vec3(view), roughness};
}

std::string describe(const Case& c) {
    char text[400];
    std::snprintf(text, sizeof(text),
                  "light at (%g %g %g) dir (%g %g %g) size (%g %g), receiver (%.8g %.8g %.8g), normal (%g %g "
                  "%g), view (%g %g %g), roughness %g",
                  c.light.positionWs.x, c.light.positionWs.y, c.light.positionWs.z, c.light.dirWs.x,
                  c.light.dirWs.y, c.light.dirWs.z, c.light.sizeM.x, c.light.sizeM.y, c.receiver.x,
                  c.receiver.y, c.receiver.z, c.normal.x, c.normal.y, c.normal.z, c.view.x, c.view.y,
                  c.view.z, c.roughness);
    return text;
}

bool sound(double value) {
    return std::isfinite(value) && value >= 0.0;
}

TEST_P(Robustness, FloatAgreesWithDoubleAndStaysFinite) {
    Random random{std::mt19937(77 + GetParam())};
    std::vector<std::pair<double, std::string>> diffuse;
    std::vector<std::pair<double, std::string>> specular;
    for (int i = 0; i < 20000; ++i) {
        const Case c = hardCase(random, GetParam());
        const f32::ShadingPoint point = f32::makeShadingPoint(c.receiver, c.normal, c.view, c.roughness);
        const f32::LtcLobe lobe = f32::makeLtcLobe(point);
        const f32::LightIrradiance found = f32::lightIrradiance(c.light, point, lobe);
        ASSERT_TRUE(sound(found.diffuse) && sound(found.specular.x) && sound(found.specular.y) &&
                    sound(found.emission.x))
            << describe(c);
        const f64::LightHot light = f64::fromF32(c.light);
        const f64::ShadingPoint exactPoint = f64::makeShadingPoint(
            dvec3(c.receiver), glm::normalize(dvec3(c.normal)), glm::normalize(dvec3(c.view)), c.roughness);
        const f64::LtcLobe exactLobe = f64::makeLtcLobe(exactPoint);
        const f64::LightIrradiance exact = f64::lightIrradiance(light, exactPoint, exactLobe);
        ASSERT_TRUE(sound(exact.diffuse) && sound(exact.specular.x) && sound(exact.specular.y))
            << describe(c);
        if ((found.emission.x > 0.0f) != (exact.emission.x > 0.0))
            continue; // on the plane of a one-sided light
        // What the light would give if it were turned to the receiver and stood overhead.
        const f64::EmitterOutline outline = f64::lightOutline(light, dvec3(c.receiver), 1.0);
        const double full =
            std::max(std::min(outline.solidAngle, kPi), kPi * outline.angularRadius * outline.angularRadius);
        diffuse.emplace_back(std::abs(found.diffuse - exact.diffuse) /
                                 std::max({exact.diffuse, 0.01 * full, 1e-30}),
                             describe(c));
        const double value = exact.specular.x + exact.specular.y;
        const double most = std::min(full / (kPi * 4.0 * std::pow(exactPoint.alpha, 2.0)),
                                     exactLobe.albedo.x + exactLobe.albedo.y);
        specular.emplace_back(std::abs(found.specular.x + found.specular.y - value) /
                                  std::max({value, 0.01 * most, 1e-30}),
                              describe(c));
    }
    for (auto* errors : {&diffuse, &specular}) {
        std::sort(errors->begin(), errors->end());
        const auto at = [&](double share) {
            return errors->at(static_cast<std::size_t>(share * static_cast<double>(errors->size() - 1)))
                .first;
        };
        std::printf("%-12s %-8s float against double: median %.2e  p99 %.2e  p99.9 %.2e  worst %.2e: %s\n",
                    kTypeNames[GetParam()], errors == &diffuse ? "diffuse" : "GGX", at(0.5), at(0.99),
                    at(0.999), at(1.0), errors->back().second.c_str());
        EXPECT_LT(at(0.5), 1e-6);
        // Half of the cases of one-sided lights lie in their plane or touch them, to 1e-5 of the light's
        // size: there float cannot tell how much of the lobe the sliver covers.
        const bool flat = GetParam() == shared::LIGHT_RECT || GetParam() == shared::LIGHT_DISK;
        EXPECT_LT(at(0.99), errors == &specular && flat ? 0.15 : 5e-3);
        EXPECT_LT(at(0.999), errors == &specular && flat ? 100.0 : 0.15);
    }
}

TEST_P(Robustness, SamplesAndHitsStaySound) {
    Random random{std::mt19937(99 + GetParam())};
    for (int i = 0; i < 20000; ++i) {
        const Case c = hardCase(random, GetParam());
        dvec2 uv(random.uniform(0, 1), random.uniform(0, 1));
        if (i % 10 == 0) uv = {std::round(uv.x), std::round(uv.y)};
        const f32::LightSample s = f32::lightSample(c.light, c.receiver, glm::vec2(uv));
        ASSERT_TRUE(sound(s.geometry) && sound(s.pdfArea) && sound(s.pdfSolidAngle) && sound(s.distanceM))
            << describe(c);
        if (!s.valid) continue;
        ASSERT_NEAR(glm::length(s.dirWs), 1.0f, 1e-5f) << describe(c);
        ASSERT_TRUE(s.uv.x >= 0.0f && s.uv.x <= 1.0f && s.uv.y >= 0.0f && s.uv.y <= 1.0f) << describe(c);
        const f32::LightHit hit = f32::lightIntersect(c.light, c.receiver, s.dirWs);
        ASSERT_TRUE(sound(hit.distanceM) && sound(hit.pdfSolidAngle) && sound(hit.pdfArea)) << describe(c);
        ASSERT_TRUE(hit.uv.x >= 0.0f && hit.uv.x <= 1.0f && hit.uv.y >= 0.0f && hit.uv.y <= 1.0f)
            << describe(c);
    }
}

// Never 0 for a light that contributes.
TEST_P(Robustness, WeightIsPositiveWhereverLightArrives) {
    Random random{std::mt19937(55 + GetParam())};
    for (int i = 0; i < 20000; ++i) {
        const Case c = hardCase(random, GetParam());
        const f32::ShadingPoint point = f32::makeShadingPoint(c.receiver, c.normal, c.view, c.roughness);
        const f32::LightIrradiance lit = f32::lightIrradiance(c.light, point, f32::makeLtcLobe(point));
        const float weight = f32::lightWeight(c.light, point, i % 2 ? 0.5f : 0.0f, i % 2 ? 0.04f : 0.8f);
        ASSERT_TRUE(sound(weight)) << describe(c);
        if (f32::luminance(lit.emission) * (lit.diffuse + lit.specular.x + lit.specular.y) > 0.0f) {
            ASSERT_GT(weight, 0.0) << describe(c);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Types, Robustness, testing::ValuesIn(kAllTypes),
                         [](const auto& type) { return std::string(kTypeNames[type.param]); });

} // namespace
} // namespace kilolux::test
