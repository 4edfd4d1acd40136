// Whole frames for tests: renders a scene with validation on, keeps its targets, reads the G-buffer back in
// words of its own, and holds every picture to what all pictures must be.
#pragma once

#include "renderer/document/light_units.h" // luminanceOf
#include "renderer/renderer.h"

#include <functional>
#include <glm/glm.hpp>
#include <gtest/gtest.h>
#include <map>

namespace kilolux::test {

// What the G-buffer says of a pixel; decoded by the tests' own arithmetic from the packed words.
struct PixelSurface {
    bool seen = false;
    std::uint32_t instance = 0, primitive = 0; // the triangle's index in its primitive
    double depthM = 0.0;                       // along the camera's axis
    glm::dvec3 normalWs{0.0};
    glm::dvec3 geoNormalWs{0.0};
    glm::dvec3 baseColor{0.0};
    double roughness = 0.0, metallic = 0.0;
};

// One frame's targets by name.
class FrameTargets {
  public:
    explicit FrameTargets(std::vector<NamedImage> images);

    bool has(const std::string& name) const { return images_.contains(name); }
    const NamedImage& named(const std::string& name) const;
    const FloatImage& floats(const std::string& name) const { return named(name).image; }
    glm::dvec3 rgb(const std::string& name, std::size_t pixel) const;
    std::size_t pixels() const;
    PixelSurface surface(std::size_t pixel) const;
    const std::map<std::string, NamedImage>& all() const { return images_; }

  private:
    template<typename T>
    T word(const std::string& name, std::size_t index) const;
    std::map<std::string, NamedImage> images_;
};

struct Rendered {
    Picture picture;
    FrameTargets targets; // of the last frame
    FrameStatistics statistics;
};

// Jitter off, the compute tracer, and then `settings` as --set reads them.
RenderOptions smallOptions(int width, int height, const std::vector<std::string>& settings = {});

// Runs a test with the filters as CPU devices have them and as others do.
void withFiltersOfAllDevices(const std::function<void(bool cpuFilters)>& test);

// Called after each frame with its index and targets.
using FrameObserver = std::function<void(int, const FrameTargets&)>;

// Renders with validation on; any message, error or unclean target fails the test. All targets are kept.
Rendered renderScene(const Scene& scene, RenderOptions options, const FrameObserver& observer = {});

// No NaN, no infinity, nothing negative where light, depth and counts are kept, unit normals on surfaces.
void expectClean(const FrameTargets& targets);

Scene loadScene(const std::string& file); // content/scenes/<file>

} // namespace kilolux::test
