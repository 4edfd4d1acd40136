#include "tests/image/motion/motion_kit.h"

#include "shaders/shared/sampling.h"

#include <cstring>

namespace kilolux::test {

RenderOptions stochasticOptions(int width, int height, const std::vector<std::string>& settings) {
    RenderOptions options = smallOptions(width, height, {"noise=white", "gbuffer=compute"});
    options.method = "stochastic";
    for (const std::string& setting : settings) {
        if (auto error = applySetting(options.settings, setting)) ADD_FAILURE() << error->message;
    }
    return options;
}

FrameRig::FrameRig(const Scene& scene, RenderOptions options) {
    options.keepTargets = true;
    Result<std::unique_ptr<Renderer>> renderer = Renderer::create(scene, options);
    if (!renderer) throw std::runtime_error(renderer.error());
    renderer_ = std::move(renderer.value());
}

FrameTargets FrameRig::frame() {
    FrameTargets targets = partialFrame();
    std::vector<NamedImage> unsignedOnes;
    for (const auto& [name, image] : targets.all()) {
        if (name != "motion") unsignedOnes.push_back(image);
    }
    expectClean(FrameTargets(std::move(unsignedOnes)));
    return targets;
}

FrameTargets FrameRig::partialFrame() {
    frames(1);
    Result<std::vector<NamedImage>> images = renderer_->targets();
    if (!images) throw std::runtime_error(images.error());
    return FrameTargets(std::move(images.value()));
}

void FrameRig::frames(int count) {
    for (int i = 0; i < count; ++i) {
        if (auto error = renderer_->renderFrame()) throw std::runtime_error(error->message);
    }
}

float valueAt(const FrameTargets& targets, const std::string& name, std::size_t pixel, int channel) {
    const FloatImage& image = targets.floats(name);
    return image.pixels[pixel * std::size_t(image.channels) + std::size_t(channel)];
}

std::uint32_t wordAt(const FrameTargets& targets, const std::string& name, std::size_t pixel, int word,
                     int wordsPerPixel) {
    std::uint32_t value;
    const std::size_t at = pixel * std::size_t(wordsPerPixel) + std::size_t(word);
    std::memcpy(&value, targets.named(name).texels.data() + at * sizeof(value), sizeof(value));
    return value;
}

bool isMissed(const FrameTargets& targets, std::size_t pixel) {
    return wordAt(targets, "samples", pixel, 0, 4) & shared::SAMPLE_MISSED;
}

namespace {

double luminanceOfPixel(const Picture& picture, std::size_t pixel) {
    const float* p = &picture.rgb[3 * pixel];
    return luminanceOf({p[0], p[1], p[2]});
}

} // namespace

double meanLuminance(const Picture& picture) {
    double sum = 0.0;
    const std::size_t pixels = picture.rgb.size() / 3;
    for (std::size_t i = 0; i < pixels; ++i)
        sum += luminanceOfPixel(picture, i);
    return sum / double(pixels);
}

double relativeDifference(const Picture& a, const Picture& b) {
    double apart = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < b.rgb.size() / 3; ++i) {
        apart += std::abs(luminanceOfPixel(a, i) - luminanceOfPixel(b, i));
        sum += luminanceOfPixel(b, i);
    }
    return apart / sum;
}

Camera orthographicCamera(const glm::dvec3& from, const glm::dvec3& direction, double pixelM, int heightPx) {
    Camera camera;
    camera.name = "orthographic";
    camera.orthographic = true;
    camera.ymagM = 0.5 * pixelM * heightPx;
    camera.worldFromCamera = lookingAlong(from, direction);
    return camera;
}

Camera movedByPixels(const Camera& camera, double pixelM, glm::dvec2 px) {
    Camera moved = camera;
    moved.worldFromCamera[3] +=
        pixelM * (px.x * camera.worldFromCamera[0] - px.y * camera.worldFromCamera[1]);
    return moved;
}

std::vector<std::uint32_t> slotsOfTile(const std::vector<glm::uvec2>& lists, std::size_t tile) {
    std::vector<std::uint32_t> slots;
    const std::size_t first = tile * shared::LIST_TEXELS;
    for (std::uint32_t i = 0; i < lists[first].x; ++i)
        slots.push_back(lists[first + 1 + i].x & 0xffffu);
    return slots;
}

void setOneEntry(std::vector<glm::uvec2>& lists, std::size_t tile, std::uint32_t slot) {
    const std::size_t first = tile * shared::LIST_TEXELS;
    lists[first] = {1u, 0u};
    lists[first + 1] = {slot, 256u};
    lists[first + shared::LIST_CELLS_AT] = {0xffffu, 64u};
}

SceneBuilder bareFloor() {
    SceneBuilder b;
    b.quad(floorAt({0, 0, 0}), 40, 40, b.material({0.6, 0.6, 0.6}, 0.0, 0.9));
    return b;
}

} // namespace kilolux::test
