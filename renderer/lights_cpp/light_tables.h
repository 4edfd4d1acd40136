// What the light functions look up beyond the hot record: the shaping records that hot records point to,
// and the pictures that those name.
// Bound for the calling thread, for kilolux::f32 and kilolux::f64 alike.
#pragma once

#include "shaders/shared/gpu_light.h"

#include <glm/glm.hpp>

#include <memory>
#include <vector>

namespace kilolux {

// A picture of one channel, row by row.
struct LightPicture {
    int width = 0, height = 0;
    std::vector<float> texels; // width * height

    // Bilinear as a sampler does it, but in double; clamped, or repeated.
    double clamped(const glm::dvec2& uv) const;
    double repeated(const glm::dvec2& uv) const;
};

// What a dome light looks up: pictures in latitude and longitude (shaders/math/panorama.glsl).
struct DomeMaps {
    struct Picture {
        int width = 0, height = 0;
        std::vector<glm::vec3> texels;
        glm::dvec3 sample(const glm::dvec2& uv) const; // bilinear in double; repeats in u, clamped in v
    };
    std::vector<Picture> levels; // the picture, then blurred by as much as a texel is wide
    Picture irradiance;          // nodes: the first and the last row are the poles
    // Columns, rows, width of the picture, levels; the rows' cumulated shares of luminance, one more than
    // there are; and for each row its cells'.
    std::vector<float> distribution;
    double texelScale = 1.0;    // times the document's texel
    double meanLuminance = 0.0; // over the sphere
    int number = 0;             // names it

    glm::dvec3 radianceAt(const glm::dvec2& uv, double level) const; // between two levels
    glm::dvec3 irradianceAt(const glm::dvec2& uv) const;             // uv of the direction
};

// The picture of a rectangle light as lights/picture.glsl reads it: a pyramid of RGBA halves, the top row
// first, and the table that warps samples.
struct SourcePicture {
    struct Level {
        int sizePx = 0;
        std::vector<std::uint64_t> texels; // 4 halves
    };
    std::vector<Level> levels; // halved down to one texel
    std::vector<float> warp;   // KX_WARP_FLOATS of lights/picture.glsl, which says how they lie
    glm::dvec3 mean{0.0};      // of all texels, by channel

    // Linear over texels and levels as a sampler does it, but in double.
    glm::dvec3 lookup(const glm::dvec2& uv, double level) const;
};

struct LightTables {
    std::vector<shared::LightShaping> shapings;
    std::vector<std::shared_ptr<const LightPicture>> profiles; // all of one size (lights/light_filter.glsl)
    std::vector<std::shared_ptr<const LightPicture>> functionImages; // all of one size
    std::shared_ptr<const DomeMaps> dome;                            // null without one
    std::vector<std::shared_ptr<const SourcePicture>> pictures;
};

// Binds the tables while it lives; the ones bound before return after it. `tables` must live as long.
class BindLightTables {
  public:
    explicit BindLightTables(const LightTables& tables);
    ~BindLightTables();
    BindLightTables(const BindLightTables&) = delete;
    BindLightTables& operator=(const BindLightTables&) = delete;

  private:
    const LightTables* before_;
};

const LightTables& boundLightTables(); // asserts that there are some

} // namespace kilolux
