#include "tests/image/oracle_kit.h"

#include "renderer/accel/instances.h"
#include "renderer/gpu_lights.h"
#include "renderer/lights_cpp/ltc_table.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <map>

namespace kilolux::test {

namespace {

using glm::dvec3;

struct Seen {
    int node, primitive, triangle;
    bool operator==(const Seen&) const = default;
};

Seen seenBy(const oracle::OracleHit& hit) {
    return {hit.node, hit.primitive, hit.triangle};
}

// Whether some ray within 1/100 px of the pixel's centre sees this; nullopt stands for nothing.
bool isTie(const oracle::Oracle& oracle, const Camera& camera, int width, int height,
           const glm::dvec2& centre, const std::optional<Seen>& wanted) {
    for (int i = 0; i < 16; ++i) {
        const double turn = 2.0 * glm::pi<double>() * i / 16.0;
        const glm::dvec2 at = centre + 0.01 * glm::dvec2(std::cos(turn), std::sin(turn));
        const oracle::CameraRay ray = oracle::cameraRay(camera, width, height, at);
        const auto hit = oracle.tracePrimary(ray.originWs, ray.directionWs, ray.minDistanceM);
        if (hit.has_value() == wanted.has_value() && (!hit || seenBy(*hit) == *wanted)) return true;
    }
    return false;
}

double angleBetween(const dvec3& a, const dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// Ranges that the renderer derives for lights without one.
std::vector<double> derivedRanges(const Scene& scene, double exposureEv100) {
    std::vector<double> ranges;
    for (const LightNode& light : scene.lights) {
        const LightDef& def = scene.lightDefs[std::size_t(light.def)];
        const bool derived = !def.rangeM && def.type != LightType::Directional;
        ranges.push_back(derived ? deriveRange(def, exposureEv100).rangeM : 0.0);
    }
    return ranges;
}

struct Lobes {
    dvec3 diffuse{0.0}, specular{0.0};
    dvec3 sum() const { return diffuse + specular; }
};

// What a pixel sends to the viewer, nit.
Lobes lobesAt(const FrameTargets& targets, std::size_t pixel, double exposure) {
    const PixelSurface s = targets.surface(pixel);
    return {targets.rgb("litDiffuse", pixel) * s.baseColor * (1.0 - s.metallic) / exposure,
            targets.rgb("litSpecular", pixel) / exposure};
}

// Sums of a replica over the matched pixels, and means of each pixel over the replicas.
struct Replicas {
    std::vector<double> channel[3], luminance;
    std::vector<double> pixelSum, pixelSquares; // luminance
    Lobes total;

    void add(const FrameTargets& targets, const std::vector<std::size_t>& pixels, double exposure) {
        pixelSum.resize(pixels.size());
        pixelSquares.resize(pixels.size());
        Lobes mean;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const Lobes lobes = lobesAt(targets, pixels[i], exposure);
            mean.diffuse += lobes.diffuse / double(pixels.size());
            mean.specular += lobes.specular / double(pixels.size());
            const double nit = luminanceOf(lobes.sum());
            pixelSum[i] += nit;
            pixelSquares[i] += nit * nit;
        }
        for (int c = 0; c < 3; ++c)
            channel[c].push_back(mean.sum()[c]);
        luminance.push_back(luminanceOf(mean.sum()));
        total.diffuse += mean.diffuse;
        total.specular += mean.specular;
    }
};

// Largest difference of a block's mean beyond four standard errors, over the picture's mean.
double worstBlock(const Replicas& replicas, const MatchedPixels& matched,
                  const std::vector<oracle::OraclePixel>& truth, int width, double meanNit) {
    struct Block {
        double difference = 0.0, variance = 0.0;
        int pixels = 0;
    };
    std::map<std::size_t, Block> blocks;
    const double n = double(replicas.luminance.size());
    for (std::size_t i = 0; i < matched.pixels.size(); ++i) {
        const std::size_t x = matched.pixels[i] % std::size_t(width),
                          y = matched.pixels[i] / std::size_t(width);
        Block& block = blocks[(y / 8) * 1000 + x / 8];
        const double mean = replicas.pixelSum[i] / n;
        const double spread = std::max(replicas.pixelSquares[i] / n - mean * mean, 0.0) / (n - 1.0);
        const double error = luminanceOf(truth[i].standardErrorNit);
        block.difference += mean - luminanceOf(truth[i].radianceNit);
        block.variance += spread + error * error;
        ++block.pixels;
    }
    double worst = 0.0;
    for (const auto& [place, block] : blocks) {
        if (block.pixels < 16) continue;
        const double beyond = std::abs(block.difference) - 4.0 * std::sqrt(block.variance);
        worst = std::max(worst, beyond / block.pixels / meanNit);
    }
    return worst;
}

std::vector<oracle::OraclePoint> pointsOf(const MatchedPixels& matched, const FrameTargets& targets) {
    std::vector<oracle::OraclePoint> points;
    for (std::size_t i = 0; i < matched.pixels.size(); ++i) {
        oracle::OraclePoint point = matched.hits[i].point; // position and geometric normal stay exact
        const PixelSurface s = targets.surface(matched.pixels[i]);
        point.shadingNormalWs = s.normalWs;
        point.material = {s.baseColor, s.metallic, s.roughness};
        points.push_back(point);
    }
    return points;
}

} // namespace

MatchedPixels matchPixels(const Scene& scene, const oracle::Oracle& oracle, const Camera& camera,
                          const FrameTargets& targets) {
    const std::vector<Instance> instances = enumerateInstances(scene);
    const int width = targets.floats("gDepth").width, height = targets.floats("gDepth").height;
    MatchedPixels matched;
    int strangers = 0;
    std::string first;
    for (std::size_t i = 0; i < targets.pixels(); ++i) {
        const glm::dvec2 centre(double(i % std::size_t(width)) + 0.5, double(i / std::size_t(width)) + 0.5);
        const oracle::CameraRay ray = oracle::cameraRay(camera, width, height, centre);
        const auto hit = oracle.tracePrimary(ray.originWs, ray.directionWs, ray.minDistanceM);
        const PixelSurface s = targets.surface(i);
        std::optional<Seen> seen;
        if (s.seen)
            seen = Seen{instances[s.instance].node, instances[s.instance].primitive, int(s.primitive)};
        if (!hit && !seen) continue;
        if (hit && seen && seenBy(*hit) == *seen) {
            matched.pixels.push_back(i);
            matched.hits.push_back(*hit);
        } else if (isTie(oracle, camera, width, height, centre, seen)) {
            ++matched.ties;
        } else if (strangers++ == 0) {
            first = "pixel " + std::to_string(i) + " sees node " + std::to_string(seen ? seen->node : -1) +
                    " triangle " + std::to_string(seen ? seen->triangle : -1) + ", the oracle node " +
                    std::to_string(hit ? hit->node : -1) + " triangle " +
                    std::to_string(hit ? hit->triangle : -1);
        }
    }
    EXPECT_EQ(strangers, 0) << first;
    return matched;
}

SurfaceErrors compareSurfaces(const MatchedPixels& matched, const Camera& camera, const Rendered& frame) {
    const dvec3 axis = -dvec3(camera.worldFromCamera[2]);
    const double exposure = exposureFromEv100(frame.statistics.exposureEv100);
    SurfaceErrors errors;
    const auto keep = [](double& worst, double value) { worst = std::max(worst, value); };
    for (std::size_t i = 0; i < matched.pixels.size(); ++i) {
        const PixelSurface s = frame.targets.surface(matched.pixels[i]);
        const oracle::OracleHit& hit = matched.hits[i];
        const double depthM = hit.distanceM * glm::dot(-hit.point.viewDirWs, axis);
        keep(errors.depth, std::abs(s.depthM / depthM - 1.0));
        keep(errors.normalRad, angleBetween(s.normalWs, hit.point.shadingNormalWs));
        keep(errors.geoNormalRad, angleBetween(s.geoNormalWs, hit.point.geometricNormalWs));
        const dvec3 color = glm::abs(s.baseColor - glm::clamp(hit.point.material.baseColor, 0.0, 1.0));
        keep(errors.baseColor, std::max({color.x, color.y, color.z}));
        keep(errors.roughness, std::abs(s.roughness - hit.point.material.roughness));
        keep(errors.metallic, std::abs(s.metallic - hit.point.material.metallic));
        const dvec3 emission = frame.targets.rgb("gEmissive", matched.pixels[i]) / exposure;
        for (int c = 0; c < 3; ++c) {
            keep(errors.emission,
                 std::abs(emission[c] - hit.emissionNit[c]) / std::max(hit.emissionNit[c], 1.0));
        }
    }
    return errors;
}

std::ostream& operator<<(std::ostream& out, const SurfaceErrors& e) {
    return out << "depth " << e.depth << ", normal " << e.normalRad << " rad, geometric normal "
               << e.geoNormalRad << " rad, base colour " << e.baseColor << ", roughness " << e.roughness
               << ", metallic " << e.metallic << ", emission " << e.emission;
}

void expectSurfaces(const SurfaceErrors& errors, const Scene& scene) {
    bool normalMapped = false;
    for (const Material& material : scene.materials)
        normalMapped = normalMapped || material.normal.image >= 0;
    // Depth: a dozen roundings of 2^-24, magnified where a surface is seen at a slant.
    EXPECT_LT(errors.depth, 2e-5);
    // Normals: 16 bits an axis, twice (vertex and G-buffer). Normal maps: lavapipe filters texels of 8 bits
    // to 8 bits, which turns a normal by up to 2/255 along both axes.
    EXPECT_LT(errors.normalRad, normalMapped ? 1.2e-2 : 2e-3);
    EXPECT_LT(errors.geoNormalRad, 2e-4);
    // Base colour: a square root in 10 or 11 bits; textures add 1/255 of what is sampled.
    EXPECT_LT(errors.baseColor, 4e-3);
    EXPECT_LT(errors.roughness, 2.5e-3);
    EXPECT_LT(errors.metallic, 2.5e-3);
    EXPECT_LT(errors.emission, 5e-3); // half floats of 11 bits, textures of 8
}

LightComparison compareLight(const Scene& scene, const LightOptions& options) {
    useLtcTable(
        loadLtcTable(KILOLUX_SOURCE_DIR "/content/ltc_ggx.bin").value()); // deriveExposureEv100() asks it
    RenderOptions render = smallOptions(options.width, options.height, options.settings);
    render.method = options.method;
    render.frames = options.frames;
    render.settings.raysPerLight = options.raysPerLight;
    // The exposure must be known before frames arrive: what the renderer would derive, fixed.
    if (render.settings.exposureEv100.automatic) {
        const double found = scene.hasExposure ? scene.exposureEv100 : deriveExposureEv100(scene);
        render.settings.exposureEv100 = {.automatic = false, .value = found};
    }
    const double exposureEv100 = render.settings.exposureEv100.value;
    const oracle::Oracle oracle(scene, derivedRanges(scene, exposureEv100));
    const Camera& camera = scene.cameras.front();
    MatchedPixels matched;
    Replicas replicas;
    const Rendered frame = renderScene(scene, render, [&](int index, const FrameTargets& targets) {
        if (index == 0) matched = matchPixels(scene, oracle, camera, targets);
        replicas.add(targets, matched.pixels, exposureFromEv100(exposureEv100));
    });
    expectSurfaces(compareSurfaces(matched, camera, frame), scene);

    oracle::OracleOptions truthOptions;
    truthOptions.estimator = options.method == "true" ? oracle::Estimator::True : oracle::Estimator::Split;
    truthOptions.samplesPerLight = options.oracleSamples;
    const std::vector<oracle::OraclePixel> truth =
        oracle.shadePoints(pointsOf(matched, frame.targets), truthOptions);
    Lobes mean;
    double variance = 0.0;
    for (const oracle::OraclePixel& pixel : truth) {
        mean.diffuse += pixel.diffuseNit / double(truth.size());
        mean.specular += pixel.specularNit / double(truth.size());
        const double error = luminanceOf(pixel.standardErrorNit) / double(truth.size());
        variance += error * error;
    }
    LightComparison result;
    for (int c = 0; c < 3; ++c) {
        result.channel[c] = measure::testEquivalence(replicas.channel[c], mean.sum()[c], 0.005);
    }
    result.oracleNit = luminanceOf(mean.sum());
    result.oracleError = std::sqrt(variance) / result.oracleNit;
    std::vector<double> planted = replicas.luminance;
    for (double& value : planted)
        value *= 1.01;
    result.planted = measure::testEquivalence(planted, result.oracleNit, 0.005);
    result.diffuseRatio = luminanceOf(replicas.total.diffuse) / options.frames / luminanceOf(mean.diffuse);
    result.specularRatio = luminanceOf(replicas.total.specular) / options.frames / luminanceOf(mean.specular);
    result.worstBlock = worstBlock(replicas, matched, truth, options.width, result.oracleNit);
    result.ties = matched.ties;
    result.compared = matched.pixels.size();
    return result;
}

std::ostream& operator<<(std::ostream& out, const LightComparison& c) {
    out << c.compared << " pixels, " << c.ties << " ties, oracle " << c.oracleNit << " nit +- "
        << 100.0 * c.oracleError << " %; difference";
    for (const measure::Equivalence& e : c.channel) {
        out << " " << 100.0 * e.relativeDifference << " [" << 100.0 * e.lower << ", " << 100.0 * e.upper
            << "]";
    }
    return out << " %, diffuse " << 100.0 * (c.diffuseRatio - 1.0) << " %, specular "
               << 100.0 * (c.specularRatio - 1.0) << " %, worst block " << 100.0 * c.worstBlock << " %";
}

void expectEquivalent(const LightComparison& c, double bound) {
    for (const measure::Equivalence& e : c.channel) {
        EXPECT_LT(e.upper, bound) << c;
        EXPECT_GT(e.lower, -bound) << c;
    }
    EXPECT_LT(c.oracleError, 0.001) << c;
    EXPECT_FALSE(c.planted.equivalent) << "a planted bias of 1 % went unseen: " << c;
}

} // namespace kilolux::test
