// Measures the light grid over the depths of real scenes: `bench_grid [--size WxH] [--runs N] [--json FILE]
// [SCENE.glb...]`, each scene with its own lights and the first one with crowds of 1,000 and 10,000. Fine
// cells by threads, by groups and by both; one pass against two; a plain loop in C++ on one thread. Then what
// barn doors save in the lists. All in
// turn, medians of wall and of processor time, which says more on a busy machine; never passes or fails on
// time.
#include "tests/bench/grid_cpu.h"
#include "tests/gpu/support/grid_rig.h"
#include "tests/unit/accel/scene_kit.h"

#include "renderer/document/gltf_import.h"
#include "renderer/gpu_lights.h"
#include "renderer/renderer.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fmt/format.h>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>

namespace kilolux::test {

namespace {

struct Options {
    int width = 640;
    int height = 360;
    int runs = 15;
    std::string json;
    std::vector<std::string> scenes;
};

struct RunTime {
    double wallMs = 0.0;
    double cpuMs = 0.0; // of all threads, the driver's as well
};

RunTime timeOf(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t startCpu = std::clock();
    work();
    return {std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count(),
            1000.0 * double(std::clock() - startCpu) / CLOCKS_PER_SEC};
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
    return values[values.size() / 2];
}

constexpr double kExposureEv100 = 10.0;

// What a camera sees: the linear depths of the renderer's own frame, lights muted because they do not matter.
std::vector<float> depthsOf(Scene scene, const Options& options) {
    for (LightNode& light : scene.lights)
        light.muted = true;
    RenderOptions render;
    render.width = options.width;
    render.height = options.height;
    render.keepTargets = true;
    render.settings.jitter = false;
    render.settings.exposureEv100 = {.automatic = false, .value = kExposureEv100};
    Result<std::unique_ptr<Renderer>> renderer = Renderer::create(scene, render);
    if (!renderer) throw std::runtime_error(renderer.error());
    if (const Result<Picture> picture = renderer.value()->render({}); !picture)
        throw std::runtime_error(picture.error());
    Result<std::vector<NamedImage>> targets = renderer.value()->targets();
    for (NamedImage& target : targets.value()) {
        if (target.name == "gDepth") return std::move(target.image.pixels);
    }
    throw std::runtime_error("no target 'gDepth'");
}

// One pass instead of two: every light against every fine cell.
class OnePass {
  public:
    explicit OnePass(gpu::PassResources& resources)
        : pass_(resources, "cull_once",
                joined({{{"Frame"},
                         {"pyramid"},
                         {"GridCells", gpu::Access::Write},
                         {"GridIndices", gpu::Access::Write},
                         {"GridCounters", gpu::Access::ReadWrite}},
                        lightUses()}),
                "../tests/bench/cull_once.comp") {}

    void run(gpu::Device& device, const GridRig& rig) {
        const LightGrid& grid = rig.grid();
        const glm::uvec3 fine = rig.constants().grid.fineSize;
        gpu::Commands commands(device);
        commands.fillBuffer(grid.counters(), 0);
        pass_.record(commands, rig.scene().features(),
                     joined({{{"Frame", rig.frameBuffer()},
                              {"pyramid", rig.targets().pyramid},
                              {"GridCells", grid.cells()},
                              {"GridIndices", grid.indices()},
                              {"GridCounters", grid.counters()}},
                             rig.scene().lightBindings()}),
                     {fine.x, fine.y, fine.z});
        commands.submitAndWait();
    }

  private:
    gpu::ComputePass pass_;
};

// Places in the list of what is measured: below kOnePass the two passes, from kLoop on the C++ loops.
constexpr std::size_t kOnePass = 4, kLoop = 5;

struct Measured {
    std::string name;
    std::vector<double> wallMs, cpuMs;
    std::size_t tests = 0, indices = 0;
};

struct Place {
    std::string name;
    Scene scene; // the lights
    GridView view;
    std::vector<float> depthsM;
};

std::vector<Measured> measure(GridPasses& passes, OnePass& onePass, const Place& place, int runs) {
    gpu::Device& device = passes.resources.device();
    GridRig rig(passes, place.scene, place.view, kExposureEv100);
    rig.setDepths(place.depthsM);
    const GpuLights records = makeGpuLights(place.scene, rig.scene().anchor(), kExposureEv100);
    const BindLightTables bound(records.tables);
    CpuGridBuilder loop(rig.constants(), place.depthsM, records.hot);
    std::vector<Measured> results;
    for (const char* name : {"by threads to 256", "by threads to 64", "by threads to 16", "by groups",
                             "one pass", "plain loop", "plain loop, one pass"})
        results.push_back({name, {}, {}, 0, 0});
    constexpr std::uint32_t kThreadLights[] = {shared::GRID_MAX_THREAD_LIGHTS, 64, 16, 0};
    rig.run(0);                             // compiles, and makes room
    for (int run = 0; run <= runs; ++run) { // the first is not counted
        for (std::size_t i = 0; i < results.size(); ++i) {
            RunTime time;
            if (i < kOnePass) {
                time = timeOf([&] { rig.submit(kThreadLights[i]); });
            } else if (i == kOnePass) {
                time = timeOf([&] { onePass.run(device, rig); });
            } else {
                time = timeOf([&] {
                    loop.build(i == kLoop ? CpuGridBuilder::Passes::Two : CpuGridBuilder::Passes::One);
                });
            }
            const auto counts = rig.grid().counters().downloadAs<std::uint32_t>();
            results[i].tests = i < kLoop ? counts[shared::GRID_COUNTER_TESTS] : loop.grid().tests;
            results[i].indices = i < kLoop ? counts[shared::GRID_COUNTER_USED] : loop.grid().indices.size();
            if (run == 0) continue;
            results[i].wallMs.push_back(time.wallMs);
            results[i].cpuMs.push_back(time.cpuMs);
        }
    }
    return results;
}

std::string report(const Place& place, const std::vector<Measured>& results, std::string& json) {
    std::string text = fmt::format("{}: {} lights\n", place.name, place.scene.lights.size());
    const double loopMs = median(results[kLoop].cpuMs);
    for (const Measured& result : results) {
        const double ms = median(result.cpuMs);
        text += fmt::format(
            "  {:<21} {:7.2f} ms, {:7.2f} by processor time: {:7} tests at {:6.2f} ns, {:6} indices at "
            "{:7.2f} ns, {:.2f} of the loop\n",
            result.name, median(result.wallMs), ms, result.tests, 1e6 * ms / double(result.tests),
            result.indices, 1e6 * ms / double(result.indices), ms / loopMs);
        json += fmt::format(
            R"({}{{"scene":"{}","lights":{},"how":"{}","wallMs":{:.4f},"cpuMs":{:.4f},"tests":{},"indices":{},"ofLoop":{:.4f}}})",
            json.empty() ? "" : ",\n", place.name, place.scene.lights.size(), result.name,
            median(result.wallMs), ms, result.tests, result.indices, ms / loopMs);
    }
    text += fmt::format("  one pass over two: {:.1f} on the device, {:.1f} in the loop\n",
                        median(results[kOnePass].cpuMs) / median(results[0].cpuMs),
                        median(results[kLoop + 1].cpuMs) / loopMs);
    return text;
}

// Ceiling panels over the first scene's depths, all with doors that lean out 20 degrees: what the lists hold
// with the doors' planes and without, by cells that list a light at all and by entries.
void reportDoors(GridPasses& passes, Place place) {
    const Bounds bounds = worldBounds(place.scene);
    place.scene = makeScene({makeBox(glm::dvec3(0.01))});
    constexpr int kSide = 16;
    for (int i = 0; i < kSide * kSide; ++i) {
        const glm::dvec3 share((i % kSide + 0.5) / kSide, 0.9, (i / kSide + 0.5) / kSide);
        Node node;
        node.worldFromNode = glm::translate(glm::dmat4(1.0), glm::mix(bounds.min, bounds.max, share)) *
                             glm::rotate(glm::dmat4(1.0), -glm::half_pi<double>(), glm::dvec3(1, 0, 0));
        place.scene.nodes.push_back(node);
        LightDef def;
        def.type = LightType::Rect;
        def.intensity = 200.0;
        def.widthM = def.heightM = 0.3;
        def.rangeM = 0.5 * place.view.extentM;
        def.barnDoors.fill({.angleRad = glm::radians(20.0), .lengthM = 0.3});
        place.scene.lightDefs.push_back(def);
        LightNode light;
        light.node = int(place.scene.nodes.size()) - 1;
        light.def = i;
        place.scene.lights.push_back(light);
    }
    double entries[2], filled[2];
    for (const bool doors : {true, false}) {
        if (!doors) {
            for (std::size_t i = 0; i < place.scene.lightDefs.size(); ++i)
                place.scene.lightDefs[i].barnDoors.fill({});
        }
        GridRig rig(passes, place.scene, place.view, kExposureEv100);
        rig.setDepths(place.depthsM);
        rig.run(0); // makes room
        const GridLists lists = rig.run(0);
        entries[doors] = filled[doors] = 0.0;
        for (const shared::GridCell& cell : lists.cells) {
            entries[doors] += cell.count;
            filled[doors] += cell.count > 0;
        }
    }
    fmt::print("{} rectangles with doors over {}: {:.0f} entries of cells instead of {:.0f} ({:.1f} % "
               "saved), {:.0f} "
               "cells with lights instead of {:.0f}\n",
               kSide * kSide, place.name, entries[1], entries[0], 100.0 * (1.0 - entries[1] / entries[0]),
               filled[1], filled[0]);
}

Options parse(int argc, char** argv) {
    Options options;
    for (int i = 1; i < argc; ++i) {
        const auto value = [&] { return i + 1 < argc ? argv[++i] : ""; };
        if (!std::strcmp(argv[i], "--json"))
            options.json = value();
        else if (!std::strcmp(argv[i], "--runs"))
            options.runs = std::max(1, std::atoi(value()));
        else if (!std::strcmp(argv[i], "--size"))
            std::sscanf(value(), "%dx%d", &options.width, &options.height);
        else
            options.scenes.push_back(argv[i]);
    }
    if (options.scenes.empty()) {
        for (const char* name : {"gallery", "night_market"})
            options.scenes.push_back(fmt::format("{}/content/scenes/{}.glb", KILOLUX_SOURCE_DIR, name));
    }
    return options;
}

int run(int argc, char** argv) {
    const Options options = parse(argc, argv);
    std::vector<Place> places;
    for (const std::string& path : options.scenes) {
        Result<Scene> scene = importGltf(path);
        if (!scene) throw std::runtime_error(scene.error());
        Place place{std::filesystem::path(path).stem().string(), std::move(scene.value()), {}, {}};
        const Bounds bounds = worldBounds(place.scene);
        place.view = {place.scene.cameras.empty()
                          ? derivedCamera(place.scene, double(options.width) / options.height)
                          : place.scene.cameras.front(),
                      options.width, options.height, glm::length(bounds.max - bounds.min)};
        place.depthsM = depthsOf(place.scene, options);
        places.push_back(std::move(place));
    }
    // Crowds about the first scene's middle, with ranges that leave a cell some tens of them.
    for (const int count : {1000, 10000}) {
        const Bounds bounds = worldBounds(places[0].scene);
        const glm::dvec3 middle = 0.5 * (bounds.min + bounds.max);
        Place crowd{fmt::format("crowd over {}", places[0].name),
                    crowdScene({count, 0.5 * places[0].view.extentM, 0.2, 7}), places[0].view,
                    places[0].depthsM};
        crowd.view.camera.worldFromCamera =
            glm::translate(glm::dmat4(1.0), -middle) * crowd.view.camera.worldFromCamera;
        places.push_back(std::move(crowd));
    }
    gpu::Device device;
    gpu::PassResources resources(device);
    GridPasses passes(resources);
    OnePass onePass(resources);
    fmt::print("device '{}', {} x {}, medians of {} runs\n", device.name(), options.width, options.height,
               options.runs);
    std::string json;
    for (const Place& place : places)
        fmt::print("{}", report(place, measure(passes, onePass, place, options.runs), json));
    reportDoors(passes, places[0]);
    if (!options.json.empty()) std::ofstream(options.json) << fmt::format("[\n{}\n]\n", json);
    return 0;
}

} // namespace

} // namespace kilolux::test

int main(int argc, char** argv) {
    return kilolux::test::run(argc, argv);
}
