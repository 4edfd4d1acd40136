#include "ui/value_field.h"

#include "ui/theme.h"
#include "ui/widgets.h"

#include <algorithm>
#include <fmt/format.h>
#include <imgui.h>

namespace kilolux {

namespace {

constexpr float kDragFromPx = 3.0f; // shorter ones are clicks

int onResize(ImGuiInputTextCallbackData* data) {
    if (data->EventFlag == ImGuiInputTextFlags_CallbackResize) {
        auto* text = static_cast<std::string*>(data->UserData);
        text->resize(std::size_t(data->BufTextLen));
        data->Buf = text->data();
    }
    return 0;
}

void beginTyping(PropertiesState& state, const std::string& id, const std::string& text, int index) {
    state.editing = id;
    state.text = text;
    state.editBegins = true;
    state.editIndex = index;
}

// The text field while it is typed in; the text when Enter, Tab or a click elsewhere ends it.
std::optional<std::string> typeIn(PropertiesState& state, const std::string& initial, float widthPx) {
    ImGui::SetNextItemWidth(widthPx);
    if (state.editBegins) ImGui::SetKeyboardFocusHere();
    const bool entered =
        ImGui::InputText("##typed", state.text.data(), state.text.capacity() + 1,
                         ImGuiInputTextFlags_AutoSelectAll | ImGuiInputTextFlags_EnterReturnsTrue |
                             ImGuiInputTextFlags_CallbackResize,
                         onResize, &state.text);
    const bool active = ImGui::IsItemActive();
    if (state.editBegins) {
        state.editBegins = !active;
        return std::nullopt;
    }
    if (active && !entered) return std::nullopt;
    const bool escaped = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Tab)))
        state.editNext = state.editIndex + (ImGui::GetIO().KeyShift ? -1 : 1);
    const std::string text(state.text.c_str());
    state.editing.clear();
    // What was opened and left as it stood changes nothing, whatever its hidden digits.
    if (escaped || text == initial) return std::nullopt;
    return text;
}

void drawText(const FieldText& text, ImVec2 from, ImVec2 to) {
    ImDrawList& canvas = *ImGui::GetWindowDrawList();
    const ImVec2 padding = ImGui::GetStyle().FramePadding;
    const ImVec2 unitSize = ImGui::CalcTextSize(text.unit.c_str());
    const ImVec2 size = ImGui::CalcTextSize(text.shown.c_str());
    const float gap = text.unit.empty() ? 0.0f : 4.0f, top = from.y + padding.y;
    const float right = to.x - padding.x;
    canvas.PushClipRect({from.x + 2.0f, from.y}, to, true);
    if (!text.unit.empty()) canvas.AddText({right - unitSize.x, top}, theme::kDim, text.unit.c_str());
    // Too long a number keeps its beginning.
    const bool isName = text.tone == FieldText::Tone::Name;
    const float x = isName ? from.x + padding.x
                           : std::max(right - unitSize.x - gap - size.x, from.x + std::min(padding.x, 4.0f));
    canvas.AddText({x, top}, text.tone == FieldText::Tone::Dim ? theme::kDim : theme::kText,
                   text.shown.c_str());
    canvas.PopClipRect();
}

} // namespace

std::string dragKey(const PropertiesState& state) {
    return fmt::format("{} {}", state.dragging, state.drags);
}

void noteDragged(Desk& desk) {
    propertiesOf(desk).hasDragged = true;
}

FieldEvent valueField(Desk& desk, const std::string& id, const FieldText& text, float widthPx,
                      const char* help, FieldDrag drag) {
    PropertiesState& state = propertiesOf(desk);
    FieldEvent event;
    ImGui::PushID(id.c_str());
    const int index = state.fieldCount++;
    if (state.editNext == index) {
        state.editNext = -1;
        beginTyping(state, id, text.typed, index);
    }
    if (state.editing == id) {
        if (const std::optional<std::string> typed = typeIn(state, text.typed, widthPx))
            event = {FieldEvent::Kind::Typed, *typed, 0.0};
        mark(desk, id);
        ImGui::PopID();
        return event;
    }
    const ImVec2 size{widthPx, ImGui::GetFrameHeight()}, from = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("##field", size);
    mark(desk, id);
    const bool hovered = ImGui::IsItemHovered(), held = ImGui::IsItemActive();
    const ImVec2 to{from.x + size.x, from.y + size.y};
    const bool dragging = state.dragging == id;
    ImGui::GetWindowDrawList()->AddRectFilled(from, to,
                                              ImGui::GetColorU32(dragging  ? ImGuiCol_FrameBgActive
                                                                 : hovered ? ImGuiCol_FrameBgHovered
                                                                           : ImGuiCol_FrameBg),
                                              ImGui::GetStyle().FrameRounding);
    drawText(text, from, to);
    if (hovered)
        ImGui::SetMouseCursor(drag == FieldDrag::Sideways ? ImGuiMouseCursor_ResizeEW
                                                          : ImGuiMouseCursor_TextInput);
    if (hovered && !held && help) tooltip(help);
    const float moved = ImGui::GetIO().MousePos.x - ImGui::GetIO().MouseClickedPos[0].x;
    const bool givenUp = state.givenUp == id;
    if (held && !dragging && !givenUp && drag == FieldDrag::Sideways &&
        std::abs(moved) > kDragFromPx * float(desk.uiScale)) {
        endDrag(desk); // whatever was open before is another step
        state.dragging = id;
        state.dragStart = desk.session->scene();
        ++state.drags;
        state.hasDragged = false;
        state.dragPx = 0.0;
    }
    if (state.dragging == id && held && double(moved) != state.dragPx) {
        state.dragPx = moved;
        event = {FieldEvent::Kind::Dragged, "", double(moved) / desk.uiScale};
    }
    if (ImGui::IsItemDeactivated()) {
        if (state.dragging == id) {
            endDrag(desk);
            state.dragging.clear();
            state.dragStart = {};
        } else if (hovered && !givenUp) {
            beginTyping(state, id, text.typed, index);
        }
    }
    if (givenUp && !held) state.givenUp.clear();
    ImGui::PopID();
    return event;
}

} // namespace kilolux
