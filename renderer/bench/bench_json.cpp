// The numbers of a run as JSON, and a run held against an older one.
#include "renderer/bench/bench_math.h"
#include "renderer/bench/bench_scene.h"
#include "renderer/bench/sweep.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace kilolux::bench {

namespace {

using Json = nlohmann::ordered_json;

Json pointJson(const BenchPoint& p) {
    return {{"frame", p.frame},
            {"relativeMse", p.relativeMse},
            {"energyRatio", p.energyRatio},
            {"blocksWithin", p.blocksWithin},
            {"flipMean", p.flipMean}};
}

Json runsJson(const std::vector<BenchRun>& runs) {
    Json json = Json::array();
    for (const BenchRun& run : runs) {
        Json points = Json::array();
        for (const BenchPoint& point : run.points)
            points.push_back(pointJson(point));
        json.push_back(
            {{"lightingMs", run.lightingMs}, {"raysPerPixel", run.raysPerPixel}, {"points", points}});
    }
    return json;
}

Json ratioJson(double budget, const char* unit, const std::vector<double>& ratios) {
    const Interval i = intervalOf(ratios);
    Json json{{unit, budget}};
    if (ratios.empty()) {
        json["ratio"] = nullptr; // one of the two has no frame yet
    } else {
        json["ratio"] = i.median;
        json["least"] = i.least;
        json["largest"] = i.largest;
    }
    return json;
}

Json changeJson(const ChangeResult& c) {
    Json json{{"change", changeName(c.change)}, {"relativeMse", c.relativeMse}, {"flipMean", c.flipMean}};
    if (c.change != Change::LightsOn) return json;
    json["arrived"] = c.arrived;
    json["lagFrames"] = c.lagFrames ? Json(*c.lagFrames) : Json(nullptr); // it never stayed there
    return json;
}

Json methodJson(const SceneResult& scene, const MethodResult& m, const std::vector<double>& rayBudgets) {
    Json json{{"method", m.method.label}, {"reference", m.reference}};
    if (m.error) {
        json["error"] = *m.error;
        return json;
    }
    json["settingsHash"] = fmt::format("{:016x}", settingsHash(m.method.settings));
    json["filtered"] = runsJson(m.filtered);
    json["raw"] = runsJson(m.raw);
    json["statistics"] = statisticsJson(m.statistics, m.method.settings);
    Json atTime = Json::array(), atRays = Json::array();
    for (const double ms : scene.budgetsMs)
        atTime.push_back(ratioJson(ms, "ms", ratiosAtEqualTime(scene.methods.front(), m, ms)));
    for (const double rays : rayBudgets)
        atRays.push_back(ratioJson(rays, "raysPerPixel", ratiosAtEqualRays(scene.methods.front(), m, rays)));
    if (m.still) {
        json["still"] = {{"rawFrameRelativeMse", m.still->frameError},
                         {"flicker", m.still->flicker},
                         {"correlationInTime", m.still->inTime},
                         {"correlationInSpace", m.still->inSpace},
                         {"hdrFlipMean", m.still->hdrFlip}};
    }
    for (const ChangeResult& change : m.changes)
        json["changes"].push_back(changeJson(change));
    json["errorOverFirstAtEqualTime"] = std::move(atTime);
    json["errorOverFirstAtEqualRays"] = std::move(atRays);
    return json;
}

// Geometric means of the first method's error over the others'.
Json meansJson(const BenchResult& result) {
    Json json = Json::array();
    for (std::size_t i = 1; i < result.plan.methods.size(); ++i) {
        Json means = Json::array();
        for (const OverScenes& mean : meansOverScenes(result, i))
            means.push_back({{"at", mean.at},
                             {"mean", mean.firstOverOther.median},
                             {"least", mean.firstOverOther.least},
                             {"largest", mean.firstOverOther.largest},
                             {"scenes", mean.scenes}});
        json.push_back({{"method", result.plan.methods[i].label}, {"means", means}});
    }
    return json;
}

double medianMs(const Json& runs) {
    std::vector<double> ms;
    for (const Json& run : runs)
        ms.push_back(run.at("lightingMs").get<double>());
    return medianOf(ms);
}

// A run of the JSON above, back.
BenchRun runFrom(const Json& json) {
    BenchRun run;
    run.lightingMs = json.at("lightingMs").get<double>();
    for (const Json& point : json.at("points"))
        run.points.push_back({point.at("frame").get<int>(), point.at("relativeMse").get<double>(), 0, 0, 0});
    return run;
}

std::string compareMethod(const std::string& scene, double budgetMs, const MethodResult& now,
                          const Json& then) {
    MethodResult before;
    for (const Json& run : then.at("filtered"))
        before.filtered.push_back(runFrom(run));
    std::vector<double> ms;
    for (const BenchRun& run : now.filtered)
        ms.push_back(run.lightingMs);
    const std::vector<double> ratios = ratiosAtEqualTime(before, now, budgetMs);
    const double timeRatio = medianOf(ms) / std::max(medianMs(then.at("filtered")), 1e-9);
    return fmt::format("{}, {}: time x {:.3f}, error after {:.0f} ms x {}\n", scene, now.method.label,
                       timeRatio, budgetMs, ratios.empty() ? "-" : fmt::format("{:.3f}", medianOf(ratios)));
}

} // namespace

Json benchJson(const BenchResult& result) {
    const BenchPlan& plan = result.plan;
    Json scenes = Json::array();
    for (const SceneResult& scene : result.scenes) {
        Json methods = Json::array();
        for (const MethodResult& method : scene.methods)
            methods.push_back(methodJson(scene, method, plan.budgetsRays));
        scenes.push_back({{"scene", scene.scene.file.filename().string()},
                          {"camera", scene.camera},
                          {"width", scene.width},
                          {"height", scene.height},
                          {"sweepFactor", scene.sweepFactor},
                          {"exposureEv100", scene.exposureEv100},
                          {"splitAgainstTrueRelativeMse", scene.modelGap},
                          {"budgetsMs", scene.budgetsMs},
                          {"methods", methods}});
    }
    return {{"kilolux", "bench"},
            {"version", 1},
            {"date", plan.date},
            {"command", plan.command},
            {"device", result.device},
            {"driver", result.driver},
            {"width", plan.width},
            {"height", plan.height},
            {"frames", plan.frames},
            {"repetitions", plan.repetitions},
            {"referenceFrames", plan.referenceFrames},
            {"epsilon", 0.01},
            {"pixelsPerDegree", 67},
            {"sweep", sweepName(plan.sweep)},
            {"cancelled", result.cancelled},
            {"firstOverOthers", meansJson(result)},
            {"scenes", scenes}};
}

Result<std::string> compareWithOlder(const BenchResult& result, const Json& older) {
    std::string text;
    try {
        for (const SceneResult& scene : result.scenes) {
            for (const Json& oldScene : older.at("scenes")) {
                const std::string name = scene.scene.file.filename().string();
                if (oldScene.at("scene") != name || oldScene.value("sweepFactor", 1.0) != scene.sweepFactor)
                    continue;
                for (const MethodResult& method : scene.methods) {
                    for (const Json& oldMethod : oldScene.at("methods")) {
                        if (oldMethod.at("method") != method.method.label || oldMethod.contains("error") ||
                            method.error)
                            continue;
                        text += compareMethod(name, scene.budgetsMs.back(), method, oldMethod);
                    }
                }
            }
        }
    } catch (const nlohmann::json::exception& error) {
        return Error{fmt::format("not a report of 'kilolux bench': {}", error.what())};
    }
    return text.empty() ? std::string("no scene and method in common\n") : text;
}

} // namespace kilolux::bench
