// kilolux render: checks every argument before any long work, then imports, renders and writes.
#include "app/choices.h"
#include "app/commands.h"

#include "renderer/document/gltf_import.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

namespace kilolux {
namespace {

namespace fs = std::filesystem;

constexpr int kSettledFrames = 32;

struct Arguments {
    std::string scene;
    std::string output;
    std::string size = "960x540";
    std::string statistics;
    std::string dumpFolder;
    std::string preset;
    std::vector<std::string> sets;
    RenderOptions options;
    int frames = 0; // 0: what the method wants
    bool half = false;
    bool list = false;
    bool json = false;
    bool verbose = false;
};

Problem as(ExitCode code, const std::optional<Error>& error) {
    return error ? Problem{{code, error->message}} : std::nullopt;
}

std::string counted(std::size_t count, std::string_view noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

bool sameFile(const std::string& a, const std::string& b) {
    std::error_code missing;
    const auto whole = [&](const std::string& file) {
        return fs::weakly_canonical(fs::absolute(file), missing);
    };
    return !a.empty() && !b.empty() && whole(a) == whole(b);
}

// Fills options and the default output name from the text of the arguments, and refuses what cannot work.
Problem checkArguments(Arguments& arguments) {
    if (arguments.scene.empty())
        return Failure{ExitCode::BadInput, "SCENE is missing; try: kilolux render SCENE.glb -o OUT.png"};
    RenderOptions& options = arguments.options;
    if (Problem p = as(ExitCode::BadInput,
                       applyPictureArguments(arguments.size, arguments.preset, arguments.sets, options)))
        return p;
    const bool ofPass = options.view.starts_with("pass:"); // checked when the frame has run
    if (Problem p =
            as(ExitCode::BadInput, checkChoice("view", ofPass ? "" : options.view, Renderer::views())))
        return p;
    if (arguments.output.empty()) {
        const std::string stem = fs::path(arguments.scene).stem().string();
        std::string view = options.view;
        std::replace_if(
            view.begin(), view.end(), [](char c) { return c == ':' || c == '/'; }, '-');
        arguments.output = stem + (view.empty() ? "" : "-" + view) + ".png";
    }
    const Result<PictureFormat> format = pictureFormat(arguments.output);
    if (!format) return Failure{ExitCode::BadInput, format.error()};
    if (arguments.half && format.value() != PictureFormat::Exr)
        return Failure{ExitCode::BadInput, "--half is for .exr only"};
    if (sameFile(arguments.statistics, arguments.scene) || sameFile(arguments.statistics, arguments.output))
        return Failure{
            ExitCode::BadInput,
            fmt::format("--stats '{}' would overwrite the scene or the picture", arguments.statistics)};
    // Sampled pictures need some frames to settle; these are whole from the first one on.
    const bool whole = options.method == "all-lights" || options.method == "split" ||
                       options.method == "true" || options.method == "shadow-maps";
    options.frames = arguments.frames > 0 ? arguments.frames : (whole ? 1 : kSettledFrames);
    options.keepTargets = !arguments.dumpFolder.empty();
    return std::nullopt;
}

// Asked before the work, so that an hour of rendering does not end at a full or closed disk.
Problem checkDisk(const Arguments& arguments) {
    if (Problem p = as(ExitCode::CouldNotWork, checkWritable(arguments.output))) return p;
    if (!arguments.statistics.empty())
        if (Problem p = as(ExitCode::CouldNotWork, checkWritable(arguments.statistics))) return p;
    if (arguments.dumpFolder.empty()) return std::nullopt;
    std::error_code failure;
    fs::create_directories(arguments.dumpFolder, failure);
    if (failure)
        return Failure{ExitCode::CouldNotWork, fmt::format("cannot create the folder '{}': {}",
                                                           arguments.dumpFolder, failure.message())};
    return as(ExitCode::CouldNotWork, checkWritable(fs::path(arguments.dumpFolder) / "target.exr"));
}

std::optional<Error> writePicture(const Arguments& arguments, const Picture& picture) {
    const PictureFormat format = pictureFormat(arguments.output).value();
    if (format == PictureFormat::Png)
        return writePng(arguments.output, picture.width, picture.height, picture.srgb8);
    const FloatImage linear{picture.width, picture.height, 3, picture.rgb};
    if (format == PictureFormat::Hdr) return writeHdr(arguments.output, linear);
    return writeExr(arguments.output, linear, arguments.half ? ExrDepth::Half : ExrDepth::Float);
}

std::optional<Error> writeTargets(Renderer& renderer, const fs::path& folder) {
    const Result<std::vector<NamedImage>> targets = renderer.targets();
    if (!targets) return Error{targets.error()};
    for (const NamedImage& target : targets.value())
        if (auto error = writeExr(folder / (target.name + ".exr"), target.image, ExrDepth::Float))
            return error;
    fmt::print("wrote {} to '{}'\n", counted(targets.value().size(), "target"), folder.string());
    return std::nullopt;
}

void printVerbose(const FrameStatistics& s) {
    fmt::print(stderr, "device      {} ({}), timing by {}\n", s.device, s.driver, s.timing);
    fmt::print(stderr, "scene       {} ({:.1f} in range of a pixel), {}\n", counted(s.lights, "light"),
               s.lightsInRangeMean, counted(s.triangles, "triangle"));
    fmt::print(stderr, "frame       {:.2f} ms, direct lighting {:.2f} ms, {} rays in all\n", s.frameMs,
               s.directLightingMs, s.rays);
    for (const PassTiming& pass : s.passes)
        fmt::print(stderr, "  {:<24} {:>9.3f} ms median {:>9.3f} ms p95\n", pass.name, pass.medianMs,
                   pass.p95Ms);
    fmt::print(stderr, "GPU memory  {:.1f} MiB\n", s.gpuMemoryPeakMiB);
    for (const MemoryCause& cause : s.gpuMemory)
        fmt::print(stderr, "  {:<24} {:>9.1f} MiB\n", cause.cause, cause.peakMiB);
}

Problem renderToFiles(const Arguments& arguments, const Scene& scene) {
    const auto start = std::chrono::steady_clock::now();
    const RenderOptions& options = arguments.options;
    Result<std::unique_ptr<Renderer>> renderer = Renderer::create(scene, options);
    if (!renderer) return Failure{ExitCode::CouldNotWork, renderer.error()};
    const Result<Picture> picture = renderer.value()->render([&](int done, int all) {
        if (arguments.verbose) fmt::print(stderr, "frame {} of {}\n", done, all);
        return true;
    });
    if (!picture) return Failure{ExitCode::CouldNotWork, picture.error()};

    if (Problem p = as(ExitCode::CouldNotWork, writePicture(arguments, picture.value()))) return p;
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    fmt::print("wrote '{}' ({} x {}, {}, {:.1f} s)\n", arguments.output, options.width, options.height,
               counted(options.frames, "frame"), seconds.count());

    const FrameStatistics statistics = renderer.value()->statistics();
    for (const std::string& note : statistics.notes)
        printWarning(fmt::format("{}: {}", arguments.scene, note));
    if (arguments.verbose) printVerbose(statistics);
    if (!arguments.statistics.empty()) {
        const std::string text = statisticsJson(statistics, options.settings).dump(2) + "\n";
        if (Problem p = as(ExitCode::CouldNotWork, writeText(arguments.statistics, text))) return p;
        fmt::print("wrote '{}'\n", arguments.statistics);
    }
    if (arguments.dumpFolder.empty()) return std::nullopt;
    return as(ExitCode::CouldNotWork, writeTargets(*renderer.value(), arguments.dumpFolder));
}

Problem renderCommand(Arguments& arguments) {
    if (Problem p = checkArguments(arguments)) return p;
    if (Problem p = checkDisk(arguments)) return p;
    const Result<Scene> scene = importGltf(arguments.scene);
    if (!scene) return Failure{ExitCode::BadInput, scene.error()};
    for (const std::string& warning : scene.value().warnings)
        printWarning(fmt::format("{}: {}", arguments.scene, warning));
    if (Problem p = as(ExitCode::BadInput, checkCamera(arguments.options.camera, scene.value()))) return p;
    return renderToFiles(arguments, scene.value());
}

constexpr const char* kExamples = R"(Examples:
  kilolux render gallery.glb -o gallery.png
  kilolux render gallery.glb -o wide.exr --size 1280x720 --method true --frames 64
  kilolux render gallery.glb -o normals.png --view normal --camera close
  kilolux render gallery.glb -o dark.png --set exposureEv100=9 --set toneMap=none --stats dark.json
  kilolux render --list            names of methods, views, presets and settings, with what they do

PNG is what the display shows; EXR and HDR hold linear light without exposure.)";

} // namespace

Command addRenderCommand(CLI::App& app) {
    auto arguments = std::make_shared<Arguments>();
    Arguments& a = *arguments;
    CLI::App* render = app.add_subcommand("render", "Render a scene to a picture file");
    render->add_option("SCENE", a.scene, "a .gltf or .glb file")->type_name("");
    render
        ->add_option("-o,--output", a.output,
                     "picture to write: .png, .exr or .hdr (default: SCENE's name .png)")
        ->type_name("FILE");
    render->add_option("--size", a.size, "in pixels")->type_name("WxH")->capture_default_str();
    render
        ->add_option(
            "--frames", a.frames,
            fmt::format(
                "frames to accumulate (default: 1 for all-lights, split, true and shadow-maps, else {})",
                kSettledFrames))
        ->check(CLI::Range(1, 1000000).description(""))
        ->type_name("N");
    render->add_option("--seed", a.options.seed, "of the random numbers; same seed, same bytes")
        ->check(CLI::Range(std::uint32_t(0), std::numeric_limits<std::uint32_t>::max()).description(""))
        ->type_name("N")
        ->capture_default_str();
    render->add_option("--method", a.options.method, "how direct light is found (see --list)")
        ->type_name("NAME");
    render
        ->add_option("--view", a.options.view,
                     "what the picture shows (see --list), or pass:NAME for what a pass wrote")
        ->type_name("NAME");
    render->add_option("--camera", a.options.camera, "a camera of the scene")->type_name("NAME");
    render->add_option("--preset", a.preset, "a quality preset, under what --set says (see --list)")
        ->type_name("NAME");
    render->add_option("--set", a.sets, "a setting, any number of times (see --list)")
        ->allow_extra_args(false)
        ->type_name("KEY=VALUE");
    render->add_option("--stats", a.statistics, "write statistics to this JSON file")->type_name("FILE");
    render->add_option("--dump", a.dumpFolder, "write every target of the last frame as EXR into this folder")
        ->type_name("FOLDER");
    render->add_flag("--half", a.half, "EXR in 16-bit floats");
    render->add_flag("--list", a.list, "list methods, views, presets and settings");
    render->add_flag("--json", a.json, "with --list: as JSON")->needs("--list");
    render->add_flag("-v,--verbose", a.verbose, "tell progress, times and memory on stderr");
    render->footer(kExamples);
    return [arguments] {
        if (arguments->list) {
            fmt::print("{}", listChoices(arguments->json ? ListFormat::Json : ListFormat::Text));
            return ExitCode::Done;
        }
        const Problem problem = renderCommand(*arguments);
        if (!problem) return ExitCode::Done;
        printError(problem->message);
        return problem->code;
    };
}

} // namespace kilolux
