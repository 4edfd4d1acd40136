// Pictures made of two, see reference_image.h.
#include "renderer/view_colors.h"
#include "ui/reference_image.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace kilolux {

std::shared_ptr<const ShownFrame> splitPicture(const ShownFrame& left, const ShownFrame& right, double at) {
    auto result = std::make_shared<ShownFrame>(right);
    const int width = right.width, split = int(std::lround(std::clamp(at, 0.0, 1.0) * width));
    for (int y = 0; y < right.height; ++y) {
        const int fromY = std::min(int((y + 0.5) * left.height / right.height), left.height - 1);
        std::byte* row = &result->rgba8[std::size_t(y) * std::size_t(width) * 4];
        const std::byte* fromRow = &left.rgba8[std::size_t(fromY) * std::size_t(left.width) * 4];
        if (left.width == width) {
            std::memcpy(row, fromRow, std::size_t(split) * 4);
            continue;
        }
        for (int x = 0; x < split; ++x) {
            const int fromX = std::min(int((x + 0.5) * left.width / width), left.width - 1);
            std::memcpy(row + std::size_t(x) * 4, fromRow + std::size_t(fromX) * 4, 4);
        }
    }
    return result;
}

static std::byte toByte(float unit) {
    return std::byte(std::lround(255.0f * std::clamp(unit, 0.0f, 1.0f)));
}

Legend errorLegend() {
    Legend legend; // 0 to 1
    legend.map = ColorMap::Amount;
    return legend;
}

std::shared_ptr<const ShownFrame> errorPicture(const ErrorReport& report) {
    auto result = std::make_shared<ShownFrame>();
    result->width = report.width;
    result->height = report.height;
    result->rgba8.reserve(report.flip.size() * 4);
    for (const float error : report.flip) {
        for (const float channel : amountColor(error))
            result->rgba8.push_back(toByte(channel));
        result->rgba8.push_back(std::byte(255));
    }
    return result;
}

} // namespace kilolux
