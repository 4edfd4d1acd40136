// Every view renders without a word from validation and shows what its name says; all targets reach the files
// of
// --dump; the pipelines with every feature on give the exact ones' picture; memory stays in its budget.
#include "tests/cli/run_program.h"
#include "tests/image/image_kit.h"
#include "tests/image/image_scenes.h"

#include "shaders/shared/features.h"

#include <algorithm>
#include <iostream>

namespace kilolux::test {
namespace {

Scene variedScene() {
    Scene scene = stageScene(lightCases());
    scene.materials[0].emissiveNit = {3, 5, 8};
    return scene;
}

class EveryView : public testing::TestWithParam<std::string> {};

TEST_P(EveryView, ShowsSomething) {
    RenderOptions options = smallOptions(48, 32, {"exposureEv100=6"});
    options.view = GetParam();
    const auto view = std::find_if(Renderer::views().begin(), Renderer::views().end(),
                                   [](const NamedChoice& choice) { return choice.name == GetParam(); });
    if (view->help.starts_with("stochastic:")) {
        EXPECT_FALSE(Renderer::create(variedScene(), options)) << "another method has nothing to show";
        options.method = "stochastic";
        if (GetParam() == "list-age") options.frames = 3; // all is new in the first
    }
    const Rendered frame = renderScene(variedScene(), options);
    ASSERT_EQ(frame.picture.srgb8.size(), 48u * 32u * 3u);
    const auto [low, high] = std::minmax_element(frame.picture.srgb8.begin(), frame.picture.srgb8.end());
    EXPECT_GT(*high - *low, 20) << "the display";
    const auto [least, most] = std::minmax_element(frame.picture.rgb.begin(), frame.picture.rgb.end());
    EXPECT_LT(*least, *most) << "the raw values";
    EXPECT_EQ(frame.targets.has("viewValues"), GetParam() != "final");
}

std::vector<std::string> viewNames() {
    std::vector<std::string> names;
    for (const NamedChoice& view : Renderer::views())
        names.emplace_back(view.name);
    return names;
}

INSTANTIATE_TEST_SUITE_P(Views, EveryView, testing::ValuesIn(viewNames()), [](const auto& tested) {
    std::string name = tested.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

// Raw values are those of the G-buffer.
TEST(ViewValues, AreTheTargets) {
    const Scene scene = variedScene();
    const auto valuesOf = [&](const char* view) {
        RenderOptions options = smallOptions(32, 24, {"exposureEv100=6"});
        options.view = view;
        return renderScene(scene, options);
    };
    const Rendered normals = valuesOf("normal"), depth = valuesOf("depth"), color = valuesOf("base-color"),
                   counts = valuesOf("lights-in-range");
    for (std::size_t i = 0; i < normals.targets.pixels(); ++i) {
        const PixelSurface s = normals.targets.surface(i);
        if (!s.seen) continue;
        EXPECT_LT(glm::length(normals.targets.rgb("viewValues", i) - s.normalWs), 1e-5);
        EXPECT_LT(glm::length(color.targets.rgb("viewValues", i) - s.baseColor), 1e-5);
        EXPECT_FLOAT_EQ(depth.picture.rgb[3 * i], float(s.depthM));
        const auto packed = std::uint32_t(counts.targets.floats("lightCounts").pixels[i]);
        EXPECT_EQ(counts.picture.rgb[3 * i], float(packed & 0xffffu));
        EXPECT_LE(packed >> 16, packed & 0xffffu);
    }
}

class Dump : public ProgramTest {};

TEST_F(Dump, WritesEveryTarget) {
    setenv("KILOLUX_VALIDATION", "1", 1);
    const ProgramRun result = run({"render", scene("cornell"), "--size", "40x24", "-o", "out.png", "--view",
                                   "depth", "--set", "gbuffer=raster", "--dump", "dump"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    for (const char* target :
         {"visibility", "rasterDepth", "gDepth", "gSurface", "gMaterial", "gEmissive", "pyramid",
          "litDiffuse", "litSpecular", "lightCounts", "sceneColor", "meanColor", "viewValues", "display"}) {
        EXPECT_TRUE(std::filesystem::exists(folder_ / "dump" / (std::string(target) + ".exr"))) << target;
    }
}

// A pipeline that knows what the scene lacks draws the same as one that can draw everything. Compilers order
// sums differently; a rounding may turn a ray at an edge.
TEST(Features, AllOnGivesTheSamePicture) {
    std::vector<std::pair<std::string, Scene>> scenes;
    scenes.emplace_back("cornell", loadScene("cornell.glb"));
    for (const std::size_t light : {1u, 3u, 5u}) {
        scenes.emplace_back(lightCases()[light].name, stageScene({lightCases()[light]}));
    }
    for (const auto& [name, scene] : scenes) {
        for (const std::string method : {"split", "true"}) {
            if (method == "true" && name != "cornell")
                continue; // it takes no part in what the types differ in
            RenderOptions options = smallOptions(40, 30, {"exposureEv100=5"});
            options.method = method;
            const Rendered exact = renderScene(scene, options);
            options.allFeatures = true;
            const Rendered all = renderScene(scene, options);
            EXPECT_LT(exact.statistics.featuresOn.size(), std::size_t(shared::FEATURE_COUNT));
            EXPECT_EQ(all.statistics.featuresOn.size(), std::size_t(shared::FEATURE_COUNT));
            EXPECT_EQ(exact.targets.named("gSurface").texels, all.targets.named("gSurface").texels) << name;
            int different = 0;
            for (std::size_t i = 0; i < exact.targets.pixels(); ++i) {
                for (const char* target : {"litDiffuse", "litSpecular"}) {
                    const glm::dvec3 a = exact.targets.rgb(target, i), b = all.targets.rgb(target, i);
                    different += glm::length(a - b) > 1e-4 * glm::length(a + b);
                }
            }
            EXPECT_LE(different, 2) << name << ", " << method;
        }
    }
}

// Peak device memory of the gallery at 640 x 360: at most 160 bytes a pixel and 80 a triangle, beside
// textures. Block slack: memory is taken in blocks of 16 MiB, one open block for each of buffers, images,
// uploads and readbacks.
TEST(Memory, GalleryStaysInItsBudget) {
    const Scene scene = loadScene("gallery.glb");
    RenderOptions options = smallOptions(640, 360);
    options.keepTargets = false;
    Result<std::unique_ptr<Renderer>> renderer = Renderer::create(scene, options);
    ASSERT_TRUE(renderer) << renderer.error();
    const Result<Picture> picture = renderer.value()->render({});
    ASSERT_TRUE(picture) << picture.error();
    const FrameStatistics statistics = renderer.value()->statistics();
    double texturesMiB = 0.0;
    for (const MemoryCause& cause : statistics.gpuMemory) {
        std::cout << cause.cause << ": " << cause.peakMiB << " MiB\n";
        if (cause.cause == "textures") texturesMiB = cause.peakMiB;
    }
    constexpr double kMiB = 1024.0 * 1024.0, kSlackMiB = 4 * 16.0;
    const double pixelsMiB = 160.0 * 640 * 360 / kMiB,
                 trianglesMiB = 80.0 * double(statistics.triangles) / kMiB;
    const double budgetMiB = pixelsMiB + trianglesMiB + texturesMiB + kSlackMiB;
    std::cout << "peak " << statistics.gpuMemoryPeakMiB << " MiB of " << budgetMiB << " (pixels " << pixelsMiB
              << ", " << statistics.triangles << " triangles " << trianglesMiB << ")\n";
    EXPECT_LE(statistics.gpuMemoryPeakMiB, budgetMiB);
    double geometryMiB = 0.0, targetsMiB = 0.0;
    for (const MemoryCause& cause : statistics.gpuMemory) {
        if (cause.cause == "geometry" || cause.cause == "ray world") geometryMiB += cause.peakMiB;
        if (cause.cause == "targets") targetsMiB = cause.peakMiB;
    }
    EXPECT_LE(geometryMiB, trianglesMiB) << "80 bytes a triangle";
    EXPECT_LE(targetsMiB, pixelsMiB) << "160 bytes a pixel";
}

} // namespace
} // namespace kilolux::test
