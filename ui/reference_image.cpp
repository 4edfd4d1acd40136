// Stored picture, split view and live error in the window; see reference_image.h.
#include "ui/reference_image.h"

#include "renderer/settings_presets.h"
#include "ui/panels.h"
#include "ui/quality_part.h"
#include "ui/theme.h"
#include "ui/widgets.h"

#include <bit>
#include <fmt/format.h>
#include <functional>
#include <imgui.h>

namespace kilolux {

namespace {

constexpr std::uint32_t kStillFrames = 4; // of the mean, until the picture is worth measuring

ReferenceState& state(Desk& desk) {
    if (!desk.reference) desk.reference = std::make_shared<ReferenceState>();
    return *desk.reference;
}

// Names all that a reference depends on.
std::uint64_t viewKey(const Desk& desk, const std::string& method) {
    const ShownFrame& shown = *desk.shown;
    std::uint64_t key = std::hash<std::string>{}(method) ^ settingsHash(referenceSettings(desk.settings));
    const auto add = [&key](std::uint64_t word) { key = (key ^ word) * 1099511628211ull + (key >> 29); };
    add(shown.documentVersion);
    add(std::uint64_t(shown.width) << 32 | std::uint64_t(shown.height));
    add(std::bit_cast<std::uint64_t>(desk.exposureEv100));
    add(std::bit_cast<std::uint64_t>(shown.camera.yfovRad));
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 3; ++row)
            add(std::bit_cast<std::uint64_t>(shown.camera.worldFromCamera[column][row]));
    return key;
}

ReferenceView referenceView(const Desk& desk, const std::string& method, std::uint64_t key) {
    ReferenceView view{*desk.scene(), {}, desk.shown->camera, desk.exposureEv100, key};
    view.options.method = method;
    view.options.settings = referenceSettings(desk.settings);
    view.options.width = desk.shown->width;
    view.options.height = desk.shown->height;
    return view;
}

// Keeps the reference on the view that is shown, and has the picture measured whenever one of their means has
// doubled.
void followLive(Desk& desk) {
    ReferenceState& ref = state(desk);
    if (!ref.measures) return;
    const ShownFrame& shown = *desk.shown;
    const bool still = shown.settings == desk.settings && shown.renderScale == desk.settings.renderScale &&
                       shown.meanFrames >= kStillFrames && shown.documentVersion == desk.session->version() &&
                       desk.view.empty();
    ref.live->setResting(!still);
    const LiveReference::State live = ref.live->state();
    if (live.report != ref.report) {
        ref.report = live.report;
        ref.comparing = false;
    }
    if (!still) return;
    const std::uint64_t key = viewKey(desk, ref.method);
    if (key != ref.wantedKey) {
        ref.wantedKey = key;
        ref.comparedFrames = ref.comparedMean = 0;
        ref.comparing = false;
        ref.report.reset();
        ref.live->begin(referenceView(desk, ref.method, key));
        return;
    }
    // Either of them has twice as many frames, or the picture has begun anew.
    const std::string preset = presetName(shown.settings);
    const bool due = live.frames >= std::max(1u, 2 * ref.comparedFrames) ||
                     shown.meanFrames >= 2 * ref.comparedMean || shown.meanFrames < ref.comparedMean ||
                     preset != ref.comparedPreset;
    if (live.key != key || live.frames == 0 || ref.comparing || !due) return;
    ref.comparing = true;
    ref.comparedFrames = live.frames;
    ref.comparedMean = shown.meanFrames;
    ref.comparedPreset = preset;
    const MeasuredPicture of{0, shown.statistics.frameMs, preset};
    desk.renderThread->post([reference = std::weak_ptr(ref.live), key, of](Renderer& renderer) {
        const auto picture = std::make_shared<Picture>(renderer.picture());
        const auto there = reference.lock();
        if (there) there->compare(picture, key, {renderer.meanFrames(), of.frameMs, of.preset});
    });
}

void stopMeasuring(Desk& desk) {
    ReferenceState& ref = state(desk);
    ref.live->stop();
    ref.report.reset();
    ref.wantedKey = 0;
    if (ref.mode == Comparing::Error || ref.mode == Comparing::Reference) ref.mode = Comparing::Off;
}

void drawModes(Desk& desk) {
    ReferenceState& ref = state(desk);
    const auto mode = [&](const char* place, const char* text, const char* tip, Comparing which,
                          bool possible) {
        ImGui::SameLine();
        const bool on = ref.mode == which;
        const ButtonLook look =
            !possible ? ButtonLook::Disabled : (on ? ButtonLook::Active : ButtonLook::Plain);
        if (textButton(desk, place, text, look)) ref.mode = on ? Comparing::Off : which;
        tooltip(tip);
    };
    if (textButton(desk, "reference.store", "Store")) {
        ref.stored = desk.shown;
        ref.storedExposure =
            fmt::format("EV {:.2f}, {}", desk.exposureEv100,
                        desk.shown->settled ? "settled" : fmt::format("{} frames", desk.shown->meanFrames));
        notify(desk, Notice::Kind::Info, "The picture is stored as the reference");
    }
    tooltip("Keep this picture to compare with");
    mode("reference.show", "Stored", "Show the stored picture (B)", Comparing::Stored, bool(ref.stored));
    mode("reference.split", "Split", "Stored on the left, present on the right; drag the line",
         Comparing::Split, bool(ref.stored));
    if (ref.stored) ImGui::TextDisabled("Stored: %s", ref.storedExposure.c_str());
}

// How far the reference is, and the way out of it.
void drawProgress(Desk& desk, const LiveReference::State& live) {
    ReferenceState& ref = state(desk);
    const bool prepares = !live.preparing.empty();
    const char* waits = desk.view.empty() ? "" : ", waits for the picture's own view";
    const std::string words = prepares ? live.preparing
                                       : fmt::format("Reference: {} of {} frames{}", live.frames,
                                                     LiveReference::kMostFrames, waits);
    const float stop = ImGui::CalcTextSize("Stop").x + 2 * ImGui::GetStyle().FramePadding.x;
    ImGui::AlignTextToFramePadding();
    ImGui::PushStyleColor(ImGuiCol_Text, theme::kDim);
    textWithin(words, ImGui::GetContentRegionAvail().x - stop - px(desk, 8));
    ImGui::PopStyleColor();
    ImGui::SameLine(ImGui::GetContentRegionMax().x - stop);
    const bool stops = textButton(desk, "reference.stop", "Stop");
    tooltip("Gives the reference up");
    progressBar(desk, prepares ? live.preparedShare : double(live.frames) / LiveReference::kMostFrames);
    mark(desk, "reference.progress");
    if (stops) {
        ref.measures = false;
        stopMeasuring(desk);
    }
}

void drawLive(Desk& desk) {
    ReferenceState& ref = state(desk);
    if (ImGui::Checkbox("Measure the error", &ref.measures)) {
        if (!ref.live) ref.live = std::make_shared<LiveReference>(desk.wake);
        if (!ref.measures) stopMeasuring(desk);
    }
    mark(desk, "reference.live");
    tooltip("Renders a reference of this view whenever the picture rests,\nwith what the processor has left, "
            "and measures "
            "against it");
    if (!ref.measures) return;
    for (const char* method : {"split", "true"}) {
        ImGui::SameLine();
        const ButtonLook look = ref.method == method ? ButtonLook::Active : ButtonLook::Plain;
        if (textButton(desk, fmt::format("reference.{}", method).c_str(), method, look)) ref.method = method;
        tooltip(ref.method == "split" ? "Analytic light times visibility: what the picture converges to"
                                      : "The material at sampled points of every light");
    }
    const LiveReference::State live = ref.live->state();
    if (!live.problem.empty()) ImGui::TextWrapped("%s", live.problem.c_str());
    drawProgress(desk, live);
    if (!ref.report) return;
    ImGui::Text("FLIP %.4f, 95 %% of it within %.3f", ref.report->flipMean, ref.report->flip95);
    mark(desk, "reference.error");
    ImGui::Text("relMSE %.3g", ref.report->relativeMse);
    const auto mode = [&](const char* place, const char* text, Comparing which) {
        const bool shown = ref.mode == which;
        if (textButton(desk, place, text, shown ? ButtonLook::Active : ButtonLook::Plain))
            ref.mode = shown ? Comparing::Off : which;
        ImGui::SameLine();
    };
    mode("reference.map", "Show the error", Comparing::Error);
    mode("reference.truth", "Show the reference", Comparing::Reference);
    ImGui::NewLine();
}

std::shared_ptr<const ShownFrame> referencePicture(const ErrorReport& report) {
    auto result = std::make_shared<ShownFrame>();
    result->width = report.width;
    result->height = report.height;
    for (std::size_t i = 0; i < report.reference.size(); ++i) {
        result->rgba8.push_back(std::byte(report.reference[i]));
        if (i % 3 == 2) result->rgba8.push_back(std::byte(255));
    }
    return result;
}

// Composes again only when something of it has changed.
void compose(Desk& desk) {
    ReferenceState& ref = state(desk);
    const void* of[3] = {desk.shown.get(), ref.stored.get(), ref.report.get()};
    const bool same = ref.composedMode == ref.mode && ref.composedAt == ref.splitAt &&
                      std::equal(of, of + 3, ref.composedOf);
    if (same) return;
    std::copy(of, of + 3, ref.composedOf);
    ref.composedMode = ref.mode;
    ref.composedAt = ref.splitAt;
    ref.composed.reset();
    if (ref.mode == Comparing::Stored) ref.composed = ref.stored;
    if (ref.mode == Comparing::Split && ref.stored)
        ref.composed = splitPicture(*ref.stored, *desk.shown, ref.splitAt);
    if (ref.mode == Comparing::Error && ref.report) ref.composed = errorPicture(*ref.report);
    if (ref.mode == Comparing::Reference && ref.report) ref.composed = referencePicture(*ref.report);
}

void drawSplitLine(Desk& desk, ImDrawList& canvas) {
    ReferenceState& ref = state(desk);
    const ViewportRect& rect = desk.viewport.rect;
    const ImGuiIO& io = ImGui::GetIO();
    const double x = rect.x + ref.splitAt * rect.width;
    const bool inside = rect.contains({io.MousePos.x, io.MousePos.y});
    const bool near = inside && std::abs(double(io.MousePos.x) - x) < px(desk, 6) && !io.WantCaptureMouse;
    if (near && !desk.pointerTaken && ImGui::IsMouseClicked(0)) {
        ref.dragging = true;
    }
    if (ref.dragging) {
        desk.pointerTaken = true;
        ref.splitAt = std::clamp((double(io.MousePos.x) - rect.x) / rect.width, 0.0, 1.0);
        if (!ImGui::IsMouseDown(0)) ref.dragging = false;
    }
    if (near || ref.dragging) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    const float at = float(std::round(rect.x + ref.splitAt * rect.width)), top = float(rect.y),
                bottom = float(rect.y + rect.height);
    canvas.AddLine({at, top}, {at, bottom}, near || ref.dragging ? theme::kAccent : theme::kText,
                   px(desk, 1));
    if (desk.recordsPlaces) desk.places["reference.line"] = {double(at) - 2.0, rect.y, 4.0, rect.height};
    canvas.AddText({at - ImGui::CalcTextSize("stored").x - px(desk, 8), top + px(desk, 8)}, theme::kText,
                   "stored");
    canvas.AddText({at + px(desk, 8), top + px(desk, 8)}, theme::kText, "now");
}

} // namespace

Settings referenceSettings(const Settings& settings) {
    Settings best = settings;
    applyPreset(best, "high"); // the default: what references make of the rest does not matter
    best.renderScale = 1.0;
    return best;
}

void drawReferencePart(Desk& desk) {
    drawModes(desk);
    drawLive(desk);
}

void forgetReference(Desk& desk) {
    if (!desk.reference) return;
    if (desk.reference->live) desk.reference->live->stop();
    desk.reference->wantedKey = 0;
    desk.reference->comparing = false;
    desk.reference->report.reset();
}

void toggleStored(Desk& desk) {
    ReferenceState& ref = state(desk);
    if (ref.stored) ref.mode = ref.mode == Comparing::Stored ? Comparing::Off : Comparing::Stored;
}

// What the colours of the error map mean, in the corner of the picture.
void drawErrorLegend(Desk& desk, ImDrawList& canvas) {
    const Legend legend = errorLegend();
    const ViewportRect& rect = desk.viewport.rect;
    const float pad = px(desk, 8), width = px(desk, 176), height = px(desk, 8);
    const float line = ImGui::GetTextLineHeight();
    const ImVec2 corner{float(rect.x) + pad, float(rect.y) + pad};
    canvas.AddRectFilled(corner, {corner.x + width + 2 * pad, corner.y + 2 * line + height + 2 * pad},
                         IM_COL32(24, 24, 24, 220), px(desk, 3));
    const ImVec2 at{corner.x + pad, corner.y + pad};
    canvas.AddText(at, theme::kText, "FLIP against the reference");
    constexpr int kSteps = 64;
    const float top = at.y + line + px(desk, 2);
    if (desk.recordsPlaces) desk.places["reference.legend"] = {at.x, top, width, height};
    for (int i = 0; i < kSteps; ++i) {
        const std::array<float, 3> srgb = legendColor(legend, (i + 0.5) / kSteps);
        canvas.AddRectFilled({at.x + width * float(i) / kSteps, top},
                             {at.x + width * float(i + 1) / kSteps, top + height},
                             ImGui::ColorConvertFloat4ToU32({srgb[0], srgb[1], srgb[2], 1.0f}));
    }
    for (const LegendTick& tick : legendTicks(legend, 3)) {
        const float textWidth = ImGui::CalcTextSize(tick.text.c_str()).x;
        const float x =
            at.x + std::clamp(width * float(tick.position) - 0.5f * textWidth, 0.0f, width - textWidth);
        canvas.AddText({x, top + height}, theme::kDim, tick.text.c_str());
    }
}

void drawReferenceOverlay(Desk& desk, ImDrawList& canvas) {
    ReferenceState& ref = state(desk);
    followLive(desk);
    followQuality(desk);
    compose(desk);
    if (ref.mode == Comparing::Split && ref.composed) drawSplitLine(desk, canvas);
    if (ref.mode == Comparing::Error && ref.composed) drawErrorLegend(desk, canvas);
    const char* name = ref.mode == Comparing::Stored      ? "stored picture"
                       : ref.mode == Comparing::Reference ? "reference"
                                                          : "";
    const ViewportRect& rect = desk.viewport.rect;
    if (ref.composed)
        canvas.AddText({float(rect.x) + px(desk, 8), float(rect.y) + px(desk, 8)}, theme::kAccent, name);
}

std::shared_ptr<const ShownFrame> comparedPicture(const Desk& desk) {
    return desk.reference ? desk.reference->composed : nullptr;
}

} // namespace kilolux
