// Input between GLFW and Dear ImGui, see glfw_input.h. ImGui's own GLFW back end polls states and is not
// used.
#include "ui/glfw_input.h"

#include "ui/render_thread.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <utility>

namespace kilolux {

namespace {

GlfwInput& of(GLFWwindow* window) {
    return *static_cast<GlfwInput*>(glfwGetWindowUserPointer(window));
}

InputEvent eventAt(GLFWwindow* window, InputEvent::Kind kind) {
    InputEvent event;
    event.kind = kind;
    event.atMs = steadyMs();
    // Where the pointer was told to be last: asked now, X says where it is by now, which may be far from the
    // press.
    const GlfwInput& input = of(window);
    if (input.pointerPx) {
        event.px = *input.pointerPx;
    } else {
        glfwGetCursorPos(window, &event.px.x, &event.px.y);
        event.px *= input.pxPerPoint;
    }
    return event;
}

bool isModifier(int key) {
    return key >= GLFW_KEY_LEFT_SHIFT && key <= GLFW_KEY_RIGHT_SUPER;
}

void onMove(GLFWwindow* window, double x, double y) {
    InputEvent event = eventAt(window, InputEvent::Kind::Move);
    event.px = glm::dvec2(x, y) * of(window).pxPerPoint;
    of(window).pointerPx = event.px;
    of(window).queue.push(event);
}

void onButton(GLFWwindow* window, int button, int action, int) {
    InputEvent event = eventAt(window, InputEvent::Kind::Button);
    event.code = button;
    event.down = action == GLFW_PRESS;
    of(window).queue.push(event);
}

void onWheel(GLFWwindow* window, double x, double y) {
    InputEvent event = eventAt(window, InputEvent::Kind::Wheel);
    event.px = {x, y};
    of(window).queue.push(event);
}

void onKey(GLFWwindow* window, int key, int scancode, int action, int mods) {
    if (action == GLFW_REPEAT || key == GLFW_KEY_UNKNOWN) return; // ImGui repeats by itself
    InputEvent event = eventAt(window, InputEvent::Kind::Key);
    event.code = key;
    event.down = action == GLFW_PRESS;
    event.modifier = isModifier(key);
    const bool command = mods & (GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER);
    event.writes = !command && (key == GLFW_KEY_SPACE || glfwGetKeyName(key, scancode));
    of(window).queue.push(event);
}

void onText(GLFWwindow* window, unsigned int character) {
    InputEvent event = eventAt(window, InputEvent::Kind::Text);
    event.character = character;
    of(window).queue.push(event);
}

void onDrop(GLFWwindow* window, int count, const char** paths) {
    of(window).dropped.assign(paths, paths + count);
}

// Keys held when the focus leaves are released elsewhere and would stay down for ever.
void onFocus(GLFWwindow* window, int focused) {
    GlfwInput& input = of(window);
    input.changed = true;
    if (focused) return;
    const ImGuiIO& io = ImGui::GetIO();
    for (int key = 0; key < int(IM_ARRAYSIZE(io.KeysDown)); ++key) {
        if (!io.KeysDown[key]) continue;
        InputEvent event = eventAt(window, InputEvent::Kind::Key);
        event.code = key;
        event.modifier = isModifier(key);
        input.queue.push(event);
    }
}

template<typename... Rest>
void onChange(GLFWwindow* window, Rest...) {
    of(window).changed = true;
}

} // namespace

void installInput(GLFWwindow* window, GlfwInput& input) {
    input.window = window;
    glfwSetWindowUserPointer(window, &input);
    glfwSetCursorPosCallback(window, onMove);
    glfwSetMouseButtonCallback(window, onButton);
    glfwSetScrollCallback(window, onWheel);
    glfwSetKeyCallback(window, onKey);
    glfwSetCharCallback(window, onText);
    glfwSetDropCallback(window, onDrop);
    glfwSetWindowFocusCallback(window, onFocus);
    glfwSetCursorEnterCallback(window, onChange<int>);
    glfwSetFramebufferSizeCallback(window, onChange<int, int>);
    glfwSetWindowRefreshCallback(window, onChange<>);
    glfwSetWindowIconifyCallback(window, onChange<int>);
    glfwSetWindowCloseCallback(window, onChange<>);
}

void connectImGui(GlfwInput& input) {
    ImGuiIO& io = ImGui::GetIO();
    constexpr std::pair<ImGuiKey, int> kKeys[] = {{ImGuiKey_Tab, GLFW_KEY_TAB},
                                                  {ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
                                                  {ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
                                                  {ImGuiKey_UpArrow, GLFW_KEY_UP},
                                                  {ImGuiKey_DownArrow, GLFW_KEY_DOWN},
                                                  {ImGuiKey_PageUp, GLFW_KEY_PAGE_UP},
                                                  {ImGuiKey_PageDown, GLFW_KEY_PAGE_DOWN},
                                                  {ImGuiKey_Home, GLFW_KEY_HOME},
                                                  {ImGuiKey_End, GLFW_KEY_END},
                                                  {ImGuiKey_Insert, GLFW_KEY_INSERT},
                                                  {ImGuiKey_Delete, GLFW_KEY_DELETE},
                                                  {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
                                                  {ImGuiKey_Space, GLFW_KEY_SPACE},
                                                  {ImGuiKey_Enter, GLFW_KEY_ENTER},
                                                  {ImGuiKey_Escape, GLFW_KEY_ESCAPE},
                                                  {ImGuiKey_KeyPadEnter, GLFW_KEY_KP_ENTER},
                                                  {ImGuiKey_A, GLFW_KEY_A},
                                                  {ImGuiKey_C, GLFW_KEY_C},
                                                  {ImGuiKey_V, GLFW_KEY_V},
                                                  {ImGuiKey_X, GLFW_KEY_X},
                                                  {ImGuiKey_Y, GLFW_KEY_Y},
                                                  {ImGuiKey_Z, GLFW_KEY_Z}};
    for (const auto& [imgui, glfw] : kKeys)
        io.KeyMap[imgui] = glfw;
    io.ClipboardUserData = input.window;
    io.GetClipboardTextFn = [](void* window) {
        return glfwGetClipboardString(static_cast<GLFWwindow*>(window));
    };
    io.SetClipboardTextFn = [](void* window, const char* text) {
        glfwSetClipboardString(static_cast<GLFWwindow*>(window), text);
    };
    io.BackendFlags |= ImGuiBackendFlags_HasMouseCursors;
}

void feedImGui(const std::vector<InputEvent>& events) {
    ImGuiIO& io = ImGui::GetIO();
    for (const InputEvent& event : events) {
        if (event.kind == InputEvent::Kind::Move || event.kind == InputEvent::Kind::Button)
            io.MousePos = {float(event.px.x), float(event.px.y)};
        switch (event.kind) {
        case InputEvent::Kind::Move:
            break;
        case InputEvent::Kind::Button:
            if (event.code < IM_ARRAYSIZE(io.MouseDown)) io.MouseDown[event.code] = event.down;
            break;
        case InputEvent::Kind::Wheel:
            io.MouseWheelH += float(event.px.x);
            io.MouseWheel += float(event.px.y);
            break;
        case InputEvent::Kind::Key:
            io.KeysDown[event.code] = event.down;
            break;
        case InputEvent::Kind::Text:
            io.AddInputCharacter(event.character);
            break;
        }
    }
    io.KeyCtrl = io.KeysDown[GLFW_KEY_LEFT_CONTROL] || io.KeysDown[GLFW_KEY_RIGHT_CONTROL];
    io.KeyShift = io.KeysDown[GLFW_KEY_LEFT_SHIFT] || io.KeysDown[GLFW_KEY_RIGHT_SHIFT];
    io.KeyAlt = io.KeysDown[GLFW_KEY_LEFT_ALT] || io.KeysDown[GLFW_KEY_RIGHT_ALT];
    io.KeySuper = io.KeysDown[GLFW_KEY_LEFT_SUPER] || io.KeysDown[GLFW_KEY_RIGHT_SUPER];
}

void showCursor(GLFWwindow* window) {
    static GLFWcursor* shapes[ImGuiMouseCursor_COUNT] = {};
    constexpr std::pair<ImGuiMouseCursor, int> kShapes[] = {{ImGuiMouseCursor_TextInput, GLFW_IBEAM_CURSOR},
                                                            {ImGuiMouseCursor_ResizeEW, GLFW_HRESIZE_CURSOR},
                                                            {ImGuiMouseCursor_ResizeNS, GLFW_VRESIZE_CURSOR},
                                                            {ImGuiMouseCursor_Hand, GLFW_HAND_CURSOR}};
    const ImGuiMouseCursor wanted = ImGui::GetMouseCursor();
    GLFWcursor* shape = nullptr; // the arrow
    for (const auto& [cursor, name] : kShapes) {
        if (cursor != wanted) continue;
        if (!shapes[cursor]) shapes[cursor] = glfwCreateStandardCursor(name);
        shape = shapes[cursor];
    }
    glfwSetCursor(window, shape);
}

} // namespace kilolux
