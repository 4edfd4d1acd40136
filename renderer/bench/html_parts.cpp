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

class LogPlot {
  public:
    LogPlot(const std::vector<Curve>& curves, std::string xLabel, std::string yLabel)
        : curves_(curves), xLabel_(std::move(xLabel)), yLabel_(std::move(yLabel)) {
        for (const Curve& curve : curves)
            for (const auto& [x, y] : curve.points) {
                low_[0] = std::min(low_[0], std::log10(x));
                high_[0] = std::max(high_[0], std::log10(x));
                low_[1] = std::min(low_[1], std::log10(y));
                high_[1] = std::max(high_[1], std::log10(y));
            }
    }

    std::string svg() const {
        if (low_[0] > high_[0]) return "<p>nothing to plot</p>\n";
        std::string text =
            fmt::format("<svg viewBox=\"0 0 {} {}\" width=\"{}\" role=\"img\">\n", kWidth, kHeight, kWidth);
        for (int axis = 0; axis < 2; ++axis)
            for (int decade = int(std::floor(low_[axis])); decade <= int(std::ceil(high_[axis])); ++decade)
                text += gridLine(axis, decade);
        for (std::size_t i = 0; i < curves_.size(); ++i)
            text += line(curves_[i], kColors[i % kColors.size()], int(i));
        return text + fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>"
                                  "<text x=\"12\" y=\"14\">{}</text></svg>\n",
                                  kLeft + (kRight - kLeft) / 2, kHeight - 4, escaped(xLabel_),
                                  escaped(yLabel_));
    }

  private:
    static constexpr double kWidth = 880, kHeight = 320, kLeft = 60, kRight = 440, kTop = 24, kBottom = 284;

    double place(int axis, double logValue) const {
        const double from = std::floor(low_[axis]), to = std::max(std::ceil(high_[axis]), from + 1.0);
        const double t = (logValue - from) / (to - from);
        return axis == 0 ? std::lerp(kLeft, kRight, t) : std::lerp(kBottom, kTop, t);
    }
    std::string gridLine(int axis, int decade) const {
        const double at = place(axis, decade);
        const std::string number = fmt::format("{:g}", std::pow(10.0, decade));
        if (axis == 0)
            return fmt::format("<line class=\"g\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/>"
                               "<text x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">{4}</text>\n",
                               at, kTop, kBottom, kBottom + 14, number);
        return fmt::format("<line class=\"g\" x1=\"{1}\" x2=\"{2}\" y1=\"{0:.1f}\" y2=\"{0:.1f}\"/>"
                           "<text x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\">{5}</text>\n",
                           at, kLeft, kRight, kLeft - 4, at + 4, number);
    }
    std::string line(const Curve& curve, const char* color, int index) const {
        std::string points, dots;
        for (const auto& [x, y] : curve.points) {
            const double px = place(0, std::log10(x)), py = place(1, std::log10(y));
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
    double low_[2] = {1e9, 1e9}, high_[2] = {-1e9, -1e9};
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
    return fmt::format("<figure><img width=\"{}\" height=\"{}\" alt=\"{}\" src=\"data:image/png;base64,{}\">"
                       "<figcaption>{}</figcaption></figure>\n",
                       width, height, escaped(caption), base64(bytes), escaped(caption));
}

std::string logPlot(const std::vector<Curve>& curves, const std::string& xLabel, const std::string& yLabel) {
    return LogPlot(curves, xLabel, yLabel).svg();
}

} // namespace kilolux::bench
