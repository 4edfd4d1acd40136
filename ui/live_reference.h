// The error of the shown picture, live: a renderer of its own draws a reference of the same view in a thread
// of the lowest priority, frame after frame, and pictures are measured against its mean. Knows no ImGui.
#pragma once

#include "renderer/renderer.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace kilolux {

// What a reference is of.
struct ReferenceView {
    Scene scene;
    RenderOptions options; // size and settings of the picture; the method is the reference's
    Camera camera;
    double exposureEv100 = 0.0;
    std::uint64_t key = 0; // the caller's name for all of this
};

// What a picture was that is measured, for who asked.
struct MeasuredPicture {
    std::uint32_t frames = 0; // in its mean
    double frameMs = 0.0;     // that one of them takes
    std::string preset;       // of its settings
};

struct ErrorReport {
    std::uint64_t key = 0;
    MeasuredPicture of;
    std::uint32_t frames = 0;            // that the reference's mean held
    double relativeMse = 0.0;            // linear light, epsilon 0.01 of the mean's square
    double flipMean = 0.0, flip95 = 0.0; // LDR-FLIP of what the display shows, 67 pixels per degree
    int width = 0, height = 0;
    std::vector<float> flip;             // per pixel, 0 to 1
    std::vector<std::uint8_t> reference; // as the display shows it, 3 bytes a pixel
};

class LiveReference {
  public:
    // `wake` is called from the thread whenever there is something new.
    explicit LiveReference(std::function<void()> wake);
    ~LiveReference();
    LiveReference(const LiveReference&) = delete;
    LiveReference& operator=(const LiveReference&) = delete;

    // Begins anew with another view; nobody waits for it. What was being prepared or rendered is given up.
    void begin(ReferenceView view);
    // Gives the renderer up, in the middle of what it does.
    void stop();
    // While the picture moves the cores are its own.
    void setResting(bool resting);
    // Measures a picture of the view named by `key` against the mean so far.
    void compare(std::shared_ptr<const Picture> shown, std::uint64_t key, MeasuredPicture of = {});

    struct State {
        std::uint64_t key = 0;
        std::uint32_t frames = 0;
        std::string preparing;      // what is prepared, in words; empty: nothing is
        double preparedShare = 0.0; // 0 to 1
        std::string problem;
        std::shared_ptr<const ErrorReport> report;
    };
    State state() const;

    static constexpr std::uint32_t kMostFrames = 512;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// Both of one size.
ErrorReport measureError(const Picture& reference, const Picture& shown);

} // namespace kilolux
