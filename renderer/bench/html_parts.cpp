#include "renderer/bench/html_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

namespace kilolux::bench {

namespace {

constexpr std::array kColors = {"#b45f06", "#1f77b4", "#2ca02c", "#9467bd",
                                "#d62728", "#17becf", "#7f7f7f", "#bcbd22"};

constexpr int kLeastWidthPx = 384;

std::string base64(const std::vector<std::uint8_t>& bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 3; ++k)
            word = word << 8 | (k < left ? bytes[i + k] : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= left ? digits[word >> (18 - 6 * k) & 63u] : '=';
    }
    return text;
}

// 1, 2 and 5 of every decade.
double tick(int index) {
    constexpr std::array kSteps = {1.0, 2.0, 5.0};
    const int decade = int(std::floor(index / 3.0));
    return kSteps[std::size_t(index - 3 * decade)] * std::pow(10.0, decade);
}

// Of an axis: from the tick below all values to the one above.
struct Ticks {
    int first = 0, last = 1;
    int step = 1; // 3: whole decades only

    double place(double value) const {
        const double from = std::log10(tick(first)), to = std::log10(tick(last));
        return (std::log10(value) - from) / (to - from);
    }
};

Ticks ticksFor(double low, double high) {
    Ticks ticks;
    ticks.first = 3 * int(std::floor(std::log10(low))) + 3;
    while (tick(ticks.first) > low * (1.0 + 1e-9))
        --ticks.first;
    ticks.last = ticks.first + 1;
    while (tick(ticks.last) < high * (1.0 - 1e-9))
        ++ticks.last;
    ticks.step = ticks.last - ticks.first > 7 ? 3 : 1;
    return ticks;
}

std::string numberText(double value) {
    if (value >= 1e6) return fmt::format("{:g} million", value * 1e-6);
    return value >= 1e3 ? fmt::format("{:.0f}", value) : fmt::format("{:g}", value);
}

class LogPlot {
  public:
    LogPlot(const std::vector<Curve>& curves, std::string xLabel, std::string yLabel)
        : curves_(curves), xLabel_(std::move(xLabel)), yLabel_(std::move(yLabel)) {
        double low[2] = {1e300, 1e300}, high[2] = {0.0, 0.0};
        for (const Curve& curve : curves)
            for (const auto& [x, y] : curve.points) {
                low[0] = std::min(low[0], x);
                high[0] = std::max(high[0], x);
                low[1] = std::min(low[1], y);
                high[1] = std::max(high[1], y);
            }
        empty_ = high[0] <= 0.0 || high[1] <= 0.0;
        if (empty_) return;
        for (int axis = 0; axis < 2; ++axis)
            ticks_[axis] = ticksFor(low[axis], high[axis]);
    }

    std::string svg() const {
        if (empty_) return "<p>nothing to plot</p>\n";
        std::string text =
            fmt::format("<svg viewBox=\"0 0 {} {}\" width=\"{}\" role=\"img\" aria-label=\"{} over {}\">\n",
                        kWidth, kHeight, kWidth, escaped(yLabel_), escaped(xLabel_));
        for (int axis = 0; axis < 2; ++axis)
            for (int i = ticks_[axis].first; i <= ticks_[axis].last; ++i)
                if (ticks_[axis].step == 1 || i % 3 == 0) text += gridLine(axis, tick(i));
        for (std::size_t i = 0; i < curves_.size(); ++i)
            text += line(curves_[i], kColors[i % kColors.size()], int(i));
        return text + fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>"
                                  "<text x=\"12\" y=\"14\">{}</text></svg>\n",
                                  kLeft + (kRight - kLeft) / 2, kHeight - 4, escaped(xLabel_),
                                  escaped(yLabel_));
    }

  private:
    static constexpr double kWidth = 880, kHeight = 340, kLeft = 68, kRight = 600, kTop = 26, kBottom = 300;

    double place(int axis, double value) const {
        const double t = ticks_[axis].place(value);
        return axis == 0 ? std::lerp(kLeft, kRight, t) : std::lerp(kBottom, kTop, t);
    }
    std::string gridLine(int axis, double value) const {
        const double at = place(axis, value);
        const std::string number = numberText(value);
        if (axis == 0)
            return fmt::format("<line class=\"g\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/>"
                               "<text x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">{4}</text>\n",
                               at, kTop, kBottom, kBottom + 16, number);
        return fmt::format("<line class=\"g\" x1=\"{1}\" x2=\"{2}\" y1=\"{0:.1f}\" y2=\"{0:.1f}\"/>"
                           "<text x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\">{5}</text>\n",
                           at, kLeft, kRight, kLeft - 6, at + 4, number);
    }
    std::string line(const Curve& curve, const char* color, int index) const {
        std::string points, dots;
        for (const auto& [x, y] : curve.points) {
            const double px = place(0, x), py = place(1, y);
            points += fmt::format("{:.1f},{:.1f} ", px, py);
            dots += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"/>", px, py, color);
        }
        const double y = kTop + 16.0 * index + 8.0;
        return fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>{}"
                           "<rect x=\"{}\" y=\"{}\" width=\"10\" height=\"10\" fill=\"{}\"/><text x=\"{}\" "
                           "y=\"{}\">{}</text>\n",
                           points, color, dots, kRight + 16, y - 9, color, kRight + 30, y,
                           escaped(curve.label));
    }

    const std::vector<Curve>& curves_;
    std::string xLabel_, yLabel_;
    Ticks ticks_[2];
    bool empty_ = false;
};

} // namespace

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '"':
            result += "&quot;";
            break;
        case '\'':
            result += "&#39;";
            break;
        default:
            result += c;
        }
    }
    return result;
}

std::string picture(int width, int height, const std::vector<std::uint8_t>& srgb,
                    const std::string& caption) {
    if (srgb.empty()) return {};
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const auto output = OIIO::ImageOutput::create("png", &memory);
    OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    if (!output || !output->open("picture.png", spec) ||
        !output->write_image(OIIO::TypeDesc::UINT8, srgb.data()) || !output->close())
        return fmt::format("<p>no picture: {}</p>", escaped(output ? output->geterror() : "no PNG writer"));
    // Small ones are shown in whole multiples of their pixels.
    const int factor = std::max(1, kLeastWidthPx / width);
    return fmt::format("<figure><img width=\"{}\" height=\"{}\" alt=\"{}\" src=\"data:image/png;base64,{}\">"
                       "<figcaption>{}</figcaption></figure>\n",
                       factor * width, factor * height, escaped(caption), base64(bytes), escaped(caption));
}

std::string logPlot(const std::vector<Curve>& curves, const std::string& xLabel, const std::string& yLabel) {
    return LogPlot(curves, xLabel, yLabel).svg();
}

} // namespace kilolux::bench
