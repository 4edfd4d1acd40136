// Shadows: what half a light gives, by closed form; the two estimators where they must agree and where they
// must not; ray precision at hostile scales; noise as large as stated.
#include "tests/unit/oracle/scene_builder.h"

#include "renderer/reference/oracle_random.h"

#include <gtest/gtest.h>
#include <numeric>

namespace kilolux::oracle {
namespace {

using glm::dvec3;

// A rectangle light 2 x 1.2 m at z = -2 that looks to +Z, and a blind at z = -1 whose edge is the plane
// through x = edge: a receiver at x = edge sees only the light's part below that x.
struct BlindScene {
    SceneBuilder builder;
    explicit BlindScene(double edge) {
        LightDef def = lightDef(LightType::Rect, 1000.0, LightUnit::Nit);
        def.widthM = 2.0;
        def.heightM = 1.2;
        builder.light(def, lookingAlong({0, 0, -2}, {0, 0, 1}));
        const int grey = builder.material(dvec3(0.5));
        builder.quad(glm::translate(glm::dmat4(1.0), dvec3(edge + 5.0, 0, -1)), 10.0, 20.0, grey);
    }
};

double rectRadiance(const OraclePoint& point, double x0, double x1, Estimator estimator, bool specular) {
    SceneBuilder builder;
    LightDef def = lightDef(LightType::Rect, 1000.0, LightUnit::Nit);
    def.widthM = x1 - x0;
    def.heightM = 1.2;
    // Shaping is off, so a part of the light is a smaller light.
    builder.light(def, lookingAlong({0.5 * (x0 + x1), 0, -2}, {0, 0, 1}));
    OracleOptions options;
    options.estimator = estimator;
    const OraclePointResult r = Oracle(builder.scene).evaluatePoint(point, 0, options);
    return specular ? r.specularNit.g : r.irradianceLux.g;
}

TEST(Shadow, HalfHiddenRectangleEqualsItsVisiblePart) {
    const double edge = 0.3;
    const BlindScene scene(edge);
    const Oracle oracle(scene.builder.scene);
    OracleOptions options;
    options.samplesPerLight = 1 << 14;
    for (const double roughness : {0.15, 0.6}) {
        OraclePoint point = pointAt({edge, 0.2, 0}, {0, 0, -1});
        point.viewDirWs = glm::normalize(dvec3(-0.15, 0.2, -1));
        point.material = {dvec3(0.6), 0.0, roughness};
        const OraclePointResult exact = oracle.evaluatePoint(point, 0, options);
        const double diffuse = rectRadiance(point, -1.0, edge, Estimator::True, false);
        const double specular = rectRadiance(point, -1.0, edge, Estimator::True, true);
        EXPECT_NEAR(exact.irradianceLux.g, diffuse, 0.002 * diffuse);
        EXPECT_NEAR(exact.specularNit.g, specular, 0.01 * specular);

        options.estimator = Estimator::Split;
        const OraclePointResult split = oracle.evaluatePoint(point, 0, options);
        const double share = (edge + 1.0) / 2.0;
        EXPECT_NEAR(split.visibility, share, 1e-3);
        EXPECT_NEAR(split.irradianceLux.g, share * rectRadiance(point, -1, 1, Estimator::Split, false),
                    0.002 * split.irradianceLux.g);
        EXPECT_NEAR(split.specularNit.g, share * rectRadiance(point, -1, 1, Estimator::Split, true),
                    0.002 * split.specularNit.g);
        EXPECT_GT(std::abs(split.specularNit.g - specular), 0.02 * specular) << "the model error is visible";
        options.estimator = Estimator::True;
    }
}

TEST(Shadow, EstimatorsAgreeWhereNothingIsHidden) {
    for (const LightType type : {LightType::Sphere, LightType::Spot, LightType::Tube, LightType::Rect,
                                 LightType::Disk, LightType::Directional}) {
        SceneBuilder builder;
        LightDef def =
            lightDef(type, 100.0, type == LightType::Directional ? LightUnit::Lux : LightUnit::Candela);
        def.radiusM = 0.2;
        def.lengthM = 1.0;
        def.angularDiameterRad = 0.1;
        builder.light(def, lookingAlong({0.3, 2, 0.1}, {0, -1, 0}));
        builder.quad(lookingAlong({0, 0, 0}, {0, -1, 0}), 10, 10, builder.material(dvec3(0.5)));
        const Oracle oracle(builder.scene);
        OraclePoint point = pointAt({0.1, 0, 0.2}, {0, 1, 0});
        point.viewDirWs = glm::normalize(dvec3(-0.2, 1, 0.1));
        point.material.roughness = 0.2;
        OracleOptions options;
        const OraclePointResult exact = oracle.evaluatePoint(point, 0, options);
        options.estimator = Estimator::Split;
        const OraclePointResult split = oracle.evaluatePoint(point, 0, options);
        EXPECT_GT(exact.diffuseNit.g, 0.0);
        EXPECT_NEAR(exact.diffuseNit.g, split.diffuseNit.g, 1e-9 * split.diffuseNit.g) << int(type);
        EXPECT_NEAR(exact.specularNit.g, split.specularNit.g, 1e-9 * split.specularNit.g) << int(type);
        EXPECT_DOUBLE_EQ(split.visibility, 1.0);
        EXPECT_LT(exact.standardErrorNit.g, 1e-9 * exact.diffuseNit.g);
    }
}

// A light half below the horizon is a smaller light, not a hidden one; and the geometric normal hides what
// the shading normal would let in.
TEST(Shadow, HorizonIsNotAShadowButTheGeometricOneIs) {
    SceneBuilder builder;
    LightDef def = lightDef(LightType::Rect, 1000.0, LightUnit::Nit);
    def.widthM = def.heightM = 2.0;
    builder.light(def, lookingAlong({0, 0, -2}, {0, 0, 1}));
    const Oracle oracle(builder.scene);
    OracleOptions options;
    options.samplesPerLight = 1 << 14;
    options.estimator = Estimator::Split;
    OraclePoint point = pointAt({0, 0, 0}, {0, 1, 0});
    EXPECT_EQ(oracle.evaluatePoint(point, 0, options).visibility, 1.0);
    point.shadingNormalWs =
        glm::normalize(dvec3(0, 0.2, -1)); // sees all; the surface itself sees the upper half
    EXPECT_NEAR(oracle.evaluatePoint(point, 0, options).visibility, 0.5, 1e-3);
    options.estimator = Estimator::True;
    LightDef upper = def;
    upper.heightM = 1.0;
    SceneBuilder half;
    half.light(upper, lookingAlong({0, 0.5, -2}, {0, 0, 1}));
    const double expected = Oracle(half.scene).evaluatePoint(point, 0, options).unshadowedIrradianceLux.g;
    EXPECT_NEAR(oracle.evaluatePoint(point, 0, options).irradianceLux.g, expected, 0.002 * expected);
}

TEST(Shadow, HiddenBehindAThinWallAndNotByItsOwnPlane) {
    for (const double scale : {0.01, 1.0, 100.0, 10000.0})
        for (const double away : {0.0, 10000.0}) {
            SceneBuilder builder;
            const dvec3 origin(away, away * 0.5, -away);
            const dvec3 normal = glm::normalize(dvec3(0.3, 0.9, -0.2));
            builder.light(lightDef(LightType::Sphere, 100.0, LightUnit::Candela),
                          lookingAlong(origin + normal * scale, {0, 0, -1}));
            const int grey = builder.material(dvec3(0.5));
            const double thicknessM = 0.001 * std::min(scale, 1.0);
            builder.quad(lookingAlong(origin, -normal), 4 * scale, 4 * scale, grey);
            builder.quad(lookingAlong(origin - normal * thicknessM, normal), 4 * scale, 4 * scale, grey);
            const Oracle oracle(builder.scene);
            int lit = 0;
            int dark = 0;
            for (int i = 0; i < 500; ++i) {
                const glm::dvec2 uv = sobolPoint(i, 5) - 0.5;
                const glm::dmat4 top = builder.scene.nodes[1].worldFromNode;
                const dvec3 at = dvec3(top * glm::dvec4(uv * 3.0 * scale, 0.0, 1.0));
                lit += oracle.evaluatePoint(pointAt(at, normal), 0).visibility == 1.0;
                const auto hit = oracle.tracePrimary(at - normal * (0.5 * scale), normal);
                ASSERT_TRUE(hit);
                dark += oracle.evaluatePoint(pointAt(hit->point.positionWs, -hit->point.viewDirWs), 0)
                            .visibility == 0.0;
            }
            EXPECT_EQ(lit, 500) << scale << " " << away;
            EXPECT_EQ(dark, 500) << scale << " " << away;
        }
}

// Rays from the middle of a closed, rotated box, many of them at edges and corners: none escapes.
TEST(Shadow, ClosedBoxLeaksNothing) {
    SceneBuilder builder;
    const int grey = builder.material(dvec3(0.5));
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(dvec3(1, 2, 3)));
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            dvec3 direction(0.0);
            direction[axis] = side;
            builder.quad(turn * lookingAlong(direction, direction), 2.0, 2.0, grey);
        }
    const Oracle oracle(builder.scene);
    int escaped = 0;
    for (int i = 0; i < 200000; ++i) {
        const glm::dvec2 uv = sobolPoint(i, 9);
        const double z = 2.0 * uv.x - 1.0;
        const double phi = 2.0 * kPi * uv.y;
        dvec3 d(std::sqrt(1 - z * z) * std::cos(phi), std::sqrt(1 - z * z) * std::sin(phi), z);
        if (i % 2 == 0) { // towards an edge
            d /= std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
            d.x = std::copysign(1.0, d.x);
            d.y = std::copysign(1.0, d.y);
            d = glm::normalize(d);
        }
        escaped += !oracle.occluded(dvec3(0.0), dvec3(turn * glm::dvec4(d, 0.0)), 10.0);
    }
    EXPECT_LE(escaped, 2) << "edge rays may pass between two roundings, no more";
}

TEST(Shadow, RayEndBiasSparesTheFixture) {
    SceneBuilder builder;
    LightDef def = lightDef(LightType::Sphere, 100.0, LightUnit::Candela);
    def.rayEndBiasM = 0.1;
    builder.light(def, lookingAlong({0, 1, 0}, {0, 0, -1}));
    def.rayEndBiasM = 0.01;
    builder.light(def, lookingAlong({0, 1, 0}, {0, 0, -1}));
    builder.quad(lookingAlong({0, 0.95, 0}, {0, -1, 0}), 1, 1, builder.material(dvec3(0.5)));
    const Oracle oracle(builder.scene);
    EXPECT_EQ(oracle.evaluatePoint(pointAt({0, 0, 0}, {0, 1, 0}), 0).visibility, 1.0);
    EXPECT_EQ(oracle.evaluatePoint(pointAt({0, 0, 0}, {0, 1, 0}), 1).visibility, 0.0);
}

// 200 seeds of a penumbra point: the mean is the truth, the spread is the stated standard error.
TEST(Shadow, StatedErrorIsTheSpread) {
    const BlindScene scene(0.3);
    const Oracle oracle(scene.builder.scene);
    OraclePoint point = pointAt({0.3, 0.2, 0}, {0, 0, -1});
    point.material = {dvec3(1.0), 0.0, 0.3};
    const double truth = rectRadiance(point, -1.0, 0.3, Estimator::True, false) / kPi +
                         rectRadiance(point, -1.0, 0.3, Estimator::True, true);
    for (const Estimator estimator : {Estimator::True, Estimator::Split}) {
        OracleOptions options;
        options.estimator = estimator;
        options.samplesPerLight = 64;
        std::vector<double> values;
        double stated2 = 0.0;
        for (int i = 0; i < 200; ++i) {
            options.seed = 100 + i;
            const OraclePointResult r = oracle.evaluatePoint(point, 0, options);
            values.push_back(r.diffuseNit.g + r.specularNit.g);
            stated2 += r.standardErrorNit.g * r.standardErrorNit.g / 200;
        }
        const double mean = std::accumulate(values.begin(), values.end(), 0.0) / 200;
        double spread2 = 0.0;
        for (const double value : values)
            spread2 += (value - mean) * (value - mean) / 199;
        EXPECT_NEAR(std::sqrt(stated2 / spread2), 1.0, 0.2);
        if (estimator == Estimator::True) {
            EXPECT_NEAR(mean, truth, 4.0 * std::sqrt(spread2 / 200));
        }
    }
}

} // namespace
} // namespace kilolux::oracle
