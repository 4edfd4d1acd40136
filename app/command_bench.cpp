// kilolux bench: speed against error of methods over scenes, as JSON and as a page.
#include "app/choices.h"
#include "app/commands.h"

#include "renderer/bench/bench.h"
#include "renderer/bench/bench_scene.h"
#include "renderer/bench/sweep.h"
#include "renderer/settings_presets.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <ctime>
#include <fmt/format.h>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

namespace kilolux {
namespace {

namespace fs = std::filesystem;

struct Arguments {
    std::vector<std::string> scenes;
    std::string methods = "stochastic,restir,resampling,uniform";
    bool presets = false;
    std::string size = "320x180", camera, folder, older, references, sweep, changes, budgets;
    bench::BenchPlan plan;
};

std::string dateNow() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[32];
    std::strftime(text, sizeof(text), "%Y-%m-%dT%H:%M:%SZ", &utc);
    return text;
}

std::vector<std::string> splitAt(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::size_t begin = 0;
    for (std::size_t end; (end = text.find(separator, begin)) != std::string::npos; begin = end + 1)
        parts.push_back(text.substr(begin, end - begin));
    parts.push_back(text.substr(begin));
    return parts;
}

// The default first: the others are compared with it.
std::string presetMethods() {
    std::string list = fmt::format("stochastic:preset={}", presetOf(Settings{})->name);
    for (const SettingsPreset& preset : settingsPresets())
        if (&preset != presetOf(Settings{})) list += fmt::format(",stochastic:preset={}", preset.name);
    return list;
}

// As a shell reads it again.
std::string quoted(const std::string& text) {
    const bool plain =
        !text.empty() && text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                                "0123456789_-./:,=+") == std::string::npos;
    if (plain) return text;
    std::string result = "'";
    for (const char c : text)
        result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result + "'";
}

// What repeats the run, defaults spelled out.
std::string commandOf(const Arguments& a) {
    std::string command = "kilolux bench";
    for (const std::string& scene : a.scenes)
        command += " " + quoted(scene);
    command += fmt::format(" -o {} --methods {} --size {} --frames {} --repetitions {} --reference-frames {}",
                           quoted(a.folder), quoted(a.methods), a.size, a.plan.frames, a.plan.repetitions,
                           a.plan.referenceFrames);
    for (const auto& [name, value] : {std::pair{"--camera", &a.camera},
                                      {"--budgets", &a.budgets},
                                      {"--sweep", &a.sweep},
                                      {"--changes", &a.changes}})
        if (!value->empty()) command += fmt::format(" {} {}", name, quoted(*value));
    return command;
}

// "16ms,64ms,4rays": of direct lighting, or per pixel. A plain number is in ms.
std::optional<Error> parseBudgets(const std::string& text, bench::BenchPlan& plan) {
    std::vector<double> ms, rays;
    for (const std::string& part : splitAt(text, ',')) {
        std::size_t used = 0;
        double value = 0.0;
        try {
            value = std::stod(part, &used);
        } catch (const std::exception&) {
            used = 0;
        }
        const std::string unit = part.substr(used);
        if (used == 0 || !(value > 0.0) || !std::isfinite(value) ||
            (unit != "" && unit != "ms" && unit != "rays"))
            return Error{fmt::format("--budgets: '{}': expected a number above 0 and 'ms' or 'rays'", part)};
        (unit == "rays" ? rays : ms).push_back(value);
    }
    std::sort(ms.begin(), ms.end());
    std::sort(rays.begin(), rays.end());
    plan.budgetsMs = ms;
    if (!rays.empty()) plan.budgetsRays = rays;
    return std::nullopt;
}

// Sweep, changes, budgets and references.
std::optional<Error> parseWhatElse(Arguments& a) {
    const auto sweep = bench::sweepFromName(a.sweep);
    if (!sweep)
        return Error{fmt::format("--sweep: '{}': expected lights, resolution, triangles or rays", a.sweep)};
    a.plan.sweep = *sweep;
    for (const std::string& name : a.changes.empty() ? std::vector<std::string>{} : splitAt(a.changes, ',')) {
        const auto change = bench::changeFromName(name);
        if (!change)
            return Error{fmt::format(
                "--changes: '{}': expected lights-on, lights-move or camera-turns, by commas", name)};
        a.plan.changes.push_back(*change);
    }
    a.plan.references = a.references;
    return a.budgets.empty() ? std::nullopt : parseBudgets(a.budgets, a.plan);
}

Problem checkArguments(Arguments& a) {
    if (a.scenes.empty())
        return Failure{ExitCode::BadInput, "no scene; try: kilolux bench SCENE.glb -o FOLDER"};
    const Result<PictureSize> size = parsePictureSize(a.size);
    if (!size) return Failure{ExitCode::BadInput, size.error()};
    a.plan.width = size.value().width;
    a.plan.height = size.value().height;
    for (const std::string& scene : a.scenes) {
        std::error_code missing;
        if (!fs::exists(scene, missing))
            return Failure{ExitCode::BadInput, fmt::format("'{}': no such file", scene)};
        a.plan.scenes.push_back({scene, a.camera});
    }
    if (a.presets) a.methods = presetMethods();
    for (const std::string& text : splitAt(a.methods, ',')) {
        Result<bench::BenchMethod> method = bench::parseMethod(text);
        if (!method) return Failure{ExitCode::BadInput, fmt::format("--methods: {}", method.error())};
        a.plan.methods.push_back(std::move(method.value()));
    }
    if (const auto error = parseWhatElse(a)) return Failure{ExitCode::BadInput, error->message};
    if (const auto error = bench::checkScenes(a.plan)) return Failure{ExitCode::BadInput, error->message};
    std::error_code failure;
    fs::create_directories(a.folder, failure);
    if (failure) {
        return Failure{ExitCode::CouldNotWork,
                       fmt::format("cannot create the folder '{}': {}", a.folder, failure.message())};
    }
    if (const auto error = checkWritable(fs::path(a.folder) / "bench.json"))
        return Failure{ExitCode::CouldNotWork, error->message};
    return std::nullopt;
}

Result<nlohmann::ordered_json> readOlder(const std::string& file) {
    std::ifstream stream(file);
    if (!stream) return Error{fmt::format("'{}': cannot be read", file)};
    nlohmann::ordered_json json = nlohmann::ordered_json::parse(stream, nullptr, false);
    if (json.is_discarded()) return Error{fmt::format("'{}': not JSON", file)};
    return json;
}

// Ctrl+C asks for the end: what is done is written.
std::atomic<bool> stopAsked = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal's handler sets it");

void askForStop(int) {
    stopAsked = true;
}

bench::OnProgress progressLine() {
    const auto start = std::chrono::steady_clock::now();
    return [start](const bench::BenchProgress& p) {
        const double elapsedS =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        std::string left;
        if (p.done > 0) left = fmt::format(", about {:.0f} s left", elapsedS / p.done * (p.all - p.done));
        fmt::print(stderr, "{} of {}: {}{}\n", p.done + 1, p.all, p.doing, left);
        return !stopAsked;
    };
}

Problem runCommand(Arguments& a) {
    if (Problem p = checkArguments(a)) return p;
    nlohmann::ordered_json older;
    if (!a.older.empty()) {
        Result<nlohmann::ordered_json> read = readOlder(a.older);
        if (!read) return Failure{ExitCode::BadInput, read.error()};
        older = std::move(read.value());
    }
    a.plan.date = dateNow();
    a.plan.command = commandOf(a);
    a.plan.stop = &stopAsked;
    std::signal(SIGINT, askForStop);
    const Result<bench::BenchResult> result = bench::runBench(a.plan, progressLine());
    std::signal(SIGINT, SIG_DFL);
    if (!result) return Failure{ExitCode::CouldNotWork, result.error()};
    const fs::path json = fs::path(a.folder) / "bench.json", html = fs::path(a.folder) / "bench.html";
    for (const auto& error : {writeText(json, bench::benchJson(result.value()).dump(2) + "\n"),
                              writeText(html, bench::benchHtml(result.value()))})
        if (error) return Failure{ExitCode::CouldNotWork, error->message};
    fmt::print("wrote '{}' and '{}'{}\n", json.string(), html.string(),
               result.value().cancelled ? " (stopped before the end)" : "");
    if (a.older.empty()) return std::nullopt;
    const Result<std::string> comparison = bench::compareWithOlder(result.value(), older);
    if (!comparison) return Failure{ExitCode::BadInput, fmt::format("'{}': {}", a.older, comparison.error())};
    fmt::print("{}", comparison.value());
    return std::nullopt;
}

constexpr const char* kExamples = R"(Examples:
  kilolux bench gallery.glb night_market.glb -o report
  kilolux bench gallery.glb -o report --methods stochastic,restir:reuseWeights=rays,stochastic:guiding=false
  kilolux bench gallery.glb -o report --compare old/bench.json
  kilolux bench gallery.glb -o report --presets      cost and error of every quality preset
  kilolux bench gallery.glb -o report --sweep lights --references references
  kilolux bench gallery.glb -o report --changes lights-on,camera-turns

The first method is what the others are compared with. Ctrl+C stops and writes what is done.)";

} // namespace

Command addBenchCommand(CLI::App& app) {
    auto arguments = std::make_shared<Arguments>();
    Arguments& a = *arguments;
    CLI::App* bench = app.add_subcommand("bench", "Measure speed against error of methods, in one run");
    bench->add_option("SCENES", a.scenes, ".gltf or .glb files")->type_name("");
    bench->add_option("-o,--output", a.folder, "folder for bench.json and bench.html")
        ->type_name("FOLDER")
        ->required();
    bench->add_option("--methods", a.methods, "NAME or NAME:KEY=VALUE:..., by commas (see --list)")
        ->type_name("LIST")
        ->capture_default_str();
    bench->add_flag("--presets", a.presets, "compare the quality presets in place of methods")
        ->excludes("--methods");
    bench->add_option("--size", a.size, "in pixels")->type_name("WxH")->capture_default_str();
    bench->add_option("--camera", a.camera, "a camera that all scenes have (default: 'wide', else the first)")
        ->type_name("NAME");
    bench->add_option("--frames", a.plan.frames, "of every run")
        ->check(CLI::Range(1, 4096).description(""))
        ->type_name("N")
        ->capture_default_str();
    bench->add_option("--repetitions", a.plan.repetitions, "with other random numbers, interleaved")
        ->check(CLI::Range(1, 100).description(""))
        ->type_name("N")
        ->capture_default_str();
    bench->add_option("--reference-frames", a.plan.referenceFrames, "of 4 rays per light")
        ->check(CLI::Range(2, 65536).description(""))
        ->type_name("N")
        ->capture_default_str();
    bench->add_option("--budgets", a.budgets, "where errors are compared: 16ms,64ms,4rays (a pixel)")
        ->type_name("LIST");
    bench->add_option("--sweep", a.sweep, "scaling over lights, resolution, triangles or rays")
        ->type_name("NAME");
    bench->add_option("--changes", a.changes, "by commas: lights-on, lights-move, camera-turns")
        ->type_name("LIST");
    bench->add_option("--references", a.references, "keep references here, and take them from here")
        ->type_name("FOLDER");
    bench->add_option("--compare", a.older, "print ratios against an older bench.json")->type_name("FILE");
    bench->footer(kExamples);
    return [arguments] {
        const Problem problem = runCommand(*arguments);
        if (!problem) return ExitCode::Done;
        printError(problem->message);
        return problem->code;
    };
}

} // namespace kilolux
