#include "tests/bench/loop_kit.h"

#include "renderer/document/gltf_import.h"
#include "renderer/gpu_lights.h"

#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <chrono>
#include <ctime>
#include <fmt/format.h>
#include <fstream>
#include <glm/glm.hpp>

// The display curve of the shaders, in double.
namespace kilolux::test::curve {
using namespace glm;
using vec3 = dvec3;
#define float double
#include "shaders/math/tone_map.glsl"
#undef float
} // namespace kilolux::test::curve

namespace kilolux::test {

namespace fs = std::filesystem;

Shot makeShot(const LoopOptions& options, int width, int height) {
    Shot shot;
    shot.width = options.width > 0 ? options.width : width;
    shot.height = options.width > 0 ? options.height : height;
    shot.settings = options.settings;
    return shot;
}

static fs::path scenePath(const std::string& name) {
    return fs::path(KILOLUX_SOURCE_DIR) / "content/scenes" / (name + ".glb");
}

LoopScene openScene(const std::string& name) {
    Result<Scene> scene = importGltf(scenePath(name));
    if (!scene) throw std::runtime_error(scene.error());
    LoopScene result{name, std::move(scene.value()), {}};
    for (const Camera& camera : result.scene.cameras)
        if (camera.name == "wide") result.camera = camera.name;
    return result;
}

std::vector<LoopScene> openScenes(const LoopOptions& options, const std::vector<std::string>& names) {
    std::vector<LoopScene> scenes;
    for (const std::string& name : options.scenes.empty() ? names : options.scenes) {
        if (fs::exists(scenePath(name))) {
            scenes.push_back(openScene(name));
        } else {
            fmt::print("  no scene '{}': left out\n", name);
        }
    }
    return scenes;
}

std::unique_ptr<Renderer> makeRenderer(const LoopScene& scene, const Shot& shot) {
    RenderOptions options;
    options.width = shot.width;
    options.height = shot.height;
    options.seed = shot.seed;
    options.method = shot.method;
    options.camera = scene.camera;
    options.settings = shot.settings;
    Result<std::unique_ptr<Renderer>> renderer = Renderer::create(scene.scene, options);
    if (!renderer) throw std::runtime_error(renderer.error());
    return std::move(renderer.value());
}

FrameTime renderFrame(Renderer& renderer) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t startCpu = std::clock();
    if (const std::optional<Error> error = renderer.renderFrame()) throw std::runtime_error(error->message);
    return {std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count(),
            1000.0 * double(std::clock() - startCpu) / CLOCKS_PER_SEC};
}

double medianOf(std::vector<double> values) {
    if (values.empty()) return 0.0;
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
    return values[values.size() / 2];
}

// --- References ------------------------------------------------------------------------------------------

namespace {

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

// Of what the references depend on; the shaders are not among it, so a folder serves one state of them.
std::string referenceName(const LoopScene& scene, const Shot& shot, int frames) {
    return fmt::format("{}-{}-{}-{}x{}-{}-{:08x}-{:08x}-{}.exr", scene.name, scene.camera, shot.method,
                       shot.width, shot.height, frames, settingsHash(shot.settings) & 0xffffffffu,
                       fileHash(scene.scene.sourcePath) & 0xffffffffu, shot.seed);
}

FloatImage renderHalf(const LoopOptions& options, const LoopScene& scene, const Shot& shot, int frames) {
    const fs::path file = options.references / referenceName(scene, shot, frames);
    if (!options.references.empty()) {
        if (std::optional<FloatImage> kept = readImage(file)) return std::move(*kept);
    }
    const std::unique_ptr<Renderer> renderer = makeRenderer(scene, shot);
    for (int frame = 0; frame < frames; ++frame)
        renderFrame(*renderer);
    Picture picture = renderer->picture();
    FloatImage image{picture.width, picture.height, 3, std::move(picture.rgb)};
    if (!options.references.empty()) {
        fs::create_directories(options.references);
        if (const auto error = writeExr(file, image, ExrDepth::Float))
            throw std::runtime_error(error->message);
    }
    return image;
}

} // namespace

Reference renderReference(const LoopOptions& options, const LoopScene& scene, const Shot& shot) {
    // The settings that change these pictures, and no others, so that files fit whatever is measured.
    Shot plain = shot;
    plain.settings = Settings{};
    plain.settings.exposureEv100 = shot.settings.exposureEv100;
    plain.settings.jitter = shot.settings.jitter;
    plain.settings.pixelFilter = shot.settings.pixelFilter;
    plain.settings.raysPerLight = shot.settings.raysPerLight;
    Reference result;
    // Rims of lamps depend on where jitter meets them: with it, either half goes the whole way.
    const int frames =
        plain.settings.jitter ? options.referenceFrames : std::max(1, options.referenceFrames / 2);
    for (std::uint32_t half = 0; half < 2; ++half) {
        plain.seed = 1 + half;
        result.halves[half] = renderHalf(options, scene, plain, frames);
    }
    result.mean = result.halves[0];
    for (std::size_t i = 0; i < result.mean.pixels.size(); ++i)
        result.mean.pixels[i] = 0.5f * (result.mean.pixels[i] + result.halves[1].pixels[i]);
    const bool metered = shot.settings.exposureEv100.automatic && !scene.scene.hasExposure;
    result.exposureEv100 = metered ? deriveExposureEv100(scene.scene)
                                   : shot.settings.exposureEv100.valueOr(scene.scene.exposureEv100);
    return result;
}

measure::ImageView viewOf(const FloatImage& image) {
    return {image.width, image.height, image.pixels};
}
measure::ImageView viewOf(const Picture& picture) {
    return {picture.width, picture.height, picture.rgb};
}

SquaredError& SquaredError::operator+=(const SquaredError& other) {
    absolute += other.absolute;
    relative += other.relative;
    return *this;
}

SquaredError squaredError(const Reference& reference, const Picture& picture) {
    const double exposure = exposureFromEv100(reference.exposureEv100);
    SquaredError sum;
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
        const double error0 = exposure * (double(picture.rgb[i]) - double(reference.halves[0].pixels[i]));
        const double error1 = exposure * (double(picture.rgb[i]) - double(reference.halves[1].pixels[i]));
        const double light = exposure * double(reference.mean.pixels[i]);
        sum += {error0 * error1, error0 * error1 / (light * light + 0.01)};
    }
    const double count = double(picture.rgb.size());
    return {sum.absolute / count, sum.relative / count};
}

FloatImage displayed(const FloatImage& linear, double exposureEv100) {
    const double exposure = exposureFromEv100(exposureEv100);
    FloatImage result{linear.width, linear.height, 3, {}};
    for (std::size_t i = 0; i + 2 < linear.pixels.size(); i += 3) {
        const glm::dvec3 light(linear.pixels[i], linear.pixels[i + 1], linear.pixels[i + 2]);
        const glm::dvec3 curve = curve::toneMapNeutral(glm::max(exposure * light, glm::dvec3(0.0)));
        const glm::dvec3 srgb = curve::srgbFromLinear(glm::clamp(curve, 0.0, 1.0));
        for (int c = 0; c < 3; ++c)
            result.pixels.push_back(float(std::round(255.0 * srgb[c]) / 255.0));
    }
    return result;
}

FloatImage displayed(const Picture& picture) {
    FloatImage result{picture.width, picture.height, 3, {}};
    for (const std::uint8_t byte : picture.srgb8)
        result.pixels.push_back(float(byte) / 255.0f);
    return result;
}

std::string withGoal(double value, Goal goal, double bound) {
    const bool met = goal == Goal::AtLeast ? value >= bound : value <= bound;
    return fmt::format("{:.3g} (goal: at {} {:g}, {})", value, goal == Goal::AtLeast ? "least" : "most",
                       bound, met ? "met" : "missed");
}

} // namespace kilolux::test
