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
    std::vector<float> texels;

    // Bilinear as a sampler does it, but in double; clamped, or repeated.
    double clamped(const glm::dvec2& uv) const;
    double repeated(const glm::dvec2& uv) const;
};

struct LightTables {
    std::vector<shared::LightShaping> shapings;
    std::vector<std::shared_ptr<const LightPicture>> profiles; // all of one size (lights/light_filter.glsl)
    std::vector<std::shared_ptr<const LightPicture>> functionImages; // all of one size
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
