#include "renderer/bench/html_costs.h"

#include "renderer/bench/html_parts.h"

#include <algorithm>
#include <fmt/format.h>

namespace kilolux::bench {

namespace {

const double* msOf(const FrameStatistics& statistics, const std::string& pass) {
    for (const PassTiming& timing : statistics.passes)
        if (timing.name == pass) return &timing.medianMs;
    return nullptr;
}

const double* mibOf(const FrameStatistics& statistics, const std::string& cause) {
    for (const MemoryCause& memory : statistics.gpuMemory)
        if (memory.cause == cause) return &memory.peakMiB;
    return nullptr;
}

using Amount = const double* (*)(const FrameStatistics&, const std::string&);

std::string amountRows(const SceneResult& scene, const std::vector<std::string>& names, Amount amount) {
    std::string rows;
    for (const std::string& name : names) {
        rows += fmt::format("<tr><th>{}</th>", escaped(name));
        for (const MethodResult& m : scene.methods) {
            const double* value = amount(m.statistics, name);
            rows += value ? fmt::format("<td>{:.2f}</td>", *value) : "<td></td>";
        }
        rows += "</tr>\n";
    }
    return rows;
}

} // namespace

std::string stageTable(const MethodResult& m) {
    struct Stage {
        const char* name;
        double talkMs; // below 0: not there
        std::vector<std::string_view> passes;
    };
    const std::vector<Stage> stages = {{"light grid", -1.0, {"cull_coarse", "cull_fine"}},
                                       {"sampling", 0.70, {"sample_lights", "upsample_samples"}},
                                       {"screen traces", 0.47, {}},
                                       {"ray tracing", 1.35, {"compact_rays", "trace_samples"}},
                                       {"shading", 0.55, {"shade_samples"}},
                                       {"visible light list", 0.05, {"visible_list"}},
                                       {"denoising", 0.96, {"denoise_temporal", "denoise_spatial"}}};
    std::string rows;
    double allMs = 0.0;
    for (const Stage& stage : stages) {
        double ms = 0.0;
        for (const PassTiming& pass : m.statistics.passes)
            if (std::find(stage.passes.begin(), stage.passes.end(), pass.name) != stage.passes.end())
                ms += pass.medianMs;
        allMs += ms;
        rows += fmt::format("<tr><th>{}</th><td>{}</td><td>{}</td></tr>\n", stage.name,
                            stage.passes.empty() ? "does not exist" : fmt::format("{:.2f}", ms),
                            stage.talkMs < 0.0 ? "not told" : fmt::format("{:.2f}", stage.talkMs));
    }
    return fmt::format(
        "<table><tr><th>stage</th><th>{}, ms here</th><th>the talk, ms on its console at 1080p</th></tr>\n{}"
        "<tr><th>volumes: fog and translucency</th><td>does not exist</td><td>0.11 + 0.48 + 0.1 + 0.42 + 0.1 "
        "+ 0.22</td></tr>\n<tr><th>all</th><td>{:.2f}</td><td>5.51</td></tr>\n</table>\n",
        escaped(m.method.label), rows, allMs);
}

std::string passTable(const SceneResult& scene) {
    std::vector<std::string> passes, causes;
    const auto addOnce = [](std::vector<std::string>& names, const std::string& name) {
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    };
    std::string methods;
    for (const MethodResult& m : scene.methods) {
        methods += fmt::format("<th>{}</th>", escaped(m.method.label));
        for (const PassTiming& timing : m.statistics.passes)
            addOnce(passes, timing.name);
        for (const MemoryCause& memory : m.statistics.gpuMemory)
            addOnce(causes, memory.cause);
    }
    return fmt::format(
        "<details><summary>every pass and all memory</summary>\n<p>Medians of the last "
        "repetition. A pass that runs now and then, as shadow maps that are drawn where something "
        "has changed, has here the time of once, and in the time per frame its share of the "
        "frames.</p>\n<table><tr><th>pass, ms</th>{0}</tr>\n{1}</table>\n"
        "<table><tr><th>memory by cause, MiB at most</th>{0}</tr>\n{2}</table>\n</details>\n",
        methods, amountRows(scene, passes, msOf), amountRows(scene, causes, mibOf));
}

} // namespace kilolux::bench
