#include "renderer/lights_cpp/light_tables.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace kilolux {

namespace {
thread_local const LightTables* bound = nullptr;

template<typename Fetch>
double bilinear(const glm::dvec2& at, const Fetch& fetch) {
    const glm::dvec2 low = glm::floor(at), share = at - low;
    const int x = int(low.x), y = int(low.y);
    const double below = glm::mix(fetch(x, y), fetch(x + 1, y), share.x),
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
