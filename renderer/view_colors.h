// The colour maps and scales of shaders/math as C++, for legends, probes and pictures that are mapped on the
// CPU.
#pragma once

#include <array>
#include <cstdint>

namespace kilolux {

std::array<float, 3> amountColor(float t);      // 0..1 to sRGB
std::array<float, 3> signedColor(float t);      // -1..1 to sRGB
std::array<float, 3> idColor(std::uint32_t id); // sRGB
// sRGB of what has no place on a scale.
std::array<float, 3> clippedColor();
std::array<float, 3> crushedColor();
std::array<float, 3> noRayColor();
std::array<float, 3> overflowColor();
// Stops between an exposed luminance and middle grey; black has a least number.
double stopsFromGrey(double exposedLuminance);
std::array<float, 3> displayColor(const std::array<float, 3>& exposed); // linear to sRGB, toned neutrally

} // namespace kilolux
