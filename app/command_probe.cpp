// kilolux probe: why a pixel looks as it does, as a table or as JSON.
#include "app/choices.h"
#include "app/commands.h"

#include "renderer/document/gltf_import.h"

#include <charconv>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

namespace kilolux {
namespace {

struct Arguments {
    std::string scene, pixel, size = "960x540";
    std::string preset;
    std::vector<std::string> sets;
    RenderOptions options;
    glm::ivec2 at{0};
    bool json = false;
};

Problem badInput(const std::optional<Error>& error) {
    return error ? Problem{{ExitCode::BadInput, error->message}} : std::nullopt;
}

// "X,Y" in pixels from the top left corner.
std::optional<glm::ivec2> parsePixel(std::string_view text) {
    glm::ivec2 pixel(0);
    const char* const end = text.data() + text.size();
    const auto x = std::from_chars(text.data(), end, pixel.x);
    if (x.ec != std::errc() || x.ptr == end || *x.ptr != ',') return std::nullopt;
    const auto y = std::from_chars(x.ptr + 1, end, pixel.y);
    if (y.ec != std::errc() || y.ptr != end) return std::nullopt;
    return pixel;
}

Problem checkArguments(Arguments& a) {
    if (a.scene.empty())
        return Failure{ExitCode::BadInput, "SCENE is missing; try: kilolux probe SCENE.glb --pixel 480,270"};
    RenderOptions& options = a.options;
    if (Problem p = badInput(applyPictureArguments(a.size, a.preset, a.sets, options))) return p;
    if (Problem p = badInput(checkChoice("view", options.view, Renderer::views()))) return p;
    const std::optional<glm::ivec2> pixel = parsePixel(a.pixel);
    if (!pixel) {
        return Failure{ExitCode::BadInput,
                       fmt::format("--pixel '{}': expected X,Y in pixels, such as 480,270", a.pixel)};
    }
    a.at = *pixel;
    if (a.at.x < 0 || a.at.y < 0 || a.at.x >= options.width || a.at.y >= options.height) {
        return Failure{ExitCode::BadInput, fmt::format("--pixel '{}': outside the picture of {} x {}",
                                                       a.pixel, options.width, options.height)};
    }
    return std::nullopt;
}

void printSurface(const Probe& p) {
    const auto three = [](const glm::dvec3& v) {
        return fmt::format("{} {} {}", valueText(v.x), valueText(v.y), valueText(v.z));
    };
    fmt::print("pixel       {}, {}\n", p.pixel.x, p.pixel.y);
    fmt::print("picture     {} nit, {:+.2f} stops from middle grey at EV {}\n", three(p.pictureNit), p.stops,
               valueText(p.exposureEv100));
    if (!p.surface) return fmt::print("surface     none: the sky\n");
    fmt::print("surface     '{}' of '{}', material '{}'\n", p.mesh, p.node, p.material);
    fmt::print("position    {} m, normal {}, {} m deep\n", three(p.positionWs), three(p.normalWs),
               valueText(p.depthM));
    fmt::print("material    base colour {}, roughness {}, metallic {}\n", three(p.baseColor),
               valueText(p.roughness), valueText(p.metallic));
    fmt::print("light       {} lux on it, {} nit from it; {} of {} lights in range are seen, {} count\n",
               valueText(p.lux), valueText(p.nit), p.lightsSeen, p.lightsInRange,
               valueText(p.effectiveLights));
    if (p.candidates == 0) return;
    fmt::print("choice      {} candidates: {} listed in tile {},{}, every {} of {} in the cell{}{}\n",
               p.candidates, p.listLights, p.listTile.x, p.listTile.y, p.stride, p.cellLights,
               p.missed ? "; not found in the previous frame" : "", p.hasTurn ? "" : "; not its turn");
    fmt::print("weights     visible {}, hidden {} counting {}, directional {} counting {}\n",
               valueText(p.visibleWeight), valueText(p.hiddenWeight), valueText(p.hiddenBudget),
               valueText(p.directionalWeight), valueText(p.directionalBudget));
}

void printLights(const Probe& p) {
    if (p.lights.empty()) return;
    fmt::print("\n{:<28} {:>11} {:>10} {:>10} {:>7} {:>6} {:>8} {:>6}  {}\n", "light", "type", "lux", "nit",
               "share", "seen", "weight", "prob.", "list");
    for (const ProbedLight& light : p.lights) {
        const std::string name = light.name.empty() ? fmt::format("light {}", light.id) : light.name;
        fmt::print("{:<28} {:>11} {:>10} {:>10} {:>5.1f} % {:>4.0f} % {:>8} {:>6.4f}  {}{}{}\n",
                   name.substr(0, 28), light.type, valueText(light.lux), valueText(light.nit),
                   100.0 * light.share, 100.0 * light.visibility, valueText(light.weight), light.probability,
                   light.list, light.listed ? ", listed" : "", light.chosen > 0 ? ", chosen" : "");
    }
}

Problem probeScene(const Arguments& a) {
    const Result<Scene> scene = importGltf(a.scene);
    if (!scene) return Failure{ExitCode::BadInput, scene.error()};
    for (const std::string& warning : scene.value().warnings)
        printWarning(fmt::format("{}: {}", a.scene, warning));
    if (Problem p = badInput(checkCamera(a.options.camera, scene.value()))) return p;
    Result<std::unique_ptr<Renderer>> renderer = Renderer::create(scene.value(), a.options);
    if (!renderer) return Failure{ExitCode::CouldNotWork, renderer.error()};
    const Result<Picture> picture = renderer.value()->render({});
    if (!picture) return Failure{ExitCode::CouldNotWork, picture.error()};
    const Result<Probe> probe = renderer.value()->probe(a.at);
    if (!probe) return Failure{ExitCode::CouldNotWork, probe.error()};
    if (a.json) {
        fmt::print("{}\n", probeJson(probe.value()).dump(2));
        return std::nullopt;
    }
    printSurface(probe.value());
    printLights(probe.value());
    return std::nullopt;
}

constexpr const char* kExamples = R"(Examples:
  kilolux probe gallery.glb --pixel 480,270
  kilolux probe gallery.glb --pixel 480,270 --frames 64 --json > why.json

Lights are sorted by the light that reaches the camera from them by way of the pixel. Probabilities are those of the
last frame: a light that is not a candidate in it may be one in the next.)";

} // namespace

Command addProbeCommand(CLI::App& app) {
    auto arguments = std::make_shared<Arguments>();
    Arguments& a = *arguments;
    a.options.frames = 16;
    CLI::App* probe = app.add_subcommand("probe", "Tell why a pixel looks as it does");
    probe->add_option("SCENE", a.scene, "a .gltf or .glb file")->type_name("");
    probe->add_option("--pixel", a.pixel, "from the top left corner")->type_name("X,Y");
    probe->add_option("--size", a.size, "of the picture in pixels")->type_name("WxH")->capture_default_str();
    probe->add_option("--frames", a.options.frames, "rendered before")
        ->check(CLI::Range(1, 1000000).description(""))
        ->type_name("N")
        ->capture_default_str();
    probe->add_option("--seed", a.options.seed, "of the random numbers")
        ->check(CLI::Range(std::uint32_t(0), std::numeric_limits<std::uint32_t>::max()).description(""))
        ->type_name("N")
        ->capture_default_str();
    probe->add_option("--method", a.options.method, "how direct light is found (see --list)")
        ->type_name("NAME");
    probe->add_option("--view", a.options.view, "whose raw value is told as well")->type_name("NAME");
    probe->add_option("--camera", a.options.camera, "a camera of the scene")->type_name("NAME");
    probe->add_option("--preset", a.preset, "a quality preset, under what --set says")->type_name("NAME");
    probe->add_option("--set", a.sets, "a setting, any number of times (see --list)")
        ->allow_extra_args(false)
        ->type_name("KEY=VALUE");
    probe->add_flag("--json", a.json, "as JSON");
    probe->footer(kExamples);
    return [arguments] {
        Problem problem = checkArguments(*arguments);
        if (!problem) problem = probeScene(*arguments);
        if (!problem) return ExitCode::Done;
        printError(problem->message);
        return problem->code;
    };
}

} // namespace kilolux
