// Pictures on rectangle lights: how samples follow them, how near the prefiltered analytic light comes to the
// oracle's, which way up and round they hang, and pictures of numbers that are none.
#include "renderer/gpu_lights.h"
#include "renderer/lights_cpp/lights_f32.h"
#include "renderer/lights_cpp/lights_f64.h"
#include "renderer/lights_cpp/ltc_table.h"
#include "renderer/reference/oracle_estimate.h"
#include "renderer/source_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace kilolux {
namespace {

using glm::dvec2;
using glm::dvec3;

using ColorAt = std::function<dvec3(double u, double v)>; // u to the right, v down

std::shared_ptr<const Image> imageOf(int width, int height, const ColorAt& color) {
    auto image = std::make_shared<Image>();
    image->width = width;
    image->height = height;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const dvec3 rgb = color((x + 0.5) / width, (y + 0.5) / height);
            for (const double value : {rgb.r, rgb.g, rgb.b, 1.0})
                image->rgbaF32.push_back(float(value));
        }
    }
    return image;
}

dvec3 halves(double u, double) {
    return dvec3(u < 0.5 ? 1.0 : 0.0);
}

dvec3 quadrants(double u, double v) {
    if (v < 0.5) return u < 0.5 ? dvec3(1.0, 0.1, 0.1) : dvec3(0.1, 1.0, 0.1);
    return u < 0.5 ? dvec3(0.1, 0.1, 1.0) : dvec3(0.9, 0.8, 0.1);
}

dvec3 checker(double u, double v) {
    return dvec3((int(u * 8.0) + int(v * 8.0)) % 2 ? 1.0 : 0.02);
}

struct Numbers {
    std::mt19937 engine{17};
    double between(double low, double high) { return low + (high - low) * double(engine()) / 4294967296.0; }
    dvec3 direction() { return f64::sphereFromSquare({between(0, 1), between(0, 1)}); }
};

// A light of 2 x 1 m at the origin that looks along -Z.
LightDef pictureLight(std::shared_ptr<const Image> image) {
    LightDef def;
    def.type = LightType::Rect;
    def.unit = LightUnit::Nit;
    def.intensity = 100.0;
    def.rangeM = 1e6;
    def.widthM = 2.0;
    def.heightM = 1.0;
    def.sourceImage = std::move(image);
    return def;
}

class Pictures : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        useLtcTable(loadLtcTable(KILOLUX_SOURCE_DIR "/content/ltc_ggx.bin").value());
    }

    // Binds the records of a light at the origin.
    void use(const LightDef& def) {
        bound_.reset();
        Scene scene;
        scene.lightDefs = {def};
        scene.nodes = {Node{}};
        scene.lights = {{.id = 1, .node = 0, .def = 0}};
        records_ = makeGpuLights(scene, dvec3(0.0), 0.0);
        bound_ = std::make_unique<BindLightTables>(records_.tables);
    }
    const shared::LightHot& hot() const { return records_.hot[0]; }
    f64::LightHot light() const { return f64::fromF32(records_.hot[0]); }

  private:
    GpuLights records_;
    std::unique_ptr<BindLightTables> bound_;
};

LightDef withDoors(LightDef def) {
    def.barnDoors[0] = {0.3, 0.6};
    def.barnDoors[2] = {0.1, 0.4};
    return def;
}

// Even numbers of the square meet the face as often as the density says, the way back is exact, and near
// numbers are near points.
TEST_F(Pictures, SamplesFollowTheLuminance) {
    for (const ColorAt& color : {ColorAt(halves), ColorAt(quadrants), ColorAt(checker)}) {
        for (const bool doors : {false, true}) {
            const LightDef def = pictureLight(imageOf(256, 256, color));
            use(doors ? withDoors(def) : def);
            const f64::LightHot rect = light();
            const dvec3 receiver =
                doors ? dvec3(-1.6, 0.7, -0.9) : dvec3(0.7, -0.2, -0.9); // behind two flaps
            constexpr int kSide = 400, kCells = 6;
            double counted[kCells][kCells] = {}, expected[kCells][kCells] = {}, steps = 0.0, chosen = 0.0;
            dvec2 before(0.0);
            for (int i = 0; i < kSide * kSide; ++i) {
                // Back and forth, so that each number is beside the one before.
                const int y = i / kSide, x = y % 2 ? kSide - 1 - i % kSide : i % kSide;
                const auto s = f64::lightSample(rect, receiver, {(x + 0.5) / kSide, (y + 0.5) / kSide});
                ASSERT_TRUE(s.valid);
                const dvec2 at(s.positionWs.x / 2.0 + 0.5, s.positionWs.y + 0.5);
                counted[int(at.x * kCells)][int(at.y * kCells)] += 1.0 / (kSide * kSide);
                chosen += f64::luminance(s.tint) / (kSide * kSide);
                if (i > 0) steps = std::max(steps, glm::length(at - before));
                before = at;
                if (i % 97 != 0) continue;
                const auto hit = f64::lightIntersect(rect, receiver, s.dirWs);
                ASSERT_TRUE(hit.hit);
                ASSERT_NEAR(hit.uv.x, s.uv.x, 1e-6);
                ASSERT_NEAR(hit.uv.y, s.uv.y, 1e-6);
                ASSERT_NEAR(hit.pdfArea / s.pdfArea, 1.0, 0.02); // the density has steps
                if (!doors) {
                    ASSERT_NEAR(s.uv.x, (x + 0.5) / kSide, 1e-6);
                }
            }
            double all = 0.0;
            for (int i = 0; i < kSide * kSide; ++i) {
                const dvec2 at((i % kSide + 0.5) / kSide, (i / kSide + 0.5) / kSide);
                const dvec3 to = dvec3(2.0 * at.x - 1.0, at.y - 0.5, 0.0) - receiver;
                const auto hit = f64::lightIntersect(rect, receiver, glm::normalize(to));
                const double share = hit.hit ? hit.pdfArea * 2.0 / (kSide * kSide) : 0.0; // of 2 m2
                expected[int(at.x * kCells)][int(at.y * kCells)] += share;
                all += share;
            }
            EXPECT_NEAR(all, 1.0, 5e-3);
            for (int k = 0; k < kCells * kCells; ++k)
                EXPECT_NEAR(counted[k / kCells][k % kCells], expected[k / kCells][k % kCells], 3e-3);
            // From row to row a step down a column of dark cells is long in u, but no jump across the light.
            EXPECT_LT(steps, 0.2);
            const double mean = f64::luminance(dvec3(sourcePictureOf(def)->mean));
            std::printf("mean luminance %.3f, of samples %.3f, longest step %.3f\n", mean, chosen, steps);
            if (!doors) {
                EXPECT_GT(chosen, mean * 1.2);
            }
        }
    }
}

struct Receiver {
    dvec3 position, normal, view;
    double roughness;
};

// Before the light at 0.1 to 4 m, looking towards it.
Receiver someReceiver(Numbers& numbers, double roughness) {
    const double distanceM = 0.1 * std::pow(40.0, numbers.between(0, 1));
    dvec3 out = numbers.direction();
    out.z = -std::abs(out.z) - 0.3;
    Receiver r;
    r.position =
        dvec3(numbers.between(-0.9, 0.9), numbers.between(-0.4, 0.4), 0.0) + glm::normalize(out) * distanceM;
    r.normal = glm::normalize(dvec3(0, 0, 1) + numbers.direction() * 0.8);
    r.view = glm::normalize(r.normal + numbers.direction() * 0.8);
    r.roughness = roughness;
    return r;
}

oracle::OraclePointResult truthOf(const LightDef& def, const Receiver& r) {
    oracle::OraclePoint point;
    point.positionWs = r.position;
    point.geometricNormalWs = point.shadingNormalWs = r.normal;
    point.viewDirWs = r.view;
    point.material = {dvec3(1.0), 0.0, r.roughness};
    return oracle::estimateLight(oracle::makeLight(def, glm::dmat4(1.0)), point, {}, oracle::Estimator::True,
                                 8, 1);
}

double at(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    return values[std::size_t(share * double(values.size() - 1))];
}

// Errors count against what a white picture gives there; where that is next to nothing of the specular lobe,
// against a tenth of the lobe.
struct ModelErrors {
    std::vector<double> diffuse, specular, plainDiffuse, plainSpecular;
};

ModelErrors errorsOf(const f64::LightHot& rect, const LightDef& def, double roughness, int count) {
    Numbers numbers;
    ModelErrors errors;
    const dvec3 mean = sourcePictureOf(def)->mean;
    while (int(errors.diffuse.size()) < count) {
        const Receiver r = someReceiver(numbers, roughness);
        const oracle::OraclePointResult truth = truthOf(def, r);
        const auto point = f64::makeShadingPoint(r.position, r.normal, r.view, r.roughness);
        const f64::LtcLobe lobe = f64::makeLtcLobe(point);
        const auto lit = f64::lightIrradiance(rect, point, lobe);
        const dvec3 plain = f64::lightEvaluate(rect, r.position);
        if (plain.r <= 0.0) continue;
        const double diffuse = lit.diffuse, specular = 0.04 * lit.specular.x + lit.specular.y;
        const auto error = [&](const dvec3& found, const dvec3& exact, double scale) {
            const dvec3 difference = glm::abs(found - exact) / (plain.r * scale);
            return std::max({difference.r, difference.g, difference.b});
        };
        const double seen = std::max(specular, 0.1 * (0.04 * lobe.albedo.x + lobe.albedo.y));
        errors.diffuse.push_back(error(lit.emission * diffuse, truth.unshadowedIrradianceLux, diffuse));
        errors.specular.push_back(error(lit.specularEmission * specular, truth.unshadowedSpecularNit, seen));
        errors.plainDiffuse.push_back(error(plain * mean * diffuse, truth.unshadowedIrradianceLux, diffuse));
        errors.plainSpecular.push_back(error(plain * mean * specular, truth.unshadowedSpecularNit, seen));
    }
    return errors;
}

TEST_F(Pictures, AnalyticLightIsNearTheOracles) {
    const std::pair<const char*, ColorAt> kinds[] = {
        {"halves", halves}, {"quadrants", quadrants}, {"checker", checker}};
    for (const auto& [name, color] : kinds) {
        for (const double roughness : {0.15, 0.5}) {
            for (const bool doors : {false, true}) {
                if (doors && roughness < 0.5) continue;
                const LightDef plain = pictureLight(imageOf(256, 256, color));
                const LightDef def = doors ? withDoors(plain) : plain;
                use(def);
                const ModelErrors e = errorsOf(light(), def, roughness, 100);
                std::printf("%-9s %s roughness %.2f: diffuse median %.3f, p95 %.3f (mean colour %.3f, %.3f); "
                            "specular %.3f, %.3f (%.3f, %.3f)\n",
                            name, doors ? "doors" : "     ", roughness, at(e.diffuse, 0.5),
                            at(e.diffuse, 0.95), at(e.plainDiffuse, 0.5), at(e.plainDiffuse, 0.95),
                            at(e.specular, 0.5), at(e.specular, 0.95), at(e.plainSpecular, 0.5),
                            at(e.plainSpecular, 0.95));
                EXPECT_LT(at(e.diffuse, 0.5), 0.02);
                EXPECT_LT(at(e.diffuse, 0.95), 0.1);
                EXPECT_LT(at(e.specular, 0.5), 0.03);
                EXPECT_LT(at(e.specular, 0.95), 0.1);
            }
        }
    }
}

// The light at its points, over their density, is the oracle's.
TEST_F(Pictures, PointsAddUpToTheOraclesLight) {
    Numbers numbers;
    for (const bool doors : {false, true}) {
        const LightDef plain = pictureLight(imageOf(256, 256, quadrants));
        const LightDef def = doors ? withDoors(plain) : plain;
        use(def);
        for (int i = 0; i < 12; ++i) {
            const Receiver r = someReceiver(numbers, 0.5);
            const auto point = f64::makeShadingPoint(r.position, r.normal, r.view, r.roughness);
            const dvec3 emission = f64::lightEvaluate(light(), r.position);
            constexpr int kSide = 256;
            dvec3 lux(0.0), specular(0.0);
            for (int k = 0; k < kSide * kSide; ++k) {
                const auto s = f64::lightSample(light(), r.position,
                                                {(k % kSide + 0.5) / kSide, (k / kSide + 0.5) / kSide});
                if (!s.valid) continue;
                const auto lobe = f64::ggxTimesCosine(r.normal, r.view, point.noV, s.dirWs, point.alpha);
                const dvec3 arriving = emission * s.tint * (s.geometry / (kSide * kSide));
                lux += arriving * std::max(glm::dot(r.normal, s.dirWs), 0.0);
                specular += arriving * lobe.x * (0.04 * (1.0 - lobe.y) + lobe.y);
            }
            const oracle::OraclePointResult truth = truthOf(def, r);
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(lux[c], truth.unshadowedIrradianceLux[c],
                            0.02 * truth.unshadowedIrradianceLux[c] + 1e-5 * emission.r)
                    << i;
                EXPECT_NEAR(specular[c], truth.unshadowedSpecularNit[c],
                            0.02 * truth.unshadowedSpecularNit[c] + 1e-5 * emission.r)
                    << i;
            }
        }
    }
}

// Seen from the front, where the light's +X is at the left hand, a picture reads as it does on a screen.
TEST_F(Pictures, HangsUprightAndReadsFromTheFront) {
    use(pictureLight(imageOf(64, 64, quadrants)));
    const std::pair<dvec2, dvec3> corners[] = {{{0.5, 0.25}, {1.0, 0.1, 0.1}},    // top left: red
                                               {{-0.5, 0.25}, {0.1, 1.0, 0.1}},   // top right: green
                                               {{0.5, -0.25}, {0.1, 0.1, 1.0}},   // bottom left: blue
                                               {{-0.5, -0.25}, {0.9, 0.8, 0.1}}}; // bottom right: yellow
    for (const auto& [place, color] : corners) {
        const auto point = f64::makeShadingPoint(dvec3(place, -0.01), {0, 0, 1}, {0, 0, 1}, 0.3);
        const auto lit = f64::lightIrradiance(light(), point, f64::makeLtcLobe(point));
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(lit.emission[c], 100.0 * color[c], 2.0);
            EXPECT_NEAR(lit.specularEmission[c], 100.0 * color[c], 2.0);
        }
    }
}

// Units are those of the light without its picture, which takes light away or adds to it.
TEST_F(Pictures, LumensAreThoseOfTheFaceTimesThePicture) {
    LightDef def =
        pictureLight(imageOf(32, 16, [](double u, double) { return dvec3(u < 0.25 ? 3.0 : 0.0); }));
    def.unit = LightUnit::Lumen;
    def.intensity = 1000.0;
    def.color = {1.0, 0.5, 0.2};
    use(def);
    const double stated = 1000.0 * 0.75 * f64::luminance(def.color);
    EXPECT_NEAR(f64::lightFlux(light()), stated, 0.01 * stated);
    double counted = 0.0;
    constexpr int kReceivers = 4000;
    for (int i = 0; i < kReceivers; ++i) {
        const double z = 1.0 - 2.0 * (i + 0.5) / kReceivers, phi = i * 2.39996322972865332;
        const dvec3 out(std::sqrt(1 - z * z) * std::cos(phi), std::sqrt(1 - z * z) * std::sin(phi), z);
        const auto point = f64::makeShadingPoint(out * 300.0, -out, -out, 1.0);
        const auto lit = f64::lightIrradiance(light(), point, f64::makeLtcLobe(point));
        counted += f64::luminance(lit.emission) * lit.diffuse * 4.0 * glm::pi<double>() * 9e4 / kReceivers;
    }
    EXPECT_NEAR(counted, f64::lightFlux(light()), 5e-3 * counted);
    use(pictureLight(imageOf(1, 1, [](double, double) { return dvec3(0.5, 0.25, 1.0); })));
    const auto point = f64::makeShadingPoint({0.3, 0.2, -1.0}, {0, 0, 1}, {0, 0, 1}, 0.5);
    const dvec3 tinted = f64::lightIrradiance(light(), point, f64::makeLtcLobe(point)).emission;
    EXPECT_NEAR(glm::length(tinted - dvec3(50.0, 25.0, 100.0)), 0.0, 0.05);
}

// Float against double; sound, and never dark by weight where there is light.
TEST_F(Pictures, NumbersThatAreNoneAreBlack) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN(),
                     kInfinity = std::numeric_limits<double>::infinity();
    const std::pair<const char*, ColorAt> kinds[] = {
        {"black", [](double, double) { return dvec3(0.0); }},
        {"not a number", [](double u, double) { return dvec3(u < 0.5 ? kNan : 1.0); }},
        {"infinite", [](double u, double) { return dvec3(u < 0.5 ? kInfinity : 1.0); }},
        {"negative", [](double u, double v) { return dvec3(u < 0.5 ? -1e30 : v); }},
        {"huge", [](double u, double v) { return dvec3(u < 0.01 && v < 0.01 ? 1e30 : 1e-3); }},
        {"tiny", [](double, double v) { return dvec3(v * 1e-7); }}};
    Numbers numbers;
    for (const auto& [name, color] : kinds) {
        SCOPED_TRACE(name);
        LightDef def = pictureLight(imageOf(100, 30, color));
        use(def);
        for (const float mean : sourcePictureOf(def)->warp)
            ASSERT_TRUE(std::isfinite(mean) && mean >= 0.0f);
        for (int i = 0; i < 300; ++i) {
            Receiver r = someReceiver(numbers, i % 3 ? numbers.between(0.0, 1.0) : 0.0);
            if (i % 4 == 0) r.position.z *= std::pow(10.0, numbers.between(-8, 0)); // towards its plane
            if (i % 4 == 1) r.position *= std::pow(10.0, numbers.between(0, 5));
            const auto point = f32::makeShadingPoint(glm::vec3(r.position), glm::vec3(r.normal),
                                                     glm::vec3(r.view), float(r.roughness));
            const auto lit = f32::lightIrradiance(hot(), point, f32::makeLtcLobe(point));
            const float weight = f32::lightWeight(hot(), point, 0.5f, 0.04f);
            const auto s =
                f32::lightSample(hot(), point.positionWs, {numbers.between(0, 1), numbers.between(0, 1)});
            for (const float value : {lit.emission.r, lit.emission.g, lit.emission.b, lit.specularEmission.r,
                                      lit.specularEmission.g, weight, s.tint.r, s.pdfArea, s.geometry})
                ASSERT_TRUE(std::isfinite(value) && value >= 0.0f) << i;
            const double light = lit.emission.g * lit.diffuse + lit.specularEmission.g * lit.specular.x;
            if (light > 1e-25) {
                ASSERT_GT(weight, 0.0f) << i;
            }
            const f64::LightHot exact = f64::fromF32(hot());
            const auto exactPoint =
                f64::makeShadingPoint(dvec3(glm::vec3(r.position)), r.normal, r.view, r.roughness);
            const auto truth = f64::lightIrradiance(exact, exactPoint, f64::makeLtcLobe(exactPoint));
            if (lit.diffuse > 1e-6f && truth.diffuse > 1e-6) {
                EXPECT_NEAR(lit.emission.g, truth.emission.g,
                            0.02 * truth.emission.g + 1e-3 * 100.0 * sourcePictureOf(def)->mean.g)
                    << i;
            }
        }
    }
}

} // namespace
} // namespace kilolux
