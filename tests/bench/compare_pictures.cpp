// compare_pictures REFERENCE TEST...: how far pictures are from a reference. EXR files hold light in nit:
// their energy is compared as it is, and FLIP as a display shows them, exposed by --ev100 through the neutral
// curve. Of PNG files both numbers are of the display's light.
#include "renderer/gpu_lights.h"
#include "renderer/measure/flip.h"
#include "renderer/measure/metrics.h"

#include <CLI/CLI.hpp>
#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/glm.hpp>

namespace display {
using glm::clamp;
using glm::max;
using glm::min;
using glm::mix;
using glm::pow;
using glm::vec3;
#include "shaders/math/tone_map.glsl"
} // namespace display

using namespace kilolux;

namespace {

struct Loaded {
    int width = 0, height = 0;
    bool light = false; // nit; otherwise sRGB in 0..1
    std::vector<float> rgb;

    measure::ImageView view() const { return {width, height, rgb}; }
};

Loaded load(const std::string& file) {
    const auto input = OIIO::ImageInput::open(file);
    if (!input) throw std::runtime_error(fmt::format("{}: {}", file, OIIO::geterror()));
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.nchannels < 3) throw std::runtime_error(fmt::format("{}: expected 3 channels", file));
    Loaded picture{spec.width, spec.height, input->format_name() == std::string("openexr"), {}};
    std::vector<float> texels(std::size_t(spec.width) * std::size_t(spec.height) *
                              std::size_t(spec.nchannels));
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, texels.data()))
        throw std::runtime_error(fmt::format("{}: {}", file, input->geterror()));
    for (std::size_t i = 0; i < texels.size(); i += std::size_t(spec.nchannels))
        picture.rgb.insert(picture.rgb.end(), texels.begin() + std::ptrdiff_t(i),
                           texels.begin() + std::ptrdiff_t(i) + 3);
    return picture;
}

Loaded displayed(Loaded picture, double ev100) {
    if (!picture.light) return picture;
    const float exposure = float(exposureFromEv100(ev100));
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
        float* p = &picture.rgb[i];
        const glm::vec3 light = glm::max(glm::vec3(p[0], p[1], p[2]) * exposure, glm::vec3(0.0f));
        const glm::vec3 shown =
            display::srgbFromLinear(glm::clamp(display::toneMapNeutral(light), 0.0f, 1.0f));
        for (int c = 0; c < 3; ++c)
            p[c] = shown[c];
    }
    return picture;
}

Loaded linear(Loaded picture) {
    if (picture.light) return picture;
    for (float& x : picture.rgb)
        x = x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
    return picture;
}

// What measure::blockEnergy says, in words.
std::string energyText(const Loaded& reference, const Loaded& test, int blockPx, double tolerance) {
    const measure::BlockEnergy e =
        measure::blockEnergy(reference.view(), test.view(), blockPx, tolerance, 0.01);
    return fmt::format("energy {:.4f}, {:.1f} % of {} blocks within {:g} %, worst {:.3f} at {},{}",
                       e.meanRatio, 100 * e.withinShare, e.litBlocks, 100 * tolerance, e.worstRatio, e.worstX,
                       e.worstY);
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app{"Compares pictures with a reference: FLIP, energy per block, relative MSE"};
    std::vector<std::string> files;
    double ev100 = 10.0, pixelsPerDegree = measure::kDefaultPixelsPerDegree, tolerance = 0.02;
    int blockPx = 16;
    app.add_option("pictures", files, "the reference, then what is compared with it")
        ->required()
        ->expected(2, 1000);
    app.add_option("--ev100", ev100, "exposure at which FLIP sees EXR files");
    app.add_option("--pixels-per-degree", pixelsPerDegree);
    app.add_option("--block", blockPx, "pixels");
    app.add_option("--tolerance", tolerance, "of a block's energy");
    CLI11_PARSE(app, argc, argv);
    try {
        const Loaded reference = load(files.front()), referenceShown = displayed(reference, ev100),
                     referenceLinear = linear(reference);
        for (std::size_t i = 1; i < files.size(); ++i) {
            const Loaded test = load(files[i]);
            if (test.width != reference.width || test.height != reference.height) {
                throw std::runtime_error(fmt::format("{}: {} x {}, the reference has {} x {}", files[i],
                                                     test.width, test.height, reference.width,
                                                     reference.height));
            }
            const measure::FlipResult flip =
                measure::flip(referenceShown.view(), displayed(test, ev100).view(), pixelsPerDegree);
            const Loaded testLinear = linear(test);
            fmt::print("{}: FLIP mean {:.4f}, p95 {:.4f}; {}; relative MSE {:.5f}\n", files[i], flip.mean,
                       flip.percentile95, energyText(referenceLinear, testLinear, blockPx, tolerance),
                       measure::relativeMeanSquaredError(referenceLinear.view(), testLinear.view()));
        }
    } catch (const std::exception& error) {
        fmt::print(stderr, "compare_pictures: error: {}\n", error.what());
        return 2;
    }
    return 0;
}
