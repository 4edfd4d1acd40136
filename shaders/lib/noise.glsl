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

#endif
