// Movements of the viewport's camera, see viewport_camera.h.
#include "ui/viewport_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace kilolux {

namespace {

constexpr double kLeastPivotM = 0.01;
// Straight up the yaw would have no meaning.
constexpr double kMostPitchRad = 1.5707;

} // namespace

void ViewportCamera::lookThrough(const Camera& camera, double pivotM) {
    lens_ = camera;
    lens_.id = 0;
    lens_.name.clear();
    lens_.node = -1;
    eyeWs_ = glm::dvec3(camera.worldFromCamera[3]);
    const glm::dvec3 ahead = -glm::normalize(glm::dvec3(camera.worldFromCamera[2]));
    pitchRad_ = std::clamp(std::asin(std::clamp(ahead.y, -1.0, 1.0)), -kMostPitchRad, kMostPitchRad);
    yawRad_ = std::atan2(ahead.x, -ahead.z);
    rollRad_ = 0.0;
    // What is left between the level frame and the camera's own is roll.
    const glm::dvec3 right = glm::normalize(glm::dvec3(camera.worldFromCamera[0]));
    const glm::dmat3 level = axes();
    rollRad_ = std::atan2(glm::dot(right, level[1]), glm::dot(right, level[0]));
    if (std::abs(rollRad_) < 1e-6) rollRad_ = 0.0;
    pivotM_ = std::max(pivotM, kLeastPivotM);
}

glm::dmat3 ViewportCamera::axes() const {
    const double cosPitch = std::cos(pitchRad_);
    const glm::dvec3 ahead(std::sin(yawRad_) * cosPitch, std::sin(pitchRad_), -std::cos(yawRad_) * cosPitch);
    const glm::dvec3 right(std::cos(yawRad_), 0.0, std::sin(yawRad_));
    const glm::dvec3 up = glm::cross(right, ahead);
    const double c = std::cos(rollRad_), s = std::sin(rollRad_);
    return {right * c + up * s, up * c - right * s, -ahead};
}

Camera ViewportCamera::camera() const {
    Camera result = lens_;
    const glm::dmat3 frame = axes();
    result.worldFromCamera = glm::dmat4(glm::dvec4(frame[0], 0.0), glm::dvec4(frame[1], 0.0),
                                        glm::dvec4(frame[2], 0.0), glm::dvec4(eyeWs_, 1.0));
    return result;
}

glm::dvec3 ViewportCamera::pivotWs() const {
    return eyeWs_ - axes()[2] * pivotM_;
}

void ViewportCamera::look(double yawRad, double pitchRad) {
    yawRad_ = std::remainder(yawRad_ + yawRad, glm::two_pi<double>());
    pitchRad_ = std::clamp(pitchRad_ + pitchRad, -kMostPitchRad, kMostPitchRad);
}

void ViewportCamera::orbit(double yawRad, double pitchRad) {
    const glm::dvec3 pivot = pivotWs();
    look(yawRad, pitchRad);
    eyeWs_ = pivot + axes()[2] * pivotM_;
}

void ViewportCamera::move(const glm::dvec3& stepM) {
    const glm::dmat3 frame = axes();
    eyeWs_ += frame[0] * stepM.x + frame[1] * stepM.y - frame[2] * stepM.z;
}

void ViewportCamera::dolly(double factor) {
    if (lens_.orthographic) {
        lens_.xmagM *= factor;
        lens_.ymagM *= factor;
        return;
    }
    const glm::dvec3 pivot = pivotWs();
    pivotM_ = std::max(pivotM_ * factor, kLeastPivotM);
    eyeWs_ = pivot + axes()[2] * pivotM_;
}

void ViewportCamera::pan(glm::dvec2 pixels, double viewportHeightPx) {
    const double extentM =
        lens_.orthographic ? 2.0 * lens_.ymagM : 2.0 * std::tan(0.5 * lens_.yfovRad) * pivotM_;
    const double metres = extentM / std::max(viewportHeightPx, 1.0);
    move({-pixels.x * metres, pixels.y * metres, 0.0});
}

void ViewportCamera::frame(const glm::dvec3& centerWs, double radiusM, double aspect) {
    const double radius = std::max(radiusM, kLeastPivotM);
    if (lens_.orthographic) {
        lens_.ymagM = radius / std::min(aspect, 1.0);
        lens_.xmagM = lens_.ymagM * aspect;
    } else {
        const double halfRad = std::atan(std::tan(0.5 * lens_.yfovRad) * std::min(aspect, 1.0));
        pivotM_ = radius / std::sin(halfRad);
    }
    eyeWs_ = centerWs + axes()[2] * pivotM_;
}

} // namespace kilolux
