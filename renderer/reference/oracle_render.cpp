// The oracle's camera, pixel filters and picture loop.
#include "renderer/reference/oracle.h"
#include "renderer/reference/oracle_light.h"
#include "renderer/reference/oracle_random.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

namespace kilolux::oracle {

namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double kBlackmanHarrisRadiusPx = 1.5;

// Integral of the Blackman-Harris window over [-1, x], x in [-1,1], not normalized.
double blackmanHarrisIntegral(double x) {
    constexpr double a[4] = {0.35875, 0.48829, 0.14128, 0.01168};
    double sum = a[0] * (x + 1.0);
    for (int k = 1; k < 4; ++k)
        sum += a[k] * std::sin(k * kPi * x) / (k * kPi);
    return sum;
}

double invertBlackmanHarris(double u) {
    const double target = u * blackmanHarrisIntegral(1.0);
    double low = -1.0;
    double high = 1.0;
    for (int i = 0; i < 52; ++i) {
        const double mid = 0.5 * (low + high);
        (blackmanHarrisIntegral(mid) < target ? low : high) = mid;
    }
    return 0.5 * (low + high);
}

// One surface point's share of a pixel: all lights, and what the point is. Returns its radiance without
// emission.
dvec3 addPoint(OraclePixel& pixel, const Oracle& oracle, const OraclePoint& point,
               const OracleOptions& options, double weight, dvec3& variance) {
    dvec3 radianceNit(0.0);
    for (std::size_t i = 0; i < oracle.lightCount(); ++i) {
        const OraclePointResult result = oracle.evaluatePoint(point, i, options);
        pixel.irradianceLux += weight * result.irradianceLux;
        pixel.diffuseNit += weight * result.diffuseNit;
        pixel.specularNit += weight * result.specularNit;
        radianceNit += result.diffuseNit + result.specularNit;
        variance += weight * weight * result.standardErrorNit * result.standardErrorNit;
    }
    pixel.coverage += weight;
    pixel.baseColor += weight * point.material.baseColor;
    pixel.shadingNormalWs = point.shadingNormalWs;
    pixel.geometricNormalWs = point.geometricNormalWs;
    pixel.positionWs = point.positionWs;
    pixel.metallic = point.material.metallic;
    pixel.roughness = point.material.roughness;
    return radianceNit;
}

dvec3 addRay(OraclePixel& pixel, const Oracle& oracle, const CameraRay& ray, const OracleOptions& options,
             double weight, dvec3& variance) {
    const std::optional<OracleHit> hit = oracle.tracePrimary(ray.originWs, ray.directionWs, ray.minDistanceM);
    if (!hit) return oracle.backgroundNit(ray.directionWs);
    pixel.emissionNit += weight * hit->emissionNit;
    pixel.hitDistanceM = hit->distanceM;
    pixel.node = hit->node;
    pixel.primitive = hit->primitive;
    pixel.triangle = hit->triangle;
    return hit->emissionNit + addPoint(pixel, oracle, hit->point, options, weight, variance);
}

// Calls work(i) for every i below count, in any order.
template<typename Work>
void inParallel(int count, int threadCount, const Work& work) {
    std::atomic<int> next = 0;
    const auto run = [&] {
        for (int i = next++; i < count; i = next++)
            work(i);
    };
    const int hardware = std::max(static_cast<int>(std::thread::hardware_concurrency()), 1);
    std::vector<std::thread> threads;
    for (int i = 1; i < (threadCount > 0 ? threadCount : hardware); ++i)
        threads.emplace_back(run);
    run();
    for (std::thread& thread : threads)
        thread.join();
}

OraclePixel renderPixel(const Oracle& oracle, const Camera& camera, int width, int height, int x, int y,
                        const OracleOptions& options) {
    OraclePixel pixel;
    const int rays = std::max(options.pixelSamples, 1);
    dvec3 variance(0.0);
    dvec3 sumOfSquares(0.0);
    OracleOptions perRay = options;
    const std::uint64_t pixelSeed =
        seedOf({options.seed, static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y)});
    for (int i = 0; i < rays; ++i) {
        dvec2 offset = options.jitterPx.value_or(dvec2(0.0));
        if (!options.jitterPx) {
            const dvec2 uv = sobolPoint(i, pixelSeed);
            offset = sampleFilter(options.filter, uv.x, uv.y);
        }
        perRay.seed = seedOf({pixelSeed, static_cast<std::uint64_t>(i)});
        const CameraRay ray = cameraRay(camera, width, height, dvec2(x + 0.5, y + 0.5) + offset);
        const dvec3 radianceNit = addRay(pixel, oracle, ray, perRay, 1.0 / rays, variance);
        pixel.radianceNit += radianceNit / double(rays);
        sumOfSquares += radianceNit * radianceNit;
    }
    if (rays > 1) // the spread over rays holds the rays' own noise
        variance = glm::max(sumOfSquares / double(rays) - pixel.radianceNit * pixel.radianceNit, dvec3(0.0)) /
                   (rays - 1.0);
    pixel.standardErrorNit = glm::sqrt(variance);
    return pixel;
}

} // namespace

dvec2 sampleFilter(PixelFilter filter, double u, double v) {
    if (filter == PixelFilter::Box) return {u - 0.5, v - 0.5};
    return kBlackmanHarrisRadiusPx * dvec2(invertBlackmanHarris(u), invertBlackmanHarris(v));
}

CameraRay cameraRay(const Camera& camera, int width, int height, const dvec2& positionPx) {
    const double aspect = static_cast<double>(width) / height;
    const dvec2 ndc(2.0 * positionPx.x / width - 1.0, 1.0 - 2.0 * positionPx.y / height); // +y up
    const glm::dmat3 frame(camera.worldFromCamera);
    const dvec3 eye(camera.worldFromCamera[3]);
    if (camera.orthographic) {
        const dvec2 at = ndc * dvec2(camera.ymagM * aspect, camera.ymagM);
        return {eye + frame[0] * at.x + frame[1] * at.y, glm::normalize(-frame[2]), camera.znearM};
    }
    const double tanHalf = std::tan(0.5 * camera.yfovRad);
    const dvec3 local(ndc.x * tanHalf * aspect, ndc.y * tanHalf, -1.0);
    const double length = glm::length(local);
    return {eye, glm::normalize(frame * local), camera.znearM * length};
}

OracleImage Oracle::render(const Camera& camera, int width, int height, const OracleOptions& options) const {
    OracleImage image{width, height, std::vector<OraclePixel>(static_cast<std::size_t>(width) * height)};
    inParallel(height, options.threads, [&](int y) {
        for (int x = 0; x < width; ++x)
            image.pixels[static_cast<std::size_t>(y) * width + x] =
                renderPixel(*this, camera, width, height, x, y, options);
    });
    return image;
}

std::vector<OraclePixel> Oracle::shadePoints(const std::vector<OraclePoint>& points,
                                             const OracleOptions& options) const {
    constexpr std::size_t kPerTask = 64;
    std::vector<OraclePixel> pixels(points.size());
    const int tasks = static_cast<int>((points.size() + kPerTask - 1) / kPerTask);
    inParallel(tasks, options.threads, [&](int task) {
        OracleOptions own = options;
        const std::size_t end = std::min((task + 1) * kPerTask, points.size());
        for (std::size_t i = task * kPerTask; i < end; ++i) {
            own.seed = seedOf({options.seed, i});
            dvec3 variance(0.0);
            pixels[i].radianceNit = addPoint(pixels[i], *this, points[i], own, 1.0, variance);
            pixels[i].standardErrorNit = glm::sqrt(variance);
        }
    });
    return pixels;
}

} // namespace kilolux::oracle
