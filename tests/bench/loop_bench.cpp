// Measures stochastic direct lighting against what it set out to reach: `bench_loop PART... [--json FILE]`,
// parts as `bench_loop --help` lists them, 'all' for all. Prints tables with the goals beside the figures;
// never passes or fails on them. Times are of interleaved runs in one process: on a busy machine only their
// ratios say anything.
#include "tests/bench/loop_parts.h"

#include "renderer/gpu/device.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <thread>

namespace kilolux::test {

namespace {

using Json = nlohmann::ordered_json;

struct Part {
    const char* name;
    const char* help;
    Json (*run)(const LoopOptions&);
};

constexpr Part kParts[] = {
    {"cost", "all-lights against stochastic: time per light in range, passes, wall time", benchCost},
    {"lists", "visible_list against a copy of the same bytes", benchLists},
    {"scaling", "time over the number of lights: per candidate and pixel, and the rest", benchScaling},
    {"quality", "64 still frames against the references: FLIP and energy per block", benchQuality},
    {"guiding", "error with visible lists and area masks over the error without", benchGuiding},
    {"rays", "useful rays per pixel, failed reprojections, list lengths", benchRays},
    {"noise", "error of denoised frames, blue over white noise", benchNoise},
    {"half", "lights chosen at half resolution: error, and contrast of shadows, against full", benchHalf},
};

double loadAverage() {
    double load = 0.0;
    return getloadavg(&load, 1) == 1 ? load : 0.0;
}

// What every figure below was measured on. Exposure and size are told by each part.
Json printHeading(const LoopOptions& options) {
    const gpu::Device device;
    const std::string date = fmt::format("{:%Y-%m-%d %H:%M}", fmt::localtime(std::time(nullptr)));
    const std::string hash = fmt::format("{:016x}", settingsHash(options.settings));
    const std::string exposure = options.settings.exposureEv100.automatic
                                     ? "the scene's"
                                     : fmt::format("EV100 {:g}", options.settings.exposureEv100.value);
    const std::string size =
        options.width > 0 ? fmt::format("{}x{}", options.width, options.height) : std::string("each part's");
    fmt::print("device '{}', driver '{}', {} threads, {}\nsettings {}, exposure {}, picture size {}\n",
               device.name(), device.driver(), std::thread::hardware_concurrency(), date, hash, exposure,
               size);
    return {{"device", device.name()},
            {"driver", device.driver()},
            {"threads", std::thread::hardware_concurrency()},
            {"date", date},
            {"settingsHash", hash},
            {"settings", settingsJson(options.settings)},
            {"exposure", exposure},
            {"pictureSize", size},
            {"timing", device.hasReliableTimestamps() ? "timestamps" : "wall"}};
}

// A part that cannot work does not keep the others from running.
bool runPart(const Part& part, const LoopOptions& options, Json& json) {
    const double loadBefore = loadAverage();
    const auto start = std::chrono::steady_clock::now();
    fmt::print("\n{}: {}\n", part.name, part.help);
    bool done = true;
    Json result;
    try {
        result["figures"] = part.run(options);
    } catch (const std::exception& error) {
        fmt::print("  failed: {}\n", error.what());
        result["error"] = error.what();
        done = false;
    }
    const double load = std::max(loadBefore, loadAverage());
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    fmt::print("  {:.0f} s, load average {:.1f}{}\n", seconds, load,
               load > 1.0 ? ": a busy machine, times mean nothing but by their ratios" : "");
    result["seconds"] = seconds;
    result["loadAverage"] = load;
    json["parts"][part.name] = result;
    return done;
}

int run(int argc, char** argv) {
    std::setvbuf(stdout, nullptr, _IOLBF, 1 << 12); // rows of long parts are seen as they come
    CLI::App app{"Measures stochastic direct lighting"};
    LoopOptions options;
    std::vector<std::string> wanted, settings;
    std::string json, size, references, pictures;
    std::string help = "parts, or 'all':";
    for (const Part& part : kParts)
        help += fmt::format("\n  {}: {}", part.name, part.help);
    app.add_option("part", wanted, help)->required();
    app.add_option("--json", json, "file for the figures");
    app.add_option("--size", size, "WIDTHxHEIGHT in pixels instead of each part's own");
    app.add_option("--frames", options.frames, "instead of each part's own number");
    app.add_option("--scene", options.scenes, "names in content/scenes instead of each part's own, by commas")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option("--reference-frames", options.referenceFrames, "frames of each reference")
        ->check(CLI::Range(2, 65536));
    app.add_option("--references", references,
                   "folder that keeps references for later runs; stale once shaders change");
    app.add_option("--pictures", pictures, "folder for the pictures that 'quality' compares, linear");
    app.add_option("--set", settings, "a setting, key=value")->allow_extra_args(false);
    CLI11_PARSE(app, argc, argv);
    options.references = references;
    options.pictures = pictures;
    if (!size.empty() && (std::sscanf(size.c_str(), "%dx%d", &options.width, &options.height) != 2 ||
                          options.width < 8 || options.height < 8)) {
        fmt::print(stderr, "--size '{}': expected WIDTHxHEIGHT, each at least 8\n", size);
        return 2;
    }
    for (const std::string& setting : settings) {
        if (const std::optional<Error> error = applySetting(options.settings, setting)) {
            fmt::print(stderr, "{}\n", error->message);
            return 2;
        }
    }
    for (const std::string& name : wanted) {
        const auto known = [&](const Part& part) { return name == part.name; };
        if (name != "all" && std::none_of(std::begin(kParts), std::end(kParts), known)) {
            fmt::print(stderr, "no part '{}'; see --help\n", name);
            return 2;
        }
    }
    Json result = printHeading(options);
    bool done = true;
    for (const Part& part : kParts) {
        const auto asked = [&](const std::string& name) { return name == "all" || name == part.name; };
        if (!std::any_of(wanted.begin(), wanted.end(), asked)) continue;
        done = runPart(part, options, result) && done;
        // After each part, so that a run that is cut short leaves what it has.
        if (json.empty()) continue;
        if (const std::optional<Error> error = writeText(json, result.dump(2) + "\n")) {
            fmt::print(stderr, "{}\n", error->message);
            return 3;
        }
    }
    return done ? 0 : 3;
}

} // namespace

} // namespace kilolux::test

int main(int argc, char** argv) {
    try {
        return kilolux::test::run(argc, argv);
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 3;
    }
}
