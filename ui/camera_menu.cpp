// The menu of views: the scene's cameras, and the bookmarks that the user keeps, names and drops. A bookmark
// is an edit as any other.
#include "renderer/document/edit_build.h"
#include "ui/panels.h"
#include "ui/theme.h"
#include "ui/widgets.h"

#include <algorithm>
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>
#include <utility>

namespace kilolux {

struct CameraMenuState {
    std::string name; // typed for the next bookmark
};

namespace {

std::string nameOf(const Camera& camera, std::size_t index) {
    return camera.name.empty() ? fmt::format("camera {}", index + 1) : camera.name;
}

// A name that no bookmark has.
std::string freeName(const Scene& scene) {
    for (std::size_t n = scene.bookmarks.size() + 1;; ++n) {
        std::string name = fmt::format("View {}", n);
        const auto taken = [&](const Camera& camera) { return camera.name == name; };
        if (std::none_of(scene.bookmarks.begin(), scene.bookmarks.end(), taken)) return name;
    }
}

CameraMenuState& state(Desk& desk) {
    if (!desk.cameraMenu) desk.cameraMenu = std::make_shared<CameraMenuState>();
    return *desk.cameraMenu;
}

bool drawView(Desk& desk, const std::string& place, const std::string& name, float widthPx) {
    const bool chosen =
        ImGui::Selectable(fmt::format("{}###{}", name, place).c_str(), false, 0, {widthPx, 0});
    mark(desk, place);
    return chosen;
}

void keepView(Desk& desk) {
    Camera camera = desk.camera.camera();
    std::string& typed = state(desk).name;
    camera.name = typed.empty() ? freeName(desk.session->scene()) : std::exchange(typed, "");
    applyEdits(desk, addBookmark(desk.session->ids(), std::move(camera)), "Keep view");
}

void drawBookmark(Desk& desk, const Camera& bookmark, std::size_t index) {
    const float width = px(desk, 180);
    const std::string place = fmt::format("view.{}", bookmark.id);
    if (drawView(desk, place, nameOf(bookmark, index), width)) {
        cutCamera(desk, bookmark);
        ImGui::CloseCurrentPopup();
    }
    ImGui::SameLine();
    const std::string drop = fmt::format("view.{}.drop", bookmark.id);
    if (iconButton(desk, drop.c_str(), theme::kDelete, "Drop this view"))
        applyEdits(desk, deleteBookmark(desk.session->scene(), bookmark.id), "Drop view");
}

} // namespace

void drawCameraMenu(Desk& desk) {
    if (iconButton(desk, "top.views", theme::kCamera, "Views: cameras of the scene and views that were kept"))
        ImGui::OpenPopup("views");
    if (!ImGui::BeginPopup("views")) return;
    closePopupOnEscape();
    const Scene scene = desk.session->scene(); // dropping one changes the list that is walked
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        if (drawView(desk, fmt::format("camera.{}", i), nameOf(scene.cameras[i], i), 0.0f))
            cutCamera(desk, scene.cameras[i]);
    }
    if (!scene.cameras.empty()) ImGui::Separator();
    for (std::size_t i = 0; i < scene.bookmarks.size(); ++i)
        drawBookmark(desk, scene.bookmarks[i], i);
    ImGui::SetNextItemWidth(px(desk, 132));
    const bool entered =
        ImGui::InputTextWithHint("##name", "name", &state(desk).name, ImGuiInputTextFlags_EnterReturnsTrue);
    mark(desk, "view.name");
    ImGui::SameLine();
    if (textButton(desk, "view.keep", "Keep view") || entered) keepView(desk);
    ImGui::EndPopup();
}

} // namespace kilolux
