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
    const auto tab = [&](const char* name, const char* place, void (*draw)(Desk&)) {
        const bool open = ImGui::BeginTabItem(name);
        mark(desk, place);
        if (!open) return;
        ImGui::BeginChild(name);
        draw(desk);
        ImGui::EndChild();
        ImGui::EndTabItem();
    };
    tab("Light", "tab.light", drawProperties);
    tab("View", "tab.view", drawViewPanel);
    tab("Probe", "tab.probe", drawProbePanel);
    tab("Cost", "tab.cost", drawStatisticsPanel);
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
        pickLights(desk, canvas);
    }
    canvas.PopClipRect();
}

void drawNotices(Desk& desk, const ViewportRect& rect) {
    std::erase_if(desk.notices, [&](const Notice& notice) {
        return notice.kind != Notice::Kind::Error && notice.shownUntilS < desk.nowS;
    });
    if (desk.notices.empty()) return;
    const float width = std::min(px(desk, 440), float(rect.width) - px(desk, 16));
    if (width < px(desk, 64)) return;
    ImGui::SetNextWindowPos({float(rect.x) + px(desk, 8), float(rect.y + rect.height) - px(desk, 8)},
                            ImGuiCond_Always, {0, 1});
    ImGui::SetNextWindowSize({width, 0});
    ImGui::SetNextWindowBgAlpha(0.92f);
    ImGui::Begin("notices", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav);
    std::size_t closed = desk.notices.size();
    for (std::size_t i = 0; i < desk.notices.size(); ++i) {
        const Notice& notice = desk.notices[i];
        const bool error = notice.kind == Notice::Kind::Error, plain = notice.kind == Notice::Kind::Info;
        ImGui::PushID(int(i));
        ImGui::AlignTextToFramePadding();
        ImGui::TextColored(ImColor(error   ? theme::kError
                                   : plain ? theme::kDim
                                           : theme::kWarning),
                           "%s", plain ? theme::kInfo : theme::kWarn);
        ImGui::SameLine();
        ImGui::PushTextWrapPos(ImGui::GetWindowContentRegionMax().x - px(desk, 32));
        ImGui::TextUnformatted(notice.text.c_str());
        ImGui::PopTextWrapPos();
        if (error) {
            ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - px(desk, 24));
            if (iconButton(desk, "notice.close", theme::kClose, "Close")) closed = i;
        }
        ImGui::PopID();
    }
    ImGui::End();
    if (closed < desk.notices.size()) desk.notices.erase(desk.notices.begin() + std::ptrdiff_t(closed));
}

// What takes long, with the way out of it.
void drawActivity(Desk& desk, const ViewportRect& rect) {
    FileTasks& files = *desk.files;
    const std::string rendering = desk.renderThread->activity();
    if (!files.isOpening() && rendering.empty()) return;
    const double sinceS = desk.nowS - files.openingSinceS;
    constexpr double kShowAfterS = 0.3; // what is over by then needs no words
    if (files.isOpening() && sinceS < kShowAfterS) return;
    ImGui::SetNextWindowPos({float(rect.center().x), float(rect.y) + px(desk, 16)}, ImGuiCond_Always,
                            {0.5f, 0});
    ImGui::SetNextWindowBgAlpha(0.92f);
    ImGui::Begin("activity", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing);
    const std::string text =
        files.isOpening() ? "Opening " + files.openingPath.filename().string() : rendering;
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(text.c_str());
    ImGui::SameLine();
    // Its length is not known: a bar that wanders says that work goes on.
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = px(desk, 96), height = px(desk, 4), top = corner.y + 0.5f * ImGui::GetFrameHeight();
    ImDrawList& canvas = *ImGui::GetWindowDrawList();
    canvas.AddRectFilled({corner.x, top}, {corner.x + width, top + height}, theme::kField, height);
    const float at = 0.5f - 0.5f * std::cos(float(desk.nowS) * 2.5f), part = 0.3f * width;
    canvas.AddRectFilled({corner.x + at * (width - part), top},
                         {corner.x + at * (width - part) + part, top + height}, theme::kAccent, height);
    ImGui::Dummy({width, ImGui::GetFrameHeight()});
    if (files.isOpening()) {
        ImGui::SameLine();
        if (textButton(desk, "activity.cancel", "Cancel")) cancelOpening(desk);
    }
    ImGui::End();
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
    remembered.leftWidth = std::clamp(remembered.leftWidth, 160.0, 720.0);
    remembered.rightWidth = std::clamp(remembered.rightWidth, 200.0, 720.0);
    drawNotices(desk, layout.viewport);
    drawActivity(desk, layout.viewport);
    drawKeysHelp(desk);
    drawFileDialogs(desk);
}

} // namespace kilolux
