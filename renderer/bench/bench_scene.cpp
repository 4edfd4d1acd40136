#include "renderer/bench/bench_scene.h"

#include "renderer/bench/sweep.h"
#include "renderer/gpu_lights.h"
#include "renderer/measure/flip.h"
#include "renderer/measure/metrics.h"
#include "renderer/measure/temporal.h"

#include <algorithm>
#include <cmath>

namespace kilolux::bench {

namespace {

constexpr int kBlockPx = 16;
constexpr double kBlockTolerance = 0.02;
constexpr int kSettled = 12; // frames after which a picture that stands still is looked at
constexpr int kLookedAt = 4; // consecutive frames

} // namespace

std::vector<float> exposedLight(const std::vector<float>& rgb, double exposureEv100) {
    const double exposure = exposureFromEv100(exposureEv100);
    std::vector<float> light = rgb;
    for (float& value : light)
        value = float(value * exposure);
    return light;
}

std::vector<std::uint8_t> bytesOf(const std::vector<float>& srgb) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(srgb.size());
    for (const float value : srgb)
        bytes.push_back(std::uint8_t(std::lround(255.0f * value)));
    return bytes;
}

RenderOptions SceneBench::options(const std::string& method, Settings settings, std::uint32_t seed) const {
    RenderOptions options;
    options.width = result_.width;
    options.height = result_.height;
    options.method = method;
    options.settings = settings;
    options.settings.jitter = false;
    options.settings.antiAlias = false;
    options.camera = result_.camera;
    options.seed = seed;
    return options;
}

Result<Reference> SceneBench::reference(const Scene& edited, const std::string& tag,
                                        const std::string& method) const {
    Settings settings;
    settings.raysPerLight = kReferenceRays;
    return makeReference(edited, options(method, settings, 0), std::max(1, plan_.referenceFrames / 2),
                         plan_.references, tag, plan_.stop);
}

Result<Reference> SceneBench::reference(const std::string& method, const Settings& moved) const {
    Settings settings = moved;
    settings.raysPerLight = kReferenceRays;
    // Other rays and pixels are another method's and another size; lights and triangles another scene.
    const bool otherScene = plan_.sweep == Sweep::Lights || plan_.sweep == Sweep::Triangles;
    const std::string tag = result_.sweepFactor == 1.0 || !otherScene
                                ? ""
                                : std::string(sweepName(plan_.sweep)) + std::to_string(result_.sweepFactor);
    return makeReference(scene_, options(method, settings, 0), std::max(1, plan_.referenceFrames / 2),
                         plan_.references, tag, plan_.stop);
}

BenchPoint SceneBench::compare(const Reference& reference, const std::vector<float>& rgb, int frame,
                               std::vector<float>* flipMap) const {
    BenchPoint point;
    point.frame = frame;
    point.relativeMse = std::max(squaredError(reference, rgb, kEpsilon).relative, 1e-9);
    const measure::BlockEnergy energy =
        measure::blockEnergy(view(reference.mean.pixels), view(rgb), kBlockPx, kBlockTolerance);
    point.energyRatio = energy.meanRatio;
    point.blocksWithin = energy.withinShare;
    const std::vector<float> wanted = displayedAt(reference.mean.pixels, reference.exposureEv100);
    const std::vector<float> shown = displayedAt(rgb, reference.exposureEv100);
    measure::FlipResult flip = measure::flip(view(wanted), view(shown));
    point.flipMean = flip.mean;
    if (flipMap) *flipMap = std::move(flip.map);
    return point;
}

Result<std::unique_ptr<Renderer>> SceneBench::makeRenderer(const MethodResult& method, PictureChoice picture,
                                                           std::uint32_t seed, const Settings& moved) const {
    Settings settings = method.method.settings;
    settings.picture = picture;
    settings.timeStepS = moved.timeStepS;
    settings.lightsSway = moved.lightsSway;
    settings.cameraTurn = moved.cameraTurn;
    applySweep(plan_.sweep, result_.sweepFactor, settings);
    return Renderer::create(scene_, options(method.method.method, settings, seed));
}

std::optional<Error> SceneBench::frame(Renderer& renderer) const {
    if (plan_.stop && plan_.stop->load()) return Error{kStopped};
    return renderer.renderFrame();
}

std::optional<Error> SceneBench::run(MethodResult& into, const Reference& reference, PictureChoice picture,
                                     int repetition) const {
    const bool filtered = picture == PictureChoice::Denoised;
    const auto made = makeRenderer(into, picture, std::uint32_t(repetition) + 1u);
    if (!made) return Error{made.error()};
    Renderer& renderer = *made.value();
    BenchRun run;
    int next = 1;
    for (int i = 1; i <= plan_.frames; ++i) {
        if (const auto error = frame(renderer)) return error;
        if (i != next && i != plan_.frames) continue;
        next = i == next ? 2 * next : next;
        const std::vector<float> rgb = renderer.picture().rgb;
        const bool keep = filtered && repetition == 0 && i <= kShownFrame;
        run.points.push_back(compare(reference, rgb, i, keep ? &into.shownFlip : nullptr));
        if (keep) into.shown = bytesOf(displayedAt(rgb, reference.exposureEv100));
    }
    const FrameStatistics statistics = renderer.statistics();
    run.lightingMs = statistics.directLightingMs;
    run.raysPerPixel = double(statistics.rays) / (double(plan_.frames) * result_.width * result_.height);
    (filtered ? into.filtered : into.raw).push_back(std::move(run));
    if (filtered) into.statistics = statistics;
    return std::nullopt;
}

std::optional<Error> SceneBench::runStill(MethodResult& into, const Reference& reference) const {
    StillFacts facts;
    const std::vector<float> wanted = exposedLight(reference.mean.pixels, reference.exposureEv100);
    for (const PictureChoice picture : {PictureChoice::Raw, PictureChoice::Denoised}) {
        const auto made = makeRenderer(into, picture, 1000u);
        if (!made) return Error{made.error()};
        std::vector<std::vector<float>> light;
        for (int i = 0; i < kSettled + kLookedAt; ++i) {
            if (const auto error = frame(*made.value())) return error;
            if (i < kSettled) continue;
            const std::vector<float> rgb = made.value()->picture().rgb;
            light.push_back(exposedLight(rgb, reference.exposureEv100));
            if (picture == PictureChoice::Raw)
                facts.frameError += squaredError(reference, rgb, kEpsilon).relative / kLookedAt;
        }
        std::vector<measure::ImageView> frames;
        for (const std::vector<float>& rgb : light)
            frames.push_back(view(rgb));
        if (picture == PictureChoice::Raw) {
            const measure::Correlation alike = measure::sampleCorrelation(view(wanted), frames);
            facts.inTime = alike.inTime;
            facts.inSpace = alike.inSpace;
            continue;
        }
        for (std::size_t i = 1; i < frames.size(); ++i)
            facts.flicker += measure::flicker(frames[i - 1], frames[i], view(wanted), kEpsilon) /
                             double(frames.size() - 1);
        facts.hdrFlip = measure::hdrFlip(view(wanted), frames.back()).mean;
    }
    into.still = facts;
    return std::nullopt;
}

} // namespace kilolux::bench
