#include "renderer/bench/reference.h"

#include "renderer/gpu_lights.h"
#include "renderer/view_colors.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>

#include <OpenImageIO/imageio.h>

namespace kilolux::bench {

namespace {

namespace fs = std::filesystem;

std::optional<FloatImage> readImage(const fs::path& file) {
    const auto input = OIIO::ImageInput::open(file.string());
    if (!input) return std::nullopt;
    FloatImage image{input->spec().width, input->spec().height, input->spec().nchannels, {}};
    image.pixels.resize(std::size_t(image.width) * std::size_t(image.height) * std::size_t(image.channels));
    if (!input->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, image.pixels.data())) return std::nullopt;
    return image;
}

std::uint64_t fileHash(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::uint64_t hash = 0xcbf29ce484222325ull;
    for (std::istreambuf_iterator<char> at(stream), end; at != end; ++at)
        hash = (hash ^ static_cast<unsigned char>(*at)) * 0x100000001b3ull;
    return hash;
}

std::string fileName(const Scene& scene, const RenderOptions& options, int frames,
                     const std::string& sceneTag) {
    std::string name = fmt::format("{}{}-{}-{}-{}x{}-{}-{:08x}-{:08x}-{}", scene.sourcePath.stem().string(),
                                   sceneTag, options.camera, options.method, options.width, options.height,
                                   frames, settingsHash(options.settings) & 0xffffffffu,
                                   fileHash(scene.sourcePath) & 0xffffffffu, options.seed);
    std::replace(name.begin(), name.end(), '/', '_'); // cameras may be named so
    return name + ".exr";
}

Result<FloatImage> renderHalf(const Scene& scene, const RenderOptions& options, int frames,
                              const fs::path& folder, const std::string& sceneTag,
                              const std::atomic<bool>* stop) {
    const fs::path file = folder / fileName(scene, options, frames, sceneTag);
    if (!folder.empty()) {
        if (std::optional<FloatImage> kept = readImage(file)) return std::move(*kept);
    }
    Result<std::unique_ptr<Renderer>> renderer = Renderer::create(scene, options);
    if (!renderer) return Error{renderer.error()};
    for (int frame = 0; frame < frames; ++frame) {
        if (stop && stop->load()) return Error{kStopped};
        if (const auto error = renderer.value()->renderFrame()) return *error;
    }
    Picture picture = renderer.value()->picture();
    FloatImage image{picture.width, picture.height, 3, std::move(picture.rgb)};
    if (folder.empty()) return image;
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (const auto error = writeExr(file, image, ExrDepth::Float)) return *error;
    return image;
}

} // namespace

Result<Reference> makeReference(const Scene& scene, const RenderOptions& options, int framesOfHalf,
                                const fs::path& folder, const std::string& sceneTag,
                                const std::atomic<bool>* stop) {
    Reference result;
    RenderOptions how = options;
    for (std::uint32_t half = 0; half < 2; ++half) {
        how.seed = 1 + half;
        Result<FloatImage> image = renderHalf(scene, how, framesOfHalf, folder, sceneTag, stop);
        if (!image) return Error{image.error()};
        result.halves[half] = std::move(image.value());
    }
    result.mean = result.halves[0];
    for (std::size_t i = 0; i < result.mean.pixels.size(); ++i)
        result.mean.pixels[i] = 0.5f * (result.mean.pixels[i] + result.halves[1].pixels[i]);
    result.exposureEv100 = shownExposureEv100(scene, options.settings);
    return result;
}

double shownExposureEv100(const Scene& scene, const Settings& settings) {
    const bool metered = settings.exposureEv100.automatic && !scene.hasExposure;
    return metered ? deriveExposureEv100(scene) : settings.exposureEv100.valueOr(scene.exposureEv100);
}

SquaredError& SquaredError::operator+=(const SquaredError& other) {
    absolute += other.absolute;
    relative += other.relative;
    return *this;
}

SquaredError squaredError(const Reference& reference, const std::vector<float>& rgb, double epsilon) {
    const double exposure = exposureFromEv100(reference.exposureEv100);
    SquaredError sum;
    for (std::size_t i = 0; i < rgb.size(); ++i) {
        const double error0 = exposure * (double(rgb[i]) - double(reference.halves[0].pixels[i]));
        const double error1 = exposure * (double(rgb[i]) - double(reference.halves[1].pixels[i]));
        const double light = exposure * double(reference.mean.pixels[i]);
        sum.absolute += error0 * error1;
        sum.relative += error0 * error1 / (light * light + epsilon);
    }
    const double count = std::max(1.0, double(rgb.size()));
    return {sum.absolute / count, sum.relative / count};
}

std::vector<float> displayedAt(const std::vector<float>& rgb, double exposureEv100) {
    const float exposure = float(exposureFromEv100(exposureEv100));
    std::vector<float> shown;
    shown.reserve(rgb.size());
    for (std::size_t i = 0; i + 2 < rgb.size(); i += 3)
        for (const float value :
             displayColor({exposure * rgb[i], exposure * rgb[i + 1], exposure * rgb[i + 2]}))
            shown.push_back(std::clamp(value, 0.0f, 1.0f));
    return shown;
}

} // namespace kilolux::bench
