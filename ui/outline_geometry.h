// Every light's shape and direction as thin lines in pixels: what the viewport draws, what a click picks and
// a marquee takes. Lights outside of the picture or behind the camera have none.
#pragma once

#include "ui/screen_map.h"

#include <span>
#include <vector>

namespace kilolux {

struct LightOutline {
    int light = 0; // into Scene::lights
    glm::dvec2 centerPx{0.0};
    double depthM = 0.0;   // of its centre
    double radiusPx = 0.0; // of a circle about everything of the shape
    std::size_t first = 0; // into segments()
    std::size_t count = 0; // the shape, and last the stem if there is one
    bool hasStem = false;  // points where the light shines
};

class OutlineSet {
  public:
    struct Segment {
        glm::vec2 from{0.0f}, to{0.0f}; // pixels of the window
    };
    // `scale`: pixels of this screen for one unscaled pixel. Sources smaller than a few pixels get a mark of
    // that size, so that every light can be seen and clicked.
    void build(const Scene& scene, const Viewport& viewport, double scale);

    std::span<const LightOutline> outlines() const { return outlines_; }
    std::span<const Segment> segmentsOf(const LightOutline& outline) const {
        return {segments_.data() + outline.first, outline.count};
    }

    // Lights whose outline passes within `reachPx` of the pointer, the nearest first: by whole pixels, then
    // by depth.
    std::vector<int> at(glm::dvec2 px, double reachPx) const;
    // Lights whose centre lies within the rectangle between two corners.
    std::vector<int> within(glm::dvec2 a, glm::dvec2 b) const;

  private:
    void addShape(const Scene& scene, const LightNode& light, const ScreenMap& map, LightOutline& outline,
                  double scale);
    void addCircle(glm::dvec2 center, double radiusPx);
    void addRing(const ScreenMap& map, const glm::dvec3& center, const glm::dvec3& x, const glm::dvec3& y,
                 double radiusPx);
    void addLine(const ScreenMap& map, const glm::dvec3& from, const glm::dvec3& to);
    void addCapsule(glm::dvec2 a, glm::dvec2 b, double radiusPx);
    void addStem(const ScreenMap& map, const glm::dvec3& center, const glm::dvec3& dir, LightOutline& outline,
                 double lengthPx);

    std::vector<LightOutline> outlines_;
    std::vector<Segment> segments_;
};

double distanceToSegment(glm::dvec2 point, glm::dvec2 from, glm::dvec2 to);

} // namespace kilolux
