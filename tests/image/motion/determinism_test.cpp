// The stochastic method's bytes: the same for a seed whatever the driver's vector width and threads, and what
// can be frozen stands still.
#include "tests/cli/run_program.h"
#include "tests/image/motion/motion_kit.h"

#include <nlohmann/json.hpp>
#include <set>

namespace kilolux::test {
namespace {

bool sameTarget(const FrameTargets& a, const FrameTargets& b, const std::string& name) {
    return a.named(name).texels == b.named(name).texels;
}

RenderOptions seeded(std::uint32_t seed) {
    RenderOptions options = stochasticOptions(45, 30, {"jitter=true", "noise=blue"});
    options.seed = seed;
    return options;
}

TEST(Determinism, SameSeedSameBytes) {
    const Scene scene = stageScene(lightCases());
    FrameRig a(scene, seeded(7)), b(scene, seeded(7)), c(scene, seeded(8));
    for (int frame = 0; frame < 3; ++frame) {
        const FrameTargets first = a.frame(), second = b.frame(), other = c.frame();
        for (const auto& [name, image] : first.all())
            EXPECT_TRUE(image.texels == second.named(name).texels) << name << " in frame " << frame;
        EXPECT_TRUE(a.renderer().visibleLists() == b.renderer().visibleLists());
        for (const char* name : {"samples", "litDiffuse", "historyDiffuse", "display"})
            EXPECT_FALSE(sameTarget(first, other, name)) << name;
    }
}

class DeterminismByProgram : public ProgramTest {
  protected:
    // Files of a run by name, targets included, with an environment variable set; `device` gets its name.
    std::map<std::string, std::string> filesWith(const char* variable, const char* value,
                                                 std::string& device) {
        std::filesystem::remove_all(folder_ / "dump");
        setenv(variable, value, 1);
        // The driver's cache of compiled shaders does not know vector widths: each value has a cache of its
        // own.
        setenv("XDG_CACHE_HOME", (folder_ / "cache" / value).c_str(), 1);
        std::filesystem::create_directories(folder_ / "cache" / value);
        // Two rays and half resolution: every pass of the method takes part. No raster: Mesa 25.0.7's own
        // compiler crashes on its pipelines at 512 bits.
        const ProgramRun result = run({"render",   scene("cornell"),   "--size",   "53x37",
                                       "--method", "stochastic",       "--frames", "3",
                                       "--set",    "raysPerPixel=2",   "--set",    "sampling=checkerboard",
                                       "--set",    "picture=denoised", "--set",    "gbuffer=compute",
                                       "-o",       "out.exr",          "--dump",   "dump",
                                       "--stats",  "stats.json"});
        unsetenv(variable);
        unsetenv("XDG_CACHE_HOME");
        EXPECT_EQ(result.exitCode, 0) << result.err;
        if (result.exitCode != 0) return {};
        device = nlohmann::json::parse(readText(folder_ / "stats.json"))["device"];
        std::map<std::string, std::string> files{{"out.exr", withoutDate(readText(folder_ / "out.exr"))}};
        for (const auto& file : std::filesystem::directory_iterator(folder_ / "dump"))
            files[file.path().filename().string()] = withoutDate(readText(file.path()));
        EXPECT_GE(files.size(), 20u);
        return files;
    }

    // Returns the devices' names.
    std::set<std::string> expectSameFiles(const char* variable, const std::vector<const char*>& values) {
        std::set<std::string> devices;
        std::map<std::string, std::string> first;
        for (const char* value : values) {
            std::string device;
            const std::map<std::string, std::string> files = filesWith(variable, value, device);
            devices.insert(device);
            if (first.empty()) first = files;
            EXPECT_EQ(files.size(), first.size());
            for (const auto& [name, bytes] : files)
                EXPECT_TRUE(bytes == first[name]) << name << " with " << variable << '=' << value;
        }
        return devices;
    }
};

// The driver's vector width is its subgroup size: 4, 8 and 16 lanes.
TEST_F(DeterminismByProgram, SubgroupSizesGiveTheSameBytes) {
    const std::set<std::string> devices = expectSameFiles("LP_NATIVE_VECTOR_WIDTH", {"256", "128", "512"});
    if (devices.size() == 1) GTEST_SKIP() << "'" << *devices.begin() << "' ignores LP_NATIVE_VECTOR_WIDTH";
}

TEST_F(DeterminismByProgram, ThreadsGiveTheSameBytes) {
    expectSameFiles("LP_NUM_THREADS", {"2", "0", "1", "5"});
}

const char* const kRawTargets[] = {"samples", "rayResults", "litDiffuse", "litSpecular"};

TEST(Freeze, NoiseAndListsRepeatTheFrame) {
    const Scene scene = stageScene(lightCases());
    RenderOptions options = seeded(3);
    FrameRig free(scene, options);
    options.settings.freezeNoise = options.settings.freezeLists = true;
    options.settings.freezeFrame = 3;
    FrameRig rig(scene, options);
    for (int frame = 0; frame < 3; ++frame) {
        const FrameTargets a = rig.frame(), b = free.frame();
        for (const auto& [name, image] : a.all())
            EXPECT_TRUE(image.texels == b.named(name).texels)
                << name << ": nothing is frozen before freezeFrame";
    }
    rig.frames(1);
    free.frames(1);
    const FrameTargets fourth = rig.frame(), fifth = rig.frame();
    const FrameTargets freeFourth = free.frame(), freeFifth = free.frame();
    for (const char* name : kRawTargets) {
        EXPECT_TRUE(sameTarget(fourth, fifth, name)) << name;
        EXPECT_FALSE(sameTarget(freeFourth, freeFifth, name)) << name;
    }
    EXPECT_TRUE(sameTarget(fourth, fifth, "gDepth")) << "jitter is frozen with the noise";
}

TEST(Freeze, ListsStayWhileNoiseGoesOn) {
    const Scene scene = stageScene(lightCases());
    RenderOptions options = seeded(3);
    options.settings.freezeLists = true;
    options.settings.freezeFrame = 3;
    FrameRig rig(scene, options);
    rig.frames(3);
    const std::vector<glm::uvec2> held = rig.renderer().visibleLists();
    const FrameTargets a = rig.frame();
    EXPECT_TRUE(rig.renderer().visibleLists() == held);
    const FrameTargets b = rig.frame();
    EXPECT_TRUE(rig.renderer().visibleLists() == held);
    EXPECT_FALSE(sameTarget(a, b, "samples"));
    EXPECT_GT(rig.renderer().statistics().listLengthMean, 0.0);

    options.settings.freezeFrame = 0; // before any frame could write them
    FrameRig never(scene, options);
    never.frames(3);
    for (const glm::uvec2& texel : never.renderer().visibleLists())
        ASSERT_EQ(texel, glm::uvec2(0u));
}

TEST(Freeze, HistoryStays) {
    const Scene scene = stageScene(lightCases());
    for (const int freezeFrame : {4, 0}) {
        RenderOptions options = seeded(3);
        options.settings.jitter = false;
        options.settings.freezeHistory = true;
        options.settings.freezeFrame = freezeFrame;
        options.poisonTargets = true; // a history that nobody wrote would show
        FrameRig rig(scene, options);
        rig.frames(std::max(freezeFrame, 1));
        // The last history that may be written is that of the frame before, or of the first one.
        const FrameTargets held = rig.frame(), later = rig.frame(), latest = rig.frame();
        for (const char* name :
             {"previousDiffuse", "previousSpecular", "previousMoments", "previousAntiAliased"}) {
            EXPECT_TRUE(sameTarget(held, later, name)) << name << ", frozen at " << freezeFrame;
            EXPECT_TRUE(sameTarget(held, latest, name)) << name << ", frozen at " << freezeFrame;
        }
        EXPECT_FALSE(sameTarget(held, later, "litDiffuse")) << "light is sampled anew";
        // A frame over the frozen history holds at most one frame more than it.
        for (std::size_t i = 0; i < latest.pixels(); ++i) {
            if (!latest.surface(i).seen) continue;
            EXPECT_LE(valueAt(latest, "historyDiffuse", i, 3), float(std::max(freezeFrame, 1)) + 1.0f);
        }
    }
}

// The frozen history was written with an exposure of its own, however long ago.
TEST(Freeze, HistoryKeepsItsExposure) {
    const Scene scene = stageScene({lightCases()[0]});
    RenderOptions options =
        stochasticOptions(48, 32, {"picture=denoised", "antiAlias=false", "raysPerPixel=4"});
    options.settings.freezeHistory = true;
    options.settings.freezeFrame = 20;
    FrameRig rig(scene, options);
    rig.frames(21);
    const Picture before = rig.picture();
    rig.renderer().setExposureEv100(rig.renderer().statistics().exposureEv100 - 3.0);
    for (int i = 0; i < 3; ++i) {
        rig.frames(1);
        EXPECT_NEAR(meanLuminance(rig.picture()) / meanLuminance(before), 1.0, 0.05) << i;
        EXPECT_LE(relativeDifference(rig.picture(), before), 0.1) << i;
    }
}

} // namespace
} // namespace kilolux::test
