// Typed intensities become the right amount of light: flux by integrating illuminance over a surrounding
// sphere, candela far away, luminance from the area, EV100 and lux from their definitions, and shaping.
#include "tests/unit/oracle/scene_builder.h"

#include "renderer/reference/oracle_estimate.h"

#include <gtest/gtest.h>

namespace kilolux::oracle {
namespace {

using glm::dvec3;

dvec3 irradianceRgb(const OracleLight& light, const dvec3& position, const dvec3& normal) {
    return estimateLight(light, pointAt(position, normal), {}, Estimator::True, 8, 1).unshadowedIrradianceLux;
}

double irradiance(const OracleLight& light, const dvec3& position, const dvec3& normal) {
    return irradianceRgb(light, position, normal).g;
}

// Illuminance of a sphere around the light, seen from inside, times its area: everything that leaves the
// light.
double fluxLumen(const OracleLight& light, double sphereRadiusM) {
    constexpr int kRings = 160;
    constexpr int kSectors = 24;
    double sum = 0.0;
    for (int i = 0; i < kRings; ++i)
        for (int j = 0; j < kSectors; ++j) {
            const double cosTheta = -1.0 + 2.0 * (i + 0.5) / kRings;
            const double sinTheta = std::sqrt(1.0 - cosTheta * cosTheta);
            const double phi = 2.0 * kPi * (j + 0.5) / kSectors;
            const dvec3 out =
                light.dirWs * cosTheta + (light.xWs * std::cos(phi) + light.yWs * std::sin(phi)) * sinTheta;
            sum += irradiance(light, light.centerWs + out * sphereRadiusM, -out);
        }
    return sum / (kRings * kSectors) * 4.0 * kPi * sphereRadiusM * sphereRadiusM;
}

LightDef sized(LightType type, double intensity, LightUnit unit) {
    LightDef def = lightDef(type, intensity, unit);
    def.radiusM = 0.15;
    def.lengthM = 0.9;
    def.widthM = 0.7;
    def.heightM = 0.4;
    def.innerConeRad = 0.3;
    def.outerConeRad = 0.7;
    return def;
}

class LocalLight : public testing::TestWithParam<LightType> {};

TEST_P(LocalLight, SurroundingSphereReceivesTheLumen) {
    const OracleLight light =
        makeLight(sized(GetParam(), 1200.0, LightUnit::Lumen), lookingAlong({1, 2, 3}, {0.3, -1, 0.2}));
    for (const double radius : {1.0, 20.0})
        EXPECT_NEAR(fluxLumen(light, radius), 1200.0, 0.002 * 1200.0) << radius;
}

TEST_P(LocalLight, CandelaIsTheFarFieldOnTheAxis) {
    const OracleLight light =
        makeLight(sized(GetParam(), 300.0, LightUnit::Candela), lookingAlong({0, 0, 0}, {0, 0, -1}));
    EXPECT_NEAR(irradiance(light, {0, 0, -1000}, {0, 0, 1}) * 1e6, 300.0, 1e-3);
    const OracleLight lux =
        makeLight(sized(GetParam(), 300.0, LightUnit::Lux), lookingAlong({0, 0, 0}, {0, 0, -1}));
    EXPECT_EQ(lux.intensityCd.g, 300.0) << "lux of a local light is meant at 1 m";
}

TEST_P(LocalLight, NitIsTheRadiance) {
    const OracleLight light =
        makeLight(sized(GetParam(), 850.0, LightUnit::Nit), lookingAlong({0, 0, 0}, {0, 0, -1}));
    EXPECT_NEAR(light.radianceNit.g, 850.0, 1e-9);
    const OracleLight ev =
        makeLight(sized(GetParam(), 10.0, LightUnit::Ev100), lookingAlong({0, 0, 0}, {0, 0, -1}));
    EXPECT_NEAR(ev.radianceNit.g, 128.0, 1e-9);
}

TEST_P(LocalLight, RangeWindowFollowsGltf) {
    LightDef def = sized(GetParam(), 100.0, LightUnit::Candela);
    const OracleLight open = makeLight(def, lookingAlong({0, 0, 0}, {0, 0, -1}));
    def.rangeM = 4.0;
    const OracleLight windowed = makeLight(def, lookingAlong({0, 0, 0}, {0, 0, -1}));
    for (const double d : {1.0, 2.0, 3.9}) {
        const double window = 1.0 - std::pow(d / 4.0, 4.0);
        EXPECT_NEAR(irradiance(windowed, {0, 0, -d}, {0, 0, 1}),
                    window * irradiance(open, {0, 0, -d}, {0, 0, 1}), 1e-9);
    }
    EXPECT_EQ(irradiance(windowed, {0, 0, -4.0}, {0, 0, 1}), 0.0);
    EXPECT_EQ(irradiance(windowed, {0, 0, -5.0}, {0, 0, 1}), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Types, LocalLight,
                         testing::Values(LightType::Sphere, LightType::Spot, LightType::Tube, LightType::Rect,
                                         LightType::Disk));

TEST(Photometry, PointSourcesKeepTheirLumen) {
    for (const LightType type : {LightType::Sphere, LightType::Spot}) {
        LightDef def = sized(type, 500.0, LightUnit::Lumen);
        def.radiusM = 0.0;
        EXPECT_NEAR(fluxLumen(makeLight(def, lookingAlong({0, 0, 0}, {0, -1, 0})), 2.0), 500.0, 1.0);
    }
}

TEST(Photometry, ConeFalloffAtItsEdges) {
    LightDef def = sized(LightType::Spot, 100.0, LightUnit::Candela);
    const OracleLight light = makeLight(def, lookingAlong({0, 0, 0}, {0, 0, -1}));
    const auto at = [&](double angle) { return shapingAt(light, {std::sin(angle), 0.0, -std::cos(angle)}); };
    EXPECT_EQ(at(0.0), 1.0);
    EXPECT_NEAR(at(0.3), 1.0, 1e-12);
    EXPECT_NEAR(at(0.7), 0.0, 1e-12);
    EXPECT_EQ(at(0.8), 0.0);
    const double halfCos = 0.5 * (std::cos(0.3) + std::cos(0.7));
    EXPECT_NEAR(at(std::acos(halfCos)), 0.25, 1e-12) << "the ramp is squared";
}

// 2 pi Int C d cos by brute force, for wide, sharp and needle cones.
TEST(Photometry, ConeSolidAngle) {
    const double cones[][2] = {{0.0, 1.5707963}, {0.3, 0.7}, {0.5, 0.5}, {0.0, 0.02}, {0.01, 0.011}};
    for (const auto& cone : cones) {
        const double cosInner = std::cos(cone[0]);
        const double cosOuter = std::cos(cone[1]);
        double sum = 0.0;
        constexpr int kSteps = 400000;
        for (int i = 0; i < kSteps; ++i) {
            const double c = cosOuter + (1.0 - cosOuter) * (i + 0.5) / kSteps;
            const double ramp = std::clamp((c - cosOuter) / std::max(0.001, cosInner - cosOuter), 0.0, 1.0);
            sum += ramp * ramp;
        }
        const double expected = 2.0 * kPi * sum * (1.0 - cosOuter) / kSteps;
        EXPECT_NEAR(coneSolidAngleSr(cosInner, cosOuter), expected, 1e-6 * expected)
            << cone[0] << " " << cone[1];
    }
}

TEST(Photometry, TintMultipliesEachChannel) {
    LightDef def = sized(LightType::Rect, 100.0, LightUnit::Nit);
    def.color = {1.0, 0.5, 0.25};
    const dvec3 e = irradianceRgb(makeLight(def, lookingAlong({0, 0, 0}, {0, 0, -1})), {0, 0, -1}, {0, 0, 1});
    EXPECT_NEAR(e.g, 0.5 * e.r, 1e-12);
    EXPECT_NEAR(e.b, 0.25 * e.r, 1e-12);
}

TEST(Photometry, SunInNitAndEv) {
    LightDef def = lightDef(LightType::Directional, 1.6e9, LightUnit::Nit);
    def.angularDiameterRad = 0.0093;
    const double sinA = std::sin(0.00465);
    EXPECT_NEAR(makeLight(def, glm::dmat4(1.0)).illuminanceLux.g, 1.6e9 * kPi * sinA * sinA, 1e-3);
}

} // namespace
} // namespace kilolux::oracle
