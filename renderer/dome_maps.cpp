#include "renderer/dome_maps.h"

#include "renderer/document/light_units.h"
#include "renderer/document/made_once.h"
#include "renderer/lights_cpp/lights_f64.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/gtc/packing.hpp>

namespace kilolux {

namespace {

using glm::dvec3;
using glm::vec3;

constexpr double kPi = 3.14159265358979323846;
constexpr int kIrradianceColumns = 128, kIrradianceRows = 65;
constexpr int kIrradianceCells = 128;     // along the equator, that the picture is summed up in for it
constexpr int kDistributionCells = 512;   // the same for drawing directions
constexpr float kLargestTexel = 32768.0f; // half floats end at 65504

struct Panorama {
    int width = 0, height = 0;
    std::vector<vec3> texels;
    const vec3& at(int x, int y) const {
        return texels[std::size_t(y) * std::size_t(width) + std::size_t(x)];
    }
};

float soundValue(float value) {
    return value > 0.0f && std::isfinite(value) ? value : 0.0f;
}

Panorama panoramaOf(const Image* image) {
    if (!image || image->width < 1 || image->height < 1) return {4, 2, std::vector<vec3>(8, vec3(1.0f))};
    Panorama result{image->width, image->height, {}};
    const auto linear = [](std::uint8_t srgb) {
        const double v = srgb / 255.0;
        return float(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
    };
    const std::size_t count = std::size_t(image->width) * std::size_t(image->height);
    for (std::size_t i = 0; i < count; ++i) {
        vec3 texel;
        for (int c = 0; c < 3; ++c) {
            const std::size_t at = 4 * i + std::size_t(c);
            texel[c] = image->rgba8.empty() ? soundValue(image->rgbaF32[at]) : linear(image->rgba8[at]);
        }
        result.texels.push_back(texel);
    }
    return result;
}

// The sphere between two rows' edges, per share of a turn: of row y of `rows`.
double rowSr(int y, int rows) {
    return 2.0 * kPi * (std::cos(kPi * y / rows) - std::cos(kPi * (y + 1) / rows));
}

dvec3 directionOf(double turn, double polarRad) {
    const double phi = (turn - 0.5) * 2.0 * kPi, sine = std::sin(polarRad);
    return {sine * std::sin(phi), std::cos(polarRad), -sine * std::cos(phi)};
}

// To another size by means over the sphere; both sizes at most those of the source.
Panorama reduced(const Panorama& source, int width, int height) {
    Panorama result{width, height, std::vector<vec3>(std::size_t(width) * std::size_t(height))};
    for (int y = 0; y < height; ++y) {
        const int y0 = y * source.height / height, y1 = std::max((y + 1) * source.height / height, y0 + 1);
        for (int x = 0; x < width; ++x) {
            const int x0 = x * source.width / width, x1 = std::max((x + 1) * source.width / width, x0 + 1);
            dvec3 sum(0.0);
            double weights = 0.0;
            for (int sy = y0; sy < y1; ++sy) {
                const double weight = rowSr(sy, source.height);
                for (int sx = x0; sx < x1; ++sx)
                    sum += weight * dvec3(source.at(sx, sy));
                weights += weight * (x1 - x0);
            }
            result.texels[std::size_t(y) * std::size_t(width) + std::size_t(x)] = vec3(sum / weights);
        }
    }
    return result;
}

// The source blurred over the sphere by a Gauss of this deviation, at half its size. Texels of a row share
// their weights, which depend on the rows and on how far apart columns are.
Panorama blurredHalf(const Panorama& source, double deviationRad) {
    const int width = std::max(source.width / 2, 4), height = std::max(source.height / 2, 2);
    Panorama result{width, height, std::vector<vec3>(std::size_t(width) * std::size_t(height))};
    const double rowRad = kPi / source.height, reachRad = 2.5 * deviationRad;
    for (int y = 0; y < height; ++y) {
        const double polar = kPi * (y + 0.5) / height;
        const int first = std::max(int((polar - reachRad) / rowRad), 0),
                  last = std::min(int((polar + reachRad) / rowRad), source.height - 1);
        std::vector<dvec3> sums(std::size_t(width), dvec3(0.0));
        double weights = 0.0;
        for (int sy = first; sy <= last; ++sy) {
            const double other = kPi * (sy + 0.5) / source.height, area = rowSr(sy, source.height);
            const double sines = std::sin(polar) * std::sin(other),
                         cosines = std::cos(polar) * std::cos(other);
            // Columns count from the middle between the two that a halved column stands for.
            for (int step = 0; step < source.width; ++step) {
                const int aside = step - source.width / 2;
                const double turn = 2.0 * kPi * (aside + 0.5) / source.width;
                const double angle2 = 2.0 - 2.0 * (cosines + sines * std::cos(turn)); // of the chord
                if (angle2 > reachRad * reachRad) continue;
                const double weight = area * std::exp(-0.5 * angle2 / (deviationRad * deviationRad));
                weights += weight;
                int sx = (1 + aside + source.width) % source.width;
                for (dvec3& sum : sums) {
                    sum += weight * dvec3(source.at(sx, sy));
                    sx += sx + 2 < source.width ? 2 : 2 - source.width;
                }
            }
        }
        for (int x = 0; x < width; ++x)
            result.texels[std::size_t(y) * std::size_t(width) + std::size_t(x)] =
                weights > 0.0 ? vec3(sums[std::size_t(x)] / weights) : vec3(0.0f);
    }
    return result;
}

// Light of a part of the picture, and the mean direction that it comes from (shorter than 1).
struct Bundle {
    dvec3 light{0.0};
    dvec3 direction{0.0};
};

std::vector<Bundle> bundlesOf(const Panorama& picture) {
    constexpr int columns = kIrradianceCells, rows = kIrradianceCells / 2;
    std::vector<Bundle> bundles(std::size_t(columns) * std::size_t(rows));
    // Small pictures are taken apart, so that a texel is no single direction.
    const int split = std::max({1, 2 * columns / picture.width, 2 * rows / picture.height});
    for (int y = 0; y < picture.height * split; ++y) {
        const double polar = kPi * (y + 0.5) / (picture.height * split);
        const double area = rowSr(y, picture.height * split) / (picture.width * split);
        for (int x = 0; x < picture.width * split; ++x) {
            const vec3& texel = picture.at(x / split, y / split);
            const double weight = luminanceOf(dvec3(texel)) * area;
            if (!(weight > 0.0)) continue;
            Bundle& bundle = bundles[std::size_t(y * rows / (picture.height * split)) * std::size_t(columns) +
                                     std::size_t(x * columns / (picture.width * split))];
            bundle.light += dvec3(texel) * area;
            bundle.direction += weight * directionOf((x + 0.5) / (picture.width * split), polar);
        }
    }
    std::erase_if(bundles, [](const Bundle& bundle) { return luminanceOf(bundle.light) <= 0.0; });
    for (Bundle& bundle : bundles)
        bundle.direction /= luminanceOf(bundle.light);
    return bundles;
}

// Cosine over what is above the horizon of a bundle, which is taken as a strip of even light.
double cosineAbove(double cosine) {
    constexpr double radius = kPi / kIrradianceCells;
    if (std::abs(cosine) >= radius) return std::max(cosine, 0.0);
    return (cosine + radius) * (cosine + radius) / (4.0 * radius);
}

std::vector<vec3> irradianceOf(const Panorama& picture) {
    const std::vector<Bundle> bundles = bundlesOf(picture);
    std::vector<vec3> map;
    for (int y = 0; y < kIrradianceRows; ++y) {
        for (int x = 0; x < kIrradianceColumns; ++x) {
            const dvec3 normal = directionOf(double(x) / kIrradianceColumns, kPi * y / (kIrradianceRows - 1));
            dvec3 lux(0.0);
            for (const Bundle& bundle : bundles)
                lux += bundle.light * cosineAbove(glm::dot(normal, bundle.direction));
            map.push_back(vec3(lux));
        }
    }
    return map;
}

// Mean luminance of a bilinear picture over each texel's own area: above 0 wherever light is found by
// interpolation.
std::vector<double> spreadLuminance(const Panorama& picture) {
    const auto luminanceAt = [&](int x, int y) {
        return luminanceOf(
            dvec3(picture.at((x + picture.width) % picture.width, std::clamp(y, 0, picture.height - 1))));
    };
    constexpr double kShare[] = {0.125, 0.75, 0.125};
    std::vector<double> result;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            double sum = 0.0;
            for (int dy = -1; dy <= 1; ++dy) {
                for (int dx = -1; dx <= 1; ++dx)
                    sum += kShare[dx + 1] * kShare[dy + 1] * luminanceAt(x + dx, y + dy);
            }
            result.push_back(sum);
        }
    }
    return result;
}

// Cumulated shares, from 0 to 1; even ones where all is 0.
void appendCumulated(std::vector<float>& out, const double* weights, int count) {
    double sum = 0.0, sofar = 0.0;
    for (int i = 0; i < count; ++i)
        sum += weights[i];
    out.push_back(0.0f);
    for (int i = 0; i < count; ++i) {
        sofar += sum > 0.0 ? weights[i] / sum : 1.0 / count;
        out.push_back(i + 1 == count ? 1.0f : float(std::min(sofar, 1.0)));
    }
}

std::vector<float> distributionOf(const Panorama& picture, int levels) {
    const int columns = std::min(kDistributionCells, picture.width),
              rows = std::min(kDistributionCells / 2, picture.height);
    const std::vector<double> luminance = spreadLuminance(picture);
    std::vector<double> cells(std::size_t(columns) * std::size_t(rows)), ofRow(std::size_t(rows), 0.0);
    for (int y = 0; y < picture.height; ++y) {
        const int row = y * rows / picture.height;
        for (int x = 0; x < picture.width; ++x) {
            const double light = luminance[std::size_t(y) * std::size_t(picture.width) + std::size_t(x)] *
                                 rowSr(y, picture.height);
            cells[std::size_t(row) * std::size_t(columns) + std::size_t(x * columns / picture.width)] +=
                light;
            ofRow[std::size_t(row)] += light;
        }
    }
    std::vector<float> result{float(columns), float(rows), float(picture.width), float(levels)};
    appendCumulated(result, ofRow.data(), rows);
    for (int row = 0; row < rows; ++row)
        appendCumulated(result, &cells[std::size_t(row) * std::size_t(columns)], columns);
    return result;
}

std::shared_ptr<const DomeMaps> makeDomeMaps(const Image* image) {
    static std::atomic<int> made = 0;
    Panorama picture = panoramaOf(image);
    if (picture.width > kDomeWidthPx) {
        const int height =
            std::clamp(int(std::int64_t(picture.height) * kDomeWidthPx / picture.width), 1, picture.height);
        picture = reduced(picture, kDomeWidthPx, height);
    }
    float peak = 0.0f;
    for (const vec3& texel : picture.texels)
        peak = std::max({peak, texel.x, texel.y, texel.z});
    if (!(peak > 0.0f)) return nullptr;
    auto maps = std::make_shared<DomeMaps>();
    maps->texelScale = std::exp2(std::floor(std::log2(double(kLargestTexel) / double(peak))));
    // All that follows is of the texels as the device holds them.
    for (vec3& texel : picture.texels) {
        for (int c = 0; c < 3; ++c)
            texel[c] = glm::unpackHalf1x16(glm::packHalf1x16(texel[c] * float(maps->texelScale)));
    }
    maps->levels.push_back({picture.width, picture.height, picture.texels});
    const std::size_t irradianceTexels = std::size_t(kIrradianceColumns) * kIrradianceRows;
    maps->irradiance = {kIrradianceColumns, kIrradianceRows,
                        image ? irradianceOf(picture)
                              : std::vector<vec3>(irradianceTexels, vec3(kPi * maps->texelScale))};
    double mean = 0.0;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x)
            mean +=
                luminanceOf(dvec3(picture.at(x, y))) * rowSr(y, picture.height) / picture.width / (4.0 * kPi);
    }
    maps->meanLuminance = mean;
    maps->number = ++made;
    // Each level's blur is as wide as its texels; the first holds none.
    Panorama level = picture;
    double had = 0.0;
    while (level.width >= 32 && level.height >= 16 && level.width % 2 == 0 && level.height % 2 == 0) {
        const double wanted = 2.0 * kPi / (level.width / 2);
        level = blurredHalf(level, std::sqrt(wanted * wanted - had * had));
        had = wanted;
        maps->levels.push_back({level.width, level.height, level.texels});
    }
    maps->distribution = distributionOf(picture, int(maps->levels.size()));
    return maps;
}

} // namespace

std::shared_ptr<const DomeMaps> domeMapsOf(const std::shared_ptr<const Image>& image) {
    static const std::shared_ptr<const DomeMaps> white = makeDomeMaps(nullptr);
    static MadeOnce<Image, std::shared_ptr<const DomeMaps>> pictures;
    if (!image) return white;
    return *pictures.get(image, [](const Image& source) { return makeDomeMaps(&source); });
}

bool domeShines(const Dome& dome) {
    const double nit = luminanceOf(dome.color) * dome.intensityNit;
    return nit > 0.0 && std::isfinite(nit) && domeMapsOf(dome.image);
}

dvec3 domeTexelNit(const Dome& dome, const DomeMaps& maps) {
    return glm::max(dome.color, 0.0) * (dome.intensityNit / maps.texelScale);
}

dvec3 fillNit(const Dome& dome) {
    const dvec3 nit = glm::max(dome.fillColor, 0.0) * dome.fillNit;
    const bool sound = luminanceOf(nit) > 0.0 && std::isfinite(luminanceOf(nit));
    return sound ? nit : dvec3(0.0);
}

shared::LightHot domeRecord(const Dome& dome, const DomeMaps& maps) {
    shared::LightHot hot{};
    const double sine = std::sin(dome.rotationRad), cosine = std::cos(dome.rotationRad);
    hot.dirWs = glm::vec3(dvec3(-sine, 0.0, -cosine)); // the middle of the picture
    hot.tangentOct = f64::packOct16(dvec3(cosine, 0.0, -sine));
    hot.intensity = glm::vec3(domeTexelNit(dome, maps));
    hot.typeFlags = shared::LIGHT_DOME;
    hot.sizeM = {float(maps.meanLuminance), float(maps.number)};
    return hot;
}

} // namespace kilolux
