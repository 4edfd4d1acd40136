// The parts of bench_loop that measure time: always interleaved, frame by frame, so that what else the
// machine does falls on both sides.
#include "tests/bench/loop_parts.h"

#include "renderer/gpu/commands.h"
#include "renderer/gpu/pass.h"
#include "shaders/shared/sampling.h"

#include <algorithm>
#include <fmt/format.h>
#include <thread>

namespace kilolux::test {

namespace {

using Json = nlohmann::ordered_json;

struct Timed {
    std::unique_ptr<Renderer> renderer;
    std::vector<double> wallMs, cpuMs;

    // The first frames compile, and begin without lists: they are not counted in what is timed here.
    void runFrame(bool counted) {
        const FrameTime time = renderFrame(*renderer);
        if (!counted) return;
        wallMs.push_back(time.wallMs);
        cpuMs.push_back(time.cpuMs);
    }
};

double passMs(const FrameStatistics& statistics, std::string_view name) {
    for (const PassTiming& pass : statistics.passes)
        if (pass.name == name) return pass.medianMs;
    return 0.0;
}

// Lights in range are counted in the first frame alone, for statistics.
double frameMs(const FrameStatistics& statistics) {
    double ms = statistics.frameMs;
    for (const PassTiming& pass : statistics.passes)
        if (pass.name == "count_lights") ms -= pass.perFrameMs;
    return ms;
}

constexpr int kWarmFrames = 2;

void runInterleaved(std::vector<Timed>& runs, int frames) {
    for (int frame = 0; frame < kWarmFrames + frames; ++frame)
        for (Timed& run : runs)
            run.runFrame(frame >= kWarmFrames);
}

// Pixels that show a surface and may sample, of one frame.
double surfacePixels(const FrameStatistics& s) {
    return s.raysPerPixelMean > 0.0 ? double(s.rays) / s.raysPerPixelMean / s.frames : 0.0;
}

void printPasses(const FrameStatistics& all, const FrameStatistics& few) {
    std::vector<std::string> names;
    for (const FrameStatistics* s : {&all, &few})
        for (const PassTiming& pass : s->passes)
            if (std::find(names.begin(), names.end(), pass.name) == names.end()) names.push_back(pass.name);
    fmt::print("  {:<24} {:>12} {:>12}  median ms\n", "pass", "all-lights", "stochastic");
    for (const std::string& name : names)
        fmt::print("  {:<24} {:>12.3f} {:>12.3f}\n", name, passMs(all, name), passMs(few, name));
}

Json passesJson(const FrameStatistics& statistics) {
    Json json = Json::object();
    for (const PassTiming& pass : statistics.passes)
        json[pass.name] = pass.medianMs;
    return json;
}

} // namespace

Json benchCost(const LoopOptions& options) {
    Json json = Json::array();
    for (const LoopScene& scene : openScenes(options, {"night_market"})) {
        std::vector<Timed> runs(2);
        Shot shot = makeShot(options, 640, 360);
        for (std::size_t i = 0; i < 2; ++i) {
            shot.method = i == 0 ? "all-lights" : "stochastic";
            runs[i].renderer = makeRenderer(scene, shot);
        }
        runInterleaved(runs, options.frames > 0 ? options.frames : 7);
        const FrameStatistics all = runs[0].renderer->statistics(), few = runs[1].renderer->statistics();
        const double m = all.lightsInRangeMean, ratio = all.directLightingMs / few.directLightingMs;
        const double timers = frameMs(all) / frameMs(few);
        const double wall = medianOf(runs[0].wallMs) / medianOf(runs[1].wallMs);
        const double cpu = medianOf(runs[0].cpuMs) / medianOf(runs[1].cpuMs);
        fmt::print("  {} {}, {}x{}, EV100 {:g}, settings {:016x}: m = {:.1f} of {} lights in range\n",
                   scene.name, scene.camera, shot.width, shot.height, few.exposureEv100,
                   settingsHash(shot.settings), m, all.lights);
        printPasses(all, few);
        fmt::print("  direct lighting {:.1f} / {:.1f} ms = {:.2f}; over m {}\n", all.directLightingMs,
                   few.directLightingMs, ratio, withGoal(ratio / m, Goal::AtLeast, 0.4));
        fmt::print(
            "  whole frames: by timers {:.1f} / {:.1f} ms = {:.3f}, by wall {:.1f} / {:.1f} ms = {:.3f}, by "
            "processor {:.3f}\n",
            frameMs(all), frameMs(few), timers, medianOf(runs[0].wallMs), medianOf(runs[1].wallMs), wall,
            cpu);
        fmt::print("  wall off the timers by {}\n",
                   withGoal(std::abs(wall / timers - 1.0), Goal::AtMost, 0.1));
        json.push_back({{"scene", scene.name},
                        {"width", shot.width},
                        {"height", shot.height},
                        {"exposureEv100", few.exposureEv100},
                        {"settingsHash", fmt::format("{:016x}", settingsHash(shot.settings))},
                        {"lights", all.lights},
                        {"lightsInRange", m},
                        {"directLightingRatio", ratio},
                        {"ratioOverLights", ratio / m},
                        {"frameRatioTimers", timers},
                        {"frameRatioWall", wall},
                        {"frameRatioProcessor", cpu},
                        {"passesAllLights", passesJson(all)},
                        {"passesStochastic", passesJson(few)}});
    }
    return json;
}

// --- Lists -----------------------------------------------------------------------------------------------

namespace {

// The copy that visible_list is held against, on images and lists of its own.
class ListCopy {
  public:
    ListCopy(std::uint32_t width, std::uint32_t height, std::uint32_t rays)
        : resources_(device_),
          pass_(resources_, "list_copy",
                {{"samples"}, {"rayResults"}, {"visibleLists"}, {"VisibleListsOut", gpu::Access::Write}},
                "../tests/bench/list_copy.comp"),
          push_{{width, height},
                {(width + 7) / 8, (height + 7) / 8},
                device_.isCpu() ? std::max(1u, std::thread::hardware_concurrency()) : 1u,
                rays} {
        gpu::ImageDesc image{.name = "samples", .format = VK_FORMAT_R32G32B32A32_UINT};
        image.width = width;
        image.height = height;
        image.layers = rays;
        image.arrayed = true;
        samples_ = gpu::Image(device_, image);
        image.name = "rayResults";
        image.format = VK_FORMAT_R32_UINT;
        results_ = gpu::Image(device_, image);
        gpu::BufferDesc lists{"visibleLists", tiles() * shared::LIST_TEXELS * 8};
        lists.usage |= VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
        lists.texelFormat = VK_FORMAT_R32G32_UINT;
        before_ = gpu::Buffer(device_, lists);
        after_ = gpu::Buffer(device_, lists);
        gpu::Commands commands(device_);
        commands.clearColor(samples_, {});
        commands.clearColor(results_, {});
        commands.fillBuffer(before_, 0);
        commands.submitAndWait();
    }

    void run() {
        gpu::Commands commands(device_, &times_);
        pass_.record(commands, {},
                     {{"samples", samples_},
                      {"rayResults", results_},
                      {"visibleLists", before_},
                      {"VisibleListsOut", after_}},
                     push_, {std::uint32_t(tiles())});
        commands.submitAndWait();
    }

    double ms() const { return medianOf(times_.entries().front().ms); }
    double mebibytes() const {
        const double pixels = double(push_.size.x) * push_.size.y * push_.rays;
        return (pixels * 20.0 + double(tiles()) * shared::LIST_TEXELS * 16.0) / (1 << 20);
    }

  private:
    std::size_t tiles() const { return std::size_t(push_.tiles.x) * push_.tiles.y; }

    struct Push {
        glm::uvec2 size, tiles;
        std::uint32_t chunks, rays;
    };
    gpu::Device device_;
    gpu::PassResources resources_;
    gpu::ComputePass pass_;
    Push push_;
    gpu::Image samples_, results_;
    gpu::Buffer before_, after_;
    gpu::PassTimes times_;
};

} // namespace

Json benchLists(const LoopOptions& options) {
    Json json = Json::array();
    for (const LoopScene& scene : openScenes(options, {"night_market", "gallery"})) {
        const Shot shot = makeShot(options, 640, 360);
        const std::unique_ptr<Renderer> renderer = makeRenderer(scene, shot);
        const std::uint32_t rays = std::uint32_t(std::max(1.0, std::round(shot.settings.raysPerPixel)));
        ListCopy copy(std::uint32_t(shot.width), std::uint32_t(shot.height), rays);
        const int frames = options.frames > 0 ? options.frames : 24;
        for (int frame = 0; frame < frames; ++frame) {
            renderFrame(*renderer);
            copy.run();
        }
        const FrameStatistics statistics = renderer->statistics();
        const double ms = passMs(statistics, "visible_list");
        fmt::print("  {}, {}x{}: visible_list {:.3f} ms, copy of its {:.1f} MiB {:.3f} ms: {}; {:.1f} "
                   "entries a tile, "
                   "{:.2f} without room\n",
                   scene.name, shot.width, shot.height, ms, copy.mebibytes(), copy.ms(),
                   withGoal(ms / copy.ms(), Goal::AtMost, 2.0), statistics.listLengthMean,
                   statistics.listOverflowMean);
        json.push_back({{"scene", scene.name},
                        {"width", shot.width},
                        {"height", shot.height},
                        {"visibleListMs", ms},
                        {"copyMs", copy.ms()},
                        {"mebibytes", copy.mebibytes()},
                        {"ratio", ms / copy.ms()},
                        {"listLength", statistics.listLengthMean}});
    }
    return json;
}

// --- Scaling ---------------------------------------------------------------------------------------------

namespace {

// Directional lights stay: they are candidates of their own.
LoopScene everyKthLight(const LoopScene& scene, std::size_t k) {
    LoopScene result = scene;
    std::vector<LightNode> kept;
    std::size_t local = 0;
    for (const LightNode& light : scene.scene.lights) {
        const bool directional = scene.scene.lightDefs[std::size_t(light.def)].type == LightType::Directional;
        if (directional || local++ % k == 0) kept.push_back(light);
    }
    result.scene.lights = std::move(kept);
    return result;
}

// Least squares: y = slope x + intercept.
struct Line {
    double slope = 0.0, intercept = 0.0;
};
Line fitLine(const std::vector<double>& x, const std::vector<double>& y) {
    const double n = double(x.size());
    double sumX = 0.0, sumY = 0.0, sumXx = 0.0, sumXy = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        sumX += x[i];
        sumY += y[i];
        sumXx += x[i] * x[i];
        sumXy += x[i] * y[i];
    }
    const double slope = (n * sumXy - sumX * sumY) / std::max(n * sumXx - sumX * sumX, 1e-30);
    return {slope, (sumY - slope * sumX) / n};
}

} // namespace

Json benchScaling(const LoopOptions& options) {
    Json json = Json::array();
    for (const LoopScene& scene : openScenes(options, {"night_market"})) {
        constexpr std::size_t kSteps[] = {1, 2, 4, 8, 16};
        const Shot shot = makeShot(options, 640, 360);
        std::vector<Timed> runs(std::size(kSteps));
        for (std::size_t i = 0; i < runs.size(); ++i)
            runs[i].renderer = makeRenderer(everyKthLight(scene, kSteps[i]), shot);
        runInterleaved(runs, options.frames > 0 ? options.frames : 15);
        fmt::print("  {}, {}x{}\n  {:>3} {:>7} {:>9} {:>11} {:>16} {:>12} {:>12} {:>14}\n", scene.name,
                   shot.width, shot.height, "k", "lights", "in range", "candidates", "sample_lights ms",
                   "direct ms", "frame ms", "processor ms");
        std::vector<double> work, ms, direct;
        Json lines = Json::array();
        for (std::size_t i = 0; i < runs.size(); ++i) {
            const FrameStatistics s = runs[i].renderer->statistics();
            work.push_back(s.candidatesMean * surfacePixels(s));
            ms.push_back(passMs(s, "sample_lights"));
            direct.push_back(s.directLightingMs);
            fmt::print("  {:>3} {:>7} {:>9.1f} {:>11.2f} {:>16.3f} {:>12.2f} {:>12.2f} {:>14.2f}\n",
                       kSteps[i], s.lights, s.lightsInRangeMean, s.candidatesMean, ms.back(), direct.back(),
                       frameMs(s), medianOf(runs[i].cpuMs));
            lines.push_back({{"k", kSteps[i]},
                             {"lights", s.lights},
                             {"lightsInRange", s.lightsInRangeMean},
                             {"candidates", s.candidatesMean},
                             {"sampleLightsMs", ms.back()},
                             {"directLightingMs", direct.back()}});
        }
        const Line line = fitLine(work, ms);
        const double growth = direct.front() / direct.back();
        // design.md: 2.8 to 3.8 ns per candidate and pixel on lavapipe with two threads.
        fmt::print("  per candidate and pixel {} ns, the rest {:.2f} ms a frame\n",
                   withGoal(1e6 * line.slope, Goal::AtMost, 7.0), line.intercept);
        fmt::print("  direct lighting from the fewest to all lights grows {} times\n",
                   withGoal(growth, Goal::AtMost, 1.8));
        json.push_back({{"scene", scene.name},
                        {"width", shot.width},
                        {"height", shot.height},
                        {"lines", lines},
                        {"nsPerCandidate", 1e6 * line.slope},
                        {"interceptMs", line.intercept},
                        {"growth", growth}});
    }
    return json;
}

} // namespace kilolux::test
