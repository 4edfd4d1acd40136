// Irradiance and flux against closed forms, per light type.
#include "tests/unit/lights/random_lights.h"

#include <cmath>
#include <gtest/gtest.h>

namespace kilolux::test {
namespace {

struct ClosedForm : testing::Test {
    static void SetUpTestSuite() { bindCommittedTable(); }
};

struct Lit {
    double diffuse; // lux
    dvec2 specular; // nit for F0 = 1 - weight and weight
};

// At the origin.
Lit lightAt(const Emitter& emitter, double intensity, const dvec3& normal, double roughness = 0.5) {
    const f64::LightHot light = f64::fromF32(hotRecord(emitter, glm::vec3(static_cast<float>(intensity))));
    const f64::ShadingPoint point = f64::makeShadingPoint(dvec3(0.0), normal, normal, roughness);
    const f64::LightIrradiance lit = f64::lightIrradiance(light, point, f64::makeLtcLobe(point));
    return {lit.diffuse * lit.emission.x, lit.specular * lit.emission.x};
}

Emitter emitter(shared::uint type, const dvec3& center, const dvec3& z, const dvec3& x, const dvec2& size) {
    return {type, center, x, glm::cross(z, x), z, size};
}

TEST_F(ClosedForm, PointFollowsTheInverseSquareLaw) {
    for (const double distance : {0.01, 1.0, 7.0, 1000.0}) {
        const dvec3 dir = glm::normalize(dvec3(0.3, -0.2, 0.8));
        const Emitter point = emitter(shared::LIGHT_SPHERE, dir * distance, {0, 0, 1}, {1, 0, 0}, {0, 0});
        EXPECT_NEAR(lightAt(point, 100.0, {0, 0, 1}).diffuse * distance * distance / (100.0 * dir.z), 1.0,
                    1e-5);
        const Emitter ball =
            emitter(shared::LIGHT_SPHERE, dir * distance, {0, 0, 1}, {1, 0, 0}, {0.4 * distance, 0});
        EXPECT_NEAR(lightAt(ball, 100.0, {0, 0, 1}).diffuse * distance * distance / (100.0 * dir.z), 1.0,
                    1e-5);
    }
}

TEST_F(ClosedForm, DirectionalGivesItsIlluminanceTimesTheCosine) {
    const dvec3 z = glm::normalize(dvec3(0.5, 0.1, 0.6));
    for (const double tangent : {0.0, 0.004654, 0.3}) {
        const Emitter sun = emitter(shared::LIGHT_DIRECTIONAL, {0, 0, 0}, z,
                                    glm::normalize(glm::cross(z, dvec3(0, 1, 0))), {tangent, 0});
        EXPECT_NEAR(lightAt(sun, 80000.0, {0, 0, 1}).diffuse / (80000.0 * z.z), 1.0, 1e-5) << tangent;
    }
}

// Snyder, "Area Light Sources for Real-Time Graphics", 1996, in the form of Lagarde and de Rousiers 2014,
// listing 7.
double sphereOverPlane(double sine, double cosine) {
    const double h2 = 1.0 / (sine * sine);
    if (cosine >= sine * (1.0 - 1e-9)) return kPi * cosine / h2;
    const double x = std::sqrt(h2 - 1.0);
    const double sinNormal = std::sqrt(1.0 - cosine * cosine);
    const double y = -x * cosine / sinNormal;
    const double root = sinNormal * std::sqrt(1.0 - y * y);
    return (cosine * std::acos(y) - x * root) / h2 + std::atan(root / x);
}

TEST_F(ClosedForm, SphereCutByTheHorizon) {
    for (const double sine : {0.02, 0.3, 0.7, 0.95})
        for (const double part : {-0.9, -0.5, 0.0, 0.3, 0.8, 1.0, 2.0}) {
            const double cosine = std::min(part * sine, 1.0);
            const dvec3 dir(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
            const Emitter ball =
                emitter(shared::LIGHT_SPHERE, dir * 2.0, {0, 0, 1}, {1, 0, 0}, {2.0 * sine, 0});
            const double radiance = 1.0 / (kPi * 4.0 * sine * sine);
            const double expected = sphereOverPlane(sine, cosine) * radiance;
            const double full = kPi * sine * sine * radiance * sine;
            EXPECT_NEAR(lightAt(ball, 1.0, {0, 0, 1}).diffuse, expected, 2e-3 * expected + 5e-4 * full)
                << "sine " << sine << " cosine " << cosine;
        }
}

// Howell, "A Catalog of Radiation Heat Transfer Configuration Factors", B-3: a quarter of a rectangle
// overhead.
double quarterFactor(double a, double b) {
    const double sa = std::sqrt(1.0 + a * a);
    const double sb = std::sqrt(1.0 + b * b);
    return (a / sa * std::atan(b / sa) + b / sb * std::atan(a / sb)) / (2.0 * kPi);
}

TEST_F(ClosedForm, RectangleOverhead) {
    for (const double height : {0.01, 0.3, 1.0, 5.0, 100.0}) {
        const Emitter rect = emitter(shared::LIGHT_RECT, {0, 0, height}, {0, 0, 1}, {1, 0, 0}, {0.8, 0.3});
        const double radiance = 10.0 / (4.0 * 0.8 * 0.3);
        const double expected = 4.0 * kPi * radiance * quarterFactor(0.8 / height, 0.3 / height);
        EXPECT_NEAR(lightAt(rect, 10.0, {0, 0, 1}).diffuse / expected, 1.0, 1e-4) << height;
        // Half of it below the horizon of a wall: B-4 by symmetry needs no other formula than the walls' sum.
        const double wall = lightAt(rect, 10.0, {1, 0, 0}).diffuse;
        EXPECT_NEAR(wall, lightAt(rect, 10.0, {-1, 0, 0}).diffuse, 1e-6 * wall);
    }
}

// Howell B-4: an element square to the plane of a rectangle, one corner of which lies straight ahead.
TEST_F(ClosedForm, RectangleOnAWallSeenFromTheFloor) {
    const double a = 1.5; // width
    const double b = 0.8; // height above the floor
    const double c = 0.6; // distance of the element from the wall
    const Emitter rect = emitter(shared::LIGHT_RECT, {c, a / 2, b / 2}, {1, 0, 0}, {0, 1, 0}, {a / 2, b / 2});
    const double x = a / b;
    const double y = c / b;
    const double root = std::sqrt(x * x + y * y);
    const double alpha = 1.0 / std::sqrt(1.0 + y * y);
    // Integral of z over distance^4, in closed form, with the corner at (c, 0, 0).
    const double factor =
        (std::atan(x / y) - y / std::sqrt(1.0 + y * y) * std::atan(x * alpha)) / (2.0 * kPi);
    ASSERT_GT(root, 0.0);
    EXPECT_NEAR(lightAt(rect, 1.0, {0, 0, 1}).diffuse / (kPi / (a * b) * factor), 1.0, 1e-4);
}

TEST_F(ClosedForm, DiskOverheadAndAside) {
    const double radius = 0.7;
    const double radiance = 1.0 / (kPi * radius * radius);
    for (const double height : {0.05, 0.5, 2.0, 50.0}) {
        const Emitter above = emitter(shared::LIGHT_DISK, {0, 0, height}, {0, 0, 1}, {1, 0, 0}, {radius, 0});
        const double expected = kPi * radiance * radius * radius / (radius * radius + height * height);
        EXPECT_NEAR(lightAt(above, 1.0, {0, 0, 1}).diffuse / expected, 1.0, 1e-3) << height;
        // Howell B-13: parallel, off the axis by `aside`.
        for (const double aside : {0.4, 1.5}) {
            const double h = height / aside;
            const double r = radius / aside;
            const double z = 1.0 + h * h + r * r;
            const double factor = 0.5 * (1.0 - (z - 2.0 * r * r) / std::sqrt(z * z - 4.0 * r * r));
            const Emitter off =
                emitter(shared::LIGHT_DISK, {aside, 0, height}, {0, 0, 1}, {1, 0, 0}, {radius, 0});
            EXPECT_NEAR(lightAt(off, 1.0, {0, 0, 1}).diffuse / (kPi * radiance * factor), 1.0, 3e-3)
                << height << ", " << aside;
        }
    }
}

TEST_F(ClosedForm, ThinTubeOverhead) {
    const double radius = 1e-3;
    const double halfLength = 0.6;
    for (const double height : {0.2, 1.0, 10.0}) {
        const Emitter tube =
            emitter(shared::LIGHT_TUBE, {0, 0, height}, {0, 0, 1}, {1, 0, 0}, {radius, halfLength});
        const double radiance = 1.0 / (4.0 * radius * halfLength + kPi * radius * radius);
        const double angle = std::atan(halfLength / height);
        const double line = 2.0 * radiance * radius / height * (angle + std::sin(angle) * std::cos(angle));
        const double distance2 = height * height + halfLength * halfLength;
        const double ends = radiance * kPi * radius * radius * height / (distance2 * std::sqrt(distance2));
        EXPECT_NEAR(lightAt(tube, 1.0, {0, 0, 1}).diffuse / (line + ends), 1.0, 2e-3) << height;
    }
}

// The furnace: a light that fills the hemisphere gives pi L, and the specular albedo.
TEST_F(ClosedForm, LightThatFillsTheSkyGivesTheAlbedo) {
    const double size = 1e5;
    const Emitter sky = emitter(shared::LIGHT_RECT, {0, 0, 1}, {0, 0, 1}, {1, 0, 0}, {size, size});
    const double intensity = 4.0 * size * size;
    for (const double roughness : {0.05, 0.3, 0.6, 1.0}) {
        const Lit lit = lightAt(sky, intensity, {0, 0, 1}, roughness);
        const f64::ShadingPoint point = f64::makeShadingPoint(dvec3(0.0), {0, 0, 1}, {0, 0, 1}, roughness);
        const f64::LtcLobe lobe = f64::makeLtcLobe(point);
        EXPECT_NEAR(lit.diffuse, kPi, 1e-3);
        EXPECT_NEAR(lit.specular.x + lit.specular.y, lobe.albedo.x + lobe.albedo.y, 2e-3) << roughness;
    }
}

// What a light sends through a sphere of 60 m around it is its flux.
TEST_F(ClosedForm, FluxIsWhatLeavesTheLight) {
    for (const shared::uint type : {shared::LIGHT_SPHERE, shared::LIGHT_SPOT, shared::LIGHT_TUBE,
                                    shared::LIGHT_RECT, shared::LIGHT_DISK}) {
        const dvec3 z = glm::normalize(dvec3(0.3, -0.5, 0.7));
        const dvec3 x = glm::normalize(glm::cross(z, dvec3(0, 1, 0)));
        const dvec2 size = type == shared::LIGHT_TUBE ? dvec2(0.1, 0.4) : dvec2(0.3, 0.2);
        f64::LightHot light =
            f64::fromF32(hotRecord(emitter(type, {0, 0, 0}, z, x, size), {30.0f, 50.0f, 20.0f}));
        const double scale = 1.0 / (std::cos(0.3) - std::cos(0.7));
        light.shaping = {scale, -std::cos(0.7) * scale};
        double flux = 0.0;
        const int count = 160;
        for (int i = 0; i < count * count; ++i) {
            const dvec3 dir = f64::sphereFromSquare({(i % count + 0.5) / count, (i / count + 0.5) / count});
            const f64::ShadingPoint point = f64::makeShadingPoint(dir * 60.0, -dir, -dir, 0.5);
            const f64::LightIrradiance lit = f64::lightIrradiance(light, point, f64::makeLtcLobe(point));
            flux += f64::luminance(lit.emission) * lit.diffuse * 4.0 * kPi * 3600.0 / (count * count);
        }
        EXPECT_NEAR(flux / f64::lightFlux(light), 1.0, 2e-3) << kTypeNames[type];
    }
}

TEST_F(ClosedForm, RangeWindowAndBounds) {
    f64::LightHot light = f64::fromF32(
        hotRecord(emitter(shared::LIGHT_SPHERE, {1, 2, 3}, {0, 0, 1}, {1, 0, 0}, {0, 0}), glm::vec3(1.0f)));
    light.invRange = 0.25;
    EXPECT_NEAR(f64::lightEvaluate(light, {1, 2, 5}).x, 1.0 - std::pow(0.5, 4.0), 1e-9);
    EXPECT_EQ(f64::lightEvaluate(light, {1, 2, 7.001}).x, 0.0);
    EXPECT_NEAR(f64::lightBounds(light).radiusM, 4.0, 1e-9);
    light.typeFlags |= shared::LIGHT_FLAG_MUTED;
    EXPECT_EQ(f64::lightEvaluate(light, {1, 2, 5}).x, 0.0);
    EXPECT_EQ(f64::lightBounds(light).radiusM, 0.0);
    EXPECT_FALSE(f64::lightSample(light, {1, 2, 5}, {0.5, 0.5}).valid);
}

// Wherever a light gives anything, its bounds contain the receiver.
TEST_F(ClosedForm, BoundsHoldEverythingThatIsLit) {
    Random random{std::mt19937(5)};
    int lit = 0;
    for (int i = 0; i < 20000; ++i) {
        const shared::uint type = kAllTypes[i % 6];
        const Configuration c = randomConfiguration(random, type);
        f64::LightHot light = f64::fromF32(hotRecord(c.emitter, glm::vec3(1.0f)));
        light.invRange = random.uniform(0.1, 1.0);
        const double scale = 1.0 / (1.0 - std::cos(0.9));
        light.shaping = {scale, -std::cos(0.9) * scale};
        if (f64::lightEvaluate(light, dvec3(0.0)).x <= 0.0) continue;
        ++lit;
        const f64::LightBounds bounds = f64::lightBounds(light);
        const dvec3 from = -bounds.centerWs;
        EXPECT_LE(glm::length(from), bounds.radiusM * 1.000001) << kTypeNames[type];
        EXPECT_GE(glm::dot(from, bounds.axisWs), (bounds.cosHalfAngle - 1e-6) * glm::length(from))
            << kTypeNames[type];
    }
    EXPECT_GT(lit, 3000);
}

} // namespace
} // namespace kilolux::test
