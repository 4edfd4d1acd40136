// The report as one page: what was measured and how, curves of error against time and rays, tables, pictures.
#include "renderer/bench/bench_math.h"
#include "renderer/bench/bench_scene.h"
#include "renderer/bench/html_parts.h"
#include "renderer/bench/sweep.h"

#include "renderer/view_colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

namespace kilolux::bench {

namespace {

std::vector<std::uint8_t> flipPicture(const std::vector<float>& map) {
    std::vector<std::uint8_t> srgb;
    for (const float value : map)
        for (const float channel : amountColor(std::clamp(2.0f * value, 0.0f, 1.0f)))
            srgb.push_back(std::uint8_t(std::lround(255.0f * std::clamp(channel, 0.0f, 1.0f))));
    return srgb;
}

// --- Curves ----------------------------------------------------------------------------------------------

// Medians over the repetitions: x = frames * perFrame.
Curve curveOf(const MethodResult& method, const std::vector<BenchRun>& runs, double BenchRun::*perFrame) {
    Curve curve{method.method.label, {}};
    if (runs.empty()) return curve;
    for (std::size_t i = 0; i < runs.front().points.size(); ++i) {
        std::vector<double> x, y;
        for (const BenchRun& run : runs) {
            x.push_back(run.points[i].frame * (run.*perFrame));
            y.push_back(run.points[i].relativeMse);
        }
        if (medianOf(x) > 0.0) curve.points.emplace_back(medianOf(x), medianOf(y));
    }
    return curve;
}

std::string plot(const SceneResult& scene, bool filtered) {
    std::vector<Curve> curves;
    for (const MethodResult& method : scene.methods)
        curves.push_back(filtered ? curveOf(method, method.filtered, &BenchRun::lightingMs)
                                  : curveOf(method, method.raw, &BenchRun::raysPerPixel));
    return logPlot(
        curves, filtered ? "ms of direct lighting, denoised picture" : "rays per pixel, mean of raw frames",
        "relative MSE");
}

// --- Tables ----------------------------------------------------------------------------------------------

std::string ratioCell(const std::vector<double>& ratios) {
    if (ratios.empty()) return "<td>no frame yet</td>";
    const Interval i = intervalOf(ratios);
    return fmt::format("<td>{:.2f} <small>{:.2f} to {:.2f}</small></td>", i.median, i.least, i.largest);
}

std::string methodRow(const SceneResult& scene, const MethodResult& m,
                      const std::vector<double>& rayBudgets) {
    if (m.error)
        return fmt::format("<tr><th>{}</th><td colspan=\"13\">{}</td></tr>\n", escaped(m.method.label),
                           escaped(*m.error));
    std::vector<double> ms, rays, errors, flips, energy;
    for (const BenchRun& run : m.filtered) {
        ms.push_back(run.lightingMs);
        rays.push_back(run.raysPerPixel);
        errors.push_back(run.points.back().relativeMse);
        flips.push_back(run.points.back().flipMean);
        energy.push_back(run.points.back().energyRatio);
    }
    std::string row = fmt::format("<tr><th>{}</th><td>{}</td><td>{:.1f}</td><td>{:.2f}</td><td>{:.1f}</td>"
                                  "<td>{:.4f}</td><td>{:.4f}</td><td>{:+.2f} %</td>",
                                  escaped(m.method.label), m.reference, medianOf(ms), medianOf(rays),
                                  m.statistics.gpuMemoryPeakMiB, medianOf(errors), medianOf(flips),
                                  100.0 * (medianOf(energy) - 1.0));
    for (const double budget : scene.budgetsMs)
        row += ratioCell(ratiosAtEqualTime(scene.methods.front(), m, budget));
    for (const double budget : rayBudgets)
        row += ratioCell(ratiosAtEqualRays(scene.methods.front(), m, budget));
    return row + "</tr>\n";
}

std::string methodTable(const SceneResult& scene, const BenchPlan& plan) {
    std::string head =
        fmt::format("<tr><th>method</th><th>held against</th><th>ms a frame</th><th>rays a pixel</th>"
                    "<th>MiB</th><th>error, {0} frames</th><th>FLIP, {0} frames</th><th>energy</th>",
                    plan.frames);
    for (const double budget : scene.budgetsMs)
        head += fmt::format("<th>error after {:.0f} ms over the first's</th>", budget);
    for (const double rays : plan.budgetsRays)
        head += fmt::format("<th>raw error after {:g} rays a pixel over the first's</th>", rays);
    std::string rows;
    for (const MethodResult& method : scene.methods)
        rows += methodRow(scene, method, plan.budgetsRays);
    return "<table>" + head + "</tr>\n" + rows + "</table>\n";
}

// Of pictures that stand still: how noisy one frame is, how alike the errors of its samples are, what is left
// to see.
std::string stillTable(const SceneResult& scene) {
    std::string rows;
    for (const MethodResult& m : scene.methods) {
        if (!m.still) continue;
        rows += fmt::format(
            "<tr><th>{}</th><td>{:.4f}</td><td>{:.2f}</td><td>{:.2f}</td><td>{:.4f}</td><td>{:.4f}</td>"
            "</tr>\n",
            escaped(m.method.label), m.still->frameError, m.still->inTime, m.still->inSpace, m.still->flicker,
            m.still->hdrFlip);
    }
    if (rows.empty()) return {};
    return "<table><tr><th>standing still, 16th frame</th><th>error of a raw frame</th><th>samples alike in "
           "time</th>"
           "<th>and in space</th><th>flicker, denoised</th><th>HDR-FLIP, denoised</th></tr>\n" +
           rows + "</table>\n";
}

std::string changeTable(const SceneResult& scene) {
    std::string rows;
    for (const MethodResult& m : scene.methods) {
        for (const ChangeResult& c : m.changes) {
            std::string lag = "-";
            if (c.change == Change::LightsOn) lag = c.lagFrames ? fmt::format("{}", *c.lagFrames) : "never";
            rows +=
                fmt::format("<tr><th>{}, {}</th><td>{}</td><td>{}</td><td>{:.4f}</td><td>{:.4f}</td></tr>\n",
                            escaped(m.method.label), changeName(c.change), lag,
                            c.arrived.empty() ? "-" : fmt::format("{:.0f} %", 100.0 * c.arrived.front()),
                            c.relativeMse, c.flipMean);
        }
    }
    if (rows.empty()) return {};
    return "<table><tr><th>while the scene changes, denoised</th><th>frames until 90 % is there</th>"
           "<th>there in the first</th><th>error, 24th frame</th><th>FLIP, 24th frame</th></tr>\n" +
           rows + "</table>\n";
}

// --- Scaling ---------------------------------------------------------------------------------------------

double sweptAmount(Sweep sweep, const SceneResult& step) {
    const FrameStatistics& statistics = step.methods.front().statistics;
    switch (sweep) {
    case Sweep::Lights:
        return double(statistics.lights);
    case Sweep::Resolution:
        return double(step.width) * step.height;
    case Sweep::Triangles:
        return double(statistics.triangles);
    default:
        return step.sweepFactor;
    }
}

double medianMs(const MethodResult& method) {
    std::vector<double> ms;
    for (const BenchRun& run : method.filtered)
        ms.push_back(run.lightingMs);
    return medianOf(ms);
}

double lastError(const MethodResult& method) {
    std::vector<double> errors;
    for (const BenchRun& run : method.filtered)
        errors.push_back(run.points.back().relativeMse);
    return medianOf(errors);
}

// Time and error over what is swept, for each scene.
std::string scaling(const BenchResult& result) {
    const Sweep sweep = result.plan.sweep;
    if (sweep == Sweep::None) return {};
    const std::string amount = sweep == Sweep::Resolution ? "pixels"
                               : sweep == Sweep::Rays     ? "rays a pixel that are asked for"
                                                          : std::string(sweepName(sweep));
    std::string text = "<h2>Scaling</h2>\n";
    for (std::size_t first = 0, end = 0; first < result.scenes.size(); first = end) {
        const std::filesystem::path file = result.scenes[first].scene.file;
        while (end < result.scenes.size() && result.scenes[end].scene.file == file)
            ++end;
        std::vector<Curve> time, error;
        for (std::size_t m = 0; m < result.plan.methods.size(); ++m) {
            time.push_back({result.plan.methods[m].label, {}});
            error.push_back(time.back());
            for (std::size_t i = first; i < end; ++i) {
                const MethodResult& method = result.scenes[i].methods[m];
                if (method.error || method.filtered.empty()) continue;
                const double x = sweptAmount(sweep, result.scenes[i]);
                time.back().points.emplace_back(x, std::max(medianMs(method), 1e-3));
                error.back().points.emplace_back(x, lastError(method));
            }
        }
        text += fmt::format("<h3>{}</h3>\n", escaped(file.filename().string())) +
                logPlot(time, amount, "ms of direct lighting a frame") +
                logPlot(error, amount, fmt::format("relative MSE, denoised, {} frames", result.plan.frames));
    }
    return text;
}

// The talk's stages for opaque surfaces, PlayStation 5 at 1080p, beside the first method's passes here.
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
    for (const Stage& stage : stages) {
        double ms = 0.0;
        for (const PassTiming& pass : m.statistics.passes)
            if (std::find(stage.passes.begin(), stage.passes.end(), pass.name) != stage.passes.end())
                ms += pass.medianMs;
        rows += fmt::format("<tr><th>{}</th><td>{}</td><td>{}</td></tr>\n", stage.name,
                            stage.passes.empty() ? "none" : fmt::format("{:.2f}", ms),
                            stage.talkMs < 0.0 ? "not told" : fmt::format("{:.2f}", stage.talkMs));
    }
    return fmt::format(
        "<table><tr><th>stage</th><th>{}, ms here</th><th>the talk, ms on its console</th></tr>\n{}"
        "</table>\n",
        escaped(m.method.label), rows);
}

std::string pictures(const SceneResult& scene, const BenchPlan& plan) {
    const int frame = std::min(kShownFrame, plan.frames);
    std::string text = picture(scene.width, scene.height, scene.referenceShown, "reference (true)");
    for (const MethodResult& m : scene.methods) {
        text +=
            picture(scene.width, scene.height, m.shown, fmt::format("{}, frame {}", m.method.label, frame));
        text += picture(scene.width, scene.height, flipPicture(m.shownFlip),
                        fmt::format("{}: FLIP, yellow is 0.5", m.method.label));
    }
    return "<div class=\"pictures\">" + text + "</div>\n";
}

std::string sceneSection(const SceneResult& scene, const BenchPlan& plan) {
    const std::string step =
        plan.sweep == Sweep::None ? "" : fmt::format(", {} x {:g}", sweepName(plan.sweep), scene.sweepFactor);
    return fmt::format("<h2>{}, camera {}{}</h2>\n<p>{} x {} pixels, {} lights, {} triangles, EV100 {:.2f}. "
                       "Relative MSE of "
                       "'split' against 'true', the error of the shading model: {:.5f}.</p>\n",
                       escaped(scene.scene.file.filename().string()), escaped(scene.camera), step,
                       scene.width, scene.height, scene.methods.front().statistics.lights,
                       scene.methods.front().statistics.triangles, scene.exposureEv100, scene.modelGap) +
           methodTable(scene, plan) + stillTable(scene) + changeTable(scene) + plot(scene, true) +
           plot(scene, false) + stageTable(scene.methods.front()) + pictures(scene, plan);
}

std::string meanCell(const OverScenes& mean, std::size_t allScenes) {
    if (mean.scenes == 0) return "<td>-</td>";
    const Interval& i = mean.firstOverOther;
    const std::string fewer =
        mean.scenes < allScenes ? fmt::format("<br><small>{} scenes</small>", mean.scenes) : "";
    return fmt::format("<td>{:.2f} <small>{:.2f} to {:.2f}</small>{}</td>", i.median, i.least, i.largest,
                       fewer);
}

// Geometric means over the scenes of error(first) / error(other).
std::string summary(const BenchResult& result) {
    std::string head, rows;
    for (std::size_t i = 1; i < result.plan.methods.size(); ++i) {
        std::string row;
        for (const OverScenes& mean : meansOverScenes(result, i)) {
            row += meanCell(mean, result.scenes.size());
            if (i == 1) head += fmt::format("<th>{}</th>", escaped(mean.at));
        }
        rows += fmt::format("<tr><th>{}</th>{}</tr>\n", escaped(result.plan.methods[i].label), row);
    }
    return fmt::format(
        "<h2>All scenes</h2><p>Geometric means over {} scenes; below 1 {} has the smaller error.</p>\n"
        "<table><tr><th>error of {} over that of</th>{}</tr>\n{}</table>\n",
        result.scenes.size(), escaped(result.plan.methods.front().label),
        escaped(result.plan.methods.front().label), head, rows);
}

constexpr const char* kStyle =
    "body{font:15px/1.5 system-ui,sans-serif;max-width:72rem;margin:2rem auto;padding:0 1rem;color:#222}"
    "table{border-collapse:collapse;margin:1rem "
    "0;font-variant-numeric:tabular-nums;display:block;overflow-x:auto}"
    "th,td{padding:.25rem .7rem;text-align:right;border-bottom:1px solid #ddd;white-space:nowrap}"
    "tr:first-child th{font-size:.8rem;white-space:normal;min-width:4rem;vertical-align:bottom}"
    "th:first-child{text-align:left}"
    "small{color:#666}svg{max-width:100%;font-size:12px}.g{stroke:#ddd}"
    ".pictures{display:flex;flex-wrap:wrap;gap:1rem}figure{margin:0}img{max-width:100%;height:auto}"
    "figcaption{color:#555}code{background:#f2f2f2;padding:.1rem .3rem;overflow-wrap:anywhere}";

} // namespace

std::string benchHtml(const BenchResult& result) {
    const BenchPlan& plan = result.plan;
    std::string page = fmt::format(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
        "content=\"width=device-width\"><title>Kilolux bench</title><style>{}</style></head><body>\n"
        "<h1>Speed against error</h1>\n<p>{}, {} ({}). {} x {} pixels, {} still frames without jitter, {} "
        "repetitions, interleaved. Made by <code>{}</code>.{}</p>\n",
        kStyle, escaped(plan.date), escaped(result.device), escaped(result.driver), plan.width, plan.height,
        plan.frames, plan.repetitions, escaped(plan.command),
        result.cancelled ? " The run was stopped before its end." : "");
    page += fmt::format(
        "<p>Error is the relative mean squared error of exposed light, (picture - reference)&#178; / "
        "(reference&#178; "
        "+ 0.01), against the reference that the method converges to: 'split' (analytic irradiance times "
        "mean "
        "visibility) or 'true' (the BRDF at sampled points), {} frames of 4 rays a light each; two "
        "independent "
        "halves take the reference's own noise out. Time is that of direct lighting alone: culling, choice, "
        "rays, "
        "shading, denoising. Beside a ratio stand the least and the largest of the repetitions. Samples are "
        "alike when their errors are: 0 is independent, 1 the same; what is alike no filter can take away. A "
        "picture "
        "flickers by so much from frame to frame, relative to its light.</p>\n",
        plan.referenceFrames);
    if (plan.methods.size() > 1 && !result.scenes.empty()) page += summary(result);
    page += scaling(result);
    for (const SceneResult& scene : result.scenes)
        page += sceneSection(scene, plan);
    return page + "</body></html>\n";
}

} // namespace kilolux::bench
