// Questions about a pixel to the render thread, at most one at a time: the newest wins, answers come later.
// Knows no ImGui.
#pragma once

#include "renderer/probe.h"
#include "ui/render_thread.h"
#include "ui/viewport.h"

#include <memory>
#include <mutex>
#include <optional>

namespace kilolux {

class PixelProbe {
  public:
    // Asks for what `depth` says about a pixel of the shown picture. While an answer is on its way the newest
    // question waits.
    void ask(RenderThread& thread, glm::ivec2 pixel, ProbeDepth depth);
    // Passes on what waits; call once per frame.
    void update(RenderThread& thread);
    void clear();

    // The newest answer, and what went wrong instead.
    const std::optional<Probe>& answer() const { return answer_; }
    const std::string& problem() const { return problem_; }
    bool isAsking() const { return asked_ != nullptr; }

  private:
    struct Mailbox {
        std::mutex mutex;
        std::optional<Result<Probe>> answer;
    };
    struct Question {
        glm::ivec2 pixel{0};
        ProbeDepth depth = ProbeDepth::Surface;
    };
    void post(RenderThread& thread, const Question& question);

    std::shared_ptr<Mailbox> asked_;
    Question question_; // the one that was asked,
    int tries_ = 0;     // so often
    std::optional<Question> waiting_;
    std::optional<Probe> answer_;
    std::string problem_;
};

// The pixel of a picture of that size under a position in the window; nothing outside.
std::optional<glm::ivec2> pixelUnder(glm::dvec2 windowPx, const ViewportRect& rect, glm::ivec2 pictureSize);

} // namespace kilolux
