// Shadow maps of lights for the baseline 'shadow-maps': where each light's faces stand in one image, and
// which of them must be drawn again because the light, or something that it sees, has changed. Drawing is in
// passes/shadow_maps.cpp, reading in shaders/lib/shadow_map.glsl.
#pragma once

#include "renderer/gpu/resource.h"
#include "renderer/gpu_scene.h"
#include "shaders/shared/shadow_map.h"

#include <span>
#include <vector>

namespace kilolux {

// Maps of all lights, before any picture: pure numbers.
struct ShadowLayout {
    std::vector<shared::ShadowMap> maps; // by slot; without faces for dead ones and the dome
    std::uint32_t sizePx = 0;            // of a local light's face
    std::uint32_t widthPx = 0;           // of the image
    std::uint32_t heightPx = 0;
    std::size_t faces = 0;
};

// `worldMin`, `worldMax`: all that casts shadows, relative to the anchor. Faces of `sizePx`, halved until all
// fit into an image of at most `mostBytes` and `mostPx` across.
ShadowLayout layShadowMaps(const LightSlots& slots, const glm::dvec3& worldMin, const glm::dvec3& worldMax,
                           std::uint32_t sizePx, std::size_t mostBytes, std::uint32_t mostPx);

// What draws a face (0 .. 5), and its corner in the image.
glm::dmat4 clipOfShadowFace(const shared::ShadowMap& map, std::uint32_t face);
glm::uvec2 cornerOfShadowTile(const ShadowLayout& layout, const shared::ShadowMap& map, std::uint32_t tile);

class ShadowMaps {
  public:
    struct Face {
        std::uint32_t map = 0; // slot of the light
        glm::dmat4 clipFromWorld{1.0};
        glm::uvec2 cornerPx{0};
        std::uint32_t sizePx = 0;
        glm::dvec3 centerWs{0.0}; // relative to the anchor
        double reachM = 0.0;      // nothing farther from the centre can cast a shadow that is seen
        std::size_t place = 0;
    };

    ShadowMaps(gpu::Device& device, std::uint32_t sizePx) : device_(device), sizePx_(sizePx) {}

    // Takes over lights and instances as they are in this frame. The device must be idle.
    void update(const GpuScene& scene);
    // Draw no more than this in a frame: while pipelines are compiled.
    void limitFaces(std::size_t most = std::size_t(-1)) { mostFaces_ = most; }

    std::span<const Face> due() const { return due_; } // to be drawn in this frame
    void finishFrame();                                // they have been drawn
    const gpu::Image& depths() const { return depths_; }
    const gpu::Buffer& maps() const { return maps_; }
    const ShadowLayout& layout() const { return layout_; }
    std::size_t drawn() const { return drawn_; } // faces, in all finished frames

    // Whether something in a box, relative to the anchor, may stand between the light and what it reaches.
    static bool mayCast(const Face& face, const glm::dvec3& lower, const glm::dvec3& upper);

  private:
    Face faceOf(const GpuScene& scene, std::size_t slot, std::uint32_t face) const;
    void forgetMoved(const GpuScene& scene);
    void forgetChanged(const ShadowLayout& before);
    void makeImage();
    void collectDue(const GpuScene& scene);

    gpu::Device& device_;
    std::uint32_t sizePx_;
    std::size_t mostFaces_ = std::size_t(-1), drawn_ = 0;
    ShadowLayout layout_;
    std::vector<char> stands_; // by slot * 6 + face: drawn, and nothing has changed since
    std::vector<Face> due_;
    struct Posed {
        glm::dmat4 worldFromLocal;
        glm::dvec3 boundsMin, boundsMax;
    };
    std::vector<Posed> posed_; // draws as they were last seen; only where some move
    gpu::Image depths_;
    gpu::Buffer maps_;
};

} // namespace kilolux
