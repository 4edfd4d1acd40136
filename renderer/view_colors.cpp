// Compiled with -fsingle-precision-constant: the shaders' literals have no suffix.
#include "renderer/view_colors.h"

#include <glm/glm.hpp>

namespace kilolux {

namespace shader {
using namespace glm;
using uint = std::uint32_t;
#include "shaders/math/color_map.glsl"
#include "shaders/math/false_color.glsl"
#include "shaders/math/tone_map.glsl"
} // namespace shader

namespace {

std::array<float, 3> asArray(const glm::vec3& color) {
    return {color.x, color.y, color.z};
}

} // namespace

std::array<float, 3> amountColor(float t) {
    return asArray(shader::amountColor(t));
}

std::array<float, 3> signedColor(float t) {
    return asArray(shader::signedColor(t));
}

std::array<float, 3> idColor(std::uint32_t id) {
    return asArray(shader::idColor(id));
}

std::array<float, 3> clippedColor() {
    return asArray(shader::KX_CLIPPED_COLOR);
}

std::array<float, 3> crushedColor() {
    return asArray(shader::KX_CRUSHED_COLOR);
}

std::array<float, 3> noRayColor() {
    return asArray(shader::KX_NO_RAY_COLOR);
}

std::array<float, 3> overflowColor() {
    return asArray(shader::KX_OVERFLOW_COLOR);
}

double stopsFromGrey(double exposedLuminance) {
    return double(shader::stopsFromGrey(float(exposedLuminance)));
}

std::array<float, 3> displayColor(const std::array<float, 3>& exposed) {
    const glm::vec3 color = glm::max(glm::vec3(exposed[0], exposed[1], exposed[2]), glm::vec3(0.0f));
    return asArray(shader::srgbFromLinear(glm::clamp(shader::toneMapNeutral(color), 0.0f, 1.0f)));
}

} // namespace kilolux
