// Projections of the viewport, see viewport.h.
#include "ui/viewport.h"

#include <algorithm>
#include <cmath>

namespace kilolux {

namespace {

// Half extents of the picture plane: at distance 1, or in metres for orthographic cameras. As the renderer,
// a picture of another shape than the camera's keeps the vertical extent.
glm::dvec2 halfExtents(const Camera& camera, double aspect) {
    const double halfY = camera.orthographic ? camera.ymagM : std::tan(0.5 * camera.yfovRad);
    return {halfY * aspect, halfY};
}

} // namespace

bool Viewport::showsAs(const Viewport& other) const {
    return rect == other.rect && camera.worldFromCamera == other.camera.worldFromCamera &&
           camera.orthographic == other.camera.orthographic && camera.znearM == other.camera.znearM &&
           clipFromView() == other.clipFromView();
}

glm::dmat4 Viewport::viewFromWorld() const {
    return glm::inverse(camera.worldFromCamera);
}

glm::dmat4 Viewport::clipFromView() const {
    const glm::dvec2 half = halfExtents(camera, aspect());
    glm::dmat4 clip(0.0);
    clip[0][0] = 1.0 / half.x;
    clip[1][1] = -1.0 / half.y;
    if (camera.orthographic) {
        const double zFarM = camera.zfarM.value_or(camera.znearM + 1e5);
        clip[2][2] = 1.0 / (zFarM - camera.znearM);
        clip[3] = glm::dvec4(0.0, 0.0, zFarM / (zFarM - camera.znearM), 1.0);
    } else {
        clip[2][3] = -1.0;
        clip[3][2] = camera.znearM;
    }
    return clip;
}

double Viewport::depthM(const glm::dvec3& pointWs) const {
    return -(viewFromWorld() * glm::dvec4(pointWs, 1.0)).z;
}

std::optional<glm::dvec2> Viewport::project(const glm::dvec3& pointWs) const {
    const glm::dvec3 view(viewFromWorld() * glm::dvec4(pointWs, 1.0));
    if (-view.z < camera.znearM) return std::nullopt;
    const glm::dvec2 half = halfExtents(camera, aspect());
    const double divisor = camera.orthographic ? 1.0 : -view.z;
    return glm::dvec2(rect.x + rect.width * (0.5 + 0.5 * view.x / (divisor * half.x)),
                      rect.y + rect.height * (0.5 - 0.5 * view.y / (divisor * half.y)));
}

std::optional<Viewport::Segment> Viewport::project(const glm::dvec3& fromWs, const glm::dvec3& toWs) const {
    const double fromM = depthM(fromWs), toM = depthM(toWs);
    // A little behind the plane, so that rounding does not put the cut end in front of it.
    const double nearM = camera.znearM * (1.0 + 1e-9) + 1e-12;
    if (std::max(fromM, toM) < nearM) return std::nullopt;
    glm::dvec3 from = fromWs, to = toWs;
    if (fromM < nearM) from = glm::mix(fromWs, toWs, (nearM - fromM) / (toM - fromM));
    if (toM < nearM) to = glm::mix(toWs, fromWs, (nearM - toM) / (fromM - toM));
    const std::optional<glm::dvec2> a = project(from), b = project(to);
    if (!a || !b) return std::nullopt;
    return Segment{*a, *b};
}

ViewRay Viewport::ray(glm::dvec2 px) const {
    const glm::dvec2 half = halfExtents(camera, aspect());
    const glm::dvec2 plane((2.0 * (px.x - rect.x) / rect.width - 1.0) * half.x,
                           (1.0 - 2.0 * (px.y - rect.y) / rect.height) * half.y);
    const glm::dmat3 axes(camera.worldFromCamera);
    if (camera.orthographic) return {eyeWs() + axes * glm::dvec3(plane, 0.0), glm::normalize(-axes[2])};
    return {eyeWs(), glm::normalize(axes * glm::dvec3(plane, -1.0))};
}

double Viewport::metresPerPixel(const glm::dvec3& pointWs) const {
    const double halfY = halfExtents(camera, aspect()).y;
    const double distanceM = camera.orthographic ? 1.0 : std::max(depthM(pointWs), camera.znearM);
    return 2.0 * halfY * distanceM / rect.height;
}

} // namespace kilolux
