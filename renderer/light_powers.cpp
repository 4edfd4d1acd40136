#include "renderer/light_powers.h"

#include "renderer/document/light_units.h"

#include <glm/gtc/constants.hpp>
#include <numeric>

namespace kilolux {

using namespace shared;

std::vector<LightPower> aliasTable(std::span<const double> weights) {
    const std::size_t n = weights.size();
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<LightPower> table(n);
    std::vector<double> left(n); // of an entry's share, in units of 1 / n
    std::vector<std::size_t> poor, rich;
    for (std::size_t i = 0; i < n; ++i) {
        const double probability = sum > 0.0 ? weights[i] / sum : 1.0 / double(n);
        left[i] = probability * double(n);
        table[i] = {1.0f, std::uint32_t(i), float(probability)};
        (left[i] < 1.0 ? poor : rich).push_back(i);
    }
    // Each poor entry is filled up by a rich one.
    while (!poor.empty() && !rich.empty()) {
        const std::size_t taker = poor.back(), giver = rich.back();
        poor.pop_back();
        table[taker].keep = float(left[taker]);
        table[taker].other = std::uint32_t(giver);
        left[giver] -= 1.0 - left[taker];
        if (left[giver] >= 1.0) continue;
        rich.pop_back();
        poor.push_back(giver);
    }
    return table;
}

std::vector<double> lightPowers(std::span<const LightHot> hot, std::span<const LightCold> cold,
                                double sceneExtentM) {
    std::vector<double> powers;
    for (std::size_t i = 0; i < hot.size(); ++i) {
        const bool off = hot[i].typeFlags & (LIGHT_FLAG_DEAD | LIGHT_FLAG_MUTED);
        const bool directional = (hot[i].typeFlags & LIGHT_TYPE_MASK) == LIGHT_DIRECTIONAL;
        const double radiusM = 0.5 * sceneExtentM;
        const double lux = luminanceOf(glm::dvec3(hot[i].intensity));
        double lm = directional ? lux * glm::pi<double>() * radiusM * radiusM : double(cold[i].fluxLm);
        if ((hot[i].typeFlags & LIGHT_TYPE_MASK) == LIGHT_DOME) {
            const double meanLux = lux * double(hot[i].sizeM.x) * glm::pi<double>();
            lm = meanLux * 4.0 * glm::pi<double>() * radiusM * radiusM;
        }
        powers.push_back(off ? 0.0 : lm);
    }
    return powers;
}

} // namespace kilolux
