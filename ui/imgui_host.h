// Hosts Dear ImGui in a GLFW window: a Vulkan device of its own, the swapchain, the finished picture below
// and the panels on top. The only file of the window that knows Vulkan.
//
// The device is not the renderer's. On software drivers a second device has threads of its own, so that the
// system shares the cores between both and neither a long pass nor a pipeline being compiled keeps a redraw
// waiting. On hardware the copy of a picture from one to the other costs about a millisecond.
#pragma once

#include "renderer/document/result.h"
#include "ui/viewport.h"

#include <memory>

struct GLFWwindow;

namespace kilolux {

struct ShownFrame;

class ImGuiHost {
  public:
    // Errors: no device that can present.
    static Result<std::unique_ptr<ImGuiHost>> create(GLFWwindow* window);
    ~ImGuiHost();
    ImGuiHost(const ImGuiHost&) = delete;
    ImGuiHost& operator=(const ImGuiHost&) = delete;

    bool isSoftware() const; // the device is the processor itself

    // The fonts of ImGui's atlas have changed.
    std::optional<Error> uploadFonts();

    // Takes the pixels of a picture over for the frames from now on; null: none.
    void setPicture(const ShownFrame* frame);

    // Draws the picture into `rect` and what ImGui::Render() made on top, and presents. Whatever neither
    // covers is undefined. A window without area is left alone.
    std::optional<Error> present(glm::ivec2 windowPx, const ViewportRect& rect);

  private:
    struct Impl;
    explicit ImGuiHost(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

} // namespace kilolux
