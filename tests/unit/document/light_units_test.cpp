// Photometry against closed forms and against numeric integration over the sphere of directions.
#include "renderer/document/light_units.h"

#include <cmath>
#include <gtest/gtest.h>

namespace kilolux {
namespace {

constexpr double kPi = 3.14159265358979323846;

LightDef lightOf(LightType type, LightUnit unit, double intensity) {
    LightDef def;
    def.type = type;
    def.unit = unit;
    def.intensity = intensity;
    def.radiusM = 0.05;
    def.lengthM = 1.2;
    def.widthM = 0.8;
    def.heightM = 0.5;
    def.innerConeRad = 0.3;
    def.outerConeRad = 0.6;
    def.angularDiameterRad = 0.0093;
    return def;
}

TEST(LightUnits, ClosedFormsOfEachType) {
    EXPECT_NEAR(baseIntensity(lightOf(LightType::Sphere, LightUnit::Lumen, 4.0 * kPi)), 1.0, 1e-12);
    EXPECT_NEAR(baseIntensity(lightOf(LightType::Sphere, LightUnit::Nit, 100.0)), 100.0 * kPi * 0.0025,
                1e-12);
    EXPECT_NEAR(baseIntensity(lightOf(LightType::Rect, LightUnit::Nit, 100.0)), 40.0, 1e-12);
    EXPECT_NEAR(fluxLumen(lightOf(LightType::Rect, LightUnit::Nit, 100.0)), 40.0 * kPi, 1e-12);
    EXPECT_NEAR(baseIntensity(lightOf(LightType::Disk, LightUnit::Nit, 100.0)), 16.0 * kPi, 1e-12);
    EXPECT_NEAR(fluxLumen(lightOf(LightType::Disk, LightUnit::Lumen, 7.0)), 7.0, 1e-12);
    EXPECT_NEAR(baseIntensity(lightOf(LightType::Rect, LightUnit::Ev100, 3.0)), 0.4, 1e-12); // 1 nit
    EXPECT_NEAR(baseIntensity(lightOf(LightType::Directional, LightUnit::Lux, 5.0)), 5.0, 1e-12);
    // The sun: 1.6e9 nit over 0.533 degrees is about 108 klx (E = L pi sin^2 a).
    EXPECT_NEAR(baseIntensity(lightOf(LightType::Directional, LightUnit::Nit, 1.6e9)), 108685.0, 100.0);
    EXPECT_EQ(fluxLumen(lightOf(LightType::Directional, LightUnit::Lux, 5.0)), 0.0);
}

// The intensity towards an angle from the axis is L times the area seen from there: closed forms for the two
// shapes that look different from different sides, integrated over all directions.
TEST(LightUnits, FluxIsTheIntegralOfIntensity) {
    const LightDef tube = lightOf(LightType::Tube, LightUnit::Nit, 1000.0);
    const LightDef spot = lightOf(LightType::Spot, LightUnit::Candela, 10.0);
    constexpr int kSteps = 200000;
    double tubeFlux = 0.0, spotFlux = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        const double theta = (i + 0.5) * kPi / kSteps;
        const double ring = 2.0 * kPi * std::sin(theta) * kPi / kSteps;
        // A capsule seen under theta from its axis: a rectangle and a disk.
        const double seenArea =
            2.0 * tube.radiusM * tube.lengthM * std::sin(theta) + kPi * tube.radiusM * tube.radiusM;
        tubeFlux += ring * tube.intensity * seenArea;
        const double scale = 1.0 / (std::cos(spot.innerConeRad) - std::cos(spot.outerConeRad));
        const double falloff = std::clamp((std::cos(theta) - std::cos(spot.outerConeRad)) * scale, 0.0, 1.0);
        spotFlux += ring * spot.intensity * falloff * falloff;
    }
    EXPECT_NEAR(fluxLumen(tube) / tubeFlux, 1.0, 1e-8);
    EXPECT_NEAR(fluxLumen(spot) / spotFlux, 1.0, 1e-8);
}

TEST(LightUnits, ASpotConcentratesItsLumens) {
    LightDef spot = lightOf(LightType::Spot, LightUnit::Lumen, 1000.0);
    const double wide = baseIntensity(spot);
    spot.innerConeRad = 0.15;
    spot.outerConeRad = 0.3;
    EXPECT_GT(baseIntensity(spot), 3.5 * wide);
    // A sharp cone: the solid angle of a cap.
    spot.innerConeRad = spot.outerConeRad = 0.3;
    EXPECT_NEAR(baseIntensity(spot), 1000.0 / (2.0 * kPi * (1.0 - std::cos(0.3))),
                0.02 * baseIntensity(spot)); // the falloff keeps a width of 0.001
    // A cone narrower than the falloff's smallest width stays finite.
    spot.innerConeRad = 0.0;
    spot.outerConeRad = 1e-4;
    EXPECT_TRUE(std::isfinite(baseIntensity(spot)));
}

TEST(LightUnits, EveryConversionComesBack) {
    for (const LightType type : {LightType::Directional, LightType::Sphere, LightType::Spot, LightType::Tube,
                                 LightType::Rect, LightType::Disk}) {
        for (const LightUnit unit :
             {LightUnit::Lumen, LightUnit::Candela, LightUnit::Lux, LightUnit::Nit, LightUnit::Ev100}) {
            LightDef def = lightOf(type, unit, 12.5);
            if (!unitApplies(def, unit)) {
                EXPECT_EQ(type, LightType::Directional);
                EXPECT_EQ(baseIntensity(def), 0.0);
                continue;
            }
            EXPECT_NEAR(fromBaseIntensity(def, baseIntensity(def), unit), 12.5, 1e-9);
            EXPECT_NEAR(intensityIn(def, unit), 12.5, 1e-9);
        }
    }
    LightDef point = lightOf(LightType::Sphere, LightUnit::Nit, 1.0);
    point.radiusM = 0.0;
    EXPECT_FALSE(unitApplies(point, LightUnit::Nit));
    EXPECT_FALSE(unitApplies(point, LightUnit::Ev100));
    EXPECT_TRUE(unitApplies(point, LightUnit::Lumen));
}

TEST(LightUnits, TypedUnitIsHeldWhenTheSizeChanges) {
    LightDef nits = lightOf(LightType::Rect, LightUnit::Nit, 100.0);
    LightDef lumens = lightOf(LightType::Rect, LightUnit::Lumen, 100.0);
    const double nitsBefore = baseIntensity(nits), lumensBefore = baseIntensity(lumens);
    nits.widthM *= 2.0;
    lumens.widthM *= 2.0;
    EXPECT_NEAR(baseIntensity(nits), 2.0 * nitsBefore, 1e-12);
    EXPECT_NEAR(baseIntensity(lumens), lumensBefore, 1e-12);
}

// Planckian locus of the CIE 1931 observer (x, y), from tables of the locus.
TEST(ColorTemperature, FollowsThePlanckianLocus) {
    const struct {
        double temperatureK, x, y;
    } kLocus[] = {{1000, 0.6528, 0.3444}, {2000, 0.5267, 0.4133}, {2856, 0.4476, 0.4074},
                  {4000, 0.3805, 0.3768}, {5000, 0.3451, 0.3516}, {10000, 0.2807, 0.2884},
                  {40000, 0.2487, 0.2438}};
    for (const auto& entry : kLocus) {
        const glm::dvec2 xy = blackBodyChromaticity(entry.temperatureK);
        const double tolerance = entry.temperatureK < 2000.0 ? 0.012 : 0.004; // as the header states
        EXPECT_NEAR(xy.x, entry.x, tolerance) << entry.temperatureK;
        EXPECT_NEAR(xy.y, entry.y, tolerance) << entry.temperatureK;
    }
}

TEST(ColorTemperature, NeutralAt6500AndUnitLuminance) {
    const glm::dvec3 neutral = temperatureColor(6500.0);
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(neutral[i], 1.0, 1e-9);
    double previous = 0.0;
    for (double t = 1000.0; t <= 40000.0; t += 250.0) {
        const glm::dvec3 color = temperatureColor(t);
        EXPECT_NEAR(luminanceOf(color), 1.0, 1e-12);
        for (int i = 0; i < 3; ++i)
            EXPECT_GE(color[i], 0.0);
        EXPECT_GE(color.b / color.r, previous) << t;
        previous = color.b / color.r;
    }
    EXPECT_EQ(temperatureColor(10.0), temperatureColor(1000.0));
    LightDef def;
    def.color = {1.0, 0.5, 0.0};
    def.temperatureK = 3000.0;
    EXPECT_EQ(emittedColor(def), def.color * temperatureColor(3000.0));
}

} // namespace
} // namespace kilolux
