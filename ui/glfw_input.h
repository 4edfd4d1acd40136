// GLFW's callbacks into the event queue, and the queue's events into Dear ImGui's state.
#pragma once

#include "ui/event_queue.h"

#include <functional>
#include <optional>
#include <string>

struct GLFWwindow;

namespace kilolux {

// What the window's callbacks fill. It must outlive the window.
struct GlfwInput {
    EventQueue queue;
    std::vector<std::string> dropped;    // files let go over the window
    bool changed = false;                // size, focus, exposure: a redraw is due
    glm::dvec2 pxPerPoint{1.0};          // of the pointer's position
    std::optional<glm::dvec2> pointerPx; // by the newest move; none yet: nothing
    GLFWwindow* window = nullptr;
};

void installInput(GLFWwindow* window, GlfwInput& input);

// Tells ImGui which of our keys are its own, and gives it the clipboard.
void connectImGui(GlfwInput& input);

// Puts the events of a frame into ImGui's state.
void feedImGui(const std::vector<InputEvent>& events);

// The pointer's shape that the panels asked for.
void showCursor(GLFWwindow* window);

} // namespace kilolux
