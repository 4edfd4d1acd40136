// Which texel of the blue-noise masks a pixel reads in a frame, and what becomes of it. Masks repeat every
// NOISE_LAYERS frames; each such cycle moves the tile by a hash and mirrors the values, which keeps every
// distance between values and so the spectrum, but gives a pixel new combinations: long means converge.
#ifndef KILOLUX_MATH_NOISE_TILE_GLSL
#define KILOLUX_MATH_NOISE_TILE_GLSL
#include "../shared/noise.h"
#include "hash.glsl"
#include "reservoir.glsl"
#include "selection_types.glsl"

// What all pixels share in a cycle of NOISE_LAYERS frames.
KX_INLINE uint noiseCycleHash(uint frame, uint seed) {
    return hashCombine(hashUint(seed ^ 0x6e6f6973u), frame / NOISE_LAYERS);
}

// Column, row and layer. Seeds start at layers of their own.
KX_INLINE uvec3 noiseTexel(uvec2 pixel, uint frame, uint seed) {
    uint cycle = noiseCycleHash(frame, seed);
    return uvec3((pixel.x + (cycle >> 16u)) % NOISE_TILE_PX, (pixel.y + (cycle >> 24u)) % NOISE_TILE_PX,
                 (frame + hashUint(seed)) % NOISE_LAYERS);
}

// The texel's values in the cycle's orientation: each of the four mirrored or not, the point's axes swapped
// or not. A number and a point at the same texel would otherwise be the same pair for ever.
KX_INLINE uvec4 orientNoise(uvec4 texel, uint frame, uint seed) {
    uint cycle = noiseCycleHash(frame, seed);
    bool swaps = (cycle & 16u) != 0u;
    uvec4 swapped = uvec4(texel.x, texel.y, swaps ? texel.w : texel.z, swaps ? texel.z : texel.w);
    uvec4 mirrors = uvec4(cycle & 1u, (cycle >> 1u) & 1u, (cycle >> 2u) & 1u, (cycle >> 3u) & 1u);
    return swapped ^ (mirrors * 0xffffu); // v becomes 65535 - v
}

KX_INLINE PixelNoise whitePixelNoise(uvec2 pixel, uint frame, uint seed) {
    uint sampleSeed = pixelSeed(pixel, frame, seed);
    PixelNoise noise;
    noise.numbers =
        vec3(whiteNoise1(sampleSeed, 0u), whiteNoise1(sampleSeed, 1u), whiteNoise1(sampleSeed, 2u));
    noise.point = whiteNoise2(sampleSeed, 3u);
    return noise;
}

// The texel at noiseTexel's address, with white bits below its 16.
KX_INLINE PixelNoise bluePixelNoise(uvec4 texel, uvec2 pixel, uint frame, uint seed) {
    uint sampleSeed = pixelSeed(pixel, frame, seed);
    uint white = hashUint(sampleSeed);
    uvec4 values = orientNoise(texel, frame, seed);
    PixelNoise noise;
    noise.numbers = vec3(numberFromNoise16(values.x, white), numberFromNoise16(values.y, white << 8u),
                         whiteNoise1(sampleSeed, 2u));
    noise.point = vec2(numberFromNoise16(values.z, white << 16u), numberFromNoise16(values.w, white << 24u));
    return noise;
}

#endif
