// What the parts of bench_loop share: scenes, renderers that are run frame by frame, references kept in
// files, and errors against them.
#pragma once

#include "renderer/bench/bench_math.h"
#include "renderer/bench/reference.h"
#include "renderer/measure/image_view.h"
#include "renderer/renderer.h"

#include <filesystem>
#include <nlohmann/json.hpp>

namespace kilolux::test {

struct LoopOptions {
    std::vector<std::string> scenes; // names in content/scenes; empty: those of the part
    int width = 0;                   // pixels; 0: the part's own size
    int height = 0;
    int frames = 0; // 0: the part's own number
    int referenceFrames = 64;
    std::filesystem::path references; // folder that keeps them; empty: they are rendered anew
    std::filesystem::path pictures;   // folder for what 'quality' compares; empty: it is not kept
    Settings settings;
};

// One picture to render, without its scene.
struct Shot {
    std::string method = "stochastic";
    int width = 640;
    int height = 360;
    std::uint32_t seed = 0;
    Settings settings;
    bool keepTargets = false; // Renderer::targets() can be asked for
};

// The size of the options, or this one.
Shot makeShot(const LoopOptions& options, int width, int height);

// All of these throw std::runtime_error with one line for the user.

// A scene of the project and the camera that is looked through: 'wide', else the first.
struct LoopScene {
    std::string name;
    Scene scene;
    std::string camera;
};
LoopScene openScene(const std::string& name);
// The scenes that the options name, else those of `names` that exist; the others are told.
std::vector<LoopScene> openScenes(const LoopOptions& options, const std::vector<std::string>& names);

std::unique_ptr<Renderer> makeRenderer(const LoopScene& scene, const Shot& shot);

struct FrameTime {
    double wallMs = 0.0;
    double cpuMs = 0.0; // of all threads of the process, the driver's as well
};
FrameTime renderFrame(Renderer& renderer);

// --- References ------------------------------------------------------------------------------------------

using bench::medianOf;
using bench::Reference;
using bench::SquaredError;

// By the method of `shot` ('split' or 'true'), half of options.referenceFrames frames each; with jitter all
// of them.
Reference renderReference(const LoopOptions& options, const LoopScene& scene, const Shot& shot);

measure::ImageView viewOf(const FloatImage& image);
measure::ImageView viewOf(const Picture& picture);

SquaredError squaredError(const Reference& reference, const Picture& picture);

// As the display shows it: exposed, Khronos PBR Neutral, sRGB in 0..1, of 8 bits.
FloatImage displayed(const FloatImage& linear, double exposureEv100);
FloatImage displayed(const Picture& picture); // what the renderer itself gave

// --- Output ----------------------------------------------------------------------------------------------

// "0.41 (goal: at least 0.4, met)"
enum class Goal { AtLeast, AtMost };
std::string withGoal(double value, Goal goal, double bound);

} // namespace kilolux::test
