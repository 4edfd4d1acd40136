// Speed against error: methods of direct lighting over the same scenes, camera and G-buffer, in one run.
// Every method renders still frames without jitter, once through the denoiser and once as the running mean of
// its raw frames; at frames 1, 2, 4, ... the picture is held against the reference that the method converges
// to. From error and time per frame follow the errors at equal time, from error and rays those at equal rays.
#pragma once

#include "renderer/renderer.h"

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace kilolux::bench {

struct BenchScene {
    std::filesystem::path file;
    std::string camera; // empty: 'wide' where there is one, else the first
};

struct BenchMethod {
    std::string label;  // as asked for: "restir:reuseUnbiased=true"
    std::string method; // of Renderer::methods()
    Settings settings;
};

struct BenchPlan {
    std::vector<BenchScene> scenes;
    std::vector<BenchMethod> methods; // the first is what the others are compared with
    int width = 320;                  // pixels
    int height = 180;
    int frames = 32;
    int repetitions = 3;
    int referenceFrames = 64;      // of 4 rays per light each
    std::vector<double> budgetsMs; // of direct lighting; empty: 1, 4 and 16 frames of the first method
    std::string command;           // as typed, for the report
    std::string date;              // ISO 8601
};

// "NAME" or "NAME:KEY=VALUE:KEY=VALUE". Errors: unknown methods and settings.
Result<BenchMethod> parseMethod(std::string_view text);

// Of a picture after so many frames. Light is exposed; see measure/metrics.h.
struct BenchPoint {
    int frame = 0;
    double relativeMse = 0.0; // epsilon 0.01; free of the reference's own noise
    double energyRatio = 0.0;
    double blocksWithin = 0.0; // share of 16 x 16 blocks whose energy is within 2 %
    double flipMean = 0.0;
};

struct BenchRun {
    std::vector<BenchPoint> points;
    double lightingMs = 0.0; // median per frame: culling to denoising, or the method's own lighting
    double raysPerPixel = 0.0;
};

struct MethodResult {
    BenchMethod method;
    std::string reference;          // "split" or "true"
    std::vector<BenchRun> filtered; // a repetition each
    std::vector<BenchRun> raw;
    FrameStatistics statistics;       // of the last filtered run
    std::vector<std::uint8_t> shown;  // sRGB: the filtered picture after kShownFrame, of the first repetition
    std::vector<float> shownFlip;     // its FLIP map
    std::optional<std::string> error; // why there is nothing
};
inline constexpr int kShownFrame = 8;

struct SceneResult {
    BenchScene scene;
    std::string camera;
    double exposureEv100 = 0.0;
    double modelGap = 0.0; // relative MSE of 'split' against 'true'
    std::vector<std::uint8_t> referenceShown;
    std::vector<double> budgetsMs;
    std::vector<MethodResult> methods;
};

struct BenchResult {
    BenchPlan plan;
    std::string device, driver;
    std::vector<SceneResult> scenes; // fewer than planned when cancelled
    bool cancelled = false;
};

struct BenchProgress {
    std::string doing;
    int done = 0, all = 0; // steps of about equal length
};
// False stops the run after the present step; what is done is kept.
using OnProgress = std::function<bool(const BenchProgress&)>;

// Errors: no usable device, a scene that cannot be read. A method that cannot run tells so in its result.
Result<BenchResult> runBench(const BenchPlan& plan, const OnProgress& progress);

nlohmann::ordered_json benchJson(const BenchResult& result);

// One self-contained page: no links to other files or sites.
std::string benchHtml(const BenchResult& result);

// The same scenes and methods of an older JSON: a line each with the ratios of error at equal time and of
// time.
Result<std::string> compareWithOlder(const BenchResult& result, const nlohmann::ordered_json& older);

} // namespace kilolux::bench
