// Optimizes masks of blue noise for the filters that follow (Donnelly et al. 2024): values are swapped within
// a layer until the filtered error of all step functions is least. For numbers that is an energy of |x - y|
// between pixels under the filters' autocorrelation, for points of the Euclidean distance, which is |x - y|
// averaged over all half-planes. Searched by threshold accepting (Dueck and Scheuer, J. Comput. Phys. 90,
// 1990).
#pragma once

#include "content/make/noise/filter_kernel.h"

#include <array>
#include <cstdint>
#include <vector>

namespace kilolux {

// Powers of two; the layers' area at least 16 and a power of four for points; layers a multiple of 4.
struct NoiseSize {
    int width = 64;
    int height = 64;
    int layers = 32;

    int area() const { return width * height; }
};

struct NoiseEffort {
    int proposalsPerPixel = 700; // swaps tried
    std::uint32_t seed = 1;      // same seed, same bytes, on every machine
};

// Values in 16 bits, [layer][y][x]. In each layer every one of `area` equal strata has exactly one value;
// over 65536 / area layers every 16-bit value comes once.
std::vector<std::uint16_t> optimizeScalarMask(NoiseSize size, const std::vector<NoiseFilter>& filters,
                                              NoiseEffort effort);

// The same for points of the unit square: each layer is a (0, log2(area), 2)-net in base 2, and so are the
// first 65536 / area layers together.
std::vector<std::array<std::uint16_t, 2>>
optimizePointMask(NoiseSize size, const std::vector<NoiseFilter>& filters, NoiseEffort effort);

// What the project's masks are adapted to: the picture of one frame, after the spatial filter; a few frames;
// and the long history, alone and blurred.
std::vector<NoiseFilter> renderingFilters();

} // namespace kilolux
