// kilolux bench: speed against error of methods over scenes, as JSON and as a page.
#include "app/choices.h"
#include "app/commands.h"

#include "renderer/bench/bench.h"
#include "renderer/settings_presets.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
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
    std::string size = "320x180", camera, folder, older;
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

// What repeats the run, defaults spelled out.
std::string commandOf(const Arguments& a) {
    std::string command = "kilolux bench";
    for (const std::string& scene : a.scenes)
        command += " " + fs::path(scene).filename().string();
    command +=
        fmt::format(" -o {} --methods {} --size {} --frames {} --repetitions {} --reference-frames {}",
                    a.folder, a.methods, a.size, a.plan.frames, a.plan.repetitions, a.plan.referenceFrames);
    if (!a.camera.empty()) command += " --camera " + a.camera;
    if (!a.plan.budgetsMs.empty()) command += fmt::format(" --budgets {}", fmt::join(a.plan.budgetsMs, ","));
    return command;
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
    std::sort(a.plan.budgetsMs.begin(), a.plan.budgetsMs.end());
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

// Ctrl+C asks for the end: the present step is finished, and what is done is written.
volatile std::sig_atomic_t stopAsked = 0;

void askForStop(int) {
    stopAsked = 1;
}

bench::OnProgress progressLine() {
    const auto start = std::chrono::steady_clock::now();
    return [start](const bench::BenchProgress& p) {
        const double elapsedS =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        std::string left;
        if (p.done > 0) left = fmt::format(", about {:.0f} s left", elapsedS / p.done * (p.all - p.done));
        fmt::print(stderr, "{} of {}: {}{}\n", p.done + 1, p.all, p.doing, left);
        return stopAsked == 0;
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
  kilolux bench gallery.glb -o report --methods stochastic,restir:reuseUnbiased=true,stochastic:guiding=false
  kilolux bench gallery.glb -o report --compare old/bench.json
  kilolux bench gallery.glb -o report --presets      cost and error of every quality preset

The first method is what the others are compared with. Ctrl+C stops after the present step and writes what is done.)";

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
    bench->add_option("--budgets", a.plan.budgetsMs, "ms of direct lighting at which errors are compared")
        ->delimiter(',')
        ->check(CLI::PositiveNumber)
        ->type_name("MS,...");
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
