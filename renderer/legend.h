// What the colours of a view mean: colour map, numbers and unit. The same numbers steer the shader, so that a
// legend cannot say anything else than what is shown.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kilolux {

enum class ColorMap { None, Amount, Signed, Grey, Ids };
// Depth: half of the scale at a distance, its end at infinity; bright is near.
enum class LegendScale { Linear, Decades, Stops, Depth };

struct ViewRange {
    double low = 0.0;
    double high = 1.0;
    bool operator==(const ViewRange&) const = default;
};

// One entry of a legend without a scale.
struct LegendKey {
    std::array<float, 3> srgb{};
    std::string_view meaning;
};

struct Legend {
    ColorMap map = ColorMap::None;
    LegendScale scale = LegendScale::Linear;
    ViewRange range;           // in `unit`; Decades: both positive
    std::string_view unit;     // empty: a plain number
    std::string_view channels; // what red, green and blue are where they are not one colour
    std::vector<LegendKey> keys;
};

std::string_view colorMapName(ColorMap map);

// sRGB, 0 to 1, at position t of the bar, 0 at its low end; grey for maps that have no order.
std::array<float, 3> legendColor(const Legend& legend, double t);

// The value at position t of the bar, and its inverse (0 to 1). Depth is infinite at its low end.
double legendValue(const Legend& legend, double t);
double legendPosition(const Legend& legend, double value);

// Round numbers on the bar, with their positions: about `wanted` of them.
struct LegendTick {
    double position = 0.0;
    std::string text;
};
std::vector<LegendTick> legendTicks(const Legend& legend, int wanted);

// A value as a person reads it: four digits, "-" for what is not finite.
std::string valueText(double value);

} // namespace kilolux
