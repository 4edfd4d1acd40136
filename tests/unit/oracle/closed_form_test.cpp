// Unshadowed irradiance of every light type against closed forms from the literature on view factors.
#include "tests/unit/oracle/scene_builder.h"

#include "renderer/reference/oracle_estimate.h"
#include "renderer/reference/oracle_random.h"

#include <gtest/gtest.h>

namespace kilolux::oracle {
namespace {

using glm::dvec3;

double irradiance(const OracleLight& light, const dvec3& position, const dvec3& normal) {
    return estimateLight(light, pointAt(position, normal), {}, Estimator::True, 8, 1)
        .unshadowedIrradianceLux.g;
}

LightDef sphereOf(double radiusM, double nit) {
    LightDef def = lightDef(LightType::Sphere, nit, LightUnit::Nit);
    def.radiusM = radiusM;
    return def;
}

TEST(ClosedForm, PointFollowsInverseSquareAndCosine) {
    const OracleLight light = makeLight(lightDef(LightType::Sphere, 120.0, LightUnit::Candela),
                                        lookingAlong({1, 3, 2}, {0, 0, -1}));
    for (const double distance : {0.01, 1.0, 3.0, 10000.0})
        for (const double angle : {0.0, 0.5, 1.2}) {
            const dvec3 normal(std::sin(angle), std::cos(angle), 0.0);
            const double expected = 120.0 / (distance * distance) * std::cos(angle);
            EXPECT_NEAR(irradiance(light, {1, 3 - distance, 2}, normal), expected, 1e-9 * expected);
        }
    EXPECT_EQ(irradiance(light, {1, 0, 2}, {0, -1, 0}), 0.0);
}

// View factor from a point to a disk, both facing on one axis: r^2 / (r^2 + h^2) (Howell, A Catalog of
// Radiation Configuration Factors, B-13); off axis and parallel: Howell B-14.
TEST(ClosedForm, DiskOnAndOffAxis) {
    LightDef def = lightDef(LightType::Disk, 1000.0, LightUnit::Nit);
    def.widthM = 1.6; // radius 0.8
    const OracleLight light = makeLight(def, lookingAlong({0, 2, 0}, {0, -1, 0}));
    for (const double height : {0.001, 0.1, 1.0, 5.0, 300.0})
        for (const double offset : {0.0, 0.3, 0.79, 1.5, 20.0}) {
            const double h = height / offset;
            const double r = 0.8 / offset;
            const double z = 1.0 + h * h + r * r;
            const double factor = offset == 0.0
                                      ? 0.64 / (0.64 + height * height)
                                      : 0.5 * (1.0 - (z - 2.0 * r * r) / std::sqrt(z * z - 4.0 * r * r));
            const double expected = 1000.0 * kPi * factor;
            EXPECT_NEAR(irradiance(light, {offset, 2 - height, 0}, {0, 1, 0}), expected,
                        1e-7 * expected + 1e-9 * 1000.0)
                << height << " " << offset;
        }
    EXPECT_EQ(irradiance(light, {0, 2.5, 0}, {0, -1, 0}), 0.0) << "behind a one-sided light";
}

// Lambert's formula: E = L / 2 Sum angle_i * (edge normal_i . n), for a polygon above the horizon.
double lambertPolygon(const std::vector<dvec3>& corners, const dvec3& position, const dvec3& normal) {
    double sum = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const dvec3 a = glm::normalize(corners[i] - position);
        const dvec3 b = glm::normalize(corners[(i + 1) % corners.size()] - position);
        const dvec3 c = glm::cross(a, b);
        const double length = glm::length(c);
        if (length > 0.0) sum += std::atan2(length, glm::dot(a, b)) * glm::dot(c / length, normal);
    }
    return 0.5 * std::abs(sum);
}

std::vector<dvec3> clipped(const std::vector<dvec3>& corners, const dvec3& position, const dvec3& normal) {
    std::vector<dvec3> result;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const dvec3 a = corners[i];
        const dvec3 b = corners[(i + 1) % corners.size()];
        const double ha = glm::dot(a - position, normal);
        const double hb = glm::dot(b - position, normal);
        if (ha >= 0.0) result.push_back(a);
        if ((ha > 0.0 && hb < 0.0) || (ha < 0.0 && hb > 0.0))
            result.push_back(a + (b - a) * (ha / (ha - hb)));
    }
    return result;
}

TEST(ClosedForm, RectangleWithAndWithoutHorizon) {
    LightDef def = lightDef(LightType::Rect, 1000.0, LightUnit::Nit);
    def.widthM = 2.0;
    def.heightM = 0.6;
    const OracleLight light = makeLight(def, lookingAlong({0, 0, 0}, {0, 0, -1}));
    const std::vector<dvec3> corners = {{-1, -0.3, 0}, {1, -0.3, 0}, {1, 0.3, 0}, {-1, 0.3, 0}};
    const dvec3 positions[] = {{0, 0, -1}, {0.9, 0.2, -0.01}, {3, 2, -0.5}, {-5, 0, -0.02}, {0.3, 0.1, -40}};
    const dvec3 normals[] = {{0, 0, 1}, {1, 0, 0}, {0.2, -0.9, 0.4}, {0.5, 0.5, -0.1}, {0, 1, 0.001}};
    int lit = 0;
    for (const dvec3& position : positions)
        for (const dvec3& direction : normals) {
            const dvec3 normal = glm::normalize(direction);
            const std::vector<dvec3> above = clipped(corners, position, normal);
            const double expected = above.size() < 3 ? 0.0 : 1000.0 * lambertPolygon(above, position, normal);
            const double actual = irradiance(light, position, normal);
            EXPECT_NEAR(actual, expected, 1e-6 * expected + 1e-6) << position.x << " " << normal.x;
            lit += actual > 0.0;
        }
    EXPECT_GT(lit, 15);
}

// Sphere whose whole disk is above the horizon: pi L sin^2(a) cos(t). Cut by the horizon: Howell B-43 (a
// sphere and a plane element tangent through it), here in Snyder's form (Area light sources for real-time
// graphics, MSR-TR-96-11, 1996, appendix).
double sphereIrradiance(double sinA, double cosT) {
    const double cosA = std::sqrt(1.0 - sinA * sinA);
    const double t = std::acos(cosT);
    const double a = std::asin(sinA);
    if (t <= 0.5 * kPi - a) return kPi * sinA * sinA * cosT;
    if (t >= 0.5 * kPi + a) return 0.0;
    const double sinT = std::sin(t);
    const double gamma = std::asin(std::clamp(cosA / sinT, -1.0, 1.0));
    const double g =
        -2.0 * sinT * cosA * std::cos(gamma) + 0.5 * kPi - gamma + std::sin(gamma) * std::cos(gamma);
    const double h =
        cosT * (std::cos(gamma) * std::sqrt(std::max(sinA * sinA - std::cos(gamma) * std::cos(gamma), 0.0)) +
                sinA * sinA * std::asin(std::clamp(std::cos(gamma) / sinA, -1.0, 1.0)));
    if (t < 0.5 * kPi) return kPi * cosT * sinA * sinA + g - h;
    return g + h;
}

TEST(ClosedForm, SphereWithAndWithoutHorizonCut) {
    const OracleLight light = makeLight(sphereOf(1.0, 1000.0), lookingAlong({0, 0, 0}, {0, 0, -1}));
    int cut = 0;
    for (const double distance : {1.0001, 1.2, 3.0, 1000.0})
        for (double t = 0.0; t < 2.8; t += 0.175) {
            const dvec3 normal(std::sin(t), 0.0, std::cos(t));
            const double expected = 1000.0 * sphereIrradiance(1.0 / distance, std::cos(t));
            EXPECT_NEAR(irradiance(light, {0, 0, -distance}, normal), expected, 1e-6 * expected + 1e-6)
                << distance << " " << t;
            cut += std::abs(t - 0.5 * kPi) < std::asin(1.0 / distance);
        }
    EXPECT_GT(cut, 10);
}

TEST(ClosedForm, DirectionalDiskGivesItsLux) {
    LightDef def = lightDef(LightType::Directional, 90000.0, LightUnit::Lux);
    for (const double diameter : {0.0, 0.0093, 0.5}) {
        def.angularDiameterRad = diameter;
        const OracleLight light = makeLight(def, lookingAlong({0, 0, 0}, {0, -1, 0}));
        EXPECT_NEAR(irradiance(light, {5, 5, 5}, {0, 1, 0}), 90000.0, 1e-3);
        EXPECT_NEAR(irradiance(light, {5, 5, 5}, {0, 1, 1}), 90000.0 / std::sqrt(2.0), 1e-3);
    }
    const OracleLight wide = makeLight(def, lookingAlong({0, 0, 0}, {0, -1, 0}));
    const double sinA = std::sin(0.25);
    EXPECT_NEAR(irradiance(wide, {0, 0, 0}, {1, 0.05, 0}),
                90000.0 / (kPi * sinA * sinA) * sphereIrradiance(sinA, 0.05 / std::hypot(1.0, 0.05)), 1e-2);
}

// A long thin capsule nears the endless cylinder: E = 2 L r / distance... at distance D above its middle, for
// a receiver that faces it, E = pi L r / D (the half cylinder's projected width seen under a cosine squared
// law).
TEST(ClosedForm, LongTubeIsAnEndlessCylinder) {
    LightDef def = lightDef(LightType::Tube, 500.0, LightUnit::Nit);
    def.radiusM = 0.02;
    def.lengthM = 4000.0;
    const OracleLight light = makeLight(def, lookingAlong({0, 0, 0}, {0, 0, -1}));
    for (const double distance : {0.05, 1.0, 3.0}) {
        const double expected = 500.0 * kPi * 0.02 / distance;
        EXPECT_NEAR(irradiance(light, {0, 0, -distance}, {0, 0, 1}), expected, 1e-5 * expected) << distance;
    }
}

TEST(ClosedForm, ShortTubeIsASphere) {
    LightDef tube = lightDef(LightType::Tube, 700.0, LightUnit::Nit);
    tube.radiusM = 0.5;
    tube.lengthM = 1e-7;
    const OracleLight light = makeLight(tube, lookingAlong({0, 0, 0}, {0, 0, -1}));
    const OracleLight sphere = makeLight(sphereOf(0.5, 700.0), lookingAlong({0, 0, 0}, {0, 0, -1}));
    for (const double t : {0.0, 0.7, 1.4, 1.7}) {
        const dvec3 normal(std::sin(t), 0.0, std::cos(t));
        EXPECT_NEAR(irradiance(light, {0, 0, -1.1}, normal), irradiance(sphere, {0, 0, -1.1}, normal), 1e-3)
            << t;
    }
}

// Every type against brute force over its area: mean of L cos cos A / d^2, with the receiver's horizon
// cutting some of the lights. Also the tie between sampleSource and the region.
TEST(ClosedForm, AreaSamplingAgrees) {
    LightDef defs[] = {
        lightDef(LightType::Sphere, 1000, LightUnit::Nit), lightDef(LightType::Tube, 1000, LightUnit::Nit),
        lightDef(LightType::Rect, 1000, LightUnit::Nit), lightDef(LightType::Disk, 1000, LightUnit::Nit)};
    for (LightDef& def : defs) {
        def.radiusM = 0.4;
        def.lengthM = 1.5;
        def.widthM = 1.2;
        const OracleLight light = makeLight(def, lookingAlong({0, 0, 0}, {0.3, 0.2, -1}));
        for (const dvec3& position : {dvec3(0.2, 0.1, -1.0), dvec3(-1.5, 0.3, -0.8), dvec3(0.0, -2.0, -1.0)})
            for (const dvec3& normal : {dvec3(0, 0, 1), dvec3(1, 0.2, 0.1), dvec3(0, 1, -0.3)}) {
                const dvec3 n = glm::normalize(normal);
                double areaM2 = 4.0 * kPi * 0.4 * (0.4 + 0.75);
                if (def.type == LightType::Sphere)
                    areaM2 = 2.0 * kPi * 0.16 * (1.0 - 0.4 / glm::length(position));
                else if (def.type == LightType::Rect)
                    areaM2 = 1.2;
                else if (def.type == LightType::Disk)
                    areaM2 = kPi * 0.36;
                constexpr int kCount = 1 << 16;
                double sum = 0.0;
                for (int i = 0; i < kCount; ++i) {
                    const glm::dvec2 uv = sobolPoint(i, 7);
                    const SourcePoint s = sampleSource(light, position, uv.x, uv.y);
                    const dvec3 q = position + s.directionWs * s.distanceM;
                    dvec3 outward = light.dirWs;
                    if (def.type == LightType::Sphere) outward = glm::normalize(q);
                    if (def.type == LightType::Tube)
                        outward =
                            glm::normalize(q - light.xWs * std::clamp(glm::dot(q, light.xWs), -0.75, 0.75));
                    const double cosSource = -glm::dot(outward, s.directionWs);
                    EXPECT_EQ(s.faces, cosSource > 0.0);
                    const double cosReceiver = glm::dot(n, s.directionWs);
                    if (cosSource > 0.0 && cosReceiver > 0.0)
                        sum += cosSource * cosReceiver / (s.distanceM * s.distanceM);
                }
                const double expected = 1000.0 * areaM2 * sum / kCount;
                EXPECT_NEAR(irradiance(light, position, n), expected, 1e-3 * expected + 0.05)
                    << int(def.type) << " at " << position.x << " facing " << n.x;
            }
    }
}

} // namespace
} // namespace kilolux::oracle
