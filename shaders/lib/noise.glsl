// Random numbers of a pixel for one frame.
#ifndef KILOLUX_LIB_NOISE_GLSL
#define KILOLUX_LIB_NOISE_GLSL
#include "../math/hash.glsl"

struct PixelNoise {
    vec3 numbers; // for the visible, the hidden and the directional lights
    vec2 point;   // on the light
};

PixelNoise pixelNoise(uvec2 pixel, uint frameIndex, uint seed) {
    uint sampleSeed = pixelSeed(pixel, frameIndex, seed);
    vec2 a = whiteNoise2(sampleSeed, 0u);
    return PixelNoise(vec3(a, whiteNoise1(sampleSeed, 1u)), whiteNoise2(sampleSeed, 2u));
}

#endif
