// The report as one page: what was measured and how, curves of error against time and rays, tables, pictures.
#include "renderer/bench/bench_math.h"

#include "renderer/view_colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

namespace kilolux::bench {

namespace {

constexpr std::array kColors = {"#b45f06", "#1f77b4", "#2ca02c", "#9467bd",
                                "#d62728", "#17becf", "#7f7f7f", "#bcbd22"};

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '"':
            result += "&quot;";
            break;
        case '\'':
            result += "&#39;";
            break;
        default:
            result += c;
        }
    }
    return result;
}

std::string base64(const std::vector<std::uint8_t>& bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 3; ++k)
            word = word << 8 | (k < left ? bytes[i + k] : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= left ? digits[word >> (18 - 6 * k) & 63u] : '=';
    }
    return text;
}

// A PNG in the page itself.
std::string picture(int width, int height, const std::vector<std::uint8_t>& srgb,
                    const std::string& caption) {
    if (srgb.empty()) return {};
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const auto output = OIIO::ImageOutput::create("png", &memory);
    OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    if (!output || !output->open("picture.png", spec) ||
        !output->write_image(OIIO::TypeDesc::UINT8, srgb.data()) || !output->close())
        return fmt::format("<p>no picture: {}</p>", escaped(output ? output->geterror() : "no PNG writer"));
    return fmt::format("<figure><img width=\"{}\" height=\"{}\" alt=\"{}\" src=\"data:image/png;base64,{}\">"
                       "<figcaption>{}</figcaption></figure>\n",
                       width, height, escaped(caption), base64(bytes), escaped(caption));
}

std::vector<std::uint8_t> flipPicture(const std::vector<float>& map) {
    std::vector<std::uint8_t> srgb;
    for (const float value : map)
        for (const float channel : amountColor(std::clamp(2.0f * value, 0.0f, 1.0f)))
            srgb.push_back(std::uint8_t(std::lround(255.0f * std::clamp(channel, 0.0f, 1.0f))));
    return srgb;
}

// --- Curves ----------------------------------------------------------------------------------------------

struct Curve {
    std::string label;
    std::vector<std::pair<double, double>> points; // both above 0
};

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

class LogPlot {
  public:
    LogPlot(const std::vector<Curve>& curves, std::string xLabel)
        : curves_(curves), xLabel_(std::move(xLabel)) {
        for (const Curve& curve : curves)
            for (const auto& [x, y] : curve.points) {
                low_[0] = std::min(low_[0], std::log10(x));
                high_[0] = std::max(high_[0], std::log10(x));
                low_[1] = std::min(low_[1], std::log10(y));
                high_[1] = std::max(high_[1], std::log10(y));
            }
    }

    std::string svg() const {
        if (low_[0] > high_[0]) return "<p>nothing to plot</p>\n";
        std::string text =
            fmt::format("<svg viewBox=\"0 0 {} {}\" width=\"{}\" role=\"img\">\n", kWidth, kHeight, kWidth);
        for (int axis = 0; axis < 2; ++axis)
            for (int decade = int(std::floor(low_[axis])); decade <= int(std::ceil(high_[axis])); ++decade)
                text += gridLine(axis, decade);
        for (std::size_t i = 0; i < curves_.size(); ++i)
            text += line(curves_[i], kColors[i % kColors.size()], int(i));
        return text + fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>"
                                  "<text x=\"12\" y=\"14\">relative MSE</text></svg>\n",
                                  kLeft + (kRight - kLeft) / 2, kHeight - 4, escaped(xLabel_));
    }

  private:
    static constexpr double kWidth = 640, kHeight = 320, kLeft = 60, kRight = 440, kTop = 24, kBottom = 284;

    double place(int axis, double logValue) const {
        const double from = std::floor(low_[axis]), to = std::max(std::ceil(high_[axis]), from + 1.0);
        const double t = (logValue - from) / (to - from);
        return axis == 0 ? std::lerp(kLeft, kRight, t) : std::lerp(kBottom, kTop, t);
    }
    std::string gridLine(int axis, int decade) const {
        const double at = place(axis, decade);
        const std::string number = fmt::format("{:g}", std::pow(10.0, decade));
        if (axis == 0)
            return fmt::format("<line class=\"g\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/>"
                               "<text x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">{4}</text>\n",
                               at, kTop, kBottom, kBottom + 14, number);
        return fmt::format("<line class=\"g\" x1=\"{1}\" x2=\"{2}\" y1=\"{0:.1f}\" y2=\"{0:.1f}\"/>"
                           "<text x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\">{5}</text>\n",
                           at, kLeft, kRight, kLeft - 4, at + 4, number);
    }
    std::string line(const Curve& curve, const char* color, int index) const {
        std::string points, dots;
        for (const auto& [x, y] : curve.points) {
            const double px = place(0, std::log10(x)), py = place(1, std::log10(y));
            points += fmt::format("{:.1f},{:.1f} ", px, py);
            dots += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"/>", px, py, color);
        }
        const double y = kTop + 16.0 * index + 8.0;
        return fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>{}"
                           "<rect x=\"{}\" y=\"{}\" width=\"10\" height=\"10\" fill=\"{}\"/><text x=\"{}\" "
                           "y=\"{}\">{}</text>\n",
                           points, color, dots, kRight + 16, y - 9, color, kRight + 30, y,
                           escaped(curve.label));
    }

    const std::vector<Curve>& curves_;
    std::string xLabel_;
    double low_[2] = {1e9, 1e9}, high_[2] = {-1e9, -1e9};
};

std::string plot(const SceneResult& scene, bool filtered) {
    std::vector<Curve> curves;
    for (const MethodResult& method : scene.methods)
        curves.push_back(filtered ? curveOf(method, method.filtered, &BenchRun::lightingMs)
                                  : curveOf(method, method.raw, &BenchRun::raysPerPixel));
    return LogPlot(curves, filtered ? "ms of direct lighting, denoised picture"
                                    : "rays per pixel, mean of raw frames")
        .svg();
}

// --- Tables ----------------------------------------------------------------------------------------------

std::string ratioCell(const std::vector<double>& ratios) {
    if (ratios.empty()) return "<td>no frame yet</td>";
    const Interval i = intervalOf(ratios);
    return fmt::format("<td>{:.2f} <small>{:.2f} to {:.2f}</small></td>", i.median, i.least, i.largest);
}

std::string methodRow(const SceneResult& scene, const MethodResult& m) {
    if (m.error)
        return fmt::format("<tr><th>{}</th><td colspan=\"9\">{}</td></tr>\n", escaped(m.method.label),
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
    for (const double budget : {1.0, 16.0})
        row += ratioCell(ratiosAtEqualRays(scene.methods.front(), m, budget));
    return row + "</tr>\n";
}

std::string methodTable(const SceneResult& scene, int frames) {
    std::string head =
        fmt::format("<tr><th>method</th><th>held against</th><th>ms a frame</th><th>rays a pixel</th>"
                    "<th>MiB</th><th>error, {0} frames</th><th>FLIP, {0} frames</th><th>energy</th>",
                    frames);
    for (const double budget : scene.budgetsMs)
        head += fmt::format("<th>error after {:.0f} ms over the first's</th>", budget);
    for (const int rays : {1, 16})
        head += fmt::format("<th>raw error after {} rays a pixel over the first's</th>", rays);
    std::string rows;
    for (const MethodResult& method : scene.methods)
        rows += methodRow(scene, method);
    return "<table>" + head + "</tr>\n" + rows + "</table>\n";
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
    std::string text = picture(plan.width, plan.height, scene.referenceShown, "reference (true)");
    for (const MethodResult& m : scene.methods) {
        text += picture(plan.width, plan.height, m.shown, fmt::format("{}, frame {}", m.method.label, frame));
        text += picture(plan.width, plan.height, flipPicture(m.shownFlip),
                        fmt::format("{}: FLIP, yellow is 0.5", m.method.label));
    }
    return "<div class=\"pictures\">" + text + "</div>\n";
}

std::string sceneSection(const SceneResult& scene, const BenchPlan& plan) {
    return fmt::format(
               "<h2>{}, camera {}</h2>\n<p>{} lights, {} triangles, EV100 {:.2f}. Relative MSE of 'split' "
               "against 'true', the error of the shading model: {:.5f}.</p>\n",
               escaped(scene.scene.file.filename().string()), escaped(scene.camera),
               scene.methods.front().statistics.lights, scene.methods.front().statistics.triangles,
               scene.exposureEv100, scene.modelGap) +
           methodTable(scene, plan.frames) + plot(scene, true) + plot(scene, false) +
           stageTable(scene.methods.front()) + pictures(scene, plan);
}

// Geometric means over the scenes of error(first) / error(other), at the last budget.
std::string summary(const BenchResult& result) {
    std::string rows;
    for (std::size_t i = 1; i < result.plan.methods.size(); ++i) {
        std::vector<double> time, rays;
        for (const SceneResult& scene : result.scenes) {
            const std::vector<double> t =
                ratiosAtEqualTime(scene.methods.front(), scene.methods[i], scene.budgetsMs.back());
            const std::vector<double> r = ratiosAtEqualRays(scene.methods.front(), scene.methods[i], 16.0);
            if (!t.empty()) time.push_back(1.0 / medianOf(t));
            if (!r.empty()) rays.push_back(1.0 / medianOf(r));
        }
        rows += fmt::format(
            "<tr><th>{}</th><td>{}</td><td>{}</td></tr>\n", escaped(result.plan.methods[i].label),
            time.empty() ? "-" : fmt::format("{:.2f} over {} scenes", geometricMean(time), time.size()),
            rays.empty() ? "-" : fmt::format("{:.2f} over {} scenes", geometricMean(rays), rays.size()));
    }
    return fmt::format(
        "<h2>All scenes</h2><table><tr><th>error of {} over that of</th><th>at equal time, denoised</th>"
        "<th>at 16 rays a pixel, raw</th></tr>\n{}</table>\n",
        escaped(result.plan.methods.front().label), rows);
}

constexpr const char* kStyle =
    "body{font:15px/1.5 system-ui,sans-serif;max-width:72rem;margin:2rem auto;padding:0 1rem;color:#222}"
    "table{border-collapse:collapse;margin:1rem 0;font-variant-numeric:tabular-nums}"
    "th,td{padding:.25rem .7rem;text-align:right;border-bottom:1px solid #ddd}th:first-child{text-align:left}"
    "small{color:#666}svg{max-width:100%;font-size:12px}.g{stroke:#ddd}"
    ".pictures{display:flex;flex-wrap:wrap;gap:1rem}figure{margin:0}img{max-width:100%;height:auto}"
    "figcaption{color:#555}code{background:#f2f2f2;padding:.1rem .3rem}";

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
        "shading, denoising. Below a ratio stand the least and the largest of the repetitions.</p>\n",
        plan.referenceFrames);
    if (plan.methods.size() > 1 && !result.scenes.empty()) page += summary(result);
    for (const SceneResult& scene : result.scenes)
        page += sceneSection(scene, plan);
    return page + "</body></html>\n";
}

} // namespace kilolux::bench
