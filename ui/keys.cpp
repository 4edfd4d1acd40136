#include "ui/keys.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace kilolux {

namespace {

using enum KeyGroup;

constexpr KeyRow kRows[] = {
    {File, "Ctrl+O", "Open a scene"},
    {File, "Ctrl+S", "Save"},
    {File, "Ctrl+Shift+S", "Save under another name"},
    {File, "Ctrl+Z", "Undo"},
    {File, "Ctrl+Shift+Z", "Redo"},
    {File, "Ctrl+Q", "Quit"},
    {Tools, "Q", "Select only", KeyAction::SelectTool, GLFW_KEY_Q},
    {Tools, "W", "Move", KeyAction::MoveTool, GLFW_KEY_W},
    {Tools, "E", "Rotate", KeyAction::RotateTool, GLFW_KEY_E},
    {Tools, "R", "Scale the source", KeyAction::ScaleTool, GLFW_KEY_R},
    {Tools, "X", "World or local axes", KeyAction::ToggleSpace, GLFW_KEY_X},
    {Tools, "=", "Larger gizmo", KeyAction::LargerGizmo, GLFW_KEY_EQUAL},
    {Tools, "-", "Smaller gizmo", KeyAction::SmallerGizmo, GLFW_KEY_MINUS},
    {Tools, "G", "Gizmo and dots on or off", KeyAction::ToggleGizmos, GLFW_KEY_G},
    {Tools, "Ctrl", "Hold to snap while dragging"},
    {Tools, "Esc", "Cancel a drag or a choice, else select nothing", KeyAction::Cancel, GLFW_KEY_ESCAPE},
    {Lights, "Click, Shift+click", "Select, add to the selection or take away"},
    {Lights, "Drag", "Select by a rectangle"},
    {Lights, "Ctrl+A", "Select all", KeyAction::SelectAll, GLFW_KEY_A, true},
    {Lights, "Shift+A", "Add a light at the pointer", KeyAction::AddMenu, GLFW_KEY_A, false, true},
    {Lights, "H", "Mute or unmute", KeyAction::Mute, GLFW_KEY_H},
    {Lights, "Shift+S", "Solo", KeyAction::Solo, GLFW_KEY_S, false, true},
    {Lights, "L", "Look through the light", KeyAction::LookThrough, GLFW_KEY_L},
    {Lights, "F2", "Rename", KeyAction::Rename, GLFW_KEY_F2},
    {Lights, "Ctrl+D", "Duplicate", KeyAction::Duplicate, GLFW_KEY_D, true},
    {Lights, "Del", "Delete", KeyAction::Delete, GLFW_KEY_DELETE},
    {Lights, "Ctrl+C", "Copy as text", KeyAction::Copy, GLFW_KEY_C, true},
    {Lights, "Ctrl+X", "Cut", KeyAction::Cut, GLFW_KEY_X, true},
    {Lights, "Ctrl+V", "Paste", KeyAction::Paste, GLFW_KEY_V, true},
    {Lights, "Ctrl+G", "Group", KeyAction::Group, GLFW_KEY_G, true},
    {Lights, "Ctrl+Shift+G", "Dissolve the group", KeyAction::Ungroup, GLFW_KEY_G, true, true},
    {Camera, "F", "Frame the selection, or the scene"},
    {Camera, "Right mouse + WASD", "Fly; Q and E down and up, Shift faster, wheel sets the speed"},
    {Camera, "Alt + left mouse", "Orbit"},
    {Camera, "Middle mouse", "Pan"},
    {Camera, "Wheel", "Nearer and farther"},
    {Views, "1 to 9", "Views, 1 the picture"},
    {Views, "P, then a click", "Probe a pixel"},
    {Views, "B", "Toggle the stored picture"},
    {Window, "Tab", "Hide or show all panels"},
    {Window, "F1", "This list"},
};

} // namespace

std::span<const KeyRow> keyRows() {
    return kRows;
}

const char* nameOf(KeyGroup group) {
    switch (group) {
    case File:
        return "File";
    case Tools:
        return "Tools";
    case Lights:
        return "Lights";
    case Camera:
        return "Camera";
    case Views:
        return "Views";
    case Window:
        break;
    }
    return "Window";
}

KeyAction actionOf(int key, bool ctrl, bool shift) {
    for (const KeyRow& row : kRows)
        if (row.action != KeyAction::None && row.key == key && row.ctrl == ctrl && row.shift == shift)
            return row.action;
    return KeyAction::None;
}

} // namespace kilolux
