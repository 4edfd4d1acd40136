// Selecting in the picture: a click takes the light under the pointer, a drag those within a rectangle; and
// putting a new light where the pointer clicks.
#include "ui/light_commands.h"
#include "ui/panels.h"
#include "ui/theme.h"
#include "ui/viewport_tools.h"
#include "ui/widgets.h"

#include <algorithm>
#include <imgui.h>

namespace kilolux {

namespace {

constexpr double kReachPx = 6.0;       // unscaled
constexpr double kMarqueeFromPx = 4.0; // shorter drags are clicks

std::vector<std::uint64_t> pickable(const Desk& desk, const std::vector<int>& lights) {
    std::vector<std::uint64_t> ids;
    for (const int light : lights) {
        const std::uint64_t id = desk.session->scene().lights[std::size_t(light)].id;
        if (!isLocked(desk, id)) ids.push_back(id);
    }
    return ids;
}

Selecting howNow() {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.KeyCtrl) return Selecting::Toggle;
    return io.KeyShift ? Selecting::Add : Selecting::Replace;
}

void click(Desk& desk, GizmoState& state, glm::dvec2 px) {
    const std::vector<std::uint64_t> lights = pickable(desk, state.outlines.at(px, kReachPx * desk.uiScale));
    const Selecting how = howNow();
    const bool again = glm::distance(px, state.clickedPx) < kMarqueeFromPx * desk.uiScale;
    state.clickedPx = px;
    if (lights.empty()) {
        if (how == Selecting::Replace) select(desk, {});
        return;
    }
    std::size_t which = 0;
    // The same place once more takes the next one behind.
    if (again && how == Selecting::Replace && desk.selection.size() == 1) {
        const auto at = std::find(lights.begin(), lights.end(), desk.selection.front());
        if (at != lights.end()) which = std::size_t(at - lights.begin() + 1) % lights.size();
    }
    select(desk, {lights[which]}, how == Selecting::Add ? Selecting::Toggle : how);
}

void drawMarquee(ImDrawList& canvas, glm::dvec2 a, glm::dvec2 b) {
    const ImVec2 low{float(std::min(a.x, b.x)), float(std::min(a.y, b.y))},
        high{float(std::max(a.x, b.x)), float(std::max(a.y, b.y))};
    canvas.AddRectFilled(low, high, (theme::kAccent & 0x00ffffffu) | 0x18000000u);
    canvas.AddRect(low, high, theme::kAccent);
}

// The pointer says what the next click does.
void drawPlacing(Desk& desk, ImDrawList& canvas, glm::dvec2 mouse) {
    const float reach = px(desk, 10);
    const ImVec2 at{float(mouse.x), float(mouse.y)};
    canvas.AddLine({at.x - reach, at.y}, {at.x + reach, at.y}, theme::kAccent);
    canvas.AddLine({at.x, at.y - reach}, {at.x, at.y + reach}, theme::kAccent);
    canvas.AddText({at.x + reach, at.y + reach}, theme::kText, "Click where it goes, Esc cancels");
}

} // namespace

void pickLights(Desk& desk, ImDrawList& canvas) {
    GizmoState& state = viewportTools(desk);
    const ImGuiIO& io = ImGui::GetIO();
    const glm::dvec2 mouse(io.MousePos.x, io.MousePos.y);
    const bool menuOpen = state.addMenuPx.has_value(); // a click beside it only closes it
    drawAddMenu(desk);
    const bool free = !menuOpen && !io.WantCaptureMouse && !state.drag && !desk.pointerTaken && !io.KeyAlt;
    if (free && ImGui::IsMouseClicked(0)) {
        const glm::dvec2 press(io.MouseClickedPos[0].x, io.MouseClickedPos[0].y);
        if (desk.viewport.rect.contains(press)) {
            if (state.placing) {
                addLightAtPixel(desk, *state.placing, press);
                state.placing.reset();
            } else {
                state.pressPx = press;
                state.marquee = false;
            }
        }
    }
    if (state.placing && free && desk.viewport.rect.contains(mouse)) drawPlacing(desk, canvas, mouse);
    if (!state.pressPx) return;
    if (glm::distance(mouse, *state.pressPx) > kMarqueeFromPx * desk.uiScale) state.marquee = true;
    if (ImGui::IsMouseDown(0)) {
        desk.pointerTaken = true;
        if (state.marquee) drawMarquee(canvas, *state.pressPx, mouse);
        return;
    }
    if (state.marquee) {
        select(desk, pickable(desk, state.outlines.within(*state.pressPx, mouse)), howNow());
    } else {
        click(desk, state, *state.pressPx);
    }
    state.pressPx.reset();
    state.marquee = false;
}

} // namespace kilolux
