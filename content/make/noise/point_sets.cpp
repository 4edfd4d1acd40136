#include "content/make/noise/point_sets.h"

namespace kilolux {
namespace {

std::uint32_t mixed(std::uint64_t value) {
    return NoiseRandom(value).next();
}

std::uint32_t reverseBits(std::uint32_t bits) {
    std::uint32_t reversed = 0;
    for (int i = 0; i < 32; ++i)
        reversed |= ((bits >> i) & 1u) << (31 - i);
    return reversed;
}

// Second dimension of Sobol's sequence: Pascal's triangle modulo 2.
std::uint32_t sobol2(std::uint32_t index) {
    std::uint32_t result = 0;
    for (std::uint32_t direction = 1u << 31; index != 0; index >>= 1, direction ^= direction >> 1)
        if (index & 1u) result ^= direction;
    return result;
}

// Owen's scrambling: each binary digit is flipped or not by the digits above it.
std::uint16_t scramble(std::uint32_t bits, std::uint32_t seed) {
    std::uint32_t result = 0;
    for (int digit = 0; digit < 16; ++digit) {
        const std::uint64_t prefix = digit == 0 ? 1u : (1u << digit) | (bits >> (32 - digit));
        const std::uint32_t flip = mixed((std::uint64_t{seed} << 32) | prefix) & 1u;
        result = (result << 1) | (((bits >> (31 - digit)) & 1u) ^ flip);
    }
    return static_cast<std::uint16_t>(result);
}

} // namespace

std::uint64_t NoiseRandom::next64() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

// Rank and, below it, a place within the stratum that every rank's layers take in turn, in the order of the
// radical inverse and from a start of the rank's own, so that no layer leans to one side.
std::vector<NoiseValue<1>> spreadNumbers(int area, int layers, std::uint32_t seed) {
    const std::uint32_t places = 65536u / static_cast<std::uint32_t>(area);
    std::vector<NoiseValue<1>> values;
    for (int layer = 0; layer < layers; ++layer)
        for (int rank = 0; rank < area; ++rank) {
            const std::uint32_t turn =
                static_cast<std::uint32_t>((std::uint64_t{reverseBits(layer)} * places) >> 32);
            const std::uint32_t start = mixed((std::uint64_t{seed} << 32) | rank);
            values.push_back({static_cast<std::uint16_t>(rank * places + (turn + start) % places)});
        }
    return values;
}

std::vector<NoiseValue<2>> spreadPoints(int area, int layers, std::uint32_t seed) {
    std::vector<NoiseValue<2>> values;
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(area * layers); ++i)
        values.push_back({scramble(reverseBits(i), 2 * seed), scramble(sobol2(i), 2 * seed + 1)});
    return values;
}

} // namespace kilolux
