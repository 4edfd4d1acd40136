// The report as one page: what was measured and how, curves of error against time and rays, tables, pictures.
#include "renderer/bench/bench_math.h"
#include "renderer/bench/bench_scene.h"
#include "renderer/bench/html_costs.h"
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

std::string ratioCell(const std::vector<double>& ratios, const char* none = "no frame yet") {
    if (ratios.empty()) return fmt::format("<td>{}</td>", none);
    const Interval i = intervalOf(ratios);
    return fmt::format("<td>{:.2f} <small>{:.2f} to {:.2f}</small></td>", i.median, i.least, i.largest);
}

std::string methodRow(const MethodResult& m) {
    if (m.error)
        return fmt::format("<tr><th>{}</th><td colspan=\"7\">{}</td></tr>\n", escaped(m.method.label),
                           escaped(*m.error));
    std::vector<double> ms, rays, errors, flips, energy;
    for (const BenchRun& run : m.filtered) {
        ms.push_back(run.lightingMs);
        rays.push_back(run.raysPerPixel);
        errors.push_back(run.points.back().relativeMse);
        flips.push_back(run.points.back().flipMean);
        energy.push_back(run.points.back().energyRatio);
    }
    return fmt::format("<tr><th>{}</th><td>{}</td><td>{:.1f}</td><td>{:.2f}</td><td>{:.1f}</td>"
                       "<td>{:.4f}</td><td>{:.4f}</td><td>{:+.2f} %</td></tr>\n",
                       escaped(m.method.label), m.reference, medianOf(ms), medianOf(rays),
                       m.statistics.gpuMemoryPeakMiB, medianOf(errors), medianOf(flips),
                       100.0 * (medianOf(energy) - 1.0));
}

std::string methodTable(const SceneResult& scene, const BenchPlan& plan) {
    std::string rows;
    for (const MethodResult& method : scene.methods)
        rows += methodRow(method);
    return fmt::format(
        "<table><tr><th>method</th><th>held against</th><th>ms a frame</th><th>rays a pixel</th>"
        "<th>MiB</th><th>error, {0} frames</th><th>FLIP, {0} frames</th><th>energy</th></tr>\n"
        "{1}</table>\n",
        plan.frames, rows);
}

// Errors over that of the first method; above 1 the first is better.
std::string ratioTable(const SceneResult& scene, const BenchPlan& plan) {
    const MethodResult& first = scene.methods.front();
    std::string head = fmt::format("<tr><th>error over that of {}</th>", escaped(first.method.label)), rows;
    for (const double budget : scene.budgetsMs)
        head += fmt::format("<th>denoised, after {:.0f} ms</th>", budget);
    for (const double rays : plan.budgetsRays)
        head += fmt::format("<th>raw, after {:g} rays a pixel</th>", rays);
    for (std::size_t i = 1; i < scene.methods.size(); ++i) {
        const MethodResult& m = scene.methods[i];
        if (m.error) continue;
        const bool traces = std::any_of(m.raw.begin(), m.raw.end(),
                                        [](const BenchRun& run) { return run.raysPerPixel > 0.0; });
        rows += fmt::format("<tr><th>{}</th>", escaped(m.method.label));
        for (const double budget : scene.budgetsMs)
            rows += ratioCell(ratiosAtEqualTime(first, m, budget));
        for (const double budget : plan.budgetsRays)
            rows += ratioCell(ratiosAtEqualRays(first, m, budget), traces ? "no frame yet" : "no rays");
        rows += "</tr>\n";
    }
    return rows.empty() ? "" : "<table>" + head + "</tr>\n" + rows + "</table>\n";
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
    return "<p>While the scene changes: 'lights-on' switches every other light on after 12 frames without, "
           "'lights-move' swings all local lights by 2 % of the scene's extent, 'camera-turns' turns by 20 "
           "degrees a second, both at 30 frames a second. The picture of the 24th frame is held against what "
           "it should be then.</p>\n"
           "<table><tr><th>while the scene changes, denoised</th><th>frames until 90 % is there</th>"
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
    std::string text =
        "<h2>Scaling</h2>\n<p>A dot is a step of the sweep, which has a section of its own below.</p>\n";
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
           methodTable(scene, plan) + ratioTable(scene, plan) + stillTable(scene) + changeTable(scene) +
           plot(scene, true) + plot(scene, false) + stageTable(scene.methods.front()) + passTable(scene) +
           pictures(scene, plan);
}

std::string meanCell(const OverScenes& mean, std::size_t allScenes) {
    if (mean.scenes == 0) return "<td>no frame yet</td>";
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
        "<h2>All together</h2><p>Geometric means over {} {}; below 1 {} has the smaller error.</p>\n"
        "<table><tr><th>error of {} over that of</th>{}</tr>\n{}</table>\n",
        result.scenes.size(), result.plan.sweep == Sweep::None ? "scenes" : "steps of the sweep",
        escaped(result.plan.methods.front().label), escaped(result.plan.methods.front().label), head, rows);
}

constexpr const char* kStyle =
    "body{font:15px/1.5 system-ui,sans-serif;max-width:72rem;margin:2rem auto;padding:0 1rem;color:#222}"
    "table{border-collapse:collapse;margin:1rem "
    "0;font-variant-numeric:tabular-nums;display:block;overflow-x:auto}"
    "th,td{padding:.25rem .7rem;text-align:right;border-bottom:1px solid #ddd;white-space:nowrap}"
    "tr:first-child th{font-size:.8rem;white-space:normal;min-width:4rem;vertical-align:bottom}"
    "th:first-child{text-align:left}"
    "small{color:#666}svg{max-width:100%;font-size:12px}.g{stroke:#ddd}"
    ".pictures{display:flex;flex-wrap:wrap;gap:1rem}figure{margin:0}img{max-width:100%;height:auto;image-"
    "rendering:pixelated}"
    "figcaption{color:#555}code{background:#f2f2f2;padding:.1rem .3rem;overflow-wrap:anywhere}";

} // namespace

std::string benchHtml(const BenchResult& result) {
    const BenchPlan& plan = result.plan;
    std::string page = fmt::format(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
        "content=\"width=device-width\"><title>Kilolux bench</title><style>{}</style></head><body>\n"
        "<h1>Speed against error</h1>\n<p>{}, {} ({}). {} x {} pixels, {} still frames without jitter, {} "
        "repetition{}, interleaved. Made by <code>{}</code>.{}</p>\n",
        kStyle, escaped(plan.date), escaped(result.device), escaped(result.driver), plan.width, plan.height,
        plan.frames, plan.repetitions, plan.repetitions == 1 ? "" : "s", escaped(plan.command),
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
        "flickers by so much from frame to frame, relative to its light. Both axes of every plot are "
        "logarithmic; "
        "a curve is better the lower and the farther left it is, and the dots of a method are its frames 1, "
        "2, "
        "4, 8 and so on. "
        "'the talk' is "
        "'MegaLights: Stochastic Direct Lighting in Unreal Engine 5' (SIGGRAPH 2025), whose stages the first "
        "method follows.</p>\n",
        plan.referenceFrames);
    if (plan.methods.size() > 1 && !result.scenes.empty()) page += summary(result);
    page += scaling(result);
    for (const SceneResult& scene : result.scenes)
        page += sceneSection(scene, plan);
    return page + "</body></html>\n";
}

} // namespace kilolux::bench
