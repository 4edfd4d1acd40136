// The oracle's pictures: camera rays, pixel filters, determinism, and the sums that a picture must keep.
#include "tests/unit/oracle/scene_builder.h"

#include "renderer/document/gltf_import.h"
#include "renderer/reference/oracle_random.h"

#include <cstring>
#include <gtest/gtest.h>

namespace kilolux::oracle {
namespace {

using glm::dvec2;
using glm::dvec3;

// A floor lit by a rectangle, a quad between them, an emissive strip; camera from above at a slant.
struct SmallRoom {
    SceneBuilder builder;
    Camera camera;
    SmallRoom() {
        LightDef def = lightDef(LightType::Rect, 2000.0, LightUnit::Lumen);
        builder.light(def, lookingAlong({0, 3, 0}, {0, -1, 0}));
        def = lightDef(LightType::Sphere, 50.0, LightUnit::Candela);
        def.radiusM = 0.1;
        def.color = {1.0, 0.3, 0.2};
        builder.light(def, lookingAlong({1, 1.5, 1}, {0, -1, 0}));
        builder.quad(lookingAlong({0, 0, 0}, {0, -1, 0}), 6, 6, builder.material({0.6, 0.5, 0.4}, 0.0, 0.4));
        builder.quad(lookingAlong({0, 1, 0}, {0, -1, 0}), 1, 1, builder.material({0.3, 0.3, 0.8}, 1.0, 0.3));
        const int glow = builder.material(dvec3(0.0));
        builder.scene.materials[glow].emissiveNit = {300, 200, 100};
        builder.quad(lookingAlong({-1.5, 0.2, 0}, {-1, 0, 0}), 0.4, 0.4, glow);
        camera.worldFromCamera = lookingAlong({2.5, 2.5, 4}, {-0.55, -0.55, -1});
    }
};

// What a picture's pixel saw, as a point to shade.
OraclePoint pointOf(const OraclePixel& pixel, const Camera& camera) {
    OraclePoint point;
    point.positionWs = pixel.positionWs;
    point.geometricNormalWs = pixel.geometricNormalWs;
    point.shadingNormalWs = pixel.shadingNormalWs;
    point.viewDirWs = glm::normalize(dvec3(camera.worldFromCamera[3]) - pixel.positionWs);
    point.material = {pixel.baseColor, pixel.metallic, pixel.roughness};
    return point;
}

TEST(CameraRay, CornersAndCentre) {
    Camera camera;
    camera.yfovRad = 0.5 * kPi;
    camera.znearM = 0.5;
    camera.worldFromCamera = glm::translate(glm::dmat4(1.0), dvec3(1, 2, 3));
    const CameraRay centre = cameraRay(camera, 200, 100, {100, 50});
    EXPECT_LT(glm::length(centre.directionWs - dvec3(0, 0, -1)), 1e-15);
    EXPECT_EQ(centre.originWs, dvec3(1, 2, 3));
    EXPECT_NEAR(centre.minDistanceM, 0.5, 1e-15);
    const CameraRay corner = cameraRay(camera, 200, 100, {0, 0});
    EXPECT_LT(glm::length(corner.directionWs - glm::normalize(dvec3(-2, 1, -1))), 1e-12) << "top left";
    EXPECT_NEAR(corner.minDistanceM, 0.5 * std::sqrt(6.0), 1e-12) << "the near plane, not a sphere";
    camera.orthographic = true;
    camera.ymagM = 3.0;
    const CameraRay parallel = cameraRay(camera, 200, 100, {200, 100});
    EXPECT_LT(glm::length(parallel.originWs - dvec3(7, -1, 3)), 1e-12);
    EXPECT_LT(glm::length(parallel.directionWs - dvec3(0, 0, -1)), 1e-15);
}

TEST(Filter, OffsetsFollowTheWindow) {
    constexpr int kCount = 1 << 14;
    double inner = 0.0;
    double squares = 0.0;
    double largest = 0.0;
    dvec2 sum(0.0);
    for (int i = 0; i < kCount; ++i) {
        const dvec2 uv = sobolPoint(i, 1);
        const dvec2 box = sampleFilter(PixelFilter::Box, uv.x, uv.y);
        EXPECT_LE(std::max(std::abs(box.x), std::abs(box.y)), 0.5);
        const dvec2 p = sampleFilter(PixelFilter::BlackmanHarris, uv.x, uv.y);
        sum += p / double(kCount);
        squares += p.x * p.x / kCount;
        inner += std::abs(p.x) < 0.5 ? 1.0 / kCount : 0.0;
        largest = std::max(largest, std::abs(p.y));
    }
    EXPECT_NEAR(glm::length(sum), 0.0, 1e-3);
    EXPECT_LE(largest, 1.5);
    // By numeric integration of the window over [-1.5, 1.5].
    double total = 0.0, second = 0.0, within = 0.0;
    for (int i = 0; i < 30000; ++i) {
        const double x = -1.5 + 3.0 * (i + 0.5) / 30000;
        const double t = kPi * x / 1.5;
        const double w =
            0.35875 + 0.48829 * std::cos(t) + 0.14128 * std::cos(2 * t) + 0.01168 * std::cos(3 * t);
        total += w;
        second += w * x * x;
        within += std::abs(x) < 0.5 ? w : 0.0;
    }
    EXPECT_NEAR(squares, second / total, 1e-3);
    EXPECT_NEAR(inner, within / total, 1e-3);
}

TEST(Render, SameBytesForAnyThreadCountAndOtherBytesForAnotherSeed) {
    const SmallRoom room;
    const Oracle oracle(room.builder.scene);
    OracleOptions options;
    options.samplesPerLight = 16;
    options.jitterPx.reset();
    options.pixelSamples = 2;
    options.threads = 1;
    const OracleImage one = oracle.render(room.camera, 24, 16, options);
    options.threads = 3;
    const OracleImage three = oracle.render(room.camera, 24, 16, options);
    options.seed = 2;
    const OracleImage other = oracle.render(room.camera, 24, 16, options);
    int differing = 0;
    for (std::size_t i = 0; i < one.pixels.size(); ++i) {
        EXPECT_EQ(one.pixels[i].radianceNit, three.pixels[i].radianceNit);
        differing += one.pixels[i].radianceNit != other.pixels[i].radianceNit;
    }
    EXPECT_GT(differing, 50);
}

TEST(Render, RadianceIsTheSumOfItsParts) {
    const SmallRoom room;
    const Oracle oracle(room.builder.scene);
    const OracleImage image = oracle.render(room.camera, 48, 32);
    int emissive = 0;
    int metal = 0;
    for (const OraclePixel& pixel : image.pixels) {
        const dvec3 parts = pixel.diffuseNit + pixel.specularNit + pixel.emissionNit;
        EXPECT_LE(glm::length(parts - pixel.radianceNit), 1e-9 * (1.0 + glm::length(parts)));
        const dvec3 fromIrradiance = pixel.irradianceLux * pixel.baseColor * (1.0 - pixel.metallic) / kPi;
        EXPECT_LE(glm::length(fromIrradiance - pixel.diffuseNit), 1e-9 * (1.0 + glm::length(parts)));
        emissive += pixel.emissionNit == dvec3(300, 200, 100);
        metal += pixel.metallic == 1.0;
        EXPECT_TRUE(pixel.coverage == 0.0 || pixel.coverage == 1.0);
        EXPECT_EQ(pixel.node >= 0, pixel.coverage == 1.0);
    }
    EXPECT_GT(emissive, 1);
    EXPECT_GT(metal, 5);
}

TEST(Render, PointCallMatchesThePicture) {
    const SmallRoom room;
    const Oracle oracle(room.builder.scene);
    OracleOptions options;
    options.shadows = false; // no noise, so the two calls may be compared exactly
    const OracleImage image = oracle.render(room.camera, 24, 16, options);
    const OraclePixel& pixel = image.pixels[12 * 24 + 12];
    ASSERT_GE(pixel.node, 0);
    const OraclePoint point = pointOf(pixel, room.camera);
    dvec3 sum(0.0);
    for (std::size_t i = 0; i < oracle.lightCount(); ++i) {
        const OraclePointResult r = oracle.evaluatePoint(point, i, options);
        sum += r.diffuseNit + r.specularNit;
    }
    EXPECT_LE(glm::length(sum - pixel.radianceNit), 1e-9 * glm::length(sum));
}

// The scene that the renderer is compared on: opens, is lit, and both estimators keep the same light where
// nothing is hidden and nearly the same in all.
TEST(Render, Cornell) {
    const Result<Scene> scene = importGltf(KILOLUX_SOURCE_DIR "/content/scenes/cornell.glb");
    ASSERT_TRUE(scene) << scene.error();
    ASSERT_FALSE(scene.value().cameras.empty());
    const Oracle oracle(scene.value());
    OracleOptions options;
    const OracleImage exact = oracle.render(scene.value().cameras[0], 64, 64, options);
    options.estimator = Estimator::Split;
    const OracleImage split = oracle.render(scene.value().cameras[0], 64, 64, options);
    double exactSum = 0.0, splitSum = 0.0, error2 = 0.0;
    int lit = 0, covered = 0;
    for (std::size_t i = 0; i < exact.pixels.size(); ++i) {
        const OraclePixel& a = exact.pixels[i];
        const OraclePixel& b = split.pixels[i];
        ASSERT_TRUE(std::isfinite(a.radianceNit.g) && std::isfinite(b.radianceNit.g));
        exactSum += a.radianceNit.g;
        splitSum += b.radianceNit.g;
        error2 += a.standardErrorNit.g * a.standardErrorNit.g;
        covered += a.coverage == 1.0;
        const double noise = a.standardErrorNit.g + b.standardErrorNit.g;
        if (noise > 1e-9 * a.diffuseNit.g || a.diffuseNit.g <= 0.0) continue;
        ++lit;
        EXPECT_NEAR(a.diffuseNit.g, b.diffuseNit.g, 1e-9 * a.diffuseNit.g) << i;
    }
    EXPECT_GT(covered, 3000);
    EXPECT_GT(lit, 500);
    EXPECT_LT(std::sqrt(error2) / exactSum, 1e-3) << "noise of the mean";
    EXPECT_NEAR(splitSum / exactSum, 1.0, 0.02);
}

TEST(Render, ShadePointsOnAGivenGBuffer) {
    const SmallRoom room;
    const Oracle oracle(room.builder.scene);
    OracleOptions options;
    options.samplesPerLight = 256;
    const OracleImage image = oracle.render(room.camera, 24, 16, options);
    std::vector<OraclePoint> points;
    std::vector<const OraclePixel*> seen;
    for (const OraclePixel& pixel : image.pixels) {
        if (pixel.node < 0) continue;
        seen.push_back(&pixel);
        points.push_back(pointOf(pixel, room.camera));
    }
    const std::vector<OraclePixel> shaded = oracle.shadePoints(points, options);
    ASSERT_EQ(shaded.size(), points.size());
    for (std::size_t i = 0; i < shaded.size(); ++i) {
        const double reference = (seen[i]->diffuseNit + seen[i]->specularNit).g;
        const double noise = shaded[i].standardErrorNit.g + seen[i]->standardErrorNit.g;
        EXPECT_NEAR(shaded[i].radianceNit.g, reference, 6.0 * noise + 1e-9 * reference);
    }
}

TEST(Render, MutedAndUnreachableLightsGiveNothing) {
    SmallRoom room;
    room.builder.scene.lights[0].muted = true;
    room.builder.scene.nodes[room.builder.scene.lights[1].node].visible = false;
    const OracleImage image = Oracle(room.builder.scene).render(room.camera, 24, 16);
    for (const OraclePixel& pixel : image.pixels)
        EXPECT_EQ(pixel.diffuseNit + pixel.specularNit, dvec3(0.0));
}

TEST(Render, DerivedRangeActsOnLightsWithoutOne) {
    SmallRoom room;
    room.builder.scene.lightDefs[1].rangeM = 2.0;
    const Oracle oracle(room.builder.scene, {1.0, 0.5});
    const OraclePoint point = pointAt({0, 0, 0}, {0, 1, 0});
    EXPECT_EQ(oracle.evaluatePoint(point, 0).unshadowedIrradianceLux, dvec3(0.0)) << "3 m away, range 1";
    const OraclePoint near = pointAt({1, 0.3, 1}, {0, 1, 0});
    EXPECT_GT(oracle.evaluatePoint(near, 1).unshadowedIrradianceLux.r, 0.0) << "its own range wins";
}

// The noise of a picture as stated against its spread over seeds, jitter included.
TEST(Render, StandardErrorHoldsForPictures) {
    const SmallRoom room;
    const Oracle oracle(room.builder.scene);
    OracleOptions options;
    options.samplesPerLight = 8;
    options.pixelSamples = 8;
    options.jitterPx.reset();
    options.filter = PixelFilter::BlackmanHarris;
    double stated = 0.0;
    double spread = 0.0;
    constexpr int kSeeds = 12;
    std::vector<OracleImage> images;
    for (int seed = 0; seed < kSeeds; ++seed) {
        options.seed = seed;
        images.push_back(oracle.render(room.camera, 18, 12, options));
    }
    for (std::size_t i = 0; i < images[0].pixels.size(); ++i) {
        double mean = 0.0;
        for (const OracleImage& image : images)
            mean += image.pixels[i].radianceNit.g / kSeeds;
        for (const OracleImage& image : images) {
            const double error = image.pixels[i].standardErrorNit.g;
            stated += error * error / kSeeds;
            const double deviation = image.pixels[i].radianceNit.g - mean;
            spread += deviation * deviation / (kSeeds - 1);
        }
    }
    EXPECT_GT(stated, 0.6 * spread);
    EXPECT_LT(stated, 6.0 * spread) << "stratified offsets do better than independent ones, never worse";
}

} // namespace
} // namespace kilolux::oracle
