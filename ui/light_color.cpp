#include "ui/light_color.h"

#include "renderer/document/light_units.h"
#include "ui/light_fields.h"

#include <algorithm>
#include <cmath>

namespace kilolux {

std::uint32_t LightColors::of(const LightDef& def) {
    constexpr std::size_t kMostKept = 20'000;
    glm::dvec3 color = def.color;
    if (def.temperatureK) {
        if (blackBodies_.size() > kMostKept) blackBodies_.clear();
        const auto [at, isNew] = blackBodies_.try_emplace(*def.temperatureK);
        if (isNew) at->second = temperatureColor(*def.temperatureK);
        color *= at->second;
    }
    const double most = std::max({color.x, color.y, color.z});
    if (!(most > 0.0)) return 0xff808080u;
    constexpr double kLeast = 0.25; // of each channel, sRGB: a deep blue stays readable
    const glm::dvec3 shown = glm::max(srgbFromLinear(color / most), glm::dvec3(kLeast));
    const auto byte = [](double value) { return std::uint32_t(std::lround(255.0 * value)); };
    return 0xff000000u | byte(shown.z) << 16 | byte(shown.y) << 8 | byte(shown.x);
}

} // namespace kilolux
