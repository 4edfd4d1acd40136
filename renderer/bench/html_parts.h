// Pieces of the report's page: text that is safe in it, pictures within it, curves.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace kilolux::bench {

std::string escaped(std::string_view text);

// A PNG in the page itself; nothing without pixels.
std::string picture(int width, int height, const std::vector<std::uint8_t>& srgb, const std::string& caption);

struct Curve {
    std::string label;
    std::vector<std::pair<double, double>> points; // both above 0
};

// An SVG of curves over logarithmic axes, with their labels beside.
std::string logPlot(const std::vector<Curve>& curves, const std::string& xLabel, const std::string& yLabel);

} // namespace kilolux::bench
