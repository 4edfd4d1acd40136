#include "tests/image/image_kit.h"

#include "renderer/document/gltf_import.h"

#include <cmath>
#include <cstdlib>
#include <cstring>

namespace kilolux::test {

namespace {

// Before the first device exists: every Renderer of this program validates.
[[maybe_unused]] const int validationOn = setenv("KILOLUX_VALIDATION", "1", 1);

constexpr float kSkyDepth = 3.0e38f;

// Octahedral map of Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit
// Vectors".
glm::dvec3 directionFromSquare(glm::dvec2 at) {
    double x = at.x, y = at.y;
    const double z = 1.0 - std::abs(x) - std::abs(y);
    if (z < 0.0) {
        const double foldedX = (1.0 - std::abs(y)) * (x < 0.0 ? -1.0 : 1.0);
        y = (1.0 - std::abs(x)) * (y < 0.0 ? -1.0 : 1.0);
        x = foldedX;
    }
    return glm::normalize(glm::dvec3(x, y, z));
}

glm::dvec3 directionFromWord(std::uint32_t word) {
    const auto snorm = [](std::uint32_t half) {
        return std::max(double(std::int16_t(std::uint16_t(half))) / 32767.0, -1.0);
    };
    return directionFromSquare({snorm(word & 0xffffu), snorm(word >> 16)});
}

} // namespace

FrameTargets::FrameTargets(std::vector<NamedImage> images) {
    for (NamedImage& image : images)
        images_.emplace(image.name, std::move(image));
}

const NamedImage& FrameTargets::named(const std::string& name) const {
    const auto found = images_.find(name);
    if (found == images_.end()) throw std::runtime_error("no target '" + name + "'");
    return found->second;
}

template<typename T>
T FrameTargets::word(const std::string& name, std::size_t index) const {
    T value;
    std::memcpy(&value, named(name).texels.data() + index * sizeof(T), sizeof(T));
    return value;
}

glm::dvec3 FrameTargets::rgb(const std::string& name, std::size_t pixel) const {
    const FloatImage& image = floats(name);
    const float* p = &image.pixels[pixel * std::size_t(image.channels)];
    return {p[0], p[1], p[2]};
}

std::size_t FrameTargets::pixels() const {
    const FloatImage& depth = floats("gDepth");
    return std::size_t(depth.width) * std::size_t(depth.height);
}

PixelSurface FrameTargets::surface(std::size_t pixel) const {
    PixelSurface s;
    const float depthM = word<float>("gDepth", pixel);
    s.seen = depthM < kSkyDepth;
    if (!s.seen) return s;
    s.depthM = depthM;
    s.instance = word<std::uint32_t>("visibility", 2 * pixel);
    s.primitive = word<std::uint32_t>("visibility", 2 * pixel + 1);
    EXPECT_EQ(word<float>("gSurface", 4 * pixel), depthM);
    s.normalWs = directionFromWord(word<std::uint32_t>("gSurface", 4 * pixel + 1));
    const std::uint32_t geo = word<std::uint32_t>("gSurface", 4 * pixel + 2);
    s.geoNormalWs = directionFromSquare(glm::dvec2(geo & 16383u, geo >> 14 & 16383u) / 8191.0 - 1.0);
    const std::uint32_t color = word<std::uint32_t>("gSurface", 4 * pixel + 3);
    const glm::dvec3 root((color & 2047u) / 2047.0, (color >> 11 & 2047u) / 2047.0, (color >> 22) / 1023.0);
    s.baseColor = root * root;
    const std::uint32_t rest = word<std::uint32_t>("gMaterial", pixel);
    s.roughness = (rest & 4095u) / 4095.0;
    s.metallic = (rest >> 12 & 4095u) / 4095.0;
    return s;
}

RenderOptions smallOptions(int width, int height, const std::vector<std::string>& settings) {
    RenderOptions options;
    options.width = width;
    options.height = height;
    options.method = "all-lights";
    options.settings.jitter = false;
    options.settings.tracer = TracerChoice::Compute;
    for (const std::string& setting : settings) {
        if (auto error = applySetting(options.settings, setting)) ADD_FAILURE() << error->message;
    }
    return options;
}

void withFiltersOfAllDevices(const std::function<void(bool cpuFilters)>& test) {
    for (const bool cpuFilters : {true, false}) {
        SCOPED_TRACE(cpuFilters ? "filters of CPU devices" : "filters of other devices");
        test(cpuFilters);
    }
}

Rendered renderScene(const Scene& scene, RenderOptions options, const FrameObserver& observer) {
    options.keepTargets = true;
    Result<std::unique_ptr<Renderer>> renderer = Renderer::create(scene, options);
    if (!renderer) throw std::runtime_error(renderer.error());
    const auto targets = [&] {
        Result<std::vector<NamedImage>> images = renderer.value()->targets();
        if (!images) throw std::runtime_error(images.error());
        return FrameTargets(std::move(images.value()));
    };
    Result<Picture> picture = renderer.value()->render([&](int done, int) {
        if (observer) observer(done - 1, targets());
        return true;
    });
    if (!picture) throw std::runtime_error(picture.error());
    Rendered result{std::move(picture.value()), targets(), renderer.value()->statistics()};
    expectClean(result.targets);
    return result;
}

void expectClean(const FrameTargets& targets) {
    for (const auto& [name, image] : targets.all()) {
        const bool packed = name == "gSurface" || name == "gMaterial" || name == "visibility";
        const bool isSigned = name == "viewValues"; // normals
        int bad = 0;
        float first = 0.0f;
        for (const float value : image.image.pixels) {
            if (packed || (std::isfinite(value) && (isSigned || value >= 0.0f))) continue;
            if (bad++ == 0) first = value;
        }
        EXPECT_EQ(bad, 0) << "target '" << name << "' holds such as " << first;
    }
    for (std::size_t i = 0; i < targets.pixels(); ++i) {
        const PixelSurface s = targets.surface(i);
        if (!s.seen) continue;
        EXPECT_GT(s.depthM, 0.0) << "pixel " << i;
        EXPECT_LE(s.roughness, 1.0);
    }
}

Scene loadScene(const std::string& file) {
    Result<Scene> scene = importGltf(std::filesystem::path(KILOLUX_SOURCE_DIR) / "content/scenes" / file);
    if (!scene) throw std::runtime_error(scene.error());
    return std::move(scene.value());
}

} // namespace kilolux::test
