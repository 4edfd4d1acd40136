// The colour that stands for a light in lists and outlines.
#pragma once

#include "renderer/document/scene.h"

#include <cstdint>
#include <map>

namespace kilolux {

// Tint times temperature as 0xAABBGGRR in sRGB, at full brightness and never too dark to read on grey.
// Remembers black bodies, whose colour is an integral: 10,000 lights are asked for in every frame.
class LightColors {
  public:
    std::uint32_t of(const LightDef& def);

  private:
    std::map<double, glm::dvec3> blackBodies_; // by kelvin
};

} // namespace kilolux
