// kilolux bench on a device: both files, what they hold, what is refused, and what a stopped run keeps.
#include "tests/cli/run_program.h"

#include "renderer/bench/bench.h"

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

namespace kilolux {
namespace {

struct BenchCommand : ProgramTest {
    ProgramRun bench(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(),
                         {"bench", scene("cornell"), "-o", "report", "--size", "48x32", "--frames", "3",
                          "--repetitions", "2", "--reference-frames", "2"});
        return run(arguments);
    }
    nlohmann::json report() const {
        std::ifstream stream(folder_ / "report" / "bench.json");
        return nlohmann::json::parse(stream);
    }
};

TEST_F(BenchCommand, MeasuresMethodsAgainstOneAnother) {
    const ProgramRun result = bench({"--methods", "stochastic,restir:reuseNeighbours=2,uniform"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const nlohmann::json json = report();
    ASSERT_EQ(json.at("scenes").size(), 1u);
    const nlohmann::json& methods = json.at("scenes").at(0).at("methods");
    ASSERT_EQ(methods.size(), 3u);
    for (const nlohmann::json& method : methods) {
        EXPECT_FALSE(method.contains("error")) << method.dump(2);
        ASSERT_EQ(method.at("filtered").size(), 2u);
        const nlohmann::json& points = method.at("filtered").at(0).at("points");
        ASSERT_EQ(points.size(), 3u) << "frames 1, 2 and the last";
        EXPECT_EQ(points.at(2).at("frame"), 3);
        for (const nlohmann::json& point : points) {
            EXPECT_GT(point.at("relativeMse").get<double>(), 0.0);
            EXPECT_GT(point.at("energyRatio").get<double>(), 0.5);
            EXPECT_LT(point.at("energyRatio").get<double>(), 2.0);
        }
        EXPECT_GT(method.at("filtered").at(0).at("lightingMs").get<double>(), 0.0);
    }
    EXPECT_EQ(methods.at(0).at("reference"), "split");
    EXPECT_EQ(methods.at(1).at("reference"), "true");
    EXPECT_EQ(methods.at(1).at("statistics").at("settings").at("reuseNeighbours"), 2);
    for (const nlohmann::json& ratio : methods.at(0).at("errorOverFirstAtEqualTime"))
        EXPECT_DOUBLE_EQ(ratio.at("ratio").get<double>(), 1.0) << "against itself";
    std::ifstream page(folder_ / "report" / "bench.html");
    const std::string html((std::istreambuf_iterator<char>(page)), {});
    EXPECT_NE(html.find("restir:reuseNeighbours=2"), std::string::npos);
    EXPECT_NE(html.find("data:image/png"), std::string::npos);

    const ProgramRun again = bench({"--methods", "stochastic", "--compare", "report/bench.json"});
    EXPECT_EQ(again.exitCode, 0) << again.err;
    EXPECT_NE(again.out.find("cornell.glb, stochastic: time x"), std::string::npos) << again.out;
}

TEST_F(BenchCommand, PresetsAreMeasuredAgainstTheDefault) {
    const ProgramRun result = bench({"--presets"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const nlohmann::json json = report();
    const nlohmann::json& methods = json.at("scenes").at(0).at("methods");
    ASSERT_GE(methods.size(), 4u);
    EXPECT_EQ(methods.at(0).at("statistics").at("settings").at("raysPerPixel"), 1.0);
    std::set<double> rays;
    for (const nlohmann::json& method : methods) {
        EXPECT_FALSE(method.contains("error")) << method.dump(2);
        rays.insert(method.at("statistics").at("settings").at("raysPerPixel").get<double>());
        EXPECT_GT(method.at("filtered").at(0).at("lightingMs").get<double>(), 0.0);
        EXPECT_GT(method.at("filtered").at(0).at("points").back().at("relativeMse").get<double>(), 0.0);
    }
    EXPECT_GE(rays.size(), 3u);
}

TEST_F(BenchCommand, TellsHowChangesArriveAndKeepsReferences) {
    const std::vector<std::string> arguments = {
        "--methods", "stochastic", "--changes",    "lights-on,camera-turns",
        "--budgets", "2rays,8ms",  "--references", "kept"};
    const ProgramRun result = bench(arguments);
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const nlohmann::json json = report(), &method = json.at("scenes").at(0).at("methods").at(0);
    EXPECT_NE(json.at("command").get<std::string>().find(scene("cornell")), std::string::npos)
        << "with its folder, so that it can be run again: " << json.at("command");
    EXPECT_GT(method.at("still").at("flicker").get<double>(), 0.0);
    const nlohmann::json& on = method.at("changes").at(0);
    EXPECT_EQ(on.at("change"), "lights-on");
    EXPECT_LT(on.at("arrived").at(0).get<double>(), on.at("arrived").back().get<double>() + 0.2);
    EXPECT_LE(on.at("lagFrames").get<int>(), 12);
    EXPECT_EQ(method.at("changes").at(1).at("change"), "camera-turns");
    EXPECT_EQ(method.at("errorOverFirstAtEqualRays").size(), 1u);
    EXPECT_EQ(json.at("scenes").at(0).at("budgetsMs"), nlohmann::json({8.0}));

    const auto kept = [&] {
        std::map<std::string, std::filesystem::file_time_type> files;
        for (const auto& entry : std::filesystem::directory_iterator(folder_ / "kept"))
            files[entry.path().filename().string()] = entry.last_write_time();
        return files;
    };
    const auto before = kept();
    EXPECT_EQ(before.size(), 8u) << "two halves: split, true, dark, turned";
    ASSERT_EQ(bench(arguments).exitCode, 0);
    EXPECT_EQ(kept(), before) << "taken, not rendered anew";
}

TEST_F(BenchCommand, SweepsHaveAStepEach) {
    const ProgramRun result = bench({"--methods", "stochastic", "--sweep", "triangles"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const nlohmann::json scenes = report().at("scenes");
    ASSERT_EQ(scenes.size(), 3u);
    const auto triangles = [&](int step) {
        return scenes.at(step).at("methods").at(0).at("statistics").at("triangles").get<int>();
    };
    EXPECT_EQ(triangles(1), 4 * triangles(0));
    EXPECT_EQ(triangles(2), 16 * triangles(0));
    EXPECT_EQ(scenes.at(2).at("sweepFactor"), 16.0);
}

// What was stopped keeps whole repetitions.
TEST(BenchRun, StoppedKeepsWhatIsDone) {
    bench::BenchPlan plan;
    plan.scenes = {{std::filesystem::path(KILOLUX_SCENES) / "cornell.glb", ""}};
    plan.methods = {bench::parseMethod("uniform").value()};
    plan.width = 32;
    plan.height = 18;
    plan.frames = 2;
    plan.referenceFrames = 2;
    // Steps: two references, then two runs for each of three repetitions. The last one begins and is not
    // finished.
    const auto result =
        bench::runBench(plan, [](const bench::BenchProgress& p) { return p.done < 2 + 2 * 2 + 1; });
    ASSERT_TRUE(result) << result.error();
    EXPECT_TRUE(result.value().cancelled);
    ASSERT_EQ(result.value().scenes.size(), 1u);
    EXPECT_EQ(result.value().scenes[0].methods[0].filtered.size(), 2u);
    EXPECT_EQ(result.value().scenes[0].methods[0].raw.size(), 2u);
    std::atomic<bool> stop = true;
    plan.stop = &stop;
    const auto nothing = bench::runBench(plan, {});
    ASSERT_TRUE(nothing) << nothing.error();
    EXPECT_TRUE(nothing.value().cancelled);
    EXPECT_TRUE(nothing.value().scenes.empty());
}

TEST_F(BenchCommand, BadInputIsToldBeforeTheWork) {
    for (const auto& [arguments, expected] : std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{"--methods", "lightcut"}, "no method 'lightcut'; there are stochastic"},
             {{"--methods", "restir:reuse=1"}, "reuse"},
             {{"--compare", "none.json"}, "'none.json': cannot be read"},
             {{"--camera", "nowhere"}, "no camera 'nowhere'"},
             {{"--sweep", "everything"}, "'everything': expected lights"},
             {{"--changes", "lights-on,weather"}, "'weather': expected lights-on"},
             {{"--budgets", "16ms,4rocks"}, "'4rocks': expected a number"},
             {{"missing.glb"}, "'missing.glb': no such file"}}) {
        const ProgramRun result = bench(arguments);
        EXPECT_EQ(result.exitCode, 2) << result.err;
        EXPECT_NE(result.err.find(expected), std::string::npos) << result.err;
    }
}

} // namespace
} // namespace kilolux
