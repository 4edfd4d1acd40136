// Rendering and comparing: what is run in which order, and what is kept when it is stopped.
#include "renderer/bench/bench_math.h"
#include "renderer/bench/bench_scene.h"
#include "renderer/bench/sweep.h"

#include "renderer/document/gltf_import.h"

#include <algorithm>
#include <fmt/format.h>

namespace kilolux::bench {

namespace {

std::string chooseCamera(const Scene& scene, const std::string& wanted) {
    if (!wanted.empty() || scene.cameras.empty()) return wanted;
    for (const Camera& camera : scene.cameras)
        if (camera.name == "wide") return camera.name;
    return scene.cameras.front().name;
}

// 'split' is what shading by summed weights converges to, 'true' what the BRDF at points does.
std::string referenceOf(const std::string& method) {
    const bool split =
        method == "stochastic" || method == "all-lights" || method == "split" || method == "shadow-maps";
    return split ? "split" : "true";
}

// Counts steps: false once the user has had enough.
class Steps {
  public:
    Steps(const OnProgress& report, int all) : report_(report), all_(all) {}
    bool next(std::string doing) {
        if (!stopped_ && report_) stopped_ = !report_({std::move(doing), done_, all_});
        ++done_;
        return !stopped_;
    }
    void stop() { stopped_ = true; }
    bool stopped() const { return stopped_; }

  private:
    const OnProgress& report_;
    int all_, done_ = 0;
    bool stopped_ = false;
};

// What one scene is measured with.
struct SceneRun {
    SceneBench bench;
    SceneResult& result;
    Reference split, truth;
    const BenchPlan& plan;
    Steps& steps;
    std::string name;

    const Reference& of(const MethodResult& method) const {
        return method.reference == "split" ? split : truth;
    }
    // False: the run is to end.
    bool stopped(const std::optional<Error>& error) const { return error && error->message == kStopped; }
};

// Repetitions are interleaved: what disturbs the machine disturbs all methods.
bool runRepetitions(SceneRun& run) {
    for (int repetition = 0; repetition < run.plan.repetitions; ++repetition) {
        for (MethodResult& method : run.result.methods) {
            for (const PictureChoice picture : {PictureChoice::Denoised, PictureChoice::Mean}) {
                if (!run.steps.next(fmt::format("{}, {}, repetition {} of {}", run.name, method.method.label,
                                                repetition + 1, run.plan.repetitions)))
                    return false;
                if (method.error) continue;
                const auto error = run.bench.run(method, run.of(method), picture, repetition);
                if (run.stopped(error)) return false;
                if (error) method.error = error->message;
            }
        }
    }
    return true;
}

// What needs one run of a method only.
bool runOnce(SceneRun& run) {
    for (MethodResult& method : run.result.methods) {
        if (!run.steps.next(fmt::format("{}, {}, standing still", run.name, method.method.label)))
            return false;
        if (method.error) continue;
        std::optional<Error> error = run.bench.runStill(method, run.of(method));
        for (const Change change : run.plan.changes) {
            if (error) break;
            if (!run.steps.next(fmt::format("{}, {}, {}", run.name, method.method.label, changeName(change))))
                return false;
            error = run.bench.runChange(method, run.of(method), change);
        }
        if (run.stopped(error)) return false;
        if (error) method.error = error->message;
    }
    return true;
}

std::vector<double> budgetsOf(const SceneResult& scene, const BenchPlan& plan) {
    if (!plan.budgetsMs.empty()) return plan.budgetsMs;
    std::vector<double> ms, budgets;
    for (const BenchRun& run : scene.methods.front().filtered)
        ms.push_back(run.lightingMs);
    for (const double frames : {1.0, 4.0, 16.0})
        budgets.push_back(frames * medianOf(ms));
    return budgets;
}

// A scene that was stopped keeps its whole repetitions, and stands in the report if every method has one.
void keepScene(SceneResult&& scene, const BenchPlan& plan, BenchResult& all) {
    for (MethodResult& method : scene.methods) {
        const std::size_t whole = std::min(method.filtered.size(), method.raw.size());
        method.filtered.resize(whole);
        method.raw.resize(whole);
        if (whole == 0 && !method.error) return;
    }
    scene.budgetsMs = budgetsOf(scene, plan);
    const FrameStatistics& statistics = scene.methods.front().statistics;
    all.device = statistics.device;
    all.driver = statistics.driver;
    all.scenes.push_back(std::move(scene));
}

SceneResult emptyResult(const BenchPlan& plan, const BenchScene& wanted, const Scene& scene, double factor) {
    SceneResult result;
    result.scene = wanted;
    result.camera = chooseCamera(scene, wanted.camera);
    result.width = plan.width;
    result.height = plan.height;
    result.sweepFactor = factor;
    for (const BenchMethod& method : plan.methods) {
        result.methods.emplace_back();
        result.methods.back().method = method;
        result.methods.back().reference = referenceOf(method.method);
    }
    return result;
}

std::optional<Error> runScene(const BenchPlan& plan, const BenchScene& wanted, double factor, Steps& steps,
                              BenchResult& all) {
    Result<Scene> scene = importGltf(wanted.file);
    if (!scene) return Error{scene.error()};
    SceneResult result = emptyResult(plan, wanted, scene.value(), factor);
    applySweep(plan.sweep, factor, scene.value(), result.width, result.height);
    SceneRun run{
        SceneBench(plan, scene.value(), result), result, {}, {}, plan, steps, wanted.file.stem().string()};
    if (plan.sweep != Sweep::None) run.name += fmt::format(", {} x {:g}", sweepName(plan.sweep), factor);
    for (const char* method : {"split", "true"}) {
        if (!steps.next(fmt::format("{}, reference {}", run.name, method))) return std::nullopt;
        Result<Reference> reference = run.bench.reference(method);
        if (!reference && reference.error() == kStopped) {
            steps.stop();
            return std::nullopt;
        }
        if (!reference) return Error{reference.error()};
        (method == std::string_view("split") ? run.split : run.truth) = std::move(reference.value());
    }
    result.exposureEv100 = run.truth.exposureEv100;
    result.modelGap = run.bench.compare(run.truth, run.split.mean.pixels, 0).relativeMse;
    result.referenceShown = bytesOf(displayedAt(run.truth.mean.pixels, run.truth.exposureEv100));
    const bool whole = runRepetitions(run) && runOnce(run);
    if (!whole) steps.stop();
    keepScene(std::move(result), plan, all);
    return std::nullopt;
}

} // namespace

Result<BenchMethod> parseMethod(std::string_view text) {
    BenchMethod method;
    method.label = text;
    std::size_t colon = text.find(':');
    method.method = text.substr(0, colon);
    const auto methods = Renderer::methods();
    if (std::none_of(methods.begin(), methods.end(),
                     [&](const NamedChoice& m) { return m.name == method.method; })) {
        std::string known;
        for (const NamedChoice& m : methods)
            known += fmt::format("{}{}", known.empty() ? "" : ", ", m.name);
        return Error{fmt::format("no method '{}'; there are {}", method.method, known)};
    }
    while (colon != std::string_view::npos) {
        text = text.substr(colon + 1);
        colon = text.find(':');
        if (auto error = applySetting(method.settings, text.substr(0, colon))) return *error;
    }
    return method;
}

std::optional<Error> checkScenes(const BenchPlan& plan) {
    for (const BenchScene& wanted : plan.scenes) {
        const Result<Scene> scene = importGltf(wanted.file);
        if (!scene) return Error{scene.error()};
        const std::vector<Camera>& cameras = scene.value().cameras;
        const bool has = wanted.camera.empty() || wanted.camera == "derived" ||
                         std::any_of(cameras.begin(), cameras.end(),
                                     [&](const Camera& camera) { return camera.name == wanted.camera; });
        if (!has) return Error{fmt::format("'{}': no camera '{}'", wanted.file.string(), wanted.camera)};
    }
    return std::nullopt;
}

Result<BenchResult> runBench(const BenchPlan& plan, const OnProgress& progress) {
    BenchResult result;
    result.plan = plan;
    const std::span<const double> factors = sweepFactors(plan.sweep);
    const int perMethod = 2 * plan.repetitions + 1 + int(plan.changes.size());
    const int perScene = 2 + perMethod * int(plan.methods.size());
    Steps steps(progress, perScene * int(plan.scenes.size() * factors.size()));
    for (const BenchScene& scene : plan.scenes) {
        for (const double factor : factors) {
            if (steps.stopped()) break;
            if (const auto error = runScene(plan, scene, factor, steps, result)) return *error;
        }
    }
    result.cancelled = steps.stopped();
    return result;
}

} // namespace kilolux::bench
