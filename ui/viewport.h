// Where the picture stands in the window, and the camera that it was made with: from points of the scene to
// pixels of the window and back. Pixels count from the window's top left corner.
#pragma once

#include "renderer/document/scene.h"

#include <glm/glm.hpp>
#include <optional>

namespace kilolux {

struct ViewportRect {
    double x = 0.0; // pixels of the window
    double y = 0.0;
    double width = 1.0;
    double height = 1.0;

    bool contains(glm::dvec2 px) const {
        return px.x >= x && px.y >= y && px.x < x + width && px.y < y + height;
    }
    glm::dvec2 center() const { return {x + 0.5 * width, y + 0.5 * height}; }
    bool operator==(const ViewportRect&) const = default;
};

struct ViewRay {
    glm::dvec3 originWs{0.0}; // metres
    glm::dvec3 dirWs{0.0};    // unit length
};

// What overlays are drawn with: always the camera of the picture that is shown, not the one that the next
// picture will have, so that both stay together.
struct Viewport {
    ViewportRect rect;
    Camera camera;

    // Every point of the scene at the same pixel as in the other one.
    bool showsAs(const Viewport& other) const;
    double aspect() const { return rect.width / rect.height; }
    glm::dvec3 eyeWs() const { return glm::dvec3(camera.worldFromCamera[3]); }
    glm::dmat4 viewFromWorld() const;
    // Reversed depth with an infinite far plane; y points down, as in Vulkan.
    glm::dmat4 clipFromView() const;

    // Pixels of the window, which may lie outside `rect`; nothing in front of the near plane.
    std::optional<glm::dvec2> project(const glm::dvec3& pointWs) const;
    // The ends of a segment in pixels, cut at the near plane; nothing where all of it is behind.
    struct Segment {
        glm::dvec2 from, to;
    };
    std::optional<Segment> project(const glm::dvec3& fromWs, const glm::dvec3& toWs) const;
    ViewRay ray(glm::dvec2 px) const;
    // Distance along the view direction, metres; negative behind the camera.
    double depthM(const glm::dvec3& pointWs) const;
    // The length that one pixel covers at the depth of a point: constant-size handles follow from it.
    double metresPerPixel(const glm::dvec3& pointWs) const;
};

} // namespace kilolux
