// Input events with their times, kept until a UI frame can show each of them. Dear ImGui 1.86 looks at states
// once a frame: a key pressed and released in between would be lost, and a click would land where the pointer
// has moved to since. So a frame gets events only up to the first that would hide an earlier one.
#pragma once

#include <cstdint>
#include <deque>
#include <glm/glm.hpp>
#include <vector>

namespace kilolux {

struct InputEvent {
    enum class Kind : std::uint8_t { Move, Button, Wheel, Key, Text } kind = Kind::Move;
    double atMs = 0.0;  // by steadyMs()
    glm::dvec2 px{0.0}; // pointer at the event, pixels of the window; Wheel: steps
    int code = 0;       // button, or key by its GLFW name
    bool down = false;
    bool modifier = false;       // of a key: Shift, Ctrl, Alt, Super
    bool writes = false;         // of a key: a Text event comes with it
    std::uint32_t character = 0; // Text: a Unicode code point
};

class EventQueue {
  public:
    void push(const InputEvent& event) { events_.push_back(event); }
    bool empty() const { return events_.empty(); }
    void clear() { events_.clear(); }

    // The events of the next UI frame, at least one if there is any.
    std::vector<InputEvent> takeFrame();

  private:
    std::deque<InputEvent> events_;
};

} // namespace kilolux
