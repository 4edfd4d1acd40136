// The random numbers of a pixel and frame: spatio-temporal blue noise by one texel fetch, or white noise.
// Over pixels and frames both are uniform; blue noise arranges the error for the filters that follow.
#ifndef KILOLUX_LIB_NOISE_GLSL
#define KILOLUX_LIB_NOISE_GLSL
#include "../math/noise_tile.glsl"
#include "../shared/features.h"

layout(constant_id = CHOICE_WHITE_NOISE) const bool kWhiteNoise = false;

uniform usampler2DArray noiseMask; // RGBA16_UINT, renderer/noise.h

PixelNoise pixelNoise(uvec2 pixel, uint frame, uint seed) {
    if (kWhiteNoise) return whitePixelNoise(pixel, frame, seed);
    uvec4 texel = texelFetch(noiseMask, ivec3(noiseTexel(pixel, frame, seed)), 0);
    return bluePixelNoise(texel, pixel, frame, seed);
}

// The number that every N-th light of a cell is counted from: a lattice over pixels and frames (Roberts, "The
// Unreasonable Effectiveness of Quasirandom Sequences", 2018: R2 over the picture, the golden ratio over frames), so that
// neighbours and successive frames look at different lights. The squared error of 16 x 16 pixels over 64 frames of the
// night market is a tenth less than with white numbers. It depends on none of the other numbers.
float offsetNumber(uvec2 pixel, uint frame, uint seed) {
    if (kWhiteNoise) return whiteNoise1(pixelSeed(pixel, frame, seed), 9u);
    return unitFloat(pixel.x * 3242174889u + pixel.y * 2447445414u + frame * 2654435769u + hashUint(seed));
}

#endif
