// Colours as text, and between linear Rec. 709 and sRGB; declared in light_fields.h.
#include "ui/light_fields.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace kilolux {

namespace {

double encode(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}
double decode(double srgb) {
    return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

std::optional<glm::dvec3> parseHex(std::string_view digits) {
    std::uint32_t bits = 0;
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), bits, 16);
    if (digits.size() != 6 || read.ec != std::errc() || read.ptr != digits.data() + digits.size())
        return std::nullopt;
    return linearFromSrgb(glm::dvec3(bits >> 16, (bits >> 8) & 255u, bits & 255u) / 255.0);
}

} // namespace

glm::dvec3 srgbFromLinear(const glm::dvec3& linear) {
    return {encode(linear.x), encode(linear.y), encode(linear.z)};
}
glm::dvec3 linearFromSrgb(const glm::dvec3& srgb) {
    return {decode(srgb.x), decode(srgb.y), decode(srgb.z)};
}

Result<glm::dvec3> parseColor(std::string_view text) {
    const Error expected{
        fmt::format("expected a colour such as '#ffd8a0' or '1 0.7 0.4', found '{}'", text.substr(0, 40))};
    std::vector<double> numbers;
    std::size_t at = 0;
    while ((at = text.find_first_not_of(" \t,;", at)) != std::string_view::npos) {
        const std::string_view word = text.substr(at, text.find_first_of(" \t,;", at) - at);
        at += word.size();
        if (word.front() == '#') {
            const std::optional<glm::dvec3> color = parseHex(word.substr(1));
            if (!color || !numbers.empty() || text.find_first_not_of(" \t", at) != std::string_view::npos)
                return expected;
            return *color;
        }
        double number = 0.0;
        const auto read = std::from_chars(word.data(), word.data() + word.size(), number);
        if (read.ec != std::errc() || read.ptr != word.data() + word.size() || !std::isfinite(number) ||
            number < 0.0)
            return expected;
        numbers.push_back(number);
    }
    if (numbers.size() == 1) return glm::dvec3(numbers[0]);
    if (numbers.size() != 3) return expected;
    return glm::dvec3(numbers[0], numbers[1], numbers[2]);
}

std::string formatColor(const glm::dvec3& linear) {
    return fmt::format("{} {} {}", formatQuantity(linear.x, Quantity::Number, 4),
                       formatQuantity(linear.y, Quantity::Number, 4),
                       formatQuantity(linear.z, Quantity::Number, 4));
}

} // namespace kilolux
