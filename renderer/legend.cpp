#include "renderer/legend.h"

#include "renderer/view_colors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace kilolux {

std::string_view colorMapName(ColorMap map) {
    switch (map) {
    case ColorMap::Amount:
        return "amount: dark violet to yellow";
    case ColorMap::Signed:
        return "signed: blue below, grey, red above";
    case ColorMap::Grey:
        return "grey";
    case ColorMap::Ids:
        return "a colour per id";
    case ColorMap::None:
        break;
    }
    return "colours as they are";
}

std::array<float, 3> legendColor(const Legend& legend, double t) {
    const float at = float(std::clamp(t, 0.0, 1.0));
    if (legend.map == ColorMap::Amount)
        return amountColor(legend.scale == LegendScale::Depth ? 1.0f - at : at);
    if (legend.map == ColorMap::Signed) return signedColor(2.0f * at - 1.0f);
    return {at, at, at};
}

double legendValue(const Legend& legend, double t) {
    const auto& [low, high] = legend.range;
    if (legend.scale == LegendScale::Decades) return low * std::pow(high / low, t);
    // The shader shows d / (d + middle).
    if (legend.scale == LegendScale::Depth)
        return t < 1.0 ? low * t / (1.0 - t) : std::numeric_limits<double>::infinity();
    return low + (high - low) * t;
}

double legendPosition(const Legend& legend, double value) {
    const auto& [low, high] = legend.range;
    double t = (value - low) / (high - low);
    if (legend.scale == LegendScale::Decades)
        t = std::log(std::max(value, 1e-30) / low) / std::log(high / low);
    if (legend.scale == LegendScale::Depth) t = std::isfinite(value) ? value / (value + low) : 1.0;
    return std::clamp(t, 0.0, 1.0);
}

std::string valueText(double value) {
    if (!std::isfinite(value)) return "-";
    if (value == 0.0) return "0";
    const double size = std::abs(value);
    if (size >= 1e6 || size < 1e-4) return fmt::format("{:.3g}", value);
    const int digits = std::clamp(3 - int(std::floor(std::log10(size))), 0, 6);
    std::string text = fmt::format("{:.{}f}", value, digits);
    if (text.find('.') == std::string::npos) return text;
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
}

namespace {

// The least of 1, 2, 5 times a power of ten that is at least `step`.
double roundStep(double step) {
    const double power = std::pow(10.0, std::floor(std::log10(step)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * power >= step * 0.999) return factor * power;
    }
    return 10.0 * power;
}

} // namespace

std::vector<LegendTick> legendTicks(const Legend& legend, int wanted) {
    std::vector<LegendTick> ticks;
    const auto& [low, high] = legend.range;
    const auto add = [&](double value, std::string text) {
        ticks.push_back({legendPosition(legend, value), std::move(text)});
    };
    if (legend.scale == LegendScale::Depth) {
        for (const double t : {0.0, 0.25, 0.5, 0.75})
            ticks.push_back({t, valueText(legendValue(legend, t))});
        ticks.push_back({1.0, "far"});
        return ticks;
    }
    if (!(high > low) || wanted < 1) return ticks;
    if (legend.scale == LegendScale::Decades) {
        if (!(low > 0.0)) return ticks;
        const int first = int(std::ceil(std::log10(low) - 1e-9)),
                  last = int(std::floor(std::log10(high) + 1e-9));
        const int step = std::max(1, (last - first) / wanted);
        for (int decade = first; decade <= last; decade += step)
            add(std::pow(10.0, decade), valueText(std::pow(10.0, decade)));
        return ticks;
    }
    const double step = roundStep((high - low) / wanted);
    for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) {
        const double value = i * step;
        const bool sign = legend.scale == LegendScale::Stops && value > 0.0;
        add(value, (sign ? "+" : "") + valueText(value));
    }
    return ticks;
}

} // namespace kilolux
