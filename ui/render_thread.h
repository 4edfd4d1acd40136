// The thread that owns the Renderer. It takes what should be shown, renders frame after frame until the
// picture has settled, and hands finished pictures over. Nobody who calls it ever waits for a frame.
#pragma once

#include "renderer/renderer.h"

#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>

namespace kilolux {

// A finished picture with all that belongs to it.
struct ShownFrame {
    std::uint64_t number = 0; // of all pictures since the thread began
    Camera camera;            // that it was rendered with
    int width = 0;            // pixels
    int height = 0;
    std::vector<std::byte> rgba8; // as the display shows it, 4 bytes a pixel
    std::uint64_t documentVersion = 0;
    Settings settings; // that it was rendered with, but for the scale
    double renderScale = 1.0;
    double frameMs = 0.0;     // from taking the request to the picture
    double requestedMs = 0.0; // when the newest request in it was made, by the steady clock; 0: nothing new
    std::uint32_t meanFrames = 0;
    bool settled = false; // nothing more will come until something changes
    std::string view;
    FrameStatistics statistics;
};

struct RenderLimits {
    double movingFrameMs = 90.0;    // the internal resolution falls until a frame takes no longer
    double leastScale = 0.3;        // but not below this share of width and height
    std::uint32_t meanFrames = 256; // that a settled picture holds
    // Of a picture; a larger viewport gets it enlarged. 0: a million on software devices, no limit on others.
    std::uint32_t mostPixels = 0;
    double sliceMs = 15.0; // a frame at rest can be given up so often; 0: never
    double restMs = 200.0; // after the last change until full resolution
    bool operator==(const RenderLimits&) const = default;
};

class RenderThread {
  public:
    // `wake` is called from the thread whenever something new can be taken.
    explicit RenderThread(std::function<void()> wake);
    ~RenderThread(); // stops after the present frame
    RenderThread(const RenderThread&) = delete;
    RenderThread& operator=(const RenderThread&) = delete;

    // Replaces the renderer: scene, method, settings and camera. Pictures of the old one do not come any
    // more.
    void open(const Scene& scene, const RenderOptions& options, const Camera& camera, std::uint64_t version);
    void close(); // gives the renderer up, and what it is preparing

    // The newest of each holds from the next frame on.
    void setCamera(const Camera& camera, Renderer::CameraChange change);
    void setLights(const Scene& edited, std::uint64_t version);
    void setExposureEv100(double ev100);
    void setSettings(const Settings& settings);
    void setView(std::string view, const std::optional<ViewRange>& range = {});
    void setSize(glm::ivec2 sizePx); // of the viewport
    void setLimits(const RenderLimits& limits);
    // When the event happened that the next calls answer, by steadyMs(); 0: they stand for themselves.
    void setInputTime(double ms);
    void setPaused(bool paused); // minimised windows need no pictures

    // Runs between two frames on the thread, in the order posted; for probes and captures. After it frames go
    // on as before. Not called when there is no renderer by then.
    using Job = std::function<void(Renderer&)>;
    void post(Job job);

    // The newest finished picture that nobody has taken yet; null: none.
    std::shared_ptr<const ShownFrame> takeFrame();
    bool hasNews() const; // a picture or an error can be taken
    // What went wrong since the last call, in words for the user; the thread goes on where it can.
    std::optional<Error> takeError();
    // What it is doing when that takes long ("Compiling shaders"), and how far it is; no words: rendering or
    // at rest.
    struct Activity {
        std::string words;
        double share = 0.0;   // 0 to 1
        bool opens = false;   // a scene; else pipelines of what shows it are built
        double sinceMs = 0.0; // steadyMs() when it began
    };
    Activity activity() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

double steadyMs(); // milliseconds of a steady clock

} // namespace kilolux
