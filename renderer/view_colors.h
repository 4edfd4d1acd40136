// The colour maps of shaders/math as C++, for legends and for pictures that are mapped on the CPU.
#pragma once

#include <array>
#include <cstdint>

namespace kilolux {

std::array<float, 3> amountColor(float t);                              // 0..1 to sRGB
std::array<float, 3> signedColor(float t);                              // -1..1 to sRGB
std::array<float, 3> idColor(std::uint32_t id);                         // sRGB
std::array<float, 3> displayColor(const std::array<float, 3>& exposed); // linear to sRGB, toned neutrally

} // namespace kilolux
