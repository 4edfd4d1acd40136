// Methods while something happens: lights go on, lights move, the camera turns. Filtered pictures are held
// against what they should have become.
#include "renderer/bench/bench_scene.h"

#include "renderer/document/animation.h"
#include "renderer/measure/flip.h"
#include "renderer/measure/temporal.h"

#include <algorithm>
#include <array>

namespace kilolux::bench {

namespace {

constexpr int kFramesBefore = 12; // that the dark scene is looked at
constexpr int kFramesAfter = 24;
constexpr double kFrameS = 1.0 / 30.0;
constexpr double kSwayShare = 0.02; // of the scene's extent
constexpr double kTurnDegreesPerS = 20.0;

struct ChangeRow {
    Change change;
    std::string_view name;
};
constexpr std::array kChanges = {ChangeRow{Change::LightsOn, "lights-on"},
                                 ChangeRow{Change::LightsMove, "lights-move"},
                                 ChangeRow{Change::CameraTurns, "camera-turns"}};

Scene withHalfMuted(const Scene& scene) {
    Scene dark = scene;
    std::vector<LightNode>& lights = dark.lights.write();
    for (std::size_t i = 0; i < lights.size(); i += 2)
        lights[i].muted = true;
    return dark;
}

Settings movedBy(const Scene& scene, Change change) {
    Settings settings;
    settings.timeStepS = kFrameS;
    if (change == Change::CameraTurns) settings.cameraTurn = kTurnDegreesPerS;
    if (change == Change::LightsMove) {
        const Bounds bounds = worldBounds(scene);
        settings.lightsSway = kSwayShare * glm::length(bounds.max - bounds.min);
    }
    return settings;
}

} // namespace

std::string_view changeName(Change change) {
    return std::find_if(kChanges.begin(), kChanges.end(),
                        [&](const ChangeRow& row) { return row.change == change; })
        ->name;
}

std::optional<Change> changeFromName(std::string_view name) {
    for (const ChangeRow& row : kChanges)
        if (row.name == name) return row.change;
    return std::nullopt;
}

std::optional<Error> SceneBench::switchLightsOn(MethodResult& into, const Reference& atRest,
                                                ChangeResult& change) const {
    const Scene dark = withHalfMuted(scene_);
    const Result<Reference> before = reference(dark, "-dark", into.reference);
    if (!before) return Error{before.error()};
    const auto made = makeRenderer(into, PictureChoice::Denoised, 2000u);
    if (!made) return Error{made.error()};
    Renderer& renderer = *made.value();
    renderer.setLights(dark);
    for (int i = 0; i < kFramesBefore; ++i)
        if (const auto error = frame(renderer)) return error;
    renderer.setLights(scene_);
    const std::vector<float> from = exposedLight(before.value().mean.pixels, atRest.exposureEv100);
    const std::vector<float> to = exposedLight(atRest.mean.pixels, atRest.exposureEv100);
    for (int i = 0; i < kFramesAfter; ++i) {
        if (const auto error = frame(renderer)) return error;
        const std::vector<float> light = exposedLight(renderer.picture().rgb, atRest.exposureEv100);
        change.arrived.push_back(measure::arrivedShare(view(from), view(to), view(light)).value_or(1.0));
    }
    change.lagFrames = measure::lagFrames(change.arrived);
    const BenchPoint end = compare(atRest, renderer.picture().rgb, kFramesAfter);
    change.relativeMse = end.relativeMse;
    change.flipMean = end.flipMean;
    return std::nullopt;
}

std::optional<Error> SceneBench::keepMoving(MethodResult& into, ChangeResult& change) const {
    const Settings moved = movedBy(scene_, change.change);
    Settings end = moved; // where the last frame is, standing still
    end.timeS = (kFramesAfter - 1) * kFrameS;
    end.timeStepS = 0.0;
    const Result<Reference> wanted = reference(into.reference, end);
    if (!wanted) return Error{wanted.error()};
    const auto made = makeRenderer(into, PictureChoice::Denoised, 3000u, moved);
    if (!made) return Error{made.error()};
    for (int i = 0; i < kFramesAfter; ++i)
        if (const auto error = frame(*made.value())) return error;
    const BenchPoint point = compare(wanted.value(), made.value()->picture().rgb, kFramesAfter);
    change.relativeMse = point.relativeMse;
    change.flipMean = point.flipMean;
    return std::nullopt;
}

std::optional<Error> SceneBench::runChange(MethodResult& into, const Reference& atRest, Change change) const {
    ChangeResult result;
    result.change = change;
    const auto error =
        change == Change::LightsOn ? switchLightsOn(into, atRest, result) : keepMoving(into, result);
    if (!error) into.changes.push_back(std::move(result));
    return error;
}

} // namespace kilolux::bench
