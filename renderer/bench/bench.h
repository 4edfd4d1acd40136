// Speed against error: methods of direct lighting over the same scenes, camera and G-buffer, in one run.
// Every method renders still frames without jitter, once through the denoiser and once as the running mean of
// its raw frames; at frames 1, 2, 4, ... the picture is held against the reference that the method converges
// to. From error and time per frame follow the errors at equal time, from error and rays those at equal rays.
#pragma once

#include "renderer/renderer.h"

#include <atomic>
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
    std::string label;  // as asked for: "restir:reuseWeights=rays"
    std::string method; // of Renderer::methods()
    Settings settings;
};

// What grows from one step to the next of a scaling run (sweep.h).
enum class Sweep { None, Lights, Resolution, Triangles, Rays };

// What happens to a scene while it is looked at (bench_changes.cpp).
enum class Change {
    LightsOn,    // every second light is dark at first
    LightsMove,  // all swing, and animations run
    CameraTurns, // and uncovers what it did not see
};

struct BenchPlan {
    std::vector<BenchScene> scenes;
    std::vector<BenchMethod> methods; // the first is what the others are compared with
    int width = 320;                  // pixels
    int height = 180;
    int frames = 32;
    int repetitions = 3;
    int referenceFrames = 64;         // of 4 rays per light each
    std::filesystem::path references; // folder that keeps references for other runs; empty: none
    std::vector<double> budgetsMs;    // of direct lighting; empty: 1, 4 and 16 frames of the first method
    std::vector<double> budgetsRays = {1.0, 4.0, 16.0}; // per pixel
    Sweep sweep = Sweep::None;
    std::vector<Change> changes;
    const std::atomic<bool>* stop = nullptr; // set: the run ends at the next frame
    std::string command;                     // as typed, for the report
    std::string date;                        // ISO 8601
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

// Of the last frames of a picture that stands still.
struct StillFacts {
    double frameError = 0.0; // relative MSE of one raw frame
    double flicker = 0.0;    // of the filtered picture (measure/temporal.h)
    double inTime = 0.0;     // correlation of raw samples
    double inSpace = 0.0;
    double hdrFlip = 0.0; // of the filtered picture
};

struct ChangeResult {
    Change change = Change::LightsOn;
    std::vector<double> arrived;  // LightsOn: share of the change, frame by frame from the switch on
    std::optional<int> lagFrames; // until 90 % of it is there to stay; others: nothing
    double relativeMse = 0.0;     // of the last frame
    double flipMean = 0.0;
};

struct MethodResult {
    BenchMethod method;
    std::string reference;          // "split" or "true"
    std::vector<BenchRun> filtered; // a repetition each
    std::vector<BenchRun> raw;
    std::optional<StillFacts> still;
    std::vector<ChangeResult> changes;
    FrameStatistics statistics;       // of the last filtered run
    std::vector<std::uint8_t> shown;  // sRGB: the filtered picture after kShownFrame, of the first repetition
    std::vector<float> shownFlip;     // its FLIP map
    std::optional<std::string> error; // why there is nothing
};
inline constexpr int kShownFrame = 8;

struct SceneResult {
    BenchScene scene;
    std::string camera;
    int width = 0, height = 0; // pixels
    double sweepFactor = 1.0;  // of what the plan's sweep changes
    double exposureEv100 = 0.0;
    double modelGap = 0.0; // relative MSE of 'split' against 'true'
    std::vector<std::uint8_t> referenceShown;
    std::vector<double> budgetsMs;
    std::vector<MethodResult> methods;
};

struct BenchResult {
    BenchPlan plan;
    std::string device, driver;
    std::vector<SceneResult> scenes; // one per step of a sweep; fewer than planned when cancelled
    bool cancelled = false;
};

struct BenchProgress {
    std::string doing;
    int done = 0, all = 0; // steps of about equal length
};
// False stops the run; what is done is kept, and of a scene what all its methods have.
using OnProgress = std::function<bool(const BenchProgress&)>;

// What is wrong with the plan's scenes before anything is rendered: a file that cannot be read, a camera that
// it does not have.
std::optional<Error> checkScenes(const BenchPlan& plan);

// Errors: no usable device, a scene that cannot be read. A method that cannot run tells so in its result.
Result<BenchResult> runBench(const BenchPlan& plan, const OnProgress& progress);

nlohmann::ordered_json benchJson(const BenchResult& result); // bench.json: plan, points, times, ratios

// One self-contained page: no links to other files or sites.
std::string benchHtml(const BenchResult& result);

// The same scenes and methods of an older JSON: a line each with the ratios of error at equal time and of
// time.
Result<std::string> compareWithOlder(const BenchResult& result, const nlohmann::ordered_json& older);

} // namespace kilolux::bench
