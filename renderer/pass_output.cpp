#include "renderer/pass_output.h"

#include "renderer/readback.h"
#include "renderer/view_colors.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/format.h>

namespace kilolux {

namespace {

bool isInteger(VkFormat format) {
    return format == VK_FORMAT_R32_UINT || format == VK_FORMAT_R32G32_UINT ||
           format == VK_FORMAT_R32G32B32A32_UINT;
}

// Where single numbers lie, without the extremes.
ViewRange usualRange(const FloatImage& image) {
    std::vector<float> values;
    const std::size_t stride = std::size_t(image.channels);
    for (std::size_t i = 0; i < image.pixels.size(); i += stride) {
        if (std::isfinite(image.pixels[i]) && image.pixels[i] < 1e30f) values.push_back(image.pixels[i]);
    }
    if (values.empty()) return {0.0, 1.0};
    const auto at = [&](double share) {
        const auto nth = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
        std::nth_element(values.begin(), nth, values.end());
        return double(*nth);
    };
    const double low = at(0.01), high = at(0.99);
    return high > low ? ViewRange{low, high} : ViewRange{low, low + 1.0};
}

Legend legendOf(VkFormat format, const FloatImage& image) {
    Legend legend;
    if (isInteger(format)) {
        legend.map = ColorMap::Ids;
        legend.channels = "a colour per first word";
    } else if (image.channels < 3) {
        legend.map = ColorMap::Amount;
        legend.range = usualRange(image);
        legend.channels = image.channels == 2 ? "the first of two numbers" : "";
    } else if (format == VK_FORMAT_R8G8B8A8_UNORM) {
        legend.channels = "as on the display";
    } else {
        legend.channels = "exposed light as the display shows it";
    }
    return legend;
}

} // namespace

std::optional<PassOutputName> passOutputName(std::string_view view) {
    constexpr std::string_view prefix = "pass:";
    if (!view.starts_with(prefix)) return std::nullopt;
    view.remove_prefix(prefix.size());
    const std::size_t slash = view.find('/');
    if (slash == std::string_view::npos) return PassOutputName{std::string(view), ""};
    return PassOutputName{std::string(view.substr(0, slash)), std::string(view.substr(slash + 1))};
}

Result<PassOutput> showPassOutput(const PassOutputName& wanted, const std::vector<gpu::Captured>& captured,
                                  glm::ivec2 allocatedPx, glm::ivec2 renderedPx, glm::ivec2 outputPx) {
    PassOutput result;
    const gpu::Captured* shown = nullptr;
    for (const gpu::Captured& one : captured) {
        if (one.format == VK_FORMAT_UNDEFINED) continue; // a buffer
        result.names.push_back(one.name);
        const bool match =
            wanted.output.empty() || one.name == wanted.output || one.name == wanted.output + "Out";
        if (match && !shown) shown = &one;
    }
    if (captured.empty()) return Error{fmt::format("no pass '{}' ran in this frame", wanted.pass)};
    if (!shown) {
        return Error{fmt::format("pass '{}' writes no image{}; it writes {}", wanted.pass,
                                 wanted.output.empty() ? "" : " '" + wanted.output + "'",
                                 result.names.empty() ? "buffers only"
                                                      : fmt::format("{}", fmt::join(result.names, ", ")))};
    }
    result.name = shown->name;
    const FloatImage image = toFloatImage(*shown);
    result.legend = legendOf(shown->format, image);
    const std::size_t texelBytes = shown->bytes.size() / (std::size_t(shown->width) * shown->height);
    const glm::dvec2 step = glm::dvec2(renderedPx) / glm::dvec2(outputPx) *
                            (glm::dvec2(shown->width, shown->height) / glm::dvec2(allocatedPx));
    result.picture = {outputPx.x, outputPx.y, {}, {}};
    for (int y = 0; y < outputPx.y; ++y) {
        for (int x = 0; x < outputPx.x; ++x) {
            const glm::ivec2 texel = glm::min(glm::ivec2((glm::dvec2(x, y) + 0.5) * step),
                                              glm::ivec2(shown->width, shown->height) - 1);
            const std::size_t at = std::size_t(texel.y) * shown->width + std::size_t(texel.x);
            const float* values = &image.pixels[at * std::size_t(image.channels)];
            std::array<float, 3> color{};
            for (int c = 0; c < 3; ++c) {
                result.picture.rgb.push_back(c < image.channels ? values[c] : 0.0f);
                color[std::size_t(c)] = result.picture.rgb.back();
            }
            if (isInteger(shown->format)) {
                std::uint32_t word = 0;
                std::memcpy(&word, shown->bytes.data() + at * texelBytes, sizeof(word));
                color = idColor(word);
            } else if (image.channels < 3) {
                color = legendColor(result.legend, legendPosition(result.legend, double(values[0])));
            } else if (shown->format != VK_FORMAT_R8G8B8A8_UNORM) {
                color = displayColor(color);
            }
            for (const float channel : color)
                result.picture.srgb8.push_back(
                    std::uint8_t(std::lround(255.0f * std::clamp(channel, 0.0f, 1.0f))));
        }
    }
    return result;
}

} // namespace kilolux
