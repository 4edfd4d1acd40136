#include "tests/bench/loop_kit.h"

#include "renderer/document/gltf_import.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <fmt/format.h>

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

static RenderOptions optionsOf(const LoopScene& scene, const Shot& shot) {
    RenderOptions options;
    options.width = shot.width;
    options.height = shot.height;
    options.seed = shot.seed;
    options.method = shot.method;
    options.camera = scene.camera;
    options.settings = shot.settings;
    options.keepTargets = shot.keepTargets;
    return options;
}

std::unique_ptr<Renderer> makeRenderer(const LoopScene& scene, const Shot& shot) {
    Result<std::unique_ptr<Renderer>> renderer = Renderer::create(scene.scene, optionsOf(scene, shot));
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

Reference renderReference(const LoopOptions& options, const LoopScene& scene, const Shot& shot) {
    // The settings that change these pictures, and no others, so that files fit whatever is measured.
    Shot plain = shot;
    plain.settings = Settings{};
    plain.settings.exposureEv100 = shot.settings.exposureEv100;
    plain.settings.jitter = shot.settings.jitter;
    plain.settings.pixelFilter = shot.settings.pixelFilter;
    plain.settings.raysPerLight = shot.settings.raysPerLight;
    // Rims of lamps depend on where jitter meets them: with it, either half goes the whole way.
    const int frames =
        plain.settings.jitter ? options.referenceFrames : std::max(1, options.referenceFrames / 2);
    Result<Reference> result =
        bench::makeReference(scene.scene, optionsOf(scene, plain), frames, options.references);
    if (!result) throw std::runtime_error(result.error());
    return std::move(result.value());
}

measure::ImageView viewOf(const FloatImage& image) {
    return {image.width, image.height, image.pixels};
}
measure::ImageView viewOf(const Picture& picture) {
    return {picture.width, picture.height, picture.rgb};
}

SquaredError squaredError(const Reference& reference, const Picture& picture) {
    return bench::squaredError(reference, picture.rgb);
}

FloatImage displayed(const FloatImage& linear, double exposureEv100) {
    FloatImage result{linear.width, linear.height, 3, bench::displayedAt(linear.pixels, exposureEv100)};
    for (float& value : result.pixels)
        value = std::round(255.0f * value) / 255.0f;
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
