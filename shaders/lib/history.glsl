// How histories are written and read. They hold exposed values in half floats: written with stochastic rounding
// (a slow average would otherwise stop half a step away from its goal), read back through one function that
// rescales them when the exposure has changed.
#ifndef KILOLUX_LIB_HISTORY_GLSL
#define KILOLUX_LIB_HISTORY_GLSL
#include "filtered_light.glsl"
#include "../math/hash.glsl"
#include "frame.glsl"

// A texel of a light history: light in today's exposure, and the number of frames that it holds.
vec4 readHistory(vec4 texel) {
    return vec4(min(texel.rgb * frame.exposureRatio, vec3(kHalfMax)), texel.a);
}

// Means and deviations of luminance scale like light.
vec4 readMomentHistory(vec4 texel) {
    return min(texel * frame.exposureRatio, vec4(kHalfMax));
}

// Up or down to a neighbouring half float, by chance, so that the mean stays. Halves have 13 bits less.
float roundedToHalf(float value, uint bits) {
    return uintBitsToFloat((floatBitsToUint(value) + (bits & 0x1fffu)) & ~0x1fffu);
}

vec3 roundedToHalf(vec3 light, uint seed) {
    uint other = hashUint(seed ^ 0x7ac1u);
    return vec3(roundedToHalf(light.x, seed), roundedToHalf(light.y, seed >> 16u), roundedToHalf(light.z, other));
}

#endif
