#include "renderer/lights_cpp/light_tables.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/gtc/packing.hpp>

namespace kilolux {

namespace {
thread_local const LightTables* bound = nullptr;

template<typename Fetch>
auto bilinear(const glm::dvec2& at, const Fetch& fetch) {
    const glm::dvec2 low = glm::floor(at), share = at - low;
    const int x = int(low.x), y = int(low.y);
    const auto below = glm::mix(fetch(x, y), fetch(x + 1, y), share.x),
               above = glm::mix(fetch(x, y + 1), fetch(x + 1, y + 1), share.x);
    return glm::mix(below, above, share.y);
}
} // namespace

double LightPicture::clamped(const glm::dvec2& uv) const {
    return bilinear(glm::clamp(uv, 0.0, 1.0) * glm::dvec2(width, height) - 0.5, [&](int x, int y) {
        return double(
            texels[std::size_t(std::clamp(y, 0, height - 1) * width + std::clamp(x, 0, width - 1))]);
    });
}

double LightPicture::repeated(const glm::dvec2& uv) const {
    return bilinear(glm::fract(uv) * glm::dvec2(width, height) - 0.5, [&](int x, int y) {
        return double(texels[std::size_t((y + height) % height * width + (x + width) % width)]);
    });
}

glm::dvec3 DomeMaps::Picture::sample(const glm::dvec2& uv) const {
    const glm::dvec2 at = glm::dvec2(uv.x * width, std::clamp(uv.y, 0.0, 1.0) * height) - 0.5;
    const glm::dvec2 low = glm::floor(at), share = at - low;
    const auto fetch = [&](int x, int y) {
        const int column = ((x % width) + width) % width, row = std::clamp(y, 0, height - 1);
        return glm::dvec3(texels[std::size_t(row) * std::size_t(width) + std::size_t(column)]);
    };
    const int x = int(low.x), y = int(low.y);
    return glm::mix(glm::mix(fetch(x, y), fetch(x + 1, y), share.x),
                    glm::mix(fetch(x, y + 1), fetch(x + 1, y + 1), share.x), share.y);
}

glm::dvec3 DomeMaps::radianceAt(const glm::dvec2& uv, double level) const {
    const double clamped = std::clamp(level, 0.0, double(levels.size() - 1));
    const std::size_t below = std::size_t(clamped), above = std::min(below + 1, levels.size() - 1);
    return glm::mix(levels[below].sample(uv), levels[above].sample(uv), clamped - double(below));
}

glm::dvec3 DomeMaps::irradianceAt(const glm::dvec2& uv) const {
    const glm::dvec2 size(irradiance.width, irradiance.height);
    return irradiance.sample({uv.x + 0.5 / size.x, (uv.y * (size.y - 1.0) + 0.5) / size.y});
}

glm::dvec3 SourcePicture::lookup(const glm::dvec2& uv, double level) const {
    const auto ofLevel = [&](std::size_t index) {
        const Level& from = levels[std::min(index, levels.size() - 1)];
        return bilinear(glm::clamp(uv, 0.0, 1.0) * double(from.sizePx) - 0.5, [&](int x, int y) {
            const glm::ivec2 at = glm::clamp(glm::ivec2(x, y), 0, from.sizePx - 1);
            return glm::dvec3(glm::unpackHalf4x16(from.texels[std::size_t(at.y * from.sizePx + at.x)]));
        });
    };
    const double low = std::floor(std::max(level, 0.0));
    const glm::dvec3 finer = ofLevel(std::size_t(low));
    return level > low ? glm::mix(finer, ofLevel(std::size_t(low) + 1), level - low) : finer;
}

BindLightTables::BindLightTables(const LightTables& tables) : before_(bound) {
    bound = &tables;
}

BindLightTables::~BindLightTables() {
    bound = before_;
}

const LightTables& boundLightTables() {
    assert(bound);
    return *bound;
}

} // namespace kilolux
