// Passes of the frame by themselves: the depth pyramid at any size, the running mean, the display transform
// and the counters that statistics are made of.
#include "tests/gpu/support/gpu_fixture.h"
#include "tests/unit/accel/scene_kit.h"

#include "renderer/lights_cpp/ltc_table.h"
#include "renderer/passes/passes.h"
#include "renderer/renderer.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace kilolux::test {
namespace {

// A ball over a plate under one sphere light that reaches everything; the ball's shadow falls on the plate.
Scene ballScene() {
    Primitive plate = makeBox({3.0, 0.1, 3.0}), ball = makeSphere(12, 16, 0.5);
    for (Primitive* primitive : {&plate, &ball}) {
        primitive->boundsMin = glm::vec3(-3.0f);
        primitive->boundsMax = glm::vec3(3.0f);
    }
    Scene scene = makeScene({plate});
    scene.meshes.push_back(std::make_shared<Mesh>(Mesh{"ball", {ball}}));
    glm::dmat4 place(1.0);
    place[3] = glm::dvec4(0.0, 1.0, 0.0, 1.0);
    addNode(scene, 1, place);
    LightDef def;
    def.type = LightType::Sphere;
    def.intensity = 200.0;
    def.radiusM = 0.2;
    def.rangeM = 100.0;
    scene.lightDefs.push_back(def);
    Node node;
    node.worldFromNode = glm::dmat4(1.0);
    node.worldFromNode[3] = glm::dvec4(1.0, 4.0, 0.5, 1.0);
    scene.nodes.push_back(node);
    scene.lights.push_back({.node = int(scene.nodes.size()) - 1, .def = 0});
    return scene;
}

RenderOptions smallOptions(int frames) {
    RenderOptions options;
    options.width = 37;
    options.height = 22;
    options.method = "all-lights";
    options.frames = frames;
    options.keepTargets = true;
    options.method = "all-lights";
    options.settings.exposureEv100 = {.automatic = false, .value = 5.0};
    return options;
}

using ImagesByName = std::map<std::string, FloatImage>;

ImagesByName targetsOf(Renderer& renderer) {
    ImagesByName result;
    Result<std::vector<NamedImage>> images =
        renderer.targets(); // kept: a range over a temporary's part dangles
    for (NamedImage& image : images.value())
        result.emplace(image.name, std::move(image.image));
    return result;
}

// Renders and keeps every frame's targets.
struct FrameRun {
    std::vector<ImagesByName> frames;
    FrameStatistics statistics;
};
FrameRun runFrames(const Scene& scene, const RenderOptions& options) {
    setenv("KILOLUX_VALIDATION", "1", 1);
    FrameRun result;
    Result<std::unique_ptr<Renderer>> renderer = Renderer::create(scene, options);
    if (!renderer) throw std::runtime_error(renderer.error());
    const Result<Picture> picture = renderer.value()->render([&](int, int) {
        result.frames.push_back(targetsOf(*renderer.value()));
        return true;
    });
    if (!picture) throw std::runtime_error(picture.error());
    result.statistics = renderer.value()->statistics();
    return result;
}

class FramePass : public GpuTest {};

// Every texel of every level is the nearest and farthest depth of all pixels below it, at sizes that do not
// halve evenly: the last row and column take the odd one in.
TEST_F(FramePass, PyramidBoundsEveryPixelBelow) {
    useLtcTable(loadLtcTable(KILOLUX_SOURCE_DIR "/content/ltc_ggx.bin").value());
    const Scene scene = ballScene();
    const Result<std::unique_ptr<GpuScene>> gpuScene =
        GpuScene::create(device(), scene, glm::dvec3(0.0), 5.0);
    ASSERT_TRUE(gpuScene) << gpuScene.error();
    DepthPyramidPass pass(resources());
    std::mt19937 random(3);
    for (const glm::uvec2& size :
         {glm::uvec2(37, 22), glm::uvec2(64, 32), glm::uvec2(5, 1), glm::uvec2(1, 1)}) {
        Targets targets(device(), size.x, size.y, TargetNeeds{});
        std::vector<float> depths(size.x * size.y);
        for (float& depth : depths)
            depth = random() % 9 == 0 ? shared::DEPTH_SKY : float(random() % 1000 + 1);
        targets.gDepth.upload(std::as_bytes(std::span(depths)));
        shared::FrameConstants constants{};
        constants.size = size;
        const gpu::Buffer unused;
        const LightGrid grid(device(), size.x, size.y, 1);
        gpu::Commands commands(device());
        FrameContext frame{commands, *gpuScene.value(), targets, unused, constants, unused, grid, {}};
        pass.record(frame);
        commands.submitAndWait();
        glm::uvec2 level = glm::max(size / 2u, glm::uvec2(1));
        for (std::uint32_t mip = 0; mip < targets.pyramid.desc().mips; ++mip) {
            std::vector<glm::vec2> texels(level.x * level.y);
            const std::vector<std::byte> bytes = targets.pyramid.download(mip);
            ASSERT_EQ(bytes.size(), texels.size() * sizeof(glm::vec2));
            std::memcpy(static_cast<void*>(texels.data()), bytes.data(), bytes.size());
            for (std::uint32_t y = 0; y < level.y; ++y) {
                for (std::uint32_t x = 0; x < level.x; ++x) {
                    const glm::uvec2 first = glm::uvec2(x, y) << (mip + 1);
                    const glm::uvec2 end(x + 1 == level.x ? size.x : std::min(size.x, (x + 1) << (mip + 1)),
                                         y + 1 == level.y ? size.y : std::min(size.y, (y + 1) << (mip + 1)));
                    glm::vec2 wanted(shared::DEPTH_SKY, 0.0f);
                    for (std::uint32_t py = std::min(first.y, size.y - 1); py < end.y; ++py) {
                        for (std::uint32_t px = std::min(first.x, size.x - 1); px < end.x; ++px) {
                            const float depth = depths[py * size.x + px];
                            wanted = {std::min(wanted.x, depth), std::max(wanted.y, depth)};
                        }
                    }
                    ASSERT_EQ(texels[y * level.x + x], wanted)
                        << "level " << mip << " texel " << x << ", " << y;
                }
            }
            level = glm::max(level / 2u, glm::uvec2(1));
        }
    }
}

TEST(Frame, TheMeanIsThatOfTheFrames) {
    const FrameRun run = runFrames(ballScene(), smallOptions(5));
    ASSERT_EQ(run.frames.size(), 5u);
    const std::vector<float>& mean = run.frames.back().at("meanColor").pixels;
    double largest = 0.0;
    for (std::size_t i = 0; i < mean.size(); ++i) {
        double sum = 0.0;
        for (const ImagesByName& frame : run.frames)
            sum += double(frame.at("sceneColor").pixels[i]) / 5.0;
        EXPECT_NEAR(mean[i], sum, 1e-5 * (1.0 + sum));
        largest = std::max(largest, std::abs(sum - double(run.frames[0].at("sceneColor").pixels[i])));
    }
    EXPECT_GT(largest, 0.01) << "frames differ";
}

TEST(Frame, DisplayIsTheEncodedMean) {
    RenderOptions options = smallOptions(1);
    options.settings.toneMap = ToneMap::None;
    const FrameRun run = runFrames(ballScene(), options);
    const std::vector<float>& mean = run.frames[0].at("meanColor").pixels;
    const std::vector<float>& display = run.frames[0].at("display").pixels;
    for (std::size_t i = 0; i < mean.size(); ++i) {
        if (i % 4 == 3) continue;
        const double x = std::clamp(double(mean[i]), 0.0, 1.0);
        const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
        EXPECT_NEAR(display[i], encoded, 0.51 / 255.0) << i;
    }
}

// One light that reaches every pixel: a ray for each that faces it, none for the sky.
TEST(Frame, CountersCountWhatTheyName) {
    const FrameRun run = runFrames(ballScene(), smallOptions(3));
    EXPECT_EQ(run.statistics.lights, 1u);
    EXPECT_DOUBLE_EQ(run.statistics.lightsInRangeMean, 1.0);
    EXPECT_EQ(run.statistics.triangles, triangleCount(ballScene()));
    std::size_t facing = 0, surfaces = 0;
    for (const ImagesByName& frame : run.frames) {
        for (std::size_t i = 0; i < frame.at("gDepth").pixels.size(); ++i) {
            const bool seen = frame.at("gDepth").pixels[i] < shared::DEPTH_SKY;
            const auto counts = std::uint32_t(frame.at("lightCounts").pixels[i]);
            surfaces += seen;
            facing += counts >> 16;
            EXPECT_EQ(counts & 0xffffu, seen ? 1u : 0u);
        }
    }
    EXPECT_GE(run.statistics.rays, facing);
    EXPECT_LE(run.statistics.rays, surfaces);
    EXPECT_GT(facing, surfaces / 4);
}

} // namespace
} // namespace kilolux::test
