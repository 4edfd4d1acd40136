#include "ui/speed_error.h"

#include <algorithm>
#include <cmath>

namespace kilolux {

namespace {

constexpr double kLeastError = 1e-6;

} // namespace

void SpeedError::setView(std::uint64_t key) {
    if (key == key_) return;
    key_ = key;
    curves_.clear();
}

void SpeedError::begin(const std::string& preset) {
    preset_ = preset;
    std::erase_if(curves_, [&](const ErrorCurve& curve) { return curve.preset == preset; });
    curves_.push_back({preset, 0.0, {}});
}

void SpeedError::add(const ErrorPoint& point, double frameMs) {
    if (curves_.empty() || curves_.back().preset != preset_) begin(preset_);
    ErrorCurve& curve = curves_.back();
    curve.frameMs = frameMs;
    std::erase_if(curve.points, [&](const ErrorPoint& each) { return each.frames >= point.frames; });
    curve.points.push_back(point);
}

const ErrorCurve* SpeedError::curveOf(const std::string& preset) const {
    const auto found = std::find_if(curves_.begin(), curves_.end(),
                                    [&](const ErrorCurve& curve) { return curve.preset == preset; });
    return found == curves_.end() ? nullptr : &*found;
}

bool SpeedError::axes(Axes& axes) const {
    bool any = false;
    const auto widen = [](std::array<double, 2>& ends, double value, bool isFirst) {
        ends = isFirst ? std::array{value, value}
                       : std::array{std::min(ends[0], value), std::max(ends[1], value)};
    };
    for (const ErrorCurve& curve : curves_) {
        for (const ErrorPoint& point : curve.points) {
            widen(axes.seconds, std::max(point.seconds, 1e-6), !any);
            widen(axes.error, std::max(point.flip, kLeastError), !any);
            any = true;
        }
    }
    for (std::array<double, 2>* ends : {&axes.seconds, &axes.error}) {
        const double low = std::floor(std::log10((*ends)[0]) + 1e-9);
        const double high = std::max(std::ceil(std::log10((*ends)[1]) - 1e-9), low + 1.0);
        if (any) *ends = {std::pow(10.0, low), std::pow(10.0, high)};
    }
    return any;
}

double axisPosition(const std::array<double, 2>& ends, double value) {
    const double at = std::log(std::max(value, ends[0] * 1e-3) / ends[0]) / std::log(ends[1] / ends[0]);
    return std::clamp(at, 0.0, 1.0);
}

} // namespace kilolux
