// Pictures of rectangle lights, see source_picture.h.
#include "renderer/source_picture.h"

#include "renderer/document/light_units.h"
#include "renderer/document/made_once.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>

namespace kilolux {

namespace {

// As in lights/picture.glsl.
constexpr int kSizePx = 256, kWarpCells = 64;
constexpr double kMost = 65504.0; // of a half float
// Of the mean luminance: what samples give to dark places, where interpolation and colour may still bring
// light.
constexpr double kLeastDensity = 0.02;

glm::dvec3 texelOf(const Image& image, int x, int y) {
    const std::size_t at = 4 * (std::size_t(std::clamp(y, 0, image.height - 1)) * std::size_t(image.width) +
                                std::size_t(std::clamp(x, 0, image.width - 1)));
    glm::dvec3 rgb(0.0);
    for (int c = 0; c < 3; ++c) {
        if (image.rgba8.empty()) {
            const double value = image.rgbaF32[at + std::size_t(c)];
            rgb[c] = std::isfinite(value) ? std::clamp(value, 0.0, kMost) : 0.0;
            continue;
        }
        const double v = image.rgba8[at + std::size_t(c)] / 255.0;
        rgb[c] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    }
    return rgb;
}

// Which texels of a row or column of `size` make each of the picture's, and by how much: a tent as wide as a
// texel of the coarser of the two.
struct Tent {
    int first = 0;
    std::vector<double> weights;
};
std::vector<Tent> tents(int size) {
    std::vector<Tent> result;
    const double scale = double(size) / kSizePx, radius = std::max(1.0, scale);
    for (int i = 0; i < kSizePx; ++i) {
        const double middle = (i + 0.5) * scale - 0.5;
        Tent tent{int(std::ceil(middle - radius)), {}};
        double sum = 0.0;
        for (int k = tent.first; k <= int(std::floor(middle + radius)); ++k) {
            tent.weights.push_back(std::max(0.0, 1.0 - std::abs(k - middle) / radius));
            sum += tent.weights.back();
        }
        for (double& weight : tent.weights)
            weight /= sum;
        result.push_back(std::move(tent));
    }
    return result;
}

std::vector<glm::dvec3> resized(const Image& image) {
    const std::vector<Tent> across = tents(image.width), down = tents(image.height);
    std::vector<glm::dvec3> rows(std::size_t(image.height) * kSizePx, glm::dvec3(0.0));
    std::vector<glm::dvec3> line(static_cast<std::size_t>(image.width));
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x)
            line[std::size_t(x)] = texelOf(image, x, y);
        for (int x = 0; x < kSizePx; ++x) {
            const Tent& tent = across[std::size_t(x)];
            for (std::size_t k = 0; k < tent.weights.size(); ++k)
                rows[std::size_t(y) * kSizePx + std::size_t(x)] +=
                    line[std::size_t(std::clamp(tent.first + int(k), 0, image.width - 1))] * tent.weights[k];
        }
    }
    std::vector<glm::dvec3> result(std::size_t(kSizePx) * kSizePx, glm::dvec3(0.0));
    for (int y = 0; y < kSizePx; ++y) {
        const Tent& tent = down[std::size_t(y)];
        for (std::size_t k = 0; k < tent.weights.size(); ++k) {
            const auto from = std::size_t(std::clamp(tent.first + int(k), 0, image.height - 1)) * kSizePx;
            for (std::size_t x = 0; x < std::size_t(kSizePx); ++x)
                result[std::size_t(y) * kSizePx + x] += rows[from + x] * tent.weights[k];
        }
    }
    return result;
}

std::vector<glm::dvec3> halved(const std::vector<glm::dvec3>& texels, int sizePx) {
    std::vector<glm::dvec3> result;
    const auto at = [&](int x, int y) { return texels[std::size_t(y * sizePx + x)]; };
    for (int y = 0; y < sizePx; y += 2) {
        for (int x = 0; x < sizePx; x += 2)
            result.push_back(0.25 * (at(x, y) + at(x + 1, y) + at(x, y + 1) + at(x + 1, y + 1)));
    }
    return result;
}

// From a level of kWarpCells a side; the light's uv run against the picture's.
std::vector<float> warpOf(const std::vector<glm::dvec3>& texels, double meanLuminance) {
    constexpr int n = kWarpCells;
    const auto densityOf = [&](int column, int row) {
        const double here = luminanceOf(texels[std::size_t((n - 1 - row) * n + n - 1 - column)]);
        return meanLuminance > 0.0 ? here / meanLuminance + kLeastDensity : 1.0;
    };
    std::vector<double> rows; // n + 1 lines of n + 1 integrals
    for (int line = 0; line <= n; ++line) {
        double sum = 0.0;
        rows.push_back(0.0);
        for (int column = 0; column < n; ++column) {
            sum += 0.5 / n *
                   (densityOf(column, std::max(line - 1, 0)) + densityOf(column, std::min(line, n - 1)));
            rows.push_back(sum);
        }
    }
    std::vector<double> sums{0.0};
    for (int line = 0; line < n; ++line)
        sums.push_back(
            sums.back() +
            0.5 / n * (rows[std::size_t(line * (n + 1) + n)] + rows[std::size_t((line + 1) * (n + 1) + n)]));
    std::vector<float> warp;
    for (const double value : sums)
        warp.push_back(float(value / sums.back()));
    for (const double value : rows)
        warp.push_back(float(value / sums.back()));
    return warp;
}

} // namespace

SourcePicture makeSourcePicture(const Image& image) {
    SourcePicture made;
    std::vector<std::vector<glm::dvec3>> pyramid{resized(image)};
    for (int sizePx = kSizePx; sizePx > 1; sizePx /= 2)
        pyramid.push_back(halved(pyramid.back(), sizePx));
    made.mean = pyramid.back()[0];
    int sizePx = kSizePx;
    for (const std::vector<glm::dvec3>& level : pyramid) {
        if (sizePx == kWarpCells) made.warp = warpOf(level, luminanceOf(made.mean));
        SourcePicture::Level& packed = made.levels.emplace_back(SourcePicture::Level{sizePx, {}});
        for (const glm::dvec3& texel : level)
            packed.texels.push_back(glm::packHalf4x16(glm::vec4(glm::vec3(texel), 1.0f)));
        sizePx /= 2;
    }
    return made;
}

std::shared_ptr<const SourcePicture> sourcePictureOf(const LightDef& def) {
    static MadeOnce<Image, SourcePicture> pictures;
    const bool has = def.type == LightType::Rect && def.sourceImage && def.sourceImage->width > 0 &&
                     def.sourceImage->height > 0;
    return has ? pictures.get(def.sourceImage, makeSourcePicture) : nullptr;
}

glm::dvec3 pictureMean(const LightDef& def) {
    const std::shared_ptr<const SourcePicture> picture = sourcePictureOf(def);
    return picture ? picture->mean : glm::dvec3(1.0);
}

} // namespace kilolux
