#include "tests/unit/noise/noise_kit.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace kilolux::test {
namespace {

constexpr int kSize = NoiseMask::kWidth;
constexpr uint kFrames = 128;      // four cycles of the mask
using Frame = std::vector<double>; // [y][x] of one tile, which is a torus

Frame blurred(const Frame& frame) {
    constexpr double kWeights[5] = {1.0 / 16, 4.0 / 16, 6.0 / 16, 4.0 / 16, 1.0 / 16};
    Frame rows(frame.size()), both(frame.size());
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x)
            for (int d = -2; d <= 2; ++d)
                rows[y * kSize + x] += kWeights[d + 2] * frame[y * kSize + ((x + d) & (kSize - 1))];
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x)
            for (int d = -2; d <= 2; ++d)
                both[y * kSize + x] += kWeights[d + 2] * rows[((y + d) & (kSize - 1)) * kSize + x];
    return both;
}

std::vector<Frame> errorFrames(const Signal& signal, double mean, NoiseMode mode) {
    std::vector<Frame> frames(kFrames, Frame(kSize * kSize));
    for (uint frame = 0; frame < kFrames; ++frame)
        for (int i = 0; i < kSize * kSize; ++i)
            frames[frame][i] = signal(pixelNoise(mode, i % kSize, i / kSize, frame)) - mean;
    return frames;
}

// Mean square of what the chain leaves of the errors, over the frames that it takes.
double filteredError(const std::vector<Frame>& errors, const FilterChain& chain) {
    Frame history(kSize * kSize);
    double sum = 0.0;
    std::size_t count = 0;
    for (uint frame = 0; frame < kFrames; ++frame) {
        const uint age = chain.restartFrames > 0 ? frame % chain.restartFrames : frame;
        const double alpha = std::max(chain.alpha, 1.0 / (age + 1.0));
        for (std::size_t i = 0; i < history.size(); ++i)
            history[i] += alpha * (errors[frame][i] - history[i]);
        const bool taken = chain.restartFrames > 0 ? age + 1 == chain.restartFrames : frame >= 32;
        if (!taken) continue;
        for (double error : chain.blurs ? blurred(history) : history)
            sum += error * error;
        count += history.size();
    }
    return sum / static_cast<double>(count);
}

} // namespace

const NoiseMask& committedMask() {
    static const NoiseMask mask = [] {
        const Result<NoiseMask> loaded = loadNoiseMask(KILOLUX_SOURCE_DIR "/content/blue_noise.bin");
        if (!loaded) {
            std::fprintf(stderr, "%s\n", loaded.error().c_str());
            std::exit(1);
        }
        return loaded.value();
    }();
    return mask;
}

f32::PixelNoise pixelNoise(NoiseMode mode, uint x, uint y, uint frame, uint seed) {
    const glm::uvec2 pixel(x, y);
    if (mode == NoiseMode::White) return f32::whitePixelNoise(pixel, frame, seed);
    const glm::uvec3 at = f32::noiseTexel(pixel, frame, seed);
    const NoiseMask::Texel& texel = committedMask().at(at.x, at.y, at.z);
    return f32::bluePixelNoise({texel[0], texel[1], texel[2], texel[3]}, pixel, frame, seed);
}

const std::vector<FilterChain>& rendererFilters() {
    static const std::vector<FilterChain> chains = {
        {.name = "1 frame, blurred", .blurs = true, .alpha = 1.0, .restartFrames = 1},
        {.name = "8 frames", .blurs = false, .alpha = 0.1, .restartFrames = 8},
        {.name = "8 frames, blurred", .blurs = true, .alpha = 0.1, .restartFrames = 8},
        {.name = "32 frames", .blurs = false, .alpha = 0.1, .restartFrames = 32},
        {.name = "32 frames, blurred", .blurs = true, .alpha = 0.1, .restartFrames = 32},
        {.name = "long history", .blurs = false, .alpha = 0.1, .restartFrames = 0},
        {.name = "long history, blurred", .blurs = true, .alpha = 0.1, .restartFrames = 0}};
    return chains;
}

std::vector<double> errorRatios(const std::vector<Signal>& signals, const std::vector<double>& means) {
    std::vector<double> blue(rendererFilters().size()), white(blue), ratios(blue);
    for (std::size_t i = 0; i < signals.size(); ++i)
        for (NoiseMode mode : {NoiseMode::Blue, NoiseMode::White}) {
            const std::vector<Frame> errors = errorFrames(signals[i], means[i], mode);
            for (std::size_t c = 0; c < ratios.size(); ++c)
                (mode == NoiseMode::Blue ? blue : white)[c] += filteredError(errors, rendererFilters()[c]);
        }
    for (std::size_t c = 0; c < ratios.size(); ++c)
        ratios[c] = blue[c] / white[c];
    return ratios;
}

} // namespace kilolux::test
