// White noise by counter: the PCG output permutation as an integer hash (Jarzynski and Olano, "Hash Functions
// for GPU Rendering", JCGT 2020, section 4). No state: the same words give the same number on every device.
#ifndef KILOLUX_MATH_HASH_GLSL
#define KILOLUX_MATH_HASH_GLSL
#include "prelude.glsl"

KX_INLINE uint hashUint(uint value) {
    uint state = value * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

KX_INLINE uint hashCombine(uint seed, uint value) {
    return hashUint(seed ^ (value * 2654435769u + 0x9e3779b9u + (seed << 6u) + (seed >> 2u)));
}

// Uniform in [0, 1): the top 24 bits, which a float holds exactly.
KX_INLINE float unitFloat(uint bits) {
    return float(bits >> 8u) * (1.0 / 16777216.0);
}

// The `dimension`-th uniform number of a pixel's sample; `sampleSeed` is unique per pixel, frame and seed.
KX_INLINE float whiteNoise1(uint sampleSeed, uint dimension) {
    return unitFloat(hashCombine(sampleSeed, dimension));
}

KX_INLINE vec2 whiteNoise2(uint sampleSeed, uint dimension) {
    uint first = hashCombine(sampleSeed, dimension);
    return vec2(unitFloat(first), unitFloat(hashUint(first ^ 0x68bc21ebu)));
}

KX_INLINE uint pixelSeed(uvec2 pixel, uint frame, uint seed) {
    return hashCombine(hashCombine(hashCombine(hashUint(seed), frame), pixel.x), pixel.y);
}

#endif
