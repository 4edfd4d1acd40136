// The values that a layer of a mask holds, before the optimizer orders them in space and time: evenly spread
// numbers, and a scrambled (0,2)-sequence of points (Sobol' 1967; Owen, "Randomly Permuted (t,m,s)-Nets",
// 1995).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace kilolux {

template<std::size_t D>
using NoiseValue = std::array<std::uint16_t, D>;

// Splitmix64 (Steele, Lea and Flood, OOPSLA 2014): integers only, so the same on every machine.
class NoiseRandom {
  public:
    // The seed is mixed before it becomes a place in the one long sequence: neighbouring seeds were shifted
    // copies.
    explicit NoiseRandom(std::uint64_t seed) : state_(seed) { state_ = next64(); }
    std::uint32_t next() { return static_cast<std::uint32_t>(next64() >> 32); }
    int below(int count) { // [0, count)
        return static_cast<int>((std::uint64_t{next()} * static_cast<std::uint64_t>(count)) >> 32);
    }

  private:
    std::uint64_t next64();

    std::uint64_t state_;
};

// `area` values for each of `layers` layers, [layer][rank]; both are powers of two, area at most 65536.
std::vector<NoiseValue<1>> spreadNumbers(int area, int layers, std::uint32_t seed);
std::vector<NoiseValue<2>> spreadPoints(int area, int layers, std::uint32_t seed);

// Strata along each axis, and the stratum of a value among strataSide ^ D = area.
template<std::size_t D>
int noiseStrataSide(int area) {
    int side = 1;
    while ((D == 1 ? side : side * side) < area)
        side *= 2;
    return side;
}

template<std::size_t D>
int noiseStratum(const NoiseValue<D>& value, int area) {
    const int side = noiseStrataSide<D>(area);
    int stratum = 0;
    for (std::size_t d = D; d-- > 0;)
        stratum = stratum * side + ((value[d] * side) >> 16);
    return stratum;
}

} // namespace kilolux
