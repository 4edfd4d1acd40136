// Pictures that methods are held against: two halves of the frames with their own random numbers, so that the
// product of both errors is free of the reference's own noise. They can be kept in files.
#pragma once

#include "renderer/renderer.h"

#include <array>
#include <atomic>
#include <filesystem>
#include <optional>

namespace kilolux::bench {

inline constexpr const char* kStopped = "stopped before its end";

struct Reference {
    std::array<FloatImage, 2> halves; // linear RGB, not exposed
    FloatImage mean;
    double exposureEv100 = 0.0; // that pictures are shown with
};

// Renders either half with so many frames and seeds 1 and 2, or takes it from `folder` when it has been kept
// there; an empty folder keeps nothing. What the picture depends on is part of a file's name, `sceneTag`
// telling what was done to the scene since it was read; shaders are not: a folder serves one state of them.
// Errors: no device; kStopped once `stop` is true.
Result<Reference> makeReference(const Scene& scene, const RenderOptions& options, int framesOfHalf,
                                const std::filesystem::path& folder, const std::string& sceneTag = {},
                                const std::atomic<bool>* stop = nullptr);

// EV100 that a picture of the scene is shown with.
double shownExposureEv100(const Scene& scene, const Settings& settings);

// Mean over pixels and channels of (picture - half 0) * (picture - half 1) of exposed light, and the same
// over (reference^2 + epsilon). `rgb` is not exposed.
struct SquaredError {
    double absolute = 0.0;
    double relative = 0.0;
    SquaredError& operator+=(const SquaredError& other);
};
SquaredError squaredError(const Reference& reference, const std::vector<float>& rgb, double epsilon = 1e-2);

// Linear light as the display shows it, sRGB in 0..1.
std::vector<float> displayedAt(const std::vector<float>& rgb, double exposureEv100);

} // namespace kilolux::bench
