#include "ui/pixel_probe.h"

namespace kilolux {

namespace {

// A frame that a probe looks into may be given up for what moves meanwhile, again and again.
constexpr int kMostTries = 8;

} // namespace

void PixelProbe::ask(RenderThread& thread, glm::ivec2 pixel, ProbeDepth depth) {
    if (asked_) {
        waiting_ = Question{pixel, depth};
        return;
    }
    tries_ = 0;
    post(thread, {pixel, depth});
}

void PixelProbe::post(RenderThread& thread, const Question& question) {
    ++tries_;
    question_ = question;
    const auto [pixel, depth] = question;
    asked_ = std::make_shared<Mailbox>();
    thread.post([box = asked_, pixel, depth](Renderer& renderer) {
        Result<Probe> found = renderer.probe(pixel, depth);
        const std::lock_guard lock(box->mutex);
        box->answer = std::move(found);
    });
}

void PixelProbe::update(RenderThread& thread) {
    if (!asked_) return;
    // Who holds the box alone beforehand will get no answer any more: the job was dropped with its renderer.
    const bool alone = asked_.use_count() == 1;
    std::optional<Result<Probe>> found;
    {
        const std::lock_guard lock(asked_->mutex);
        found = std::move(asked_->answer);
    }
    if (!found && !alone) return;
    asked_.reset();
    const auto next = std::exchange(waiting_, std::nullopt);
    if (!next && !alone && found && !*found && tries_ < kMostTries) {
        post(thread, question_);
        return;
    }
    if (found && *found) {
        answer_ = found->value();
        problem_.clear();
    } else if (found) {
        problem_ = found->error();
    }
    if (next) ask(thread, next->pixel, next->depth);
}

void PixelProbe::clear() {
    asked_.reset();
    waiting_.reset();
    answer_.reset();
    problem_.clear();
}

std::optional<glm::ivec2> pixelUnder(glm::dvec2 windowPx, const ViewportRect& rect, glm::ivec2 pictureSize) {
    if (!rect.contains(windowPx)) return std::nullopt;
    // The picture fills the height; one of another shape stands in the middle.
    const double scale = double(pictureSize.y) / rect.height;
    const glm::dvec2 from(rect.center().x - 0.5 * pictureSize.x / scale, rect.y);
    const glm::dvec2 pixel = (windowPx - from) * scale;
    if (pixel.x < 0.0 || pixel.x >= pictureSize.x) return std::nullopt;
    return glm::min(glm::ivec2(pixel), pictureSize - 1);
}

} // namespace kilolux
