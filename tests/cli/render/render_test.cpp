// kilolux render on a device: files, statistics, cameras, settings and determinism, as a user sees them.
#include "tests/cli/run_program.h"

#include <OpenImageIO/imageio.h>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

namespace kilolux {
namespace {

struct RenderCommand : ProgramTest {
    // Expects success and hands back what was printed.
    ProgramRun render(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), {"render", scene("cornell"), "--size", "96x54"});
        ProgramRun result = run(arguments);
        EXPECT_EQ(result.exitCode, 0) << testing::PrintToString(arguments) << "\n" << result.err;
        return result;
    }

    std::vector<float> pixels(const std::string& name) const {
        const auto input = OIIO::ImageInput::open((folder_ / name).string());
        if (!input) {
            ADD_FAILURE() << name << ": " << OIIO::geterror();
            return {};
        }
        EXPECT_EQ(input->spec().width, 96) << name;
        EXPECT_EQ(input->spec().height, 54) << name;
        EXPECT_EQ(input->spec().nchannels, 3) << name;
        std::vector<float> values(input->spec().image_pixels() * input->spec().nchannels);
        EXPECT_TRUE(input->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, values.data()));
        return values;
    }
};

double mean(const std::vector<float>& values) {
    double sum = 0.0;
    for (const float value : values)
        sum += value;
    return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

TEST_F(RenderCommand, EveryFormatHoldsThePicture) {
    for (const char* name : {"a.png", "a.exr", "a.hdr"}) {
        const ProgramRun result = render({"-o", name, "--method", "all-lights"});
        EXPECT_NE(result.out.find("wrote '" + std::string(name) + "' (96 x 54, 1 frame"), std::string::npos)
            << result.out;
    }
    const double png = mean(pixels("a.png"));
    EXPECT_GT(png, 0.05) << "the picture is black";
    EXPECT_LT(png, 0.95) << "the picture is white";
    for (const float value : pixels("a.exr"))
        ASSERT_TRUE(std::isfinite(value) && value >= 0.0f) << value;
    EXPECT_NEAR(mean(pixels("a.hdr")) / mean(pixels("a.exr")), 1.0, 0.01);
}

TEST_F(RenderCommand, DefaultNameIsTheScenes) {
    EXPECT_NE(render({}).out.find("32 frames"), std::string::npos) << "what the default method wants";
    EXPECT_TRUE(std::filesystem::exists(folder_ / "cornell.png"));
    const nlohmann::json list = nlohmann::json::parse(run({"--list", "--json"}).out);
    const std::string view = list["views"].back()["name"];
    render({"--view", view});
    EXPECT_TRUE(std::filesystem::exists(folder_ / ("cornell-" + view + ".png")));
}

TEST_F(RenderCommand, EveryViewAndMethodRenders) {
    const nlohmann::json list = nlohmann::json::parse(run({"--list", "--json"}).out);
    for (const nlohmann::json& view : list["views"])
        render({"-o", "view.png", "--frames", "2", "--view", view["name"]});
    for (const nlohmann::json& method : list["methods"]) {
        render({"-o", "method.exr", "--frames", "2", "--method", method["name"]});
        EXPECT_GT(mean(pixels("method.exr")), 0.0) << method["name"];
    }
}

TEST_F(RenderCommand, StatisticsTellWhatWasAsked) {
    render({"-o", "a.png", "--frames", "3", "--seed", "7", "--set", "jitter=off", "--stats", "a.json"});
    const nlohmann::json s = nlohmann::json::parse(readText(folder_ / "a.json"));
    for (const char* name : {"device", "driver", "timing"})
        EXPECT_NE(s[name].get<std::string>(), "") << name;
    EXPECT_EQ(s["width"], 96);
    EXPECT_EQ(s["height"], 54);
    EXPECT_EQ(s["frames"], 3);
    EXPECT_EQ(s["seed"], 7);
    EXPECT_EQ(s["settings"]["jitter"], false);
    EXPECT_EQ(s["settingsHash"].get<std::string>().size(), 16u);
    EXPECT_EQ(s["lights"], 1);
    EXPECT_GT(s["lightsInRangeMean"], 0.0);
    EXPECT_GT(s["triangles"], 10);
    EXPECT_GT(s["rays"], 0);
    EXPECT_FALSE(s["passes"].empty());
    for (const nlohmann::json& pass : s["passes"])
        EXPECT_LE(pass["medianMs"], pass["p95Ms"]) << s["passes"];
    for (const char* name : {"directLightingMs", "frameMs", "wallMs", "startupMs"})
        EXPECT_GT(s[name], 0.0) << name;
    EXPECT_LE(s["directLightingMs"], s["frameMs"]);
    EXPECT_GT(s["gpuMemoryMiB"]["total"], 0.0);
    EXPECT_FALSE(s["firstDispatchMs"].empty());
}

TEST_F(RenderCommand, SameSeedSameBytes) {
    render({"-o", "a.exr", "--frames", "2", "--seed", "5"});
    render({"-o", "b.exr", "--frames", "2", "--seed", "5"});
    render({"-o", "c.exr", "--frames", "2", "--seed", "6"});
    EXPECT_EQ(pixels("a.exr"), pixels("b.exr"));
    EXPECT_NE(pixels("a.exr"), pixels("c.exr"));
}

TEST_F(RenderCommand, APresetIsItsSettingsUnderThoseThatAreSet) {
    render({"-o", "preset.exr", "--frames", "2", "--preset", "draft", "--set", "raysPerPixel=1", "--stats",
            "p.json"});
    render({"-o", "set.exr", "--frames", "2", "--set", "preset=draft", "--set", "raysPerPixel=1"});
    render({"-o", "plain.exr", "--frames", "2", "--set", "raysPerPixel=1"});
    EXPECT_EQ(pixels("preset.exr"), pixels("set.exr"));
    EXPECT_NE(pixels("preset.exr"), pixels("plain.exr"));
    std::ifstream file(folder_ / "p.json");
    const nlohmann::json settings = nlohmann::json::parse(file).at("settings");
    EXPECT_EQ(settings.at("raysPerPixel"), 1.0);
    EXPECT_EQ(settings.at("sampling"), "rooks");
}

TEST_F(RenderCommand, ExposureChangesTheDisplayOnly) {
    render({"-o", "dark.png", "--set", "exposureEv100=12", "--method", "all-lights"});
    render({"-o", "bright.png", "--set", "exposureEv100=4", "--method", "all-lights"});
    EXPECT_LT(mean(pixels("dark.png")), mean(pixels("bright.png")));
    render({"-o", "dark.exr", "--set", "exposureEv100=12", "--method", "all-lights"});
    render({"-o", "bright.exr", "--set", "exposureEv100=4", "--method", "all-lights"});
    EXPECT_EQ(pixels("dark.exr"), pixels("bright.exr")) << "EXR holds light without exposure";
}

TEST_F(RenderCommand, CameraChoosesTheView) {
    render({"-o", "front.exr", "--camera", "front"});
    render({"-o", "close.exr", "--camera", "close"});
    render({"-o", "default.exr"});
    EXPECT_NE(pixels("front.exr"), pixels("close.exr"));
    EXPECT_EQ(pixels("front.exr"), pixels("default.exr")) << "the first camera is the default";
}

TEST_F(RenderCommand, DumpWritesEveryTarget) {
    const ProgramRun result = render({"-o", "a.png", "--dump", "deep/targets"});
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "deep/targets")) {
        EXPECT_EQ(entry.path().extension(), ".exr");
        EXPECT_TRUE(OIIO::ImageInput::open(entry.path().string())) << entry.path();
        ++files;
    }
    EXPECT_GE(files, 3u);
    EXPECT_NE(result.out.find("wrote " + std::to_string(files) + " targets"), std::string::npos)
        << result.out;
}

TEST_F(RenderCommand, SceneWithoutLightsOrCamerasRenders) {
    std::ofstream(folder_ / "bare.gltf")
        << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[]}]})";
    const ProgramRun result = run({"render", "bare.gltf", "--size", "16x16", "-o", "bare.png"});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_NE(result.err.find("kilolux: warning: "), std::string::npos) << "an empty scene deserves a word";
    const ProgramRun refused = run({"render", "bare.gltf", "--camera", "main"});
    EXPECT_EQ(refused.exitCode, 2);
    EXPECT_NE(refused.err.find("kilolux: error: unknown camera 'main'; the scene has none"),
              std::string::npos);
}

struct ProbeCommand : ProgramTest {};

TEST_F(ProbeCommand, TellsWhyAsTableAndJson) {
    const std::vector<std::string> arguments{"probe", scene("cornell"), "--size", "96x54", "--frames",
                                             "3",     "--pixel",        "48,45"};
    const ProgramRun table = run(arguments);
    EXPECT_EQ(table.exitCode, 0) << table.err;
    for (const char* word :
         {"picture ", " nit", "surface ", " lux on it", "candidates", "prob.", "visible, listed"})
        EXPECT_NE(table.out.find(word), std::string::npos) << word << " in\n" << table.out;
    std::vector<std::string> asJson = arguments;
    asJson.emplace_back("--json");
    const ProgramRun json = run(asJson);
    ASSERT_EQ(json.exitCode, 0) << json.err;
    const nlohmann::json probe = nlohmann::json::parse(json.out);
    EXPECT_EQ(probe["pixel"], nlohmann::json({48, 45}));
    double sum = 0.0;
    for (const auto& light : probe["lights"])
        sum += light["probability"].get<double>();
    EXPECT_NEAR(sum, 1.0, 1e-4);
    EXPECT_GT(probe["lux"], 0.0);
}

TEST_F(ProbeCommand, RefusesWhatIsNoPixel) {
    for (const char* pixel : {"", "48", "48,", "a,b", "48,45,1", "96,0", "0,-1"}) {
        const ProgramRun result = run({"probe", scene("cornell"), "--size", "96x54", "--pixel", pixel});
        EXPECT_EQ(result.exitCode, 2) << pixel;
        EXPECT_NE(result.err.find("--pixel"), std::string::npos) << result.err;
    }
    EXPECT_EQ(run({"probe"}).exitCode, 2);
}

} // namespace
} // namespace kilolux
