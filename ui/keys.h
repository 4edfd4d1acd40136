// Every key of the window in one table: what the help overlay shows and what the light keys act on.
#pragma once

#include <cstdint>
#include <span>

namespace kilolux {

enum class KeyAction : std::uint8_t {
    None, // handled where it belongs; here for the help
    SelectTool,
    MoveTool,
    RotateTool,
    ScaleTool,
    ToggleSpace,
    LargerGizmo,
    SmallerGizmo,
    ToggleGizmos,
    Cancel,
    Mute,
    Solo,
    LookThrough,
    Duplicate,
    Delete,
    Copy,
    Cut,
    Paste,
    SelectAll,
    Group,
    Ungroup,
    AddMenu,
    Rename
};

enum class KeyGroup : std::uint8_t { File, Tools, Lights, Camera, Views, Window };

struct KeyRow {
    KeyGroup group;
    const char* keys; // as people read it
    const char* what;
    KeyAction action = KeyAction::None;
    int key = 0; // GLFW_KEY_*, of rows with an action
    bool ctrl = false;
    bool shift = false;
};
std::span<const KeyRow> keyRows();
const char* nameOf(KeyGroup group);

// What a key means with these modifiers; None: nothing of this table.
KeyAction actionOf(int key, bool ctrl, bool shift);

} // namespace kilolux
