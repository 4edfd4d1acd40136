// Rendering and comparing: the part of the bench that takes time.
#include "renderer/bench/bench_math.h"

#include "renderer/document/gltf_import.h"
#include "renderer/gpu_lights.h"
#include "renderer/measure/flip.h"
#include "renderer/measure/metrics.h"
#include "renderer/view_colors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace kilolux::bench {

namespace {

constexpr double kEpsilon = 0.01; // of exposed light, squared
constexpr int kBlockPx = 16;
constexpr double kBlockTolerance = 0.02;
constexpr int kReferenceRays = 4; // per light and frame

// Two halves with their own random numbers: the product of both errors is free of the reference's own noise.
struct Reference {
    std::vector<float> halves[2]; // exposed
    std::vector<float> mean;
    std::vector<float> shown; // sRGB in 0..1
};

std::vector<float> exposed(const Picture& picture, double exposure) {
    std::vector<float> rgb = picture.rgb;
    for (float& value : rgb)
        value = float(value * exposure);
    return rgb;
}

std::vector<float> displayed(const std::vector<float>& exposedRgb) {
    std::vector<float> shown;
    shown.reserve(exposedRgb.size());
    for (std::size_t i = 0; i + 2 < exposedRgb.size(); i += 3)
        for (const float value : displayColor({exposedRgb[i], exposedRgb[i + 1], exposedRgb[i + 2]}))
            shown.push_back(std::clamp(value, 0.0f, 1.0f));
    return shown;
}

std::vector<std::uint8_t> bytesOf(const std::vector<float>& srgb) {
    std::vector<std::uint8_t> bytes;
    for (const float value : srgb)
        bytes.push_back(std::uint8_t(std::lround(255.0f * value)));
    return bytes;
}

// What the run of one scene shares.
class SceneBench {
  public:
    SceneBench(const BenchPlan& plan, const Scene& scene, SceneResult& result)
        : plan_(plan), scene_(scene), result_(result) {}

    RenderOptions options(const std::string& method, const Settings& settings, std::uint32_t seed) const {
        RenderOptions options;
        options.width = plan_.width;
        options.height = plan_.height;
        options.method = method;
        options.settings = settings;
        options.settings.jitter = false; // light is compared on one G-buffer
        options.settings.antiAlias = false;
        options.camera = result_.camera;
        options.seed = seed;
        return options;
    }

    Result<Reference> reference(const std::string& method) {
        Reference reference;
        for (int half = 0; half < 2; ++half) {
            Settings settings;
            settings.raysPerLight = kReferenceRays;
            const RenderOptions how = options(method, settings, 1000u + std::uint32_t(half));
            Result<std::unique_ptr<Renderer>> renderer = Renderer::create(scene_, how);
            if (!renderer) return Error{renderer.error()};
            for (int i = 0; i < std::max(1, plan_.referenceFrames / 2); ++i)
                if (const auto error = renderer.value()->renderFrame()) return *error;
            result_.exposureEv100 = renderer.value()->statistics().exposureEv100;
            reference.halves[half] = exposed(renderer.value()->picture(), exposure());
        }
        for (std::size_t i = 0; i < reference.halves[0].size(); ++i)
            reference.mean.push_back(0.5f * (reference.halves[0][i] + reference.halves[1][i]));
        reference.shown = displayed(reference.mean);
        return reference;
    }

    BenchPoint compare(const Reference& reference, const std::vector<float>& rgb, int frame,
                       std::vector<float>* flipMap) const {
        BenchPoint point;
        point.frame = frame;
        double sum = 0.0;
        for (std::size_t i = 0; i < rgb.size(); ++i) {
            const double wanted = double(reference.mean[i]);
            const double errors = (double(rgb[i]) - double(reference.halves[0][i])) *
                                  (double(rgb[i]) - double(reference.halves[1][i]));
            sum += errors / (wanted * wanted + kEpsilon);
        }
        point.relativeMse = std::max(sum / double(rgb.size()), 1e-9);
        const measure::BlockEnergy energy =
            measure::blockEnergy(view(reference.mean), view(rgb), kBlockPx, kBlockTolerance);
        point.energyRatio = energy.meanRatio;
        point.blocksWithin = energy.withinShare;
        const std::vector<float> shown = displayed(rgb);
        measure::FlipResult flip = measure::flip(view(reference.shown), view(shown));
        point.flipMean = flip.mean;
        if (flipMap) *flipMap = std::move(flip.map);
        return point;
    }

    // One repetition of one method. Fills in the pictures of `into` when they are wanted.
    std::optional<Error> run(MethodResult& into, const Reference& reference, PictureChoice picture,
                             int repetition) {
        Settings settings = into.method.settings;
        settings.picture = picture;
        const bool filtered = picture == PictureChoice::Denoised;
        const RenderOptions how = options(into.method.method, settings, std::uint32_t(repetition) + 1u);
        Result<std::unique_ptr<Renderer>> renderer = Renderer::create(scene_, how);
        if (!renderer) return Error{renderer.error()};
        BenchRun run;
        int next = 1;
        for (int frame = 1; frame <= plan_.frames; ++frame) {
            if (const auto error = renderer.value()->renderFrame()) return error;
            if (frame != next && frame != plan_.frames) continue;
            next = frame == next ? 2 * next : next;
            const std::vector<float> rgb = exposed(renderer.value()->picture(), exposure());
            const bool keep = filtered && repetition == 0 && frame <= kShownFrame;
            run.points.push_back(compare(reference, rgb, frame, keep ? &into.shownFlip : nullptr));
            if (keep) into.shown = bytesOf(displayed(rgb));
        }
        const FrameStatistics statistics = renderer.value()->statistics();
        run.lightingMs = statistics.directLightingMs;
        run.raysPerPixel = double(statistics.rays) / (double(plan_.frames) * plan_.width * plan_.height);
        (filtered ? into.filtered : into.raw).push_back(std::move(run));
        if (filtered) into.statistics = statistics;
        return std::nullopt;
    }

    measure::ImageView view(const std::vector<float>& rgb) const { return {plan_.width, plan_.height, rgb}; }
    double exposure() const { return exposureFromEv100(result_.exposureEv100); }

  private:
    const BenchPlan& plan_;
    const Scene& scene_;
    SceneResult& result_;
};

std::string chooseCamera(const Scene& scene, const std::string& wanted) {
    if (!wanted.empty() || scene.cameras.empty()) return wanted;
    for (const Camera& camera : scene.cameras)
        if (camera.name == "wide") return camera.name;
    return scene.cameras.front().name;
}

// 'split' is what shading by summed weights converges to, 'true' what the BRDF at points does.
std::string referenceOf(const std::string& method) {
    return method == "stochastic" || method == "all-lights" || method == "split" ? "split" : "true";
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
    bool stopped() const { return stopped_; }

  private:
    const OnProgress& report_;
    int all_, done_ = 0;
    bool stopped_ = false;
};

// Repetitions are interleaved: what disturbs the machine disturbs all methods.
bool runMethods(SceneBench& bench, SceneResult& result, const Reference& split, const Reference& truth,
                const BenchPlan& plan, Steps& steps) {
    for (int repetition = 0; repetition < plan.repetitions; ++repetition) {
        for (MethodResult& method : result.methods) {
            for (const PictureChoice picture : {PictureChoice::Denoised, PictureChoice::Mean}) {
                const std::string name =
                    fmt::format("{}, {}", result.scene.file.stem().string(), method.method.label);
                if (!steps.next(
                        fmt::format("{}, repetition {} of {}", name, repetition + 1, plan.repetitions)))
                    return false;
                if (method.error) continue;
                const Reference& reference = method.reference == "split" ? split : truth;
                if (const auto error = bench.run(method, reference, picture, repetition))
                    method.error = error->message;
            }
        }
    }
    return true;
}

std::optional<Error> runScene(const BenchPlan& plan, const BenchScene& wanted, Steps& steps,
                              BenchResult& all) {
    Result<Scene> scene = importGltf(wanted.file);
    if (!scene) return Error{scene.error()};
    SceneResult result;
    result.scene = wanted;
    result.camera = chooseCamera(scene.value(), wanted.camera);
    for (const BenchMethod& method : plan.methods) {
        result.methods.emplace_back();
        result.methods.back().method = method;
        result.methods.back().reference = referenceOf(method.method);
    }
    SceneBench bench(plan, scene.value(), result);
    const std::string name = wanted.file.stem().string();
    if (!steps.next(name + ", reference split")) return std::nullopt;
    Result<Reference> split = bench.reference("split");
    if (!split) return Error{split.error()};
    if (!steps.next(name + ", reference true")) return std::nullopt;
    Result<Reference> truth = bench.reference("true");
    if (!truth) return Error{truth.error()};
    result.modelGap = bench.compare(truth.value(), split.value().mean, 0, nullptr).relativeMse;
    result.referenceShown = bytesOf(truth.value().shown);
    if (!runMethods(bench, result, split.value(), truth.value(), plan, steps)) return std::nullopt;
    result.budgetsMs = plan.budgetsMs;
    if (result.budgetsMs.empty()) {
        std::vector<double> ms;
        for (const BenchRun& run : result.methods.front().filtered)
            ms.push_back(run.lightingMs);
        for (const double frames : {1.0, 4.0, 16.0})
            result.budgetsMs.push_back(frames * medianOf(ms));
    }
    const FrameStatistics& statistics = result.methods.front().statistics;
    all.device = statistics.device;
    all.driver = statistics.driver;
    all.scenes.push_back(std::move(result));
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

Result<BenchResult> runBench(const BenchPlan& plan, const OnProgress& progress) {
    BenchResult result;
    result.plan = plan;
    const int perScene = 2 + 2 * plan.repetitions * int(plan.methods.size());
    Steps steps(progress, perScene * int(plan.scenes.size()));
    for (const BenchScene& scene : plan.scenes) {
        if (const auto error = runScene(plan, scene, steps, result)) return *error;
        if (steps.stopped()) break;
    }
    result.cancelled = steps.stopped();
    return result;
}

} // namespace kilolux::bench
