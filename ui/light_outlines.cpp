// Outlines of all lights on the picture: thin, in the light's colour, grey when muted, amber when selected;
// the cone and the doors of selected ones faintly.
#include "ui/light_place.h"
#include "ui/panels.h"
#include "ui/profile_facts.h"
#include "ui/theme.h"
#include "ui/viewport_tools.h"
#include "ui/widgets.h"

#include <algorithm>
#include <array>
#include <glm/gtc/constants.hpp>
#include <imgui.h>

namespace kilolux {

namespace {

constexpr ImU32 kMuted = IM_COL32(110, 110, 110, 255);
constexpr ImU32 kHalo = IM_COL32(0, 0, 0, 110); // so that thin lines are seen on bright walls as well
constexpr std::size_t kMostFine = 1500;         // outlines in the picture; beyond, marks are dots
constexpr std::size_t kMostShapings = 64;       // of selected lights
constexpr std::size_t kMostWebs = 8;

ImVec2 im(glm::vec2 px) {
    return {px.x, px.y};
}

struct Look {
    ImU32 color;
    float width;
    bool halo;
};

void drawOutline(ImDrawList& canvas, const OutlineSet& set, const LightOutline& outline, const Look& look) {
    if (look.halo) {
        for (const OutlineSet::Segment& segment : set.segmentsOf(outline))
            canvas.AddLine(im(segment.from), im(segment.to), kHalo, look.width + 2.0f);
    }
    for (const OutlineSet::Segment& segment : set.segmentsOf(outline))
        canvas.AddLine(im(segment.from), im(segment.to), look.color, look.width);
}

// The cone of a spot: its edge, four lines of it, and a breath of colour inside.
void drawCone(ImDrawList& canvas, const Viewport& viewport, const LightDef& def, const glm::dvec3& apex,
              const glm::dmat3& axes, double lengthM) {
    constexpr int kSides = 40;
    const ScreenMap map(viewport);
    const auto ring = [&](double halfAngle, ImU32 color, bool fills) {
        const double radius = lengthM * std::sin(halfAngle), ahead = lengthM * std::cos(halfAngle);
        const ScreenMap::Point tip = map.project(apex);
        ScreenMap::Point last{};
        for (int i = 0; i <= kSides; ++i) {
            const double angle = glm::two_pi<double>() * i / kSides;
            const ScreenMap::Point at = map.project(
                apex + axes * glm::dvec3(radius * std::cos(angle), radius * std::sin(angle), -ahead));
            if (i > 0 && at.inFront && last.inFront) {
                canvas.AddLine(im(glm::vec2(last.px)), im(glm::vec2(at.px)), color);
                if (fills && tip.inFront) {
                    canvas.AddTriangleFilled(im(glm::vec2(tip.px)), im(glm::vec2(last.px)),
                                             im(glm::vec2(at.px)), (color & 0x00ffffffu) | 0x05000000u);
                }
            }
            if (fills && i % (kSides / 4) == 0 && at.inFront && tip.inFront)
                canvas.AddLine(im(glm::vec2(tip.px)), im(glm::vec2(at.px)), color);
            last = at;
        }
    };
    ring(def.outerConeRad, (theme::kAccent & 0x00ffffffu) | 0x70000000u, true);
    if (def.innerConeRad > 0.0) ring(def.innerConeRad, (theme::kAccent & 0x00ffffffu) | 0x40000000u, false);
}

// The flaps of a rectangle with barn doors, each hinged to its edge.
void drawDoors(ImDrawList& canvas, const Viewport& viewport, const LightDef& def, const glm::dvec3& center,
               const glm::dmat3& axes) {
    const ScreenMap map(viewport);
    for (int side = 0; side < 4; ++side) {
        if (def.barnDoors[std::size_t(side)].lengthM <= 0.0) continue;
        ImVec2 corners[4];
        bool inFront = true;
        const std::array<glm::dvec3, 4> flap = barnDoorCorners(def, BarnDoorSide(side));
        for (std::size_t i = 0; i < 4; ++i) {
            const ScreenMap::Point at = map.project(center + axes * flap[i]);
            inFront = inFront && at.inFront;
            corners[i] = im(glm::vec2(at.px));
        }
        if (!inFront) continue;
        canvas.AddQuadFilled(corners[0], corners[1], corners[2], corners[3],
                             (theme::kAccent & 0x00ffffffu) | 0x14000000u);
        canvas.AddQuad(corners[0], corners[1], corners[2], corners[3],
                       (theme::kAccent & 0x00ffffffu) | 0x70000000u);
    }
}

// The profile as a web about the light, as far out as it is strong.
void drawWeb(ImDrawList& canvas, const Viewport& viewport, const LightDef& def, const glm::dvec3& center,
             const glm::dmat3& axes, double lengthM) {
    const ScreenMap map(viewport);
    for (const std::vector<glm::dvec3>& line : webOf(*def.ies)) {
        ScreenMap::Point last{};
        for (const glm::dvec3& point : line) {
            const ScreenMap::Point at = map.project(center + lengthM * (axes * point));
            if (at.inFront && last.inFront)
                canvas.AddLine(im(glm::vec2(last.px)), im(glm::vec2(at.px)),
                               (theme::kAccent & 0x00ffffffu) | 0x60000000u);
            last = at;
        }
    }
}

void drawShapings(const Desk& desk, ImDrawList& canvas) {
    const Scene& scene = desk.session->scene();
    std::size_t drawn = 0;
    for (const std::uint64_t id : desk.selection) {
        const LightDef& def = defOf(scene, id);
        const bool hasWeb = def.ies && def.iesUse != IesUse::None && def.type != LightType::Directional;
        if (def.type != LightType::Spot && def.type != LightType::Rect && !hasWeb) continue;
        if (++drawn > kMostShapings) return;
        const glm::dvec3 center = positionOf(scene, id);
        const glm::dmat3 axes = axesOf(scene, id);
        if (hasWeb && drawn <= kMostWebs) {
            drawWeb(canvas, desk.viewport, def, center, axes,
                    110.0 * desk.uiScale * desk.viewport.metresPerPixel(center));
        }
        if (def.type == LightType::Rect) {
            drawDoors(canvas, desk.viewport, def, center, axes);
            continue;
        }
        if (def.type != LightType::Spot) continue;
        // As long as its reach, but not across the whole picture.
        const double longestM = 160.0 * desk.uiScale * desk.viewport.metresPerPixel(center);
        drawCone(canvas, desk.viewport, def, center, axes, std::min(def.rangeM.value_or(longestM), longestM));
    }
}

void drawName(Desk& desk, ImDrawList& canvas, const LightOutline& outline) {
    const Scene& scene = desk.session->scene();
    const LightNode& light = scene.lights[std::size_t(outline.light)];
    const std::string& name = scene.nodes[std::size_t(light.node)].name;
    const ImVec2 size = ImGui::CalcTextSize(name.c_str());
    const float pad = px(desk, 4);
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const ImVec2 at{mouse.x + px(desk, 16), mouse.y - size.y - px(desk, 8)};
    canvas.AddRectFilled({at.x - pad, at.y - pad * 0.5f}, {at.x + size.x + pad, at.y + size.y + pad * 0.5f},
                         IM_COL32(24, 24, 24, 200), px(desk, 3));
    canvas.AddText(at, theme::kText, name.c_str());
}

void bringUpToDate(const Desk& desk, GizmoState& state) {
    const bool same = state.outlinesVersion == desk.session->version() &&
                      state.outlinesScale == desk.uiScale && state.outlinesViewport.showsAs(desk.viewport);
    if (same) return;
    state.outlines.build(desk.session->scene(), desk.viewport, desk.uiScale);
    state.outlinesVersion = desk.session->version();
    state.outlinesScale = desk.uiScale;
    state.outlinesViewport = desk.viewport;
}

} // namespace

void drawLightOutlines(Desk& desk, ImDrawList& canvas) {
    GizmoState& state = viewportTools(desk);
    const Scene& scene = desk.session->scene();
    bringUpToDate(desk, state);
    const ImGuiIO& io = ImGui::GetIO();
    const glm::dvec2 mouse(io.MousePos.x, io.MousePos.y);
    state.hovered = 0;
    const bool pointing = !io.WantCaptureMouse && !desk.pointerTaken && !state.drag && !state.pressPx &&
                          desk.viewport.rect.contains(mouse) && desk.panels.outlines;
    if (pointing) {
        for (const int light : state.outlines.at(mouse, 6.0 * desk.uiScale)) {
            const std::uint64_t id = scene.lights[std::size_t(light)].id;
            if (std::binary_search(desk.locked.begin(), desk.locked.end(), id)) continue;
            state.hovered = id;
            break;
        }
    }
    const float width = float(std::max(1.0, 1.25 * desk.uiScale));
    const bool crowded = state.outlines.outlines().size() > kMostFine;
    const LightOutline* hovered = nullptr;
    for (const LightOutline& outline : state.outlines.outlines()) {
        const LightNode& light = scene.lights[std::size_t(outline.light)];
        const bool isSelected = desk.isSelected(light.id);
        if (light.id == state.hovered) hovered = &outline;
        if (isSelected || (!desk.panels.outlines && light.id != state.hovered)) continue;
        const int group = findGroup(scene, light.group);
        const bool muted =
            light.muted || (group >= 0 && scene.groups[std::size_t(group)].muted) ||
            (!desk.solo.empty() && !std::binary_search(desk.solo.begin(), desk.solo.end(), light.id));
        const ImU32 color = muted ? kMuted : state.colors.of(scene.lightDefs[std::size_t(light.def)]);
        const bool isDot = crowded && outline.radiusPx <= 8.0 * desk.uiScale && light.id != state.hovered;
        if (isDot) {
            const float r = 1.5f * float(desk.uiScale);
            const ImVec2 c = im(glm::vec2(outline.centerPx));
            canvas.AddRectFilled({c.x - r, c.y - r}, {c.x + r, c.y + r}, color);
            if (outline.hasStem) {
                const OutlineSet::Segment stem = state.outlines.segmentsOf(outline).back();
                canvas.AddLine(im(stem.from), im(0.5f * (stem.from + stem.to)), color);
            }
            continue;
        }
        const bool isHovered = light.id == state.hovered;
        drawOutline(canvas, state.outlines, outline, {color, isHovered ? 2.0f * width : width, !crowded});
    }
    drawShapings(desk, canvas);
    for (const LightOutline& outline : state.outlines.outlines())
        if (desk.isSelected(scene.lights[std::size_t(outline.light)].id))
            drawOutline(canvas, state.outlines, outline, {theme::kAccent, 1.4f * width, !crowded});
    if (hovered) drawName(desk, canvas, *hovered);
}

} // namespace kilolux
