// The parts of bench_loop that measure pictures. They do not depend on the machine's load.
#include "tests/bench/loop_parts.h"

#include "renderer/measure/flip.h"
#include "renderer/measure/metrics.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>

namespace kilolux::test {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kBlockPx = 16;
constexpr double kBlockTolerance = 0.02;

Picture pictureAfter(const LoopScene& scene, const Shot& shot, int frames) {
    const std::unique_ptr<Renderer> renderer = makeRenderer(scene, shot);
    for (int frame = 0; frame < frames; ++frame)
        renderFrame(*renderer);
    return renderer->picture();
}

void keepPicture(const LoopOptions& options, const std::string& name, int width, int height,
                 const std::vector<float>& rgb) {
    if (options.pictures.empty()) return;
    std::filesystem::create_directories(options.pictures);
    const std::optional<Error> error =
        writeExr(options.pictures / (name + ".exr"), {width, height, 3, rgb}, ExrDepth::Float);
    if (error) throw std::runtime_error(error->message);
}

// One row of the table: what `test` shows against what `reference` shows, and their energy. `goals`: whether
// this is a row that must reach something.
Json compare(const std::string& name, const FloatImage& reference, const FloatImage& referenceShown,
             const measure::ImageView& test, const FloatImage& testShown, bool goals) {
    const measure::FlipResult flip = measure::flip(viewOf(referenceShown), viewOf(testShown));
    const measure::BlockEnergy energy =
        measure::blockEnergy(viewOf(reference), test, kBlockPx, kBlockTolerance);
    const bool met = flip.mean <= 0.08 && flip.percentile95 <= 0.25 && energy.withinShare >= 0.95;
    fmt::print("  {:<26} {:>9.4f} {:>9.4f} {:>11.1f} % {:>9.4f} {:>9.3f} ({}, {})  {}\n", name, flip.mean,
               flip.percentile95, 100.0 * energy.withinShare, energy.meanRatio, energy.worstRatio,
               energy.worstX, energy.worstY, goals ? (met ? "met" : "missed") : "");
    return {{"pair", name},
            {"flipMean", flip.mean},
            {"flipPercentile95", flip.percentile95},
            {"blocksWithin", energy.withinShare},
            {"energyRatio", energy.meanRatio},
            {"worstBlock", energy.worstRatio},
            {"worstX", energy.worstX},
            {"worstY", energy.worstY}};
}

} // namespace

Json benchQuality(const LoopOptions& options) {
    const int frames = options.frames > 0 ? options.frames : 64;
    Json json = Json::array();
    for (const LoopScene& scene : openScenes(options, {"gallery", "night_market"})) {
        Shot shot = makeShot(options, 480, 270);
        shot.method = "split";
        const Reference split = renderReference(options, scene, shot);
        shot.method = "true";
        const Reference truth = renderReference(options, scene, shot);
        const double ev100 = split.exposureEv100;
        keepPicture(options, scene.name + "-split", shot.width, shot.height, split.mean.pixels);
        keepPicture(options, scene.name + "-true", shot.width, shot.height, truth.mean.pixels);
        const FloatImage splitShown = displayed(split.mean, ev100), truthShown = displayed(truth.mean, ev100);
        fmt::print(
            "  {} {}, {}x{}, {} still frames against {} of the reference; EV100 {:g}, curve neutral, {:g} "
            "pixels per degree\n",
            scene.name, scene.camera, shot.width, shot.height, frames, options.referenceFrames, ev100,
            measure::kDefaultPixelsPerDegree);
        fmt::print("  {:<26} {:>9} {:>9} {:>13} {:>9} {:>9}\n", "", "FLIP mean", "95th", "blocks 2 %",
                   "energy", "worst block");
        Json rows = Json::array();
        const std::pair<PictureChoice, const char*> choices[] = {
            {PictureChoice::Viewport, "viewport"},
            {PictureChoice::Denoised, "denoised"},
            {PictureChoice::Mean, "mean"}}; // without filters: what is off here is the sampling's doing
        for (const auto& [choice, name] : choices) {
            Shot test = makeShot(options, 480, 270);
            test.settings.picture = choice;
            const Picture picture = pictureAfter(scene, test, frames);
            keepPicture(options, fmt::format("{}-{}", scene.name, name), test.width, test.height,
                        picture.rgb);
            rows.push_back(compare(fmt::format("{} : split", name), split.mean, splitShown, viewOf(picture),
                                   displayed(picture), choice != PictureChoice::Mean));
        }
        rows.push_back(
            compare("split : true (model)", truth.mean, truthShown, viewOf(split.mean), splitShown, false));
        rows.push_back(compare("half : half of split", split.halves[0], displayed(split.halves[0], ev100),
                               viewOf(split.halves[1]), displayed(split.halves[1], ev100), false));
        json.push_back({{"scene", scene.name},
                        {"width", shot.width},
                        {"height", shot.height},
                        {"frames", frames},
                        {"referenceFrames", options.referenceFrames},
                        {"exposureEv100", ev100},
                        {"toneMap", "neutral"},
                        {"pixelsPerDegree", measure::kDefaultPixelsPerDegree},
                        {"rows", rows}});
    }
    fmt::print(
        "  goal: mean 0.08, 95th percentile 0.25, 95 % of the blocks of {} x {} pixels within 2 %; the last "
        "row is twice the reference's own noise\n",
        kBlockPx, kBlockPx);
    return json;
}

// --- Guiding ---------------------------------------------------------------------------------------------

namespace {

const std::vector<std::string> kHiddenLayouts = {"hidden_lights_1", "hidden_lights_2", "hidden_lights_3",
                                                 "hidden_lights_4", "hidden_lights_5"};

std::vector<std::string> withLayouts(std::vector<std::string> names) {
    names.insert(names.begin(), kHiddenLayouts.begin(), kHiddenLayouts.end());
    return names;
}

// Frames of which errors are averaged: the lists have settled. A raw frame may hold one firefly that
// outweighs all others, so those of guiding are many.
constexpr int kFirstFrame = 16, kLastFrame = 32, kLastRawFrame = 112;

// Of frames [from, to) of one run.
std::vector<SquaredError> errorsOver(const LoopScene& scene, const Shot& shot, const Reference& reference,
                                     int from, int to) {
    const std::unique_ptr<Renderer> renderer = makeRenderer(scene, shot);
    std::vector<SquaredError> errors;
    for (int frame = 0; frame < to; ++frame) {
        renderFrame(*renderer);
        if (frame >= from) errors.push_back(squaredError(reference, renderer->picture()));
    }
    return errors;
}

// A ratio of means over frames, and its standard error as if frames were independent: what is within two of 1
// says nothing.
struct Ratio {
    double value = 0.0;
    double error = 0.0;
    std::string text() const { return fmt::format("{:.3f} +- {:.3f}", value, error); }
};

Ratio ratioOf(const std::vector<SquaredError>& above, const std::vector<SquaredError>& below,
              double SquaredError::*which) {
    double relativeVariance = 0.0, means[2] = {};
    for (int i = 0; i < 2; ++i) {
        const std::vector<SquaredError>& errors = i == 0 ? above : below;
        const double count = double(errors.size());
        double squares = 0.0;
        for (const SquaredError& error : errors)
            means[i] += error.*which / count;
        for (const SquaredError& error : errors)
            squares += std::pow(error.*which - means[i], 2.0);
        relativeVariance += squares / (count * std::max(count - 1.0, 1.0) * means[i] * means[i]);
    }
    const double value = means[0] / means[1];
    return {value, std::abs(value) * std::sqrt(relativeVariance)};
}

// Errors are compared on one G-buffer: without jitter.
Shot stillShot(const LoopOptions& options, PictureChoice picture, int width = 320, int height = 180) {
    Shot shot = makeShot(options, width, height);
    shot.settings.jitter = false;
    shot.settings.picture = picture;
    return shot;
}

Reference stillReference(const LoopOptions& options, const LoopScene& scene, Shot shot) {
    shot.settings.picture = PictureChoice::Viewport;
    shot.method = "split";
    return renderReference(options, scene, shot);
}

bool isLayout(const std::string& name) {
    return std::find(kHiddenLayouts.begin(), kHiddenLayouts.end(), name) != kHiddenLayouts.end();
}

} // namespace

Json benchGuiding(const LoopOptions& options) {
    const int frames = options.frames > 0 ? options.frames : kLastRawFrame;
    Json rows = Json::array();
    std::vector<double> layouts;
    double masksHalfHidden = 0.0, worst = 0.0;
    fmt::print(
        "  squared error of raw frames {} to {} against 'split', on over off, with standard errors\n  {:<18} "
        "{:>16} {:>16} {:>16} {:>16}\n",
        std::min(kFirstFrame, frames - 1) + 1, frames, "", "guiding", "masks", "guiding, rel.",
        "masks, rel.");
    for (const LoopScene& scene :
         openScenes(options, withLayouts({"half_hidden", "gallery", "night_market", "cornell"}))) {
        Shot on = stillShot(options, PictureChoice::Raw, 160, 90), noGuiding = on, noMasks = on;
        const Reference reference = stillReference(options, scene, on);
        noGuiding.settings.guiding = false;
        noMasks.settings.areaMasks = false;
        const int from = std::min(kFirstFrame, frames - 1);
        const std::vector<SquaredError> all = errorsOver(scene, on, reference, from, frames);
        const std::vector<SquaredError> unguided = errorsOver(scene, noGuiding, reference, from, frames);
        const std::vector<SquaredError> unmasked = errorsOver(scene, noMasks, reference, from, frames);
        const Ratio guiding = ratioOf(all, unguided, &SquaredError::absolute);
        const Ratio masks = ratioOf(all, unmasked, &SquaredError::absolute);
        const Ratio guidingRelative = ratioOf(all, unguided, &SquaredError::relative);
        const Ratio masksRelative = ratioOf(all, unmasked, &SquaredError::relative);
        fmt::print("  {:<18} {:>16} {:>16} {:>16} {:>16}\n", scene.name, guiding.text(), masks.text(),
                   guidingRelative.text(), masksRelative.text());
        std::fflush(stdout);
        if (isLayout(scene.name)) layouts.push_back(guiding.value);
        if (scene.name == "half_hidden") masksHalfHidden = masks.value;
        worst = std::max({worst, guiding.value, masks.value});
        rows.push_back({{"scene", scene.name},
                        {"guiding", guiding.value},
                        {"guidingError", guiding.error},
                        {"masks", masks.value},
                        {"masksError", masks.error},
                        {"guidingRelative", guidingRelative.value},
                        {"masksRelative", masksRelative.value}});
    }
    if (!layouts.empty())
        fmt::print("  guiding, median of {} layouts: {}\n", layouts.size(),
                   withGoal(medianOf(layouts), Goal::AtMost, 0.5));
    if (masksHalfHidden > 0.0)
        fmt::print("  masks, half of a large light hidden: {}\n",
                   withGoal(masksHalfHidden, Goal::AtMost, 0.8));
    fmt::print("  worst of all: {}\n", withGoal(worst, Goal::AtMost, 1.05));
    return {{"scenes", rows},
            {"layoutsMedian", medianOf(layouts)},
            {"masksHalfHidden", masksHalfHidden},
            {"worst", worst}};
}

// --- Rays ------------------------------------------------------------------------------------------------

Json benchRays(const LoopOptions& options) {
    const int frames = options.frames > 0 ? options.frames : 16;
    Json rows = Json::array();
    fmt::print("  means over {} frames from the first; useful rays are those that met their light\n"
               "  {:<18} {:>7} {:>9} {:>11} {:>10} {:>10} {:>10} {:>9} {:>9}\n",
               frames, "", "lights", "in range", "candidates", "rays/px", "useful/px", "missed", "on list",
               "no room");
    for (const LoopScene& scene :
         openScenes(options, withLayouts({"half_hidden", "gallery", "night_market", "cornell"}))) {
        const std::unique_ptr<Renderer> renderer = makeRenderer(scene, makeShot(options, 320, 180));
        for (int frame = 0; frame < frames; ++frame)
            renderFrame(*renderer);
        const FrameStatistics s = renderer->statistics();
        fmt::print("  {:<18} {:>7} {:>9.1f} {:>11.2f} {:>10.3f} {:>10.3f} {:>8.2f} % {:>9.2f} {:>9.3f}\n",
                   scene.name, s.lights, s.lightsInRangeMean, s.candidatesMean, s.raysPerPixelMean,
                   s.usefulRaysPerPixelMean, 100.0 * s.missedShare, s.listLengthMean, s.listOverflowMean);
        rows.push_back({{"scene", scene.name},
                        {"lights", s.lights},
                        {"lightsInRange", s.lightsInRangeMean},
                        {"candidates", s.candidatesMean},
                        {"raysPerPixel", s.raysPerPixelMean},
                        {"usefulRaysPerPixel", s.usefulRaysPerPixelMean},
                        {"missedShare", s.missedShare},
                        {"listLength", s.listLengthMean},
                        {"listOverflow", s.listOverflowMean}});
    }
    return rows;
}

// --- Noise -----------------------------------------------------------------------------------------------

Json benchNoise(const LoopOptions& options) {
    const int frames = options.frames > 0 ? options.frames : kLastFrame;
    constexpr int kEarlyFrames = 4;
    Json rows = Json::array();
    const std::string earlyText = fmt::format("1 to {}", kEarlyFrames);
    const std::string lateText = fmt::format("{} to {}", std::min(kFirstFrame, frames - 1) + 1, frames);
    fmt::print(
        "  squared error of denoised frames against 'split', blue over white noise, frames by number; behind "
        "it of relative errors\n  {:<18} {:>14} {:>14} {:>12} {:>13} {:>13} {:>13}\n",
        "", "1", earlyText, lateText, "rel. 1", "rel. " + earlyText, "rel. " + lateText);
    for (const LoopScene& scene :
         openScenes(options, withLayouts({"half_hidden", "gallery", "night_market", "cornell"}))) {
        const Reference reference =
            stillReference(options, scene, stillShot(options, PictureChoice::Viewport));
        std::vector<SquaredError> errors[2]; // per frame; blue, white
        for (int noise = 0; noise < 2; ++noise) {
            Shot shot = stillShot(options, PictureChoice::Denoised);
            shot.settings.antiAlias = false; // its history would hide what the denoiser leaves
            shot.settings.noise = noise == 0 ? Noise::Blue : Noise::White;
            const std::unique_ptr<Renderer> renderer = makeRenderer(scene, shot);
            for (int frame = 0; frame < frames; ++frame) {
                renderFrame(*renderer);
                errors[noise].push_back(squaredError(reference, renderer->picture()));
            }
        }
        const auto ratio = [&](int from, int to) {
            SquaredError blue, white;
            for (int frame = from; frame < std::min(to, frames); ++frame) {
                blue += errors[0][std::size_t(frame)];
                white += errors[1][std::size_t(frame)];
            }
            return SquaredError{blue.absolute / white.absolute, blue.relative / white.relative};
        };
        const SquaredError first = ratio(0, 1), early = ratio(0, kEarlyFrames);
        const SquaredError late = ratio(std::min(kFirstFrame, frames - 1), frames);
        fmt::print("  {:<18} {:>14.3f} {:>14.3f} {:>12.3f} {:>13.3f} {:>13.3f} {:>13.3f}\n", scene.name,
                   first.absolute, early.absolute, late.absolute, first.relative, early.relative,
                   late.relative);
        rows.push_back({{"scene", scene.name},
                        {"frame1", first.absolute},
                        {"early", early.absolute},
                        {"settled", late.absolute},
                        {"frame1Relative", first.relative},
                        {"earlyRelative", early.relative},
                        {"settledRelative", late.relative}});
    }
    return rows;
}

} // namespace kilolux::test
