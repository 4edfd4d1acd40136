// The part of bench_loop that measures what choosing lights at half resolution costs: error of denoised
// frames against the reference 'split' over the picture and at the edges of shadows, and how much of their
// contrast is left there.
#include "tests/bench/loop_parts.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/format.h>

namespace kilolux::test {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kFirstFrame = 16, kLastFrame = 32; // lists and histories have settled
constexpr int kEdgeFrames = 8;                   // of the reference, to find edges in
constexpr double kEdgeContrast = 0.4;            // of the brighter pixel
constexpr double kSameDepth = 0.05;              // relative

// Neighbouring pixels.
struct Pair {
    std::size_t a, b;
};

const NamedImage& named(const std::vector<NamedImage>& images, const std::string& name) {
    for (const NamedImage& image : images) {
        if (image.name == name) return image;
    }
    throw std::runtime_error("no target '" + name + "'");
}

std::uint32_t instanceAt(const std::vector<NamedImage>& images, std::size_t pixel) {
    std::uint32_t instance;
    std::memcpy(&instance, named(images, "visibility").texels.data() + 8 * pixel, 4);
    return instance;
}

// Where the diffuse light, without albedo, changes by much from a pixel to the next one of the same instance
// and depth: mostly edges of shadows, and those of boxes.
std::vector<Pair> shadowEdges(const LoopScene& scene, Shot shot) {
    shot.method = "split";
    shot.keepTargets = true;
    const std::unique_ptr<Renderer> renderer = makeRenderer(scene, shot);
    const std::size_t width = std::size_t(shot.width), pixels = width * std::size_t(shot.height);
    std::vector<double> light(pixels);
    std::vector<NamedImage> images;
    for (int frame = 0; frame < kEdgeFrames; ++frame) {
        renderFrame(*renderer);
        Result<std::vector<NamedImage>> targets = renderer->targets();
        if (!targets) throw std::runtime_error(targets.error());
        images = std::move(targets.value());
        for (std::size_t i = 0; i < pixels; ++i)
            light[i] += named(images, "litDiffuse").image.pixels[4 * i + 1] / kEdgeFrames;
    }
    const std::vector<float>& depths = named(images, "gDepth").image.pixels;
    const double darkest = 1e-3 * *std::max_element(light.begin(), light.end());
    std::vector<Pair> pairs;
    const auto add = [&](std::size_t a, std::size_t b) {
        const double most = std::max(light[a], light[b]);
        if (most < darkest || std::abs(light[a] - light[b]) < kEdgeContrast * most) return;
        if (std::abs(depths[a] - depths[b]) > kSameDepth * depths[a]) return;
        if (instanceAt(images, a) == instanceAt(images, b)) pairs.push_back({a, b});
    };
    for (std::size_t i = 0; i < pixels; ++i) {
        if (i % width + 1 < width) add(i, i + 1);
        if (i + width < pixels) add(i, i + width);
    }
    return pairs;
}

double greenAt(const std::vector<float>& rgb, std::size_t pixel) {
    return rgb[3 * pixel + 1];
}

// Squared relative error over these pixels. The halves of the reference have errors of their own, so that
// theirs drops out.
double relativeError(const Reference& reference, const Picture& picture,
                     const std::vector<std::size_t>& pixels) {
    const double exposure = 1.0 / (1.2 * std::exp2(reference.exposureEv100));
    double sum = 0.0;
    for (const std::size_t pixel : pixels) {
        for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
            const double is = exposure * picture.rgb[i], wanted = exposure * reference.mean.pixels[i];
            sum += (is - exposure * reference.halves[0].pixels[i]) *
                   (is - exposure * reference.halves[1].pixels[i]) / (wanted * wanted + 1e-2);
        }
    }
    return sum / (3.0 * double(pixels.size()));
}

// What is left of the reference's steps across the edges: 1 where they are as sharp, whatever the noise.
double contrastLeft(const Reference& reference, const Picture& picture, const std::vector<Pair>& edges) {
    double is = 0.0, wanted = 0.0;
    for (const auto& [a, b] : edges) {
        const double brightness = greenAt(reference.mean.pixels, a) + greenAt(reference.mean.pixels, b);
        if (brightness <= 0.0) continue;
        const auto step = [&](const std::vector<float>& rgb) {
            return (greenAt(rgb, a) - greenAt(rgb, b)) / brightness;
        };
        const double first = step(reference.halves[0].pixels), second = step(reference.halves[1].pixels);
        is += step(picture.rgb) * 0.5 * (first + second);
        wanted += first * second;
    }
    return is / wanted;
}

struct Figures {
    double everywhere = 0.0, atEdges = 0.0; // squared relative error
    double contrast = 0.0;
};

Figures figuresOf(const LoopScene& scene, const Shot& shot, const Reference& reference,
                  const std::vector<Pair>& edges, int frames) {
    std::vector<std::size_t> all(reference.mean.pixels.size() / 3), atEdges;
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = i;
    for (const auto& [a, b] : edges)
        atEdges.insert(atEdges.end(), {a, b});
    const std::unique_ptr<Renderer> renderer = makeRenderer(scene, shot);
    const int from = std::min(kFirstFrame, frames - 1);
    Figures mean;
    for (int frame = 0; frame < frames; ++frame) {
        renderFrame(*renderer);
        if (frame < from) continue;
        const Picture picture = renderer->picture();
        mean.everywhere += relativeError(reference, picture, all) / (frames - from);
        mean.atEdges += relativeError(reference, picture, atEdges) / (frames - from);
        mean.contrast += contrastLeft(reference, picture, edges) / (frames - from);
    }
    return mean;
}

} // namespace

Json benchHalf(const LoopOptions& options) {
    const int frames = options.frames > 0 ? options.frames : kLastFrame;
    Json json = Json::array();
    for (const LoopScene& scene : openScenes(options, {"gallery", "night_market"})) {
        Shot shot = makeShot(options, 160, 90);
        shot.settings.jitter = false;
        Shot split = shot;
        split.method = "split";
        const Reference reference = renderReference(options, scene, split);
        const std::vector<Pair> edges = shadowEdges(scene, shot);
        if (edges.empty()) throw std::runtime_error("no shadow has an edge in this picture");
        shot.settings.picture = PictureChoice::Denoised;
        shot.settings.antiAlias = false; // its history would soften edges as well
        fmt::print(
            "  {} {}, {}x{}, denoised frames {} to {}, {} steps at edges\n  {:<14} {:>16} {:>8} {:>16} {:>8} "
            "{:>14}\n",
            scene.name, scene.camera, shot.width, shot.height, std::min(kFirstFrame, frames - 1) + 1, frames,
            edges.size(), "sampling", "relative error", "of full", "at edges", "of full", "contrast left");
        Json rows = Json::array();
        Figures full;
        for (const char* sampling : {"full", "checkerboard", "rooks"}) {
            if (const std::optional<Error> error =
                    applySetting(shot.settings, fmt::format("sampling={}", sampling)))
                throw std::runtime_error(error->message);
            const Figures f = figuresOf(scene, shot, reference, edges, frames);
            if (rows.empty()) full = f;
            fmt::print("  {:<14} {:>16.5f} {:>8.2f} {:>16.5f} {:>8.2f} {:>14.3f}\n", sampling, f.everywhere,
                       f.everywhere / full.everywhere, f.atEdges, f.atEdges / full.atEdges, f.contrast);
            rows.push_back({{"sampling", sampling},
                            {"relativeError", f.everywhere},
                            {"relativeErrorAtEdges", f.atEdges},
                            {"contrastLeft", f.contrast}});
        }
        json.push_back(
            {{"scene", scene.name}, {"width", shot.width}, {"height", shot.height}, {"rows", rows}});
    }
    return json;
}

} // namespace kilolux::test
