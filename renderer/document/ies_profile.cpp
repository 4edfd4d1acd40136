// Intensity and flux of photometric profiles.
#include "renderer/document/ies_profile.h"

#include <algorithm>
#include <cmath>

namespace kilolux {

namespace {

constexpr double kPi = 3.14159265358979323846;

// Where an angle lies between two of an ascending list: the first one's index and the share of the second.
struct Place {
    std::size_t index = 0;
    double share = 0.0;
};

Place placeOf(const std::vector<double>& angles, double angle) {
    if (angles.size() == 1) return {};
    const auto above = std::upper_bound(angles.begin(), angles.end(), angle);
    const std::size_t index =
        std::clamp<std::size_t>(std::size_t(above - angles.begin()), 1, angles.size() - 1) - 1;
    return {index, std::clamp((angle - angles[index]) / (angles[index + 1] - angles[index]), 0.0, 1.0)};
}

// The two angles of a direction, in degrees.
struct Angles {
    double vertical = 0.0, horizontal = 0.0;
};

Angles anglesOf(IesPhotometry photometry, const glm::dvec3& d) {
    if (photometry == IesPhotometry::C) {
        const double horizontal = glm::degrees(std::atan2(d.y, d.x));
        return {glm::degrees(std::atan2(std::hypot(d.x, d.y), -d.z)),
                horizontal < 0.0 ? horizontal + 360.0 : horizontal};
    }
    // Horizontal angles of B and A run clockwise.
    return {glm::degrees(std::atan2(d.x, std::hypot(d.y, d.z))), glm::degrees(std::atan2(-d.y, -d.z))};
}

// How often the measured part of the sphere is repeated by symmetry, horizontally and vertically.
glm::dvec2 repetitions(const IesProfile& p) {
    const double first = p.horizontalDeg.front(), last = p.horizontalDeg.back();
    if (p.photometry != IesPhotometry::C)
        return {first < 0.0 ? 1.0 : 2.0, p.verticalDeg.front() < 0.0 ? 1.0 : 2.0};
    if (first == 90.0 && last == 270.0) return {2.0, 1.0};
    return {360.0 / last, 1.0};
}

// Into the range that was measured.
double foldedHorizontal(const IesProfile& p, double horizontal) {
    const double first = p.horizontalDeg.front(), last = p.horizontalDeg.back();
    if (p.photometry != IesPhotometry::C) return first < 0.0 ? horizontal : std::abs(horizontal);
    if (first == 90.0 && last == 270.0)
        return horizontal < 90.0 ? 180.0 - horizontal
                                 : (horizontal > 270.0 ? 540.0 - horizontal : horizontal);
    if (last <= 180.0 && horizontal > 180.0) horizontal = 360.0 - horizontal;
    if (last <= 90.0 && horizontal > 90.0) horizontal = 180.0 - horizontal;
    return horizontal;
}

} // namespace

double IesProfile::candelaAt(const glm::dvec3& direction) const {
    Angles at = anglesOf(photometry, direction);
    if (photometry != IesPhotometry::C && verticalDeg.front() >= 0.0) at.vertical = std::abs(at.vertical);
    constexpr double kRoundingDeg = 1e-9;
    if (at.vertical < verticalDeg.front() - kRoundingDeg || at.vertical > verticalDeg.back() + kRoundingDeg)
        return 0.0;
    if (photometry != IesPhotometry::C && std::abs(at.horizontal) > 90.0 + kRoundingDeg) return 0.0;
    const double horizontal = foldedHorizontal(*this, at.horizontal);
    if (horizontalDeg.size() > 1 && (horizontal < horizontalDeg.front() - kRoundingDeg ||
                                     horizontal > horizontalDeg.back() + kRoundingDeg))
        return 0.0;
    const Place v = placeOf(verticalDeg, at.vertical), h = placeOf(horizontalDeg, horizontal);
    const auto along = [&](std::size_t row) {
        const double* values = &candela[row * verticalDeg.size() + v.index];
        return v.share > 0.0 ? values[0] + (values[1] - values[0]) * v.share : values[0];
    };
    const double first = along(h.index);
    return h.share > 0.0 ? first + (along(h.index + 1) - first) * h.share : first;
}

double IesProfile::maxCandela() const {
    return *std::max_element(candela.begin(), candela.end());
}

double IesProfile::fluxLm() const {
    // Of one plane, per radian of horizontal angle: intensity is linear between two vertical angles, and the
    // width of the sphere there is the sine (C) or the cosine of the vertical one.
    const auto ofPlane = [&](std::size_t row) {
        double sum = 0.0;
        for (std::size_t i = 0; i + 1 < verticalDeg.size(); ++i) {
            const double a = glm::radians(verticalDeg[i]), b = glm::radians(verticalDeg[i + 1]);
            const double value = candela[row * verticalDeg.size() + i];
            const double slope = (candela[row * verticalDeg.size() + i + 1] - value) / (b - a);
            if (photometry == IesPhotometry::C) {
                sum += value * (std::cos(a) - std::cos(b)) +
                       slope * (std::sin(b) - std::sin(a) - (b - a) * std::cos(b));
            } else {
                sum += value * (std::sin(b) - std::sin(a)) +
                       slope * (std::cos(b) - std::cos(a) + (b - a) * std::sin(b));
            }
        }
        return sum;
    };
    if (horizontalDeg.size() == 1) {
        const bool c = photometry == IesPhotometry::C;
        return ofPlane(0) * (c ? 2.0 * kPi : kPi * repetitions(*this).y);
    }
    double sum = 0.0;
    for (std::size_t row = 0; row + 1 < horizontalDeg.size(); ++row)
        sum += glm::radians(horizontalDeg[row + 1] - horizontalDeg[row]) * 0.5 *
               (ofPlane(row) + ofPlane(row + 1));
    const glm::dvec2 times = repetitions(*this);
    return sum * times.x * times.y;
}

std::optional<double> IesProfile::efficiency() const {
    if (!lampLumens) return std::nullopt;
    return fluxLm() / *lampLumens;
}

} // namespace kilolux
