// uv -> point: even in area, continuous, fixed to the light's frame, unbiased, and inverted by
// lightIntersect.
#include "tests/unit/lights/random_lights.h"

#include <cmath>
#include <gtest/gtest.h>

namespace kilolux::test {
namespace {

struct Sampling : testing::TestWithParam<shared::uint> {
    static void SetUpTestSuite() { bindCommittedTable(); }
};

double areaOf(const Emitter& e) {
    switch (e.type) {
    case shared::LIGHT_RECT:
        return 4.0 * e.size.x * e.size.y;
    case shared::LIGHT_DISK:
        return kPi * e.size.x * e.size.x;
    case shared::LIGHT_TUBE:
        return 4.0 * kPi * e.size.x * (e.size.y + e.size.x);
    case shared::LIGHT_DIRECTIONAL:
        return 2.0 * kPi * (1.0 - 1.0 / std::sqrt(1.0 + e.size.x * e.size.x));
    default:
        return 4.0 * kPi * e.size.x * e.size.x;
    }
}

Emitter standard(shared::uint type) {
    const dvec3 z = glm::normalize(dvec3(0.2, 0.4, 0.9));
    const dvec3 x = glm::normalize(glm::cross(z, dvec3(0.3, 1.0, 0.0)));
    const dvec2 size = type == shared::LIGHT_TUBE ? dvec2(0.3, 0.5) : dvec2(0.5, 0.3);
    return {type, {0, 0, 2}, x, glm::cross(z, x), z, size};
}

// The point of the light's own map at this uv, found as a receiver that sees it would be given it; nan if
// none of the receivers tried does.
dvec3 pointAt(const f64::LightHot& light, const dvec2& uv) {
    const Emitter e = emitterOf(light);
    if (e.type == shared::LIGHT_DIRECTIONAL) return f64::lightSample(light, dvec3(0.0), uv).dirWs;
    if (e.type == shared::LIGHT_SPHERE || e.type == shared::LIGHT_SPOT)
        return e.center + f64::lightFrame(light) * f64::sphereFromSquare(uv) * e.size.x;
    for (int i = 0; i < 26; ++i) {
        const dvec3 away = f64::sphereFromSquare({i % 5 / 5.0, (i / 5 + 0.4) / 5.2});
        const f64::LightSample s = f64::lightSample(light, e.center + away * 50.0, uv);
        if (s.valid && glm::length(s.uv - uv) < 1e-9) return s.positionWs;
    }
    return dvec3(std::nan(""));
}

TEST_P(Sampling, MapPreservesAreaAndIsContinuous) {
    const Emitter e = standard(GetParam());
    const f64::LightHot light = f64::fromF32(hotRecord(e, glm::vec3(1.0f)));
    Random random{std::mt19937(3)};
    const double step = 1e-5;
    for (int i = 0; i < 400; ++i) {
        const dvec2 uv(random.uniform(0.01, 0.98), random.uniform(0.01, 0.98));
        const dvec3 p = pointAt(light, uv);
        const dvec3 du = pointAt(light, uv + dvec2(step, 0.0)) - p;
        const dvec3 dv = pointAt(light, uv + dvec2(0.0, step)) - p;
        ASSERT_FALSE(std::isnan(p.x + du.x + dv.x)) << uv.x << ", " << uv.y;
        EXPECT_NEAR(glm::length(glm::cross(du, dv)) / (step * step), areaOf(e), 2e-3 * areaOf(e))
            << uv.x << ", " << uv.y;
        EXPECT_LT(glm::length(du) + glm::length(dv), 100.0 * step);
    }
}

TEST_P(Sampling, SamePointForEveryReceiver) {
    const Emitter e = standard(GetParam());
    const f64::LightHot light = f64::fromF32(hotRecord(e, glm::vec3(1.0f)));
    Random random{std::mt19937(4)};
    for (int i = 0; i < 500; ++i) {
        const dvec3 receiver = random.direction() * random.uniform(0.0, 1.3);
        const f64::LightSample s =
            f64::lightSample(light, receiver, {random.uniform(0, 1), random.uniform(0, 1)});
        if (!s.valid) continue;
        const dvec3 point = e.type == shared::LIGHT_DIRECTIONAL ? s.dirWs : s.positionWs;
        const dvec3 own = pointAt(light, s.uv);
        if (std::isnan(own.x)) continue; // on the map's seam, or seen by none of pointAt's receivers
        EXPECT_LT(glm::length(own - point), 1e-6) << s.uv.x << ", " << s.uv.y;
    }
}

// The estimator with many even uv equals quadrature, so pdf and geometry are right; they agree with each
// other.
TEST_P(Sampling, MeanOfSamplesIsTheIrradiance) {
    Random random{std::mt19937(5 + GetParam())};
    for (int i = 0; i < 8; ++i) {
        Configuration c = randomConfiguration(random, GetParam());
        if (sineOf(c.emitter) > 0.8) continue;
        const f64::LightHot light = f64::fromF32(hotRecord(c.emitter, glm::vec3(1.0f)));
        c.emitter = emitterOf(light);
        if (f64::lightEvaluate(light, dvec3(0.0)).x <= 0.0) continue;
        double sum = 0.0;
        const int count = 300;
        for (int k = 0; k < count * count; ++k) {
            const f64::LightSample s =
                f64::lightSample(light, dvec3(0.0), {(k % count + 0.5) / count, (k / count + 0.5) / count});
            sum += s.valid ? s.geometry * std::max(s.dirWs.z, 0.0) / (count * count) : 0.0;
            EXPECT_NEAR(s.valid ? s.geometry * s.pdfSolidAngle : 1.0, 1.0, 1e-6);
        }
        const double truth = integrate(c.emitter, c.surface).diffuse;
        EXPECT_NEAR(sum, truth, 2e-3 * truth) << describe(c.emitter, c.surface);
    }
}

TEST_P(Sampling, IntersectionFindsTheSampleAgain) {
    Random random{std::mt19937(6 + GetParam())};
    int tested = 0;
    for (int i = 0; i < 4000; ++i) {
        const Configuration c = randomConfiguration(random, GetParam());
        const f64::LightHot light = f64::fromF32(hotRecord(c.emitter, glm::vec3(1.0f)));
        const dvec2 uv(random.uniform(0.002, 0.998), random.uniform(0.002, 0.998));
        const f64::LightSample s = f64::lightSample(light, dvec3(0.0), uv);
        if (!s.valid || -glm::dot(s.emitterNormalWs, s.dirWs) < 0.03) continue;
        ++tested;
        const f64::LightHit hit = f64::lightIntersect(light, dvec3(0.0), s.dirWs);
        ASSERT_TRUE(hit.hit) << describe(c.emitter, c.surface) << " uv " << uv.x << ", " << uv.y;
        EXPECT_NEAR(hit.distanceM / s.distanceM, 1.0, 1e-6);
        EXPECT_NEAR(hit.uv.x, s.uv.x, 1e-5) << describe(c.emitter, c.surface);
        EXPECT_NEAR(hit.uv.y, s.uv.y, 1e-5);
        EXPECT_NEAR(hit.pdfSolidAngle / s.pdfSolidAngle, 1.0, 1e-4);
        EXPECT_NEAR(hit.pdfArea / s.pdfArea, 1.0, 1e-6);
    }
    EXPECT_GT(tested, 1000);
}

// Over all directions the density integrates to the share of valid samples.
TEST_P(Sampling, DensityIsNormalized) {
    const Emitter e = standard(GetParam());
    const f64::LightHot light = f64::fromF32(hotRecord(e, glm::vec3(1.0f)));
    const dvec3 axis = directionTo(e);
    const glm::dmat3 frame = f64::basisFromNormal(axis);
    // Holds every standard light; a sphere just so, because its density grows without bound at its edge.
    const bool ball = GetParam() == shared::LIGHT_SPHERE || GetParam() == shared::LIGHT_SPOT;
    const double cone = 1.0 - (ball ? std::sqrt(1.0 - sineOf(e) * sineOf(e)) : std::cos(0.6));
    double integral = 0.0;
    double valid = 0.0;
    const int count = 700;
    for (int i = 0; i < count * count; ++i) {
        const dvec2 uv((i % count + 0.5) / count, (i / count + 0.5) / count);
        const double m = (1.0 - uv.y * uv.y) * cone;
        const double sine = std::sqrt(m * (2.0 - m));
        const dvec3 dir =
            frame * dvec3(sine * std::cos(2.0 * kPi * uv.x), sine * std::sin(2.0 * kPi * uv.x), 1.0 - m);
        integral += f64::lightIntersect(light, dvec3(0.0), dir).pdfSolidAngle * 2.0 * kPi * cone * 2.0 *
                    uv.y / (count * count);
        valid += f64::lightSample(light, dvec3(0.0), uv).valid ? 1.0 / (count * count) : 0.0;
    }
    EXPECT_NEAR(integral, valid, 0.02);
    EXPECT_GT(valid, GetParam() == shared::LIGHT_TUBE ? 0.7 : 0.999);
}

INSTANTIATE_TEST_SUITE_P(Types, Sampling, testing::ValuesIn(kAllTypes),
                         [](const auto& type) { return std::string(kTypeNames[type.param]); });

TEST(Warp, SquareAndDiskAreInverse) {
    Random random{std::mt19937(8)};
    for (int i = 0; i < 2000; ++i) {
        const dvec2 uv(random.uniform(0, 1), random.uniform(0, 1));
        const dvec2 p = f64::diskFromSquare(uv);
        EXPECT_LE(glm::length(p), 1.0 + 1e-12);
        EXPECT_LT(glm::length(f64::squareFromDisk(p) - uv), 1e-9);
        const dvec3 dir = f64::sphereFromSquare(uv);
        EXPECT_NEAR(glm::length(dir), 1.0, 1e-12);
        EXPECT_LT(glm::length(f64::squareFromSphere(dir) - uv), 1e-9);
    }
    for (const dvec2& corner : {dvec2(0, 0), dvec2(1, 0), dvec2(0.5, 0.5), dvec2(0.5, 0), dvec2(1, 1)})
        EXPECT_LT(glm::length(f64::squareFromDisk(f64::diskFromSquare(corner)) - corner), 1e-9);
}

TEST(Pack, OctahedralDirectionsReturn) {
    Random random{std::mt19937(9)};
    double worst = 0.0;
    for (int i = 0; i < 20000; ++i) {
        const dvec3 dir = random.direction();
        EXPECT_LT(glm::length(f64::directionFromOct(f64::octFromDirection(dir)) - dir), 1e-12);
        worst = std::max(worst, glm::length(f64::unpackOct16(f64::packOct16(dir)) - dir));
    }
    EXPECT_LT(worst, 7e-5); // 2 x 16 bits
    for (const dvec3& axis : {dvec3(1, 0, 0), dvec3(0, -1, 0), dvec3(0, 0, -1)})
        EXPECT_LT(glm::length(f64::unpackOct16(f64::packOct16(axis)) - axis), 1e-9);
}

TEST(Hash, BitsAreEven) {
    // Chi-squared over 256 buckets of the 2D noise: 255 degrees of freedom, 99.99 % below 346.
    std::vector<int> buckets(256);
    const int count = 1 << 18;
    for (int i = 0; i < count; ++i) {
        const dvec2 u = f64::whiteNoise2(
            f64::pixelSeed({static_cast<unsigned>(i % 512), static_cast<unsigned>(i / 512)}, 7, 1), 3);
        ASSERT_TRUE(u.x >= 0.0 && u.x < 1.0 && u.y >= 0.0 && u.y < 1.0);
        ++buckets[static_cast<std::size_t>(u.x * 16) * 16 + static_cast<std::size_t>(u.y * 16)];
    }
    double chi = 0.0;
    for (const int n : buckets)
        chi += (n - count / 256.0) * (n - count / 256.0) / (count / 256.0);
    EXPECT_LT(chi, 346.0);
    EXPECT_GT(chi, 180.0);
}

} // namespace
} // namespace kilolux::test
