// The renderer as everybody else sees it: a scene and options in, pictures and statistics out. It knows no
// window, opens no files but the shaders, and writes none.
#pragma once

#include "renderer/document/result.h"
#include "renderer/document/scene.h"
#include "renderer/legend.h"
#include "renderer/output/picture_file.h"
#include "renderer/probe.h"
#include "renderer/settings.h"
#include "renderer/statistics.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kilolux {

class TaskWatch; // document/task_watch.h

// A view or method that the user can choose, with one line of help.
struct NamedChoice {
    std::string_view name;
    std::string_view help;
};

// Sampled light of a frame as litDiffuse and litSpecular hold it: 4 floats a pixel.
struct LitTexels {
    std::vector<float> diffuse, specular;
};

struct RenderOptions {
    int width = 960; // pixels
    int height = 540;
    int frames = 1;
    std::uint32_t seed = 0;
    std::string method; // empty: the first of Renderer::methods()
    std::string view;   // empty: the first of Renderer::views(); or an output of a pass (pass_output.h)
    std::optional<ViewRange> viewRange; // of the view's scale; else its own
    std::string camera; // name of one of the scene's cameras; empty: the first one, or a derived one
    Settings settings;
    bool keepTargets = false;              // keep what Renderer::targets() reads back
    bool allFeatures = false;              // the pipelines that can draw any scene; the same picture, slower
    std::optional<std::uint32_t> gridRoom; // indices of the light grid's fine lists at the start, for tests
    // For tests of the filters: what stands in for the light that a frame has sampled; empty: nothing does.
    std::function<LitTexels(int frame)> replaceLit;
    // For tests: whether the filters take the paths made for CPU devices; empty: as the device is one.
    std::optional<bool> cpuFilters;
    // A frame in slices of about so many milliseconds, between which it can be given up; 0: one submission.
    double sliceMs = 0.0;
    const std::atomic<bool>* interrupt = nullptr; // set: renderFrame() gives its frame up at the next slice
    // Told how far create() and the building of pipelines are; cancelled, they end with an error.
    TaskWatch* watch = nullptr;
    bool poisonTargets = false; // targets start as NaN, so that a pixel which no pass writes shows
};

struct Picture {
    int width = 0; // pixels
    int height = 0;
    std::vector<float> rgb;          // linear Rec. 709, scene-referred, not exposed; a view: its raw values
    std::vector<std::uint8_t> srgb8; // as the display shows it, 3 bytes a pixel
};

// One target of the last frame.
struct NamedImage {
    std::string name; // GLSL name
    FloatImage image;
    std::vector<std::byte> texels; // as the device holds them, tightly packed: packed words do not fit floats
};

// Called after every finished frame with (frames done, frames in all); false cancels the render.
using RenderProgress = std::function<bool(int, int)>;

class Renderer {
  public:
    // The first of each is the default.
    static std::span<const NamedChoice> views();
    static std::span<const NamedChoice> methods();

    // `scene` must outlive the renderer. Errors: no usable device, too little memory, unknown names.
    static Result<std::unique_ptr<Renderer>> create(const Scene& scene, const RenderOptions& options);
    ~Renderer();

    // Renders options.frames frames. Errors: lost device, out of memory, cancelled.
    Result<Picture> render(const RenderProgress& progress);

    // --- Frame by frame, for windows and tests; render() is a loop of these. What is set holds from the next
    // frame on. History goes on through all of them but a cut and changed settings.

    std::optional<Error> renderFrame(); // the next one; the first compiles
    // Whether the last renderFrame() was given up. Then the next one goes on from the frame before it, with
    // its history; only the mean begins anew, and there is no picture until then.
    bool wasInterrupted() const;
    Picture picture() const; // of the last frame
    // The last frame as the display shows it: sRGB, 4 bytes a pixel. Cheaper than picture().
    std::vector<std::byte> displayPixels() const;
    enum class CameraChange { Move, Cut };
    void setCamera(const Camera& camera, CameraChange change);
    // Takes over lights, their definitions and groups, dome and fill, and the nodes' transforms and lighting
    // channels from an edited copy of the scene with the same nodes and meshes. Instances move only if an
    // animation of the scene moves them.
    void setLights(const Scene& edited);
    void setExposureEv100(double ev100);
    void setRenderScale(double scale); // 0.1 to 1 of the picture's width and height
    // Any other settings; history and targets begin anew. On error the old ones stay.
    std::optional<Error> setSettings(const Settings& settings);
    // Pictures of another size, in pixels; history begins anew.
    std::optional<Error> resize(int width, int height);
    // Frames that the running mean holds: it begins anew with every change of what it averages.
    std::uint32_t meanFrames() const;

    // What the next frames show, as RenderOptions::view and viewRange. Pictures and history go on. On error
    // the old one stays.
    std::optional<Error> setView(std::string_view view, const std::optional<ViewRange>& range = {});

    // What is known of a pixel of the last frame's picture. Renders a frame first where there is none to look
    // into: at the start, after changed settings, or when the light grid has just grown. Errors: outside the
    // picture.
    Result<Probe> probe(glm::ivec2 pixel, ProbeDepth depth = ProbeDepth::Lights);

    // For tests: the visible light lists that the next frame finds, LIST_TEXELS texels a tile
    // (shared/sampling.h).
    std::vector<glm::uvec2> visibleLists() const;
    void replaceVisibleLists(const std::vector<glm::uvec2>& texels);
    std::uint32_t lightSlot(std::uint64_t lightId) const; // 0xffffffff for lights that are not there

    bool isSoftware() const; // the device is the processor itself

    FrameStatistics statistics() const; // of the last render(), or of all frames since create()

    // Every target of the last frame; empty unless options.keepTargets.
    Result<std::vector<NamedImage>> targets();

  private:
    struct Impl;
    explicit Renderer(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

} // namespace kilolux
