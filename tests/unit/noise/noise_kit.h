// What the tests of blue noise share: the committed masks read as shaders read them, and the error of a
// stochastic signal after the filters of the renderer, against the same signal from white noise.
#pragma once

#include "renderer/lights_cpp/lights_f32.h"
#include "renderer/noise.h"

#include <functional>
#include <string>
#include <vector>

namespace kilolux::test {

using uint = std::uint32_t;

const NoiseMask& committedMask();

enum class NoiseMode { Blue, White };

// What lib/noise.glsl's pixelNoise gives.
f32::PixelNoise pixelNoise(NoiseMode mode, uint x, uint y, uint frame, uint seed = 0);

// A signal: what a pixel shows for its random numbers.
using Signal = std::function<double(const f32::PixelNoise&)>;

// How a signal is filtered: an exponential mean with at least `alpha` of the newest frame, begun anew every
// `restartFrames` frames (0: never) and taken at its end, or in every frame after 32; then, where `blurs`,
// the 5x5 binomial.
struct FilterChain {
    std::string name;
    bool blurs;
    double alpha;
    uint restartFrames;
};

// One blurred frame; 8 frames after a disocclusion; a whole cycle of the mask; long history, which crosses
// the ends of cycles. All but the first alone and blurred.
const std::vector<FilterChain>& rendererFilters();

// Mean squared error that each of rendererFilters() leaves with blue noise, over what it leaves with white
// noise: all signals together, over one tile of pixels and 128 frames. `means` are the signals' true ones.
std::vector<double> errorRatios(const std::vector<Signal>& signals, const std::vector<double>& means);

} // namespace kilolux::test
