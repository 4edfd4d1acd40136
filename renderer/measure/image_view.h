// A picture to be measured: interleaved RGB, row-major, top row first, owned by the caller.
#pragma once

#include <cstddef>
#include <span>

namespace kilolux::measure {

struct ImageView {
    int width = 0;
    int height = 0;
    std::span<const float> rgb; // width * height * 3

    std::size_t pixelCount() const { return static_cast<std::size_t>(width) * height; }
    const float* at(int x, int y) const { return rgb.data() + 3 * (static_cast<std::size_t>(y) * width + x); }
};

} // namespace kilolux::measure
