// The specular quadrature: furnace, an independent way over half vectors, refinement, and brute-force
// sampling.
#include "tests/unit/oracle/scene_builder.h"

#include "renderer/reference/oracle_estimate.h"
#include "renderer/reference/oracle_quadrature.h"
#include "renderer/reference/oracle_random.h"

#include <gtest/gtest.h>

namespace kilolux::oracle {
namespace {

using glm::dvec3;

OraclePoint surface(double cosView, const PointMaterial& material) {
    OraclePoint point = pointAt({0, 0, 0}, {0, 1, 0});
    point.viewDirWs = {std::sqrt(1.0 - cosView * cosView), cosView, 0.0};
    point.material = material;
    return point;
}

// A hemisphere of 1 nit: a directional light half a turn wide.
OracleLight furnace() {
    LightDef def = lightDef(LightType::Directional, 1.0, LightUnit::Nit);
    def.angularDiameterRad = kPi;
    return makeLight(def, lookingAlong({0, 0, 0}, {0, -1, 0}));
}

TEST(Furnace, WhiteLambertReflectsEverything) {
    for (const double cosView : {1.0, 0.5, 0.01}) {
        const OraclePointResult r =
            estimateLight(furnace(), surface(cosView, {dvec3(1.0), 0.0, 1.0}), {}, Estimator::True, 8, 1);
        EXPECT_NEAR(r.irradianceLux.g, kPi, 1e-9);
        EXPECT_NEAR(r.diffuseNit.g, 1.0, 1e-9);
    }
}

// Directional albedo of the GGX lobe by half vectors drawn from D cos (Walter et al. 2007, equation 35), with
// F = F0 + (1 - F0) (1 - VoH)^5 for the material's F0: shares no parametrization with the quadrature.
double albedoByHalfVectors(const Lobe& lobe, double f0) {
    constexpr int kCount = 1 << 18;
    double sum = 0.0;
    const double a2 = lobe.alpha * lobe.alpha;
    for (int i = 0; i < kCount; ++i) {
        const glm::dvec2 uv = sobolPoint(i, 3);
        const double cos2 = (1.0 - uv.x) / (1.0 + (a2 - 1.0) * uv.x);
        const double cosH = std::sqrt(cos2);
        const double sinH = std::sqrt(std::max(1.0 - cos2, 0.0));
        const double phi = 2.0 * kPi * uv.y;
        const dvec3 h(sinH * std::cos(phi), cosH, sinH * std::sin(phi));
        const double voH = glm::dot(lobe.view, h);
        const dvec3 l = h * (2.0 * voH) - lobe.view;
        if (voH <= 0.0 || l.y <= 0.0) continue;
        const double vis = 0.5 / (l.y * std::sqrt(lobe.noV * lobe.noV * (1.0 - a2) + a2) +
                                  lobe.noV * std::sqrt(l.y * l.y * (1.0 - a2) + a2));
        sum += (f0 + (1.0 - f0) * std::pow(1.0 - voH, 5.0)) * vis * l.y * 4.0 * voH / cosH;
    }
    return sum / kCount;
}

TEST(Furnace, GgxAlbedoMatchesHalfVectorIntegral) {
    for (const double roughness : {0.05, 0.2, 0.5, 1.0})
        for (const double cosView : {1.0, 0.6, 0.15})
            for (const double f0 : {0.04, 1.0}) {
                const PointMaterial material = f0 == 1.0 ? PointMaterial{dvec3(1.0), 1.0, roughness}
                                                         : PointMaterial{dvec3(0.5), 0.0, roughness};
                const OraclePoint point = surface(cosView, material);
                const double actual =
                    estimateLight(furnace(), point, {}, Estimator::Split, 8, 1).specularNit.g;
                const double expected =
                    albedoByHalfVectors(Lobe(point.shadingNormalWs, point.viewDirWs, roughness), f0);
                EXPECT_NEAR(actual, expected, 2e-3 * expected) << roughness << " " << cosView << " " << f0;
                EXPECT_LE(actual, 1.0001);
                if (f0 == 1.0 && roughness == 0.05 && cosView > 0.5) {
                    EXPECT_GT(actual, 0.99) << "a mirror returns all";
                }
            }
}

TEST(Specular, MirrorSeesTheRadianceOfTheLight) {
    LightDef def = lightDef(LightType::Rect, 640.0, LightUnit::Nit);
    def.widthM = def.heightM = 2.0;
    const OracleLight light = makeLight(def, lookingAlong({0, 2, 0}, {0, -1, 0}));
    const OraclePointResult r =
        estimateLight(light, surface(1.0, {dvec3(1.0), 1.0, 0.0}), {}, Estimator::True, 8, 1);
    EXPECT_NEAR(r.specularNit.g, 640.0, 0.002 * 640.0);
}

// Quadrature against plain area sampling of every type, at lobes wide enough for it.
TEST(Specular, QuadratureMatchesAreaSampling) {
    for (const LightType type : {LightType::Sphere, LightType::Tube, LightType::Rect, LightType::Disk}) {
        LightDef def = lightDef(type, 1.0, LightUnit::Nit);
        def.radiusM = 0.3;
        def.lengthM = 1.6;
        def.widthM = 1.5;
        const OracleLight light = makeLight(def, lookingAlong({0.4, 0.35, 0.2}, {-0.5, -0.6, -0.1}));
        for (const double roughness : {0.35, 0.8}) {
            OraclePoint point = surface(0.5, {dvec3(1.0), 1.0, roughness});
            point.positionWs = {-0.7, -0.6, 0.1};
            const Lobe lobe(point.shadingNormalWs, point.viewDirWs, roughness);
            const double distanceM = glm::length(point.positionWs - light.centerWs);
            double areaM2 = 1.5;
            if (type == LightType::Sphere)
                areaM2 = 2.0 * kPi * 0.09 * (1.0 - 0.3 / distanceM);
            else if (type == LightType::Tube)
                areaM2 = 4.0 * kPi * 0.3 * 1.1;
            else if (type == LightType::Disk)
                areaM2 = kPi * 0.5625;
            constexpr int kCount = 1 << 17;
            double sum = 0.0;
            for (int i = 0; i < kCount; ++i) {
                const glm::dvec2 uv = sobolPoint(i, 11);
                const SourcePoint s = sampleSource(light, point.positionWs, uv.x, uv.y);
                if (!s.faces) continue;
                const dvec3 q = point.positionWs + s.directionWs * s.distanceM - light.centerWs;
                dvec3 outward = light.dirWs;
                if (type == LightType::Sphere) outward = q / 0.3;
                if (type == LightType::Tube)
                    outward = (q - light.xWs * std::clamp(glm::dot(q, light.xWs), -0.8, 0.8)) / 0.3;
                const LobeValue value = lobe(s.directionWs);
                sum += (value.specularF0 + value.specularOne) * -glm::dot(outward, s.directionWs) /
                       (s.distanceM * s.distanceM);
            }
            const double expected = areaM2 * sum / kCount;
            const double actual =
                estimateLight(light, point, {}, Estimator::True, 8, 1).unshadowedSpecularNit.g;
            EXPECT_NEAR(actual, expected, 3e-3 * expected) << int(type) << " " << roughness;
            EXPECT_GT(actual, 0.0);
        }
    }
}

// The default tolerance against a hundred thousand times finer one, over a grid of hard inputs: near and far,
// grazing views, narrow lobes, horizon cuts.
TEST(Specular, DefaultToleranceIsConverged) {
    double worst = 0.0;
    for (const LightType type : {LightType::Sphere, LightType::Tube, LightType::Rect, LightType::Disk}) {
        LightDef def = lightDef(type, 1.0, LightUnit::Nit);
        def.radiusM = 0.2;
        def.lengthM = 1.0;
        def.widthM = 1.2;
        const OracleLight light = makeLight(def, lookingAlong({0, 1, 0}, {0.1, -1, 0.3}));
        for (const double height : {0.05, 0.5, 3.0})
            for (const double offset : {0.0, 0.8, 4.0})
                for (const double roughness : {0.05, 0.3, 1.0})
                    for (const double cosView : {0.9, 0.3, 0.02}) {
                        const dvec3 position(offset, 0.8 - height, 0.1);
                        const dvec3 normal = glm::normalize(dvec3(-0.3, 1.0, 0.2));
                        const dvec3 side = glm::normalize(glm::cross(normal, dvec3(0.2, 0.1, 1.0)));
                        const auto region = SourceRegion::make(light, position, normal);
                        if (!region) continue;
                        const Lobe lobe(normal, normal * cosView + side * std::sqrt(1.0 - cosView * cosView),
                                        roughness);
                        const LobeIntegral coarse = LobeQuadrature(*region, lobe).integral();
                        const LobeIntegral fine = LobeQuadrature(*region, lobe, 2e-9).integral();
                        const double reference = fine.specularF0 + fine.specularOne;
                        const double error = std::abs(coarse.specularF0 + coarse.specularOne - reference) /
                                             (reference + 1e-6 * fine.diffuse);
                        worst = std::max(worst, error);
                        EXPECT_NEAR(fine.diffuse, diffuseIntegral(*region, normal), 1e-6 * fine.diffuse);
                    }
    }
    EXPECT_LT(worst, 5e-4); // reached where the lobe is 1e-4 of the diffuse part; elsewhere under 5e-5
    RecordProperty("worst", std::to_string(worst));
}

} // namespace
} // namespace kilolux::oracle
