// The menu of light types at the pointer (Shift+A).
#include "ui/light_actions.h"
#include "ui/light_commands.h"
#include "ui/light_icon.h"
#include "ui/theme.h"
#include "ui/viewport_tools.h"
#include "ui/widgets.h"

#include "renderer/document/light_words.h"

#include <imgui.h>

namespace kilolux {

void drawAddMenu(Desk& desk) {
    GizmoState& state = viewportTools(desk);
    if (!state.addMenuPx) return;
    const glm::dvec2 at = *state.addMenuPx;
    // Towards the middle, where there is room for it.
    const glm::dvec2 middle = desk.viewport.rect.center();
    ImGui::SetNextWindowPos({float(at.x), float(at.y)}, ImGuiCond_Always,
                            {at.x > middle.x ? 1.0f : 0.0f, at.y > middle.y ? 1.0f : 0.0f});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_PopupBg));
    ImGui::Begin("add light", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::TextDisabled("Add a light here");
    for (const LightTypeWord& word : kLightTypeWords) {
        const ImVec2 from = ImGui::GetCursorScreenPos();
        ImGui::PushID(word.name);
        if (ImGui::Selectable("##type", false, 0, {px(desk, 168), ImGui::GetFrameHeight()})) {
            addLightAtPixel(desk, word.type, at);
            state.addMenuPx.reset();
        }
        mark(desk, std::string("add.") + word.name);
        ImGui::PopID();
        drawLightIcon(*ImGui::GetWindowDrawList(), word.type,
                      {from.x + px(desk, 12), from.y + 0.5f * ImGui::GetFrameHeight()}, px(desk, 6),
                      theme::kText);
        const float top = from.y + 0.5f * (ImGui::GetFrameHeight() - ImGui::GetTextLineHeight());
        ImGui::GetWindowDrawList()->AddText({from.x + px(desk, 28), top}, theme::kText,
                                            typeName(word.type).data());
    }
    // The row that is pressed is active by now.
    const bool outside =
        ImGui::IsMouseClicked(0) && !ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem);
    ImGui::End();
    ImGui::PopStyleColor();
    if (outside) state.addMenuPx.reset();
}

} // namespace kilolux
