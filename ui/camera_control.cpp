// Flying, orbiting and panning, see camera_control.h.
#include "ui/camera_control.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>
#include <cmath>
#include <imgui.h>

namespace kilolux {

namespace {

constexpr double kLookRadPerPx = 0.004;
constexpr double kOrbitRadPerPx = 0.006;
constexpr double kDollyPerStep = 0.88;
constexpr double kSpeedPerStep = 1.25;
constexpr double kFastFactor = 4.0;

// What holds the camera; it stays with the button that began it.
enum class Hold { None, Fly, Orbit, Pan };

bool pressedInside(int button, const ViewportRect& rect) {
    const ImVec2 at = ImGui::GetIO().MouseClickedPos[button];
    return ImGui::IsMouseDown(button) && rect.contains({at.x, at.y});
}

Hold holdNow(const Desk& desk, const ViewportRect& rect, Hold before) {
    const ImGuiIO& io = ImGui::GetIO();
    const bool free = !io.WantCaptureMouse && !desk.pointerTaken;
    if (before == Hold::Fly) return ImGui::IsMouseDown(1) ? Hold::Fly : Hold::None;
    if (before == Hold::Orbit) return ImGui::IsMouseDown(0) ? Hold::Orbit : Hold::None;
    if (before == Hold::Pan) return ImGui::IsMouseDown(2) ? Hold::Pan : Hold::None;
    if (!free) return Hold::None;
    if (ImGui::IsMouseClicked(1) && pressedInside(1, rect)) return Hold::Fly;
    if (ImGui::IsMouseClicked(2) && pressedInside(2, rect)) return Hold::Pan;
    if (io.KeyAlt && ImGui::IsMouseClicked(0) && pressedInside(0, rect)) return Hold::Orbit;
    return Hold::None;
}

bool fly(Desk& desk) {
    const ImGuiIO& io = ImGui::GetIO();
    desk.camera.look(io.MouseDelta.x * kLookRadPerPx, -io.MouseDelta.y * kLookRadPerPx);
    desk.flySpeedMs =
        std::clamp(desk.flySpeedMs * std::pow(kSpeedPerStep, double(io.MouseWheel)), 0.01, 1000.0);
    const auto axis = [](int positive, int negative) {
        return double(ImGui::IsKeyDown(positive)) - double(ImGui::IsKeyDown(negative));
    };
    const glm::dvec3 direction(axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_E, GLFW_KEY_Q),
                               axis(GLFW_KEY_W, GLFW_KEY_S));
    const double stepM = desk.flySpeedMs * (io.KeyShift ? kFastFactor : 1.0) * double(io.DeltaTime);
    if (direction != glm::dvec3(0.0)) desk.camera.move(glm::normalize(direction) * stepM);
    return direction != glm::dvec3(0.0) || io.MouseDelta.x != 0.0f || io.MouseDelta.y != 0.0f;
}

} // namespace

void controlCamera(Desk& desk, const ViewportRect& rect) {
    const ImGuiIO& io = ImGui::GetIO();
    desk.flying = false;
    if (!desk.session) return;
    const Hold hold = holdNow(desk, rect, Hold(desk.cameraHold));
    desk.cameraHold = int(hold);
    desk.flying = hold == Hold::Fly;
    const glm::dvec2 moved(io.MouseDelta.x, io.MouseDelta.y);
    bool changed = false;
    if (hold == Hold::Fly) {
        changed = fly(desk);
    } else if (hold == Hold::Orbit && moved != glm::dvec2(0.0)) {
        desk.camera.orbit(-moved.x * kOrbitRadPerPx, moved.y * kOrbitRadPerPx);
        changed = true;
    } else if (hold == Hold::Pan && moved != glm::dvec2(0.0)) {
        desk.camera.pan(moved, rect.height);
        changed = true;
    } else if (hold == Hold::None && io.MouseWheel != 0.0f && !io.WantCaptureMouse &&
               rect.contains({io.MousePos.x, io.MousePos.y})) {
        desk.camera.dolly(std::pow(kDollyPerStep, double(io.MouseWheel)));
        changed = true;
    }
    desk.pointerTaken = hold != Hold::None; // overlays add to it until the next frame
    if (changed) moveCamera(desk);
}

} // namespace kilolux
