// The same scene, settings, seed and frame give the same bytes: in one process, in another one, and with
// every vector width that the driver can be told to use, which sets its subgroup size.
#include "tests/cli/run_program.h"
#include "tests/image/image_kit.h"
#include "tests/image/image_scenes.h"

#include <nlohmann/json.hpp>
#include <set>

namespace kilolux::test {
namespace {

RenderOptions seeded(std::uint32_t seed, const char* jitter) {
    RenderOptions options = smallOptions(45, 30, {jitter});
    options.frames = 3;
    options.seed = seed;
    return options;
}

TEST(Repeat, SameSeedSameBytes) {
    const Scene scene = stageScene(lightCases());
    const Rendered a = renderScene(scene, seeded(7, "jitter=true")),
                   b = renderScene(scene, seeded(7, "jitter=true"));
    for (const auto& [name, image] : a.targets.all())
        EXPECT_EQ(image.texels, b.targets.named(name).texels) << name;
    EXPECT_EQ(a.picture.srgb8, b.picture.srgb8);
    EXPECT_EQ(a.statistics.rays, b.statistics.rays);
    // Another seed has other light on the same surfaces: references share the jitter of what they are held
    // against.
    const Rendered other = renderScene(scene, seeded(8, "jitter=true"));
    EXPECT_EQ(a.targets.named("gDepth").texels, other.targets.named("gDepth").texels);
    EXPECT_NE(a.targets.named("litDiffuse").texels, other.targets.named("litDiffuse").texels);
}

// Frames differ in their noise, and are the same whatever number of them is asked for.
TEST(Repeat, FramesAreReplicasOfTheirIndex) {
    const Scene scene = stageScene({lightCases()[0]});
    std::vector<std::vector<std::byte>> frames;
    const auto keep = [&](int, const FrameTargets& targets) {
        frames.push_back(targets.named("litDiffuse").texels);
    };
    RenderOptions options = smallOptions(32, 24);
    options.frames = 2;
    renderScene(scene, options, keep);
    options.frames = 4;
    renderScene(scene, options, keep);
    ASSERT_EQ(frames.size(), 6u);
    EXPECT_EQ(frames[0], frames[2]);
    EXPECT_EQ(frames[1], frames[3]);
    EXPECT_NE(frames[2], frames[3]);
    EXPECT_NE(frames[3], frames[4]);
}

class RepeatByProgram : public ProgramTest {};

TEST_F(RepeatByProgram, VectorWidthsGiveTheSameBytes) {
    std::set<std::string> devices;
    std::map<std::string, std::string> first;
    for (const char* width : {"128", "256", "512"}) {
        setenv("LP_NATIVE_VECTOR_WIDTH", width, 1);
        // The driver's cache does not tell widths apart: code of one crashes in a program of another.
        setenv("MESA_SHADER_CACHE_DIR", (folder_ / (std::string("cache") + width)).c_str(), 1);
        // No raster: Mesa 25.0.7's own compiler crashes on its pipelines at 512 bits.
        const ProgramRun result =
            run({"render", scene("cornell"), "--size", "45x30", "--frames", "2", "--set", "gbuffer=compute",
                 "-o", "out.png", "--dump", "dump", "--stats", "stats.json"});
        unsetenv("LP_NATIVE_VECTOR_WIDTH");
        unsetenv("MESA_SHADER_CACHE_DIR");
        ASSERT_EQ(result.exitCode, 0) << result.err;
        devices.insert(nlohmann::json::parse(readText(folder_ / "stats.json"))["device"]);
        std::map<std::string, std::string> files{{"out.png", readText(folder_ / "out.png")}};
        for (const auto& file : std::filesystem::directory_iterator(folder_ / "dump")) {
            files[file.path().filename().string()] = withoutDate(readText(file.path()));
        }
        EXPECT_GE(files.size(), 12u);
        if (first.empty()) first = files;
        for (const auto& [name, bytes] : files)
            EXPECT_TRUE(bytes == first[name]) << name << " at " << width;
    }
    if (devices.size() == 1) GTEST_SKIP() << "'" << *devices.begin() << "' ignores LP_NATIVE_VECTOR_WIDTH";
    EXPECT_EQ(devices.size(), 3u) << "the driver names its width";
}

} // namespace
} // namespace kilolux::test
