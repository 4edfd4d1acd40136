// Cameras, see camera.h.
#include "renderer/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace kilolux {

Camera derivedCamera(const Scene& scene, double aspect) {
    const Bounds bounds = worldBounds(scene);
    const glm::dvec3 center = 0.5 * (bounds.min + bounds.max);
    const double radiusM = std::max(0.5 * glm::length(bounds.max - bounds.min), 1e-3);
    Camera camera;
    camera.name = "derived";
    camera.yfovRad = glm::radians(40.0);
    const glm::dvec3 toCamera = glm::normalize(glm::dvec3(0.65, 0.45, 1.0));
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), toCamera));
    const glm::dvec3 up = glm::cross(toCamera, right);
    // The least distance from which every corner of the bounds is inside the picture, with a margin.
    const double tanY = std::tan(0.5 * camera.yfovRad), tanX = tanY * aspect;
    double distanceM = 0.1 * radiusM;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p =
            glm::dvec3(corner & 1 ? bounds.max.x : bounds.min.x, corner & 2 ? bounds.max.y : bounds.min.y,
                       corner & 4 ? bounds.max.z : bounds.min.z) -
            center;
        const double depth = glm::dot(p, toCamera);
        distanceM = std::max({distanceM, depth + std::abs(glm::dot(p, right)) / tanX,
                              depth + std::abs(glm::dot(p, up)) / tanY});
    }
    distanceM *= 1.05;
    camera.worldFromCamera = glm::dmat4(glm::dvec4(right, 0), glm::dvec4(up, 0), glm::dvec4(toCamera, 0),
                                        glm::dvec4(center + toCamera * distanceM, 1));
    camera.znearM = 1e-3 * distanceM;
    return camera;
}

glm::dvec3 anchorFor(const Camera& camera, const Bounds& scene) {
    const double radiusM = std::clamp(0.5 * glm::length(scene.max - scene.min), 1e-3, 256.0);
    const double gridM =
        std::exp2(std::ceil(std::log2(radiusM))); // a power of two: multiples are exact floats
    const glm::dvec3 position(camera.worldFromCamera[3]);
    return glm::round(position / gridM) * gridM;
}

namespace {

// Reversed depth: near plane at 1, far at 0. Vulkan's clip space has y down. `half`: half extents of the
// picture plane at distance 1, or in metres for orthographic cameras.
glm::dmat4 clipFromCamera(const Camera& camera, glm::dvec2 half, glm::dvec2 shift) {
    glm::dmat4 clip(0.0);
    clip[0][0] = 1.0 / half.x;
    clip[1][1] = -1.0 / half.y;
    if (camera.orthographic) {
        const double zFarM = camera.zfarM.value_or(camera.znearM + 1e5);
        const double depth = zFarM - camera.znearM;
        clip[2][2] = 1.0 / depth;
        clip[3] = glm::dvec4(shift, zFarM / depth, 1.0);
    } else {
        clip[2] = glm::dvec4(-shift, 0.0, -1.0);
        clip[3][2] = camera.znearM;
    }
    return clip;
}

} // namespace

void setCamera(shared::FrameConstants& frame, const Camera& camera, const glm::dvec3& anchor, int widthPx,
               int heightPx, glm::dvec2 jitterPx, double aspect) {
    const glm::dvec3 right(camera.worldFromCamera[0]), up(camera.worldFromCamera[1]),
        back(camera.worldFromCamera[2]);
    const glm::dvec3 position = glm::dvec3(camera.worldFromCamera[3]) - anchor;
    if (aspect == 0.0) aspect = double(widthPx) / double(heightPx);
    // Half extents of the picture plane: at distance 1, or in metres for orthographic cameras.
    const double halfY = camera.orthographic ? camera.ymagM : std::tan(0.5 * camera.yfovRad);
    const double halfX = halfY * aspect;
    const glm::dvec3 stepX = right * (2.0 * halfX / widthPx), stepY = up * (-2.0 * halfY / heightPx);
    const glm::dvec3 corner = right * (-halfX) + up * halfY + jitterPx.x * stepX + jitterPx.y * stepY;
    const glm::dvec3 zero(0.0);
    frame.originBase = camera.orthographic ? position + corner : position;
    frame.originStepX = camera.orthographic ? stepX : zero;
    frame.originStepY = camera.orthographic ? stepY : zero;
    frame.dirBase = camera.orthographic ? -back : -back + corner;
    frame.dirStepX = camera.orthographic ? zero : stepX;
    frame.dirStepY = camera.orthographic ? zero : stepY;
    frame.zNearM = float(camera.znearM);
    frame.pixelAngleRad = camera.orthographic ? 0.0f : float(2.0 * halfY / heightPx);

    const glm::dmat4 world =
        glm::dmat4(glm::dvec4(right, 0), glm::dvec4(up, 0), glm::dvec4(back, 0), glm::dvec4(position, 1));
    const glm::dmat4 cameraFromWorld = glm::inverse(world);
    const glm::dvec2 shift(-2.0 * jitterPx.x / widthPx, -2.0 * jitterPx.y / heightPx);
    frame.clipFromWorld =
        glm::mat4(clipFromCamera(camera, glm::dvec2(halfX, halfY), shift) * cameraFromWorld);
    frame.steadyClipFromWorld =
        glm::mat4(clipFromCamera(camera, glm::dvec2(halfX, halfY), glm::dvec2(0.0)) * cameraFromWorld);
    frame.depthRow = glm::vec4(glm::dvec4(-back, glm::dot(back, position)));
    frame.size = {unsigned(widthPx), unsigned(heightPx)};
    frame.tiles = {unsigned(widthPx + 7) / 8, unsigned(heightPx + 7) / 8};
}

namespace {

// The four-term window of Harris 1978, over |x| <= radius.
double blackmanHarris(double x, double radius) {
    const double t = glm::two_pi<double>() * (0.5 + 0.5 * x / radius);
    return 0.35875 - 0.48829 * std::cos(t) + 0.14128 * std::cos(2 * t) - 0.01168 * std::cos(3 * t);
}

constexpr double kBlackmanHarrisRadiusPx = 1.5;

// Inverse of the filter's cumulative distribution, by a table of 1024 steps.
double sampleBlackmanHarris(double u) {
    static const std::array<double, 1025> cumulative = [] {
        std::array<double, 1025> sums{};
        for (int i = 0; i < 1024; ++i) {
            const double x = kBlackmanHarrisRadiusPx * ((i + 0.5) / 512.0 - 1.0);
            sums[std::size_t(i) + 1] = sums[std::size_t(i)] + blackmanHarris(x, kBlackmanHarrisRadiusPx);
        }
        for (double& sum : sums)
            sum /= sums[1024];
        return sums;
    }();
    const auto above = std::upper_bound(cumulative.begin() + 1, cumulative.end() - 1, u);
    const auto i = std::size_t(above - cumulative.begin());
    const double within = (u - cumulative[i - 1]) / std::max(cumulative[i] - cumulative[i - 1], 1e-12);
    return kBlackmanHarrisRadiusPx * ((double(i - 1) + std::clamp(within, 0.0, 1.0)) / 512.0 - 1.0);
}

} // namespace

bool boxMayBeSeen(const glm::dmat4& clipFromWorld, const glm::dvec3& lower, const glm::dvec3& upper) {
    int outside[5] = {0, 0, 0, 0, 0};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec4 p =
            clipFromWorld * glm::dvec4(corner & 1 ? upper.x : lower.x, corner & 2 ? upper.y : lower.y,
                                       corner & 4 ? upper.z : lower.z, 1.0);
        outside[0] += p.x < -p.w;
        outside[1] += p.x > p.w;
        outside[2] += p.y < -p.w;
        outside[3] += p.y > p.w;
        outside[4] += p.z > p.w; // before the near plane
    }
    for (const int count : outside) {
        if (count == 8) return false;
    }
    return true;
}

glm::dvec2 filterOffset(PixelFilter filter, std::uint32_t index) {
    // R2 sequence (Roberts 2018, the plastic number): even over few samples.
    const double u = std::fmod(0.5 + double(index) * 0.7548776662466927, 1.0);
    const double v = std::fmod(0.5 + double(index) * 0.5698402909980532, 1.0);
    if (filter == PixelFilter::Box) return {u - 0.5, v - 0.5};
    return {sampleBlackmanHarris(u), sampleBlackmanHarris(v)};
}

} // namespace kilolux
