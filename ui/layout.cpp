// The window's regions and what is drawn in them, see layout.h.
#include "ui/layout.h"

#include "ui/camera_control.h"
#include "ui/file_dialogs.h"
#include "ui/file_tasks.h"
#include "ui/panels.h"
#include "ui/theme.h"
#include "ui/widgets.h"

#include <algorithm>
#include <imgui.h>
#include <utility>

namespace kilolux {

namespace {

constexpr double kTopUnits = 40.0, kBottomUnits = 28.0;
constexpr double kLeastViewportUnits = 200.0; // narrower windows hide a column

constexpr ImGuiWindowFlags kRegion = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                     ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                     ImGuiWindowFlags_NoSavedSettings;
// Windows with this flag lie below all others.
constexpr ImGuiWindowFlags kBehind = ImGuiWindowFlags_NoBringToFrontOnFocus;

bool beginRegion(const char* name, const ViewportRect& rect, ImU32 color, ImGuiWindowFlags flags = 0) {
    ImGui::SetNextWindowPos({float(rect.x), float(rect.y)});
    ImGui::SetNextWindowSize({float(rect.width), float(rect.height)});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, color);
    const bool open = ImGui::Begin(name, nullptr, kRegion | flags);
    ImGui::PopStyleColor();
    return open;
}

// The edge of a column: a strip that is dragged. Returns how far, in unscaled pixels.
double drawEdge(Desk& desk, const char* name, double x, const ViewportRect& column) {
    const double width = px(desk, 6);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
    beginRegion(name, {x - 0.5 * width, column.y, width, column.height}, IM_COL32(0, 0, 0, 0),
                ImGuiWindowFlags_NoBackground);
    ImGui::InvisibleButton("edge", {float(width), float(column.height)});
    mark(desk, name);
    const bool held = ImGui::IsItemActive();
    if (held || ImGui::IsItemHovered()) {
        ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
        ImGui::GetWindowDrawList()->AddRectFilled({float(x - 1.0), float(column.y)},
                                                  {float(x + 1.0), float(column.y + column.height)},
                                                  held ? theme::kAccent : IM_COL32(90, 90, 90, 255));
    }
    const double moved = held ? ImGui::GetIO().MouseDelta.x / desk.uiScale : 0.0;
    ImGui::End();
    ImGui::PopStyleVar();
    return moved;
}

void drawRightColumn(Desk& desk) {
    if (!ImGui::BeginTabBar("right tabs")) return;
    const RightTab wanted = std::exchange(desk.wantedTab, RightTab::None);
    const auto tab = [&](RightTab which, const char* name, const char* place, void (*draw)(Desk&)) {
        const ImGuiTabItemFlags flags = wanted == which ? ImGuiTabItemFlags_SetSelected : 0;
        const bool open = ImGui::BeginTabItem(name, nullptr, flags);
        mark(desk, place);
        if (!open) return;
        ImGui::BeginChild(name);
        ImGui::Dummy({0, px(desk, 4)});
        draw(desk);
        ImGui::EndChild();
        ImGui::EndTabItem();
    };
    tab(RightTab::Light, "Light", "tab.light", drawProperties);
    tab(RightTab::View, "View", "tab.view", drawViewPanel);
    tab(RightTab::Probe, "Probe", "tab.probe", drawProbePanel);
    tab(RightTab::Cost, "Cost", "tab.cost", drawStatisticsPanel);
    ImGui::EndTabBar();
}

void drawOverlays(Desk& desk, const ViewportRect& rect) {
    ImDrawList& canvas = *ImGui::GetBackgroundDrawList();
    canvas.PushClipRect({float(rect.x), float(rect.y)},
                        {float(rect.x + rect.width), float(rect.y + rect.height)});
    if (desk.shown) {
        // A picture of another shape, while its successor is on the way, leaves the sides open.
        const double shownWidth = rect.height * desk.shown->width / std::max(desk.shown->height, 1);
        const float side = float(0.5 * (rect.width - shownWidth));
        const float left = float(rect.x), top = float(rect.y), right = float(rect.x + rect.width),
                    bottom = float(rect.y + rect.height);
        if (side > 0.5f) {
            canvas.AddRectFilled({left, top}, {left + std::ceil(side), bottom}, theme::kEmpty);
            canvas.AddRectFilled({right - std::ceil(side), top}, {right, bottom}, theme::kEmpty);
        }
    } else {
        canvas.AddRectFilled({float(rect.x), float(rect.y)},
                             {float(rect.x + rect.width), float(rect.y + rect.height)}, theme::kEmpty);
    }
    if (desk.session && desk.shown) {
        drawReferenceOverlay(desk, canvas);
        drawLightOutlines(desk, canvas);
        drawProbeOverlay(desk, canvas);
        drawGizmos(desk, canvas);
        drawLightHandles(desk, canvas);
        pickLights(desk, canvas);
    }
    canvas.PopClipRect();
}

} // namespace

Layout makeLayout(const Desk& desk, glm::ivec2 windowPx) {
    const double width = windowPx.x, height = windowPx.y;
    const Remembered& remembered = desk.files->remembered;
    Layout layout;
    const bool shows = desk.panels.all;
    const double top = shows ? px(desk, kTopUnits) : 0.0;
    const double bottom = shows ? std::min<double>(px(desk, kBottomUnits), height - top) : 0.0;
    const double least = px(desk, kLeastViewportUnits);
    double left = shows && desk.panels.lights ? px(desk, remembered.leftWidth) : 0.0;
    double right = shows && desk.panels.properties ? px(desk, remembered.rightWidth) : 0.0;
    if (!desk.session && !desk.files->isOpening()) left = right = 0.0; // they would be empty
    if (width - left - right < least) left = 0.0;
    if (width - left - right < least) right = 0.0;
    const double middle = std::max(height - top - bottom, 1.0);
    layout.top = {0, 0, width, top};
    layout.bottom = {0, height - bottom, width, bottom};
    layout.left = {0, top, left, middle};
    layout.right = {width - right, top, right, middle};
    layout.viewport = {left, top, std::max(width - left - right, 1.0), middle};
    return layout;
}

void drawLayout(Desk& desk, const Layout& layout) {
    Remembered& remembered = desk.files->remembered;
    controlCamera(desk, layout.viewport); // before the overlays, which leave the pointer to it
    drawOverlays(desk, layout.viewport);
    if (!desk.session) drawFirstRun(desk, layout.viewport);
    if (layout.top.height > 0) {
        beginRegion("top", layout.top, theme::kBars, kBehind | ImGuiWindowFlags_NoScrollbar);
        drawTopBar(desk);
        ImGui::End();
        beginRegion("bottom", layout.bottom, theme::kBars, kBehind | ImGuiWindowFlags_NoScrollbar);
        drawStatusLine(desk);
        ImGui::End();
    }
    if (layout.left.width > 0) {
        beginRegion("left", layout.left, theme::kBackground, kBehind);
        drawLightList(desk);
        ImGui::End();
    }
    if (layout.right.width > 0) {
        beginRegion("right", layout.right, theme::kBackground, kBehind | ImGuiWindowFlags_NoScrollbar);
        drawRightColumn(desk);
        ImGui::End();
    }
    if (layout.left.width > 0)
        remembered.leftWidth += drawEdge(desk, "edge.left", layout.left.width, layout.left);
    if (layout.right.width > 0)
        remembered.rightWidth -= drawEdge(desk, "edge.right", layout.right.x, layout.right);
    remembered.leftWidth = kLeftWidth.clamped(remembered.leftWidth);
    remembered.rightWidth = kRightWidth.clamped(remembered.rightWidth);
    drawNotices(desk, layout.viewport);
    drawActivities(desk, layout.viewport);
    drawKeysHelp(desk);
    drawProfileBrowser(desk);
    drawFileDialogs(desk);
}

} // namespace kilolux
