// Compares the compute BVH with Embree's rtcOccluded1 on the same shadow rays, in interleaved pairs within
// one process: `bench_trace [--json FILE] [--size WxH] [--pairs N] [SCENE.gltf...]`. Prints build times,
// memory and the median ratio; never passes or fails on time.
#include "tests/bench/trace_scenes.h"

#include "renderer/accel_gpu/gpu_ray_world.h"
#include "shaders/shared/features.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fmt/format.h>
#include <fstream>
#include <thread>

namespace kilolux::test {

namespace {

struct Options {
    int width = 960;
    int height = 540;
    int pairs = 9;
    unsigned threads = std::max(1u, std::thread::hardware_concurrency());
    std::string json;
    std::vector<std::string> scenes;
};

// Wall and processor time of a run; the latter says more on a busy machine.
struct RunTime {
    double wallMs = 0.0;
    double cpuMs = 0.0;
};

RunTime timeOf(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t startCpu = std::clock();
    work();
    return {std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count(),
            1000.0 * double(std::clock() - startCpu) / CLOCKS_PER_SEC};
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
}

// Every thread takes every threads-th tile of 64 rays, as the shader's tiles are dealt out.
RunTime runEmbree(const EmbreeScene& embree, const std::vector<TestRay>& rays,
                  std::vector<std::uint8_t>& hits, unsigned threads) {
    return timeOf([&] {
        std::vector<std::thread> workers;
        for (unsigned worker = 0; worker < threads; ++worker)
            workers.emplace_back([&, worker] {
                for (std::size_t tile = worker; tile * 64 < rays.size(); tile += threads)
                    for (std::size_t i = tile * 64; i < std::min(rays.size(), tile * 64 + 64); ++i)
                        hits[i] = embree.occluded(rays[i]);
            });
        for (std::thread& worker : workers)
            worker.join();
    });
}

class GpuRun {
  public:
    GpuRun(gpu::Device& device, gpu::PassResources& resources, const GpuRayWorld& world,
           const std::vector<TestRay>& rays, unsigned chunks)
        : device_(device), pass_(resources, "trace_bench", uses(), "../tests/bench/trace_bench.comp"),
          world_(world), push_{std::uint32_t(rays.size()), chunks} {
        gpu::BufferDesc desc{"benchRays", rays.size() * 32, VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT};
        desc.texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
        rays_ = gpu::Buffer(device, desc);
        std::vector<glm::vec4> texels;
        for (const TestRay& ray : rays) {
            texels.push_back(glm::vec4(ray.origin, 0.0f));
            texels.push_back(glm::vec4(ray.dir, ray.tMaxM));
        }
        rays_.upload(texels);
        results_ = gpu::Buffer(device, {"benchResults", rays.size() * 4});
    }

    RunTime run() {
        gpu::Bindings bindings = world_.traceBindings();
        bindings.push_back({"benchRays", rays_});
        bindings.push_back({"BenchResults", results_});
        gpu::Commands commands(device_);
        pass_.record(commands, {{shared::FEATURE_ALPHA_MASK, world_.hasAlpha()}}, bindings, push_,
                     {(push_.rayCount + 63) / 64});
        return timeOf([&] { commands.submitAndWait(); });
    }

    std::vector<std::uint32_t> results() const { return results_.downloadAs<std::uint32_t>(); }

  private:
    static std::vector<gpu::PassUse> uses() {
        std::vector<gpu::PassUse> uses = GpuRayWorld::traceUses();
        uses.push_back({"benchRays"});
        uses.push_back({"BenchResults", gpu::Access::Write});
        return uses;
    }

    struct Push {
        std::uint32_t rayCount, chunks;
    };
    gpu::Device& device_;
    gpu::ComputePass pass_;
    const GpuRayWorld& world_;
    gpu::Buffer rays_, results_;
    Push push_;
};

struct SceneResult {
    std::string text, json;
};

SceneResult benchScene(gpu::Device& device, gpu::PassResources& resources, const BenchScene& bench,
                       const Options& options) {
    const std::vector<Instance> instances = enumerateInstances(bench.scene);
    const RayWorld world = buildWorld(bench.scene, instances, bench.moving, glm::dvec3(0.0));
    const BvhStats& stats = world.stats;
    const std::vector<TestRay> rays = shadowRays(bench, world, options.width, options.height);
    const GpuRayWorld gpuWorld(device, world);
    const EmbreeScene embree(bench.scene, instances, bench.moving);
    GpuRun gpu(device, resources, gpuWorld, rays, options.threads);
    std::vector<std::uint8_t> embreeHits(rays.size());
    const double firstMs = gpu.run().wallMs;
    runEmbree(embree, rays, embreeHits, options.threads);
    std::vector<double> gpuMs, embreeMs, ratios, cpuRatios;
    for (int pair = 0; pair < options.pairs; ++pair) {
        const RunTime ofEmbree = runEmbree(embree, rays, embreeHits, options.threads);
        const RunTime ofGpu = gpu.run();
        embreeMs.push_back(ofEmbree.wallMs);
        gpuMs.push_back(ofGpu.wallMs);
        ratios.push_back(ofEmbree.wallMs / ofGpu.wallMs);
        cpuRatios.push_back(ofEmbree.cpuMs / ofGpu.cpuMs);
    }
    const std::vector<std::uint32_t> gpuHits = gpu.results();
    std::size_t different = 0, occludedRays = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        different += (gpuHits[i] != 0) != (embreeHits[i] != 0);
        occludedRays += gpuHits[i] != 0;
    }
    const double occludedShare = double(occludedRays) / double(rays.size());
    const double mib = double(stats.nodeBytes + stats.triangleBytes) / (1 << 20);
    const std::size_t triangles = stats.staticTriangles + stats.movingTriangles;
    SceneResult result;
    result.text = fmt::format("{}: {} triangles, {} rays, {:.1f} % occluded, {} differ\n"
                              "  build {:.1f} ms (flatten scene {:.1f}, pairs {:.1f}, Embree {:.1f}, flatten "
                              "{:.1f}), depth {}, SAH cost {:.1f}\n"
                              "  memory {:.2f} MiB, {:.1f} bytes per triangle, {} nodes, {} pairs\n"
                              "  compute {:.1f} ms (first {:.0f}), rtcOccluded1 {:.1f} ms, ratio {:.3f} "
                              "(from {:.3f} to {:.3f}; by processor time {:.3f})\n",
                              bench.name, triangles, rays.size(), 100.0 * occludedShare, different,
                              stats.flattenSceneMs + stats.pairMs + stats.buildMs + stats.flattenMs,
                              stats.flattenSceneMs, stats.pairMs, stats.buildMs, stats.flattenMs, stats.depth,
                              stats.sahCost, mib, stats.bytesPerTriangle, stats.nodes, stats.pairs,
                              median(gpuMs), firstMs, median(embreeMs), median(ratios),
                              *std::min_element(ratios.begin(), ratios.end()),
                              *std::max_element(ratios.begin(), ratios.end()), median(cpuRatios));
    result.json = fmt::format(
        R"({{"scene":"{}","triangles":{},"rays":{},"occluded":{:.4f},"different":{},"buildMs":{:.2f},)"
        R"("mebibytes":{:.3f},"bytesPerTriangle":{:.2f},"computeMs":{:.3f},"firstDispatchMs":{:.1f},)"
        R"("embreeMs":{:.3f},"ratio":{:.4f},"ratioCpuTime":{:.4f},"pairs":{}}})",
        bench.name, triangles, rays.size(), occludedShare, different,
        stats.flattenSceneMs + stats.pairMs + stats.buildMs + stats.flattenMs, mib, stats.bytesPerTriangle,
        median(gpuMs), firstMs, median(embreeMs), median(ratios), median(cpuRatios), options.pairs);
    return result;
}

Options parse(int argc, char** argv) {
    Options options;
    for (int i = 1; i < argc; ++i) {
        const auto value = [&] { return i + 1 < argc ? argv[++i] : ""; };
        if (!std::strcmp(argv[i], "--json"))
            options.json = value();
        else if (!std::strcmp(argv[i], "--pairs"))
            options.pairs = std::max(1, std::atoi(value()));
        else if (!std::strcmp(argv[i], "--size"))
            std::sscanf(value(), "%dx%d", &options.width, &options.height);
        else
            options.scenes.push_back(argv[i]);
    }
    options.width = std::max(8, options.width / 8 * 8);
    options.height = std::max(8, options.height / 8 * 8);
    return options;
}

int run(int argc, char** argv) {
    const Options options = parse(argc, argv);
    gpu::Device device;
    gpu::PassResources resources(device);
    fmt::print("device '{}', {} threads, {} interleaved pairs\n", device.name(), options.threads,
               options.pairs);
    std::vector<BenchScene> scenes;
    scenes.push_back(makeHall());
    scenes.push_back(makeMovingHall());
    for (const std::string& path : options.scenes)
        scenes.push_back(loadBenchScene(path));
    std::string json;
    for (const BenchScene& scene : scenes) {
        const SceneResult result = benchScene(device, resources, scene, options);
        fmt::print("{}", result.text);
        json += (json.empty() ? "" : ",\n") + result.json;
    }
    json = fmt::format("{{\"device\":\"{}\",\"threads\":{},\"scenes\":[\n{}]}}\n", device.name(),
                       options.threads, json);
    if (options.json.empty())
        fmt::print("{}", json);
    else
        std::ofstream(options.json) << json;
    return 0;
}

} // namespace

} // namespace kilolux::test

int main(int argc, char** argv) {
    return kilolux::test::run(argc, argv);
}
