// kilolux bench on a device: both files, what they hold, and what is refused.
#include "tests/cli/run_program.h"

#include <fstream>
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

TEST_F(BenchCommand, BadInputIsToldBeforeTheWork) {
    for (const auto& [arguments, expected] : std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{"--methods", "lightcut"}, "no method 'lightcut'; there are stochastic"},
             {{"--methods", "restir:reuse=1"}, "reuse"},
             {{"--compare", "none.json"}, "'none.json': cannot be read"},
             {{"missing.glb"}, "'missing.glb': no such file"}}) {
        const ProgramRun result = bench(arguments);
        EXPECT_EQ(result.exitCode, 2) << result.err;
        EXPECT_NE(result.err.find(expected), std::string::npos) << result.err;
    }
}

} // namespace
} // namespace kilolux
