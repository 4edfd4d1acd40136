// Many points of the scene to pixels: what Viewport::project does, with its matrices made once.
#pragma once

#include "ui/viewport.h"

namespace kilolux {

class ScreenMap {
  public:
    explicit ScreenMap(const Viewport& viewport)
        : viewFromWorld_(viewport.viewFromWorld()), clipFromWorld_(viewport.clipFromView() * viewFromWorld_),
          rect_(viewport.rect), orthographic_(viewport.camera.orthographic), nearM_(viewport.camera.znearM) {
        pxPerUnit_ = 0.5 * rect_.height * std::abs(viewport.clipFromView()[1][1]);
    }

    struct Point {
        glm::dvec2 px{0.0};
        double depthM = 0.0;
        bool inFront = false; // of the near plane; else `px` says nothing
    };
    Point project(const glm::dvec3& pointWs) const {
        const double depth = -(viewFromWorld_ * glm::dvec4(pointWs, 1.0)).z;
        if (!orthographic_ && depth < nearM_) return {{0.0, 0.0}, depth, false};
        const glm::dvec4 clip = clipFromWorld_ * glm::dvec4(pointWs, 1.0);
        const glm::dvec2 ndc = glm::dvec2(clip) / clip.w;
        return {{rect_.x + (0.5 + 0.5 * ndc.x) * rect_.width, rect_.y + (0.5 + 0.5 * ndc.y) * rect_.height},
                depth,
                true};
    }
    // Pixels that a metre covers at a depth.
    double pxPerMetre(double depthM) const { return orthographic_ ? pxPerUnit_ : pxPerUnit_ / depthM; }
    const ViewportRect& rect() const { return rect_; }

  private:
    glm::dmat4 viewFromWorld_, clipFromWorld_;
    ViewportRect rect_;
    bool orthographic_;
    double nearM_;
    double pxPerUnit_;
};

} // namespace kilolux
