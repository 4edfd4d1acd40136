// Deterministic numbers for the oracle: a 64-bit hash (splitmix64: Steele, Lea, Flood 2014) and the first two
// Sobol dimensions, a (0,2)-sequence, under a random digital shift.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <initializer_list>

namespace kilolux::oracle {

inline std::uint64_t mixBits(std::uint64_t x) {
    x += 0x9E3779B97F4A7C15ull;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
    return x ^ (x >> 31);
}

inline std::uint64_t seedOf(std::initializer_list<std::uint64_t> parts) {
    std::uint64_t seed = 0;
    for (const std::uint64_t part : parts)
        seed = mixBits(seed ^ mixBits(part));
    return seed;
}

// Point `index` of the shifted sequence, both coordinates in [0,1).
inline glm::dvec2 sobolPoint(std::uint32_t index, std::uint64_t seed) {
    std::uint32_t x = 0;
    std::uint32_t y = 0;
    std::uint32_t xDirection = 0x80000000u;
    std::uint32_t yDirection = 0x80000000u;
    for (std::uint32_t bits = index; bits != 0; bits >>= 1) {
        if (bits & 1u) {
            x ^= xDirection;
            y ^= yDirection;
        }
        xDirection >>= 1;
        yDirection ^= yDirection >> 1;
    }
    const std::uint64_t shift = mixBits(seed);
    constexpr double kToUnit = 1.0 / 4294967296.0;
    return {(x ^ static_cast<std::uint32_t>(shift)) * kToUnit,
            (y ^ static_cast<std::uint32_t>(shift >> 32)) * kToUnit};
}

} // namespace kilolux::oracle
