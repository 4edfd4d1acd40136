// Barn doors: what a receiver sees past the flaps against flaps as segments in space, samples of that part,
// the weight, float against double, and the limits where doors are shut, open or absent.
#include "renderer/lights_cpp/light_tables.h"
#include "renderer/lights_cpp/lights_f32.h"
#include "tests/unit/lights/random_lights.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

namespace kilolux::test {
namespace {

// A rectangle in the plane z = 0 that looks along -z, with flaps given by angle and length.
struct DoorLight {
    shared::LightHot hot;
    LightTables tables;
    std::array<dvec2, 4> leaves; // reach and depth
};

DoorLight doorLight(const dvec2& halfM, const std::array<dvec2, 4>& angleAndLength) {
    DoorLight light;
    light.hot =
        hotRecord({shared::LIGHT_RECT, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, halfM}, glm::vec3(1.0f));
    light.hot.typeFlags |= 1u << shared::LIGHT_SHAPING_SHIFT;
    light.tables.shapings.resize(1);
    for (int i = 0; i < 4; ++i) {
        light.leaves[std::size_t(i)] =
            angleAndLength[std::size_t(i)].y *
            dvec2(std::sin(angleAndLength[std::size_t(i)].x), std::cos(angleAndLength[std::size_t(i)].x));
        light.tables.shapings[0].doorReachM[i] = float(light.leaves[std::size_t(i)].x);
        light.tables.shapings[0].doorDepthM[i] = float(light.leaves[std::size_t(i)].y);
    }
    return light;
}

DoorLight randomDoors(Random& random) {
    std::array<dvec2, 4> doors;
    for (dvec2& door : doors) {
        const double length = random.uniform(0, 1) < 0.2 ? 0.0 : random.logUniform(0.05, 3.0);
        door = {random.uniform(0, 1) < 0.1 ? std::round(random.uniform(0, 1)) * 0.5 * kPi
                                           : random.uniform(0.0, 0.5 * kPi),
                length};
    }
    return doorLight({random.logUniform(0.1, 2.0), random.logUniform(0.1, 2.0)}, doors);
}

dvec3 randomReceiver(Random& random) {
    return {random.uniform(-2, 2), random.uniform(-2, 2), -random.logUniform(0.02, 4.0)};
}

double crossOf(const dvec2& a, const dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

// Whether a flap stands between source and receiver, in the plane of the axis over its edge and the way
// ahead.
bool crosses(const dvec2& hinge, const dvec2& leaf, const dvec2& source, const dvec2& receiver) {
    const dvec2 way = receiver - source, toHinge = hinge - source;
    const double det = crossOf(way, leaf);
    if (std::abs(det) < 1e-14) return false;
    const double alongWay = crossOf(toHinge, leaf) / det, alongLeaf = crossOf(toHinge, way) / det;
    return alongWay > 0.0 && alongWay < 1.0 && alongLeaf > 0.0 && alongLeaf < 1.0;
}

bool isHidden(const DoorLight& light, const dvec2& source, const dvec3& receiver) {
    for (int i = 0; i < 4; ++i) {
        const int axis = i / 2;
        const double side = i % 2 ? 1.0 : -1.0;
        if (crosses({double(light.hot.sizeM[axis]), 0.0}, light.leaves[std::size_t(i)],
                    {side * source[axis], 0.0}, {side * receiver[axis], -receiver.z}))
            return true;
    }
    return false;
}

TEST(BarnDoors, WhatIsSeenIsWhatNoFlapCrosses) {
    Random random{std::mt19937(21)};
    int seen = 0, hidden = 0;
    for (int i = 0; i < 3000; ++i) {
        const DoorLight light = randomDoors(random);
        const BindLightTables bound(light.tables);
        const f64::LightHot exact = f64::fromF32(light.hot);
        const dvec3 receiver = randomReceiver(random);
        for (int k = 0; k < 20; ++k) {
            const dvec2 at(random.uniform(-1, 1), random.uniform(-1, 1));
            const dvec2 source = at * dvec2(light.hot.sizeM);
            const dvec3 dir = glm::normalize(dvec3(source, 0.0) - receiver);
            const f64::LightHit hit = f64::lightIntersect(exact, receiver, dir);
            // Within rounding of the record an edge may go either way.
            const bool near =
                isHidden(light, source * 1.0002, receiver) != isHidden(light, source * 0.9998, receiver);
            if (near) continue;
            EXPECT_EQ(hit.hit, !isHidden(light, source, receiver)) << i << ", " << k;
            (hit.hit ? seen : hidden) += 1;
        }
    }
    EXPECT_GT(seen, 10000);
    EXPECT_GT(hidden, 10000);
}

TEST(BarnDoors, SamplesAreEvenOverWhatIsSeen) {
    bindCommittedTable();
    Random random{std::mt19937(22)};
    for (int i = 0; i < 300; ++i) {
        const DoorLight light = randomDoors(random);
        const BindLightTables bound(light.tables);
        const f64::LightHot exact = f64::fromF32(light.hot);
        dvec3 receiver = randomReceiver(random);
        // Beside a light that fills the sky the midpoint rule would be at fault.
        receiver.z = std::min(receiver.z, -0.5 * double(std::max(light.hot.sizeM.x, light.hot.sizeM.y)));
        const f64::ShadingPoint point = f64::makeShadingPoint(receiver, {0, 0, 1}, {0, 0, 1}, 0.7);
        const f64::LightIrradiance lit = f64::lightIrradiance(exact, point, f64::makeLtcLobe(point));
        double sum = 0.0;
        const int side = 24;
        for (int k = 0; k < side * side; ++k) {
            const dvec2 uv((k % side + 0.5) / side, (k / side + 0.5) / side);
            const f64::LightSample s = f64::lightSample(exact, receiver, uv);
            ASSERT_EQ(s.valid, lit.emission.x > 0.0);
            if (!s.valid) continue;
            sum += s.geometry * s.dirWs.z / (side * side);
            ASSERT_FALSE(isHidden(light, (2.0 * s.uv - 1.0) * dvec2(light.hot.sizeM) * 0.9999, receiver));
            const f64::LightHit hit = f64::lightIntersect(exact, receiver, s.dirWs);
            ASSERT_TRUE(hit.hit);
            ASSERT_NEAR(hit.pdfArea / s.pdfArea, 1.0, 1e-9);
            ASSERT_LT(glm::length(hit.uv - s.uv), 1e-6);
        }
        EXPECT_NEAR(sum, lit.diffuse, 0.01 * lit.diffuse + 1e-9) << i;
    }
}

TEST(BarnDoors, OpenFlapsChangeNothingAndShutOnesHideAll) {
    const DoorLight open =
        doorLight({0.5, 0.3}, {dvec2(0.5 * kPi, 2.0), {0.3, 0.0}, {0.5 * kPi, 1.0}, {0.0, 0.0}});
    const DoorLight straight = doorLight({0.5, 0.3}, {dvec2(0.0, 1.0), {0.0, 1.0}, {0.0, 1.0}, {0.0, 1.0}});
    Random random{std::mt19937(23)};
    for (int i = 0; i < 1000; ++i) {
        const dvec3 receiver = randomReceiver(random);
        shared::LightHot bare = open.hot;
        bare.typeFlags = shared::LIGHT_RECT;
        const glm::vec2 uv(random.uniform(0, 1), random.uniform(0, 1));
        const f32::LightSample plain = f32::lightSample(bare, glm::vec3(receiver), uv);
        {
            const BindLightTables bound(open.tables);
            const f32::LightSample s = f32::lightSample(open.hot, glm::vec3(receiver), uv);
            EXPECT_LT(glm::length(s.positionWs - plain.positionWs), 1e-6f);
            EXPECT_FLOAT_EQ(s.pdfArea, plain.pdfArea);
        }
        // Between four straight walls: within them what is beside the light is dark.
        const BindLightTables bound(straight.tables);
        const bool beside = std::abs(receiver.x) > 0.5 || std::abs(receiver.y) > 0.3;
        const bool lit = f32::lightEvaluate(straight.hot, glm::vec3(receiver)).x > 0.0f;
        if (receiver.z > -1.0) {
            EXPECT_EQ(lit, !beside);
        }
    }
}

// A receiver that doors leave anything to has a weight, and float finds the part that double finds.
TEST(BarnDoors, FloatAgreesWithDoubleAndWeightsArePositive) {
    bindCommittedTable();
    Random random{std::mt19937(24)};
    double worst = 0.0;
    for (int i = 0; i < 20000; ++i) {
        DoorLight light = randomDoors(random);
        const dvec3 shift = i % 4 ? dvec3(0.0) : dvec3(60.0, 10.0, -80.0);
        light.hot.positionWs = glm::vec3(shift);
        const BindLightTables bound(light.tables);
        const glm::vec3 receiver(shift + randomReceiver(random));
        const glm::vec3 normal(f64::sphereFromSquare({random.uniform(0, 1), random.uniform(0, 1)}));
        const f32::ShadingPoint point = f32::makeShadingPoint(receiver, normal, normal, 0.5f);
        const f32::LightIrradiance lit = f32::lightIrradiance(light.hot, point, f32::makeLtcLobe(point));
        const f64::ShadingPoint exactPoint = f64::makeShadingPoint(
            dvec3(receiver), glm::normalize(dvec3(normal)), glm::normalize(dvec3(normal)), 0.5);
        const f64::LightIrradiance exact =
            f64::lightIrradiance(f64::fromF32(light.hot), exactPoint, f64::makeLtcLobe(exactPoint));
        ASSERT_TRUE(std::isfinite(lit.diffuse) && lit.diffuse >= 0.0f);
        shared::LightHot bare = light.hot;
        bare.typeFlags = shared::LIGHT_RECT;
        const f32::LightIrradiance all = f32::lightIrradiance(bare, point, f32::makeLtcLobe(point));
        EXPECT_LE(lit.diffuse, all.diffuse * 1.0001f + 1e-6f) << "doors add no light";
        worst = std::max(worst, std::abs(lit.diffuse * lit.emission.x - exact.diffuse * exact.emission.x) /
                                    std::max(exact.emission.x, 1.0));
        if (lit.emission.x * (lit.diffuse + lit.specular.x) > 0.0f) {
            ASSERT_GT(f32::lightWeight(light.hot, point, 0.5f, 0.04f), 0.0f) << i;
        }
    }
    std::printf("barn doors, float against double: largest error of the irradiance by unit radiance %.1e\n",
                worst);
    EXPECT_LT(worst, 2e-3);
}

} // namespace
} // namespace kilolux::test
