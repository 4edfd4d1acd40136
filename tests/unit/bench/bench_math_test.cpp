// Comparisons at equal time and equal rays, and the report's escaping, on runs with known answers.
#include "renderer/bench/bench_math.h"

#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace kilolux::bench {
namespace {

// Error a / frames: a line of slope -1 in logarithms.
BenchRun runOf(double a, double ms, double rays) {
    BenchRun run;
    run.lightingMs = ms;
    run.raysPerPixel = rays;
    for (const int frame : {1, 2, 4, 8, 16})
        run.points.push_back({frame, a / frame, 1.0, 1.0, 0.1});
    return run;
}

MethodResult methodOf(const std::string& name, double a, double ms, double rays) {
    MethodResult result;
    result.method.label = result.method.method = name;
    result.reference = "split";
    for (const double factor : {0.5, 1.0, 3.0}) {
        result.filtered.push_back(runOf(a * factor, ms, rays));
        result.raw.push_back(runOf(a * factor, ms, rays));
    }
    return result;
}

TEST(BenchMath, ErrorBetweenFramesFollowsTheLine) {
    const BenchRun run = runOf(8.0, 10.0, 1.0);
    for (const double frames : {1.0, 1.5, 3.0, 7.9, 8.0, 15.0})
        EXPECT_NEAR(errorAt(run, 10.0, 10.0 * frames).value(), 8.0 / frames, 1e-9) << frames;
    EXPECT_DOUBLE_EQ(errorAt(run, 10.0, 1e6).value(), 0.5) << "after the last frame its error";
    EXPECT_FALSE(errorAt(run, 10.0, 9.9)) << "no frame is done";
    EXPECT_FALSE(errorAt(run, 0.0, 9.9));
    EXPECT_FALSE(errorAt(BenchRun{}, 10.0, 100.0));
}

TEST(BenchMath, RatiosAreTakenRepetitionByRepetition) {
    const MethodResult first = methodOf("a", 1.0, 10.0, 1.0), slow = methodOf("b", 1.0, 20.0, 2.0);
    const std::vector<double> ratios = ratiosAtEqualTime(first, slow, 80.0);
    ASSERT_EQ(ratios.size(), 3u);
    for (const double ratio : ratios)
        EXPECT_NEAR(ratio, 2.0, 1e-9) << "half as many frames, twice the error";
    for (const double ratio : ratiosAtEqualRays(first, slow, 8.0))
        EXPECT_NEAR(ratio, 2.0, 1e-9);
    EXPECT_TRUE(ratiosAtEqualTime(first, slow, 15.0).empty()) << "the slow one has no frame yet";
}

TEST(BenchMath, MediansIntervalsAndGeometricMeans) {
    EXPECT_DOUBLE_EQ(medianOf({3.0, 1.0, 2.0}), 2.0);
    EXPECT_DOUBLE_EQ(medianOf({4.0, 1.0, 2.0, 3.0}), 2.5);
    EXPECT_DOUBLE_EQ(medianOf({}), 0.0);
    const Interval interval = intervalOf({5.0, 1.0, 2.0});
    EXPECT_DOUBLE_EQ(interval.median, 2.0);
    EXPECT_DOUBLE_EQ(interval.least, 1.0);
    EXPECT_DOUBLE_EQ(interval.largest, 5.0);
    EXPECT_NEAR(geometricMean(std::vector<double>{0.5, 2.0, 8.0}), 2.0, 1e-12);
}

TEST(BenchMath, MethodsAreParsedWithTheirSettings) {
    const Result<BenchMethod> plain = parseMethod("stochastic");
    ASSERT_TRUE(plain);
    EXPECT_EQ(plain.value().settings, Settings{});
    const Result<BenchMethod> set = parseMethod("restir:reuseWeights=rays:reuseNeighbours=3");
    ASSERT_TRUE(set);
    EXPECT_EQ(set.value().method, "restir");
    EXPECT_EQ(set.value().settings.reuseWeights, ReuseWeights::Rays);
    EXPECT_EQ(set.value().settings.reuseNeighbours, 3);
    EXPECT_FALSE(parseMethod("lightcut"));
    EXPECT_FALSE(parseMethod("restir:reuse=1"));
    EXPECT_FALSE(parseMethod("restir:reuseNeighbours=many"));
}

BenchResult resultOf(const std::string& sceneName, double ms) {
    BenchResult result;
    result.device = "<device & driver>";
    result.plan.methods = {methodOf("stochastic", 1.0, ms, 1.0).method,
                           methodOf("restir", 4.0, ms, 2.0).method};
    result.plan.width = result.plan.height = 2;
    result.plan.budgetsMs = {4.0 * ms};
    SceneResult scene;
    scene.scene.file = sceneName;
    scene.budgetsMs = {4.0 * ms};
    scene.width = scene.height = 2;
    scene.methods = {methodOf("stochastic", 1.0, ms, 1.0), methodOf("restir", 4.0, ms, 2.0)};
    result.scenes.push_back(scene);
    return result;
}

// Two scenes, of ratios 1/4 and 1/16: their geometric mean; repetitions agree, so that the interval is a
// point.
TEST(BenchMath, MeansOverScenes) {
    BenchResult result = resultOf("a.glb", 10.0);
    result.scenes.push_back(result.scenes[0]);
    result.scenes[1].methods[1] = methodOf("restir", 16.0, 10.0, 2.0);
    const std::vector<OverScenes> means = meansOverScenes(result, 1);
    ASSERT_EQ(means.size(), 4u) << "one of time, three of rays";
    EXPECT_EQ(means[0].scenes, 2u);
    EXPECT_NEAR(means[0].firstOverOther.median, 1.0 / 8.0, 1e-9);
    EXPECT_NEAR(means[0].firstOverOther.largest, 1.0 / 8.0, 1e-9);
    EXPECT_EQ(means[1].scenes, 0u) << "no frame after one ray";
    EXPECT_NEAR(means[2].firstOverOther.median, 1.0 / 16.0, 1e-9) << "twice the rays";
    // A repetition that goes worse widens the interval, not the mean of medians.
    for (BenchPoint& point : result.scenes[0].methods[1].filtered[2].points)
        point.relativeMse *= 0.25;
    EXPECT_NEAR(meansOverScenes(result, 1)[0].firstOverOther.median, 1.0 / 8.0, 1e-9);
    EXPECT_NEAR(meansOverScenes(result, 1)[0].firstOverOther.largest, 1.0 / 4.0, 1e-9);
}

TEST(BenchReport, JsonHoldsWhatWasMeasured) {
    const nlohmann::ordered_json json = benchJson(resultOf("a.glb", 10.0));
    const auto& other = json.at("scenes").at(0).at("methods").at(1);
    EXPECT_EQ(other.at("method"), "restir");
    EXPECT_EQ(other.at("filtered").size(), 3u);
    EXPECT_NEAR(other.at("errorOverFirstAtEqualTime").at(0).at("ratio").get<double>(), 4.0, 1e-9);
    EXPECT_NEAR(other.at("errorOverFirstAtEqualRays").at(1).at("ratio").get<double>(), 8.0, 1e-9);
    EXPECT_TRUE(other.at("errorOverFirstAtEqualRays").at(0).at("ratio").is_null())
        << "2 rays in its first frame";
}

TEST(BenchReport, PageIsSelfContainedAndEscapesNames) {
    BenchResult result = resultOf("<script>alert(1).glb", 10.0);
    result.scenes[0].referenceShown.assign(12, 128);
    const std::string page = benchHtml(result);
    EXPECT_EQ(page.find("<script"), std::string::npos);
    EXPECT_NE(page.find("&lt;script&gt;"), std::string::npos);
    EXPECT_NE(page.find("&lt;device &amp; driver&gt;"), std::string::npos);
    for (const char* outside : {"http://", "https://", "src=\"/", "href="})
        EXPECT_EQ(page.find(outside), std::string::npos) << outside;
    EXPECT_NE(page.find("data:image/png;base64,iVBOR"), std::string::npos);
    EXPECT_NE(page.find("<td>0.25 <small>0.25 to 0.25</small></td>"), std::string::npos)
        << "the first's error over the other's";
}

TEST(BenchReport, PageShowsChangesStillFactsAndScaling) {
    BenchResult result = resultOf("a.glb", 10.0);
    result.plan.sweep = Sweep::Resolution;
    result.scenes.push_back(result.scenes[0]);
    result.scenes[1].width = 4;
    MethodResult& method = result.scenes[0].methods[0];
    method.still = StillFacts{0.125, 0.5, 0.75, 0.25, 0.0625};
    method.changes = {{Change::LightsOn, {0.5, 0.95}, 2, 0.25, 0.125},
                      {Change::CameraTurns, {}, {}, 0.25, 0.125}};
    const std::string page = benchHtml(result);
    for (const char* part :
         {"<h2>Scaling</h2>", "0.1250</td><td>0.75</td><td>0.25</td><td>0.5000</td><td>0.0625",
          "stochastic, lights-on</th><td>2</td><td>50 %</td><td>0.2500", "camera-turns"})
        EXPECT_NE(page.find(part), std::string::npos) << part;
    const nlohmann::ordered_json json = benchJson(result);
    EXPECT_EQ(json.at("sweep"), "resolution");
    EXPECT_EQ(json.at("scenes").at(0).at("methods").at(0).at("changes").at(0).at("lagFrames"), 2);
    EXPECT_EQ(json.at("scenes").at(0).at("methods").at(0).at("still").at("correlationInTime"), 0.75);
}

TEST(BenchReport, OlderRunsAreComparedByTheirNumbers) {
    const nlohmann::ordered_json older = benchJson(resultOf("a.glb", 10.0));
    const Result<std::string> text = compareWithOlder(resultOf("a.glb", 20.0), older);
    ASSERT_TRUE(text);
    EXPECT_NE(text.value().find("a.glb, stochastic: time x 2.000, error after 80 ms x 2.000"),
              std::string::npos)
        << text.value();
    EXPECT_EQ(compareWithOlder(resultOf("b.glb", 20.0), older).value(), "no scene and method in common\n");
    EXPECT_FALSE(compareWithOlder(resultOf("a.glb", 20.0), nlohmann::ordered_json{{"scenes", {{{"x", 1}}}}}));
}

} // namespace
} // namespace kilolux::bench
