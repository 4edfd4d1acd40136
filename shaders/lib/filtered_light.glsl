// The YCoCg space in which history is clipped (Karis, "High Quality Temporal Supersampling", SIGGRAPH
// 2014: boxes along its axes are tighter than in RGB), and what keeps colours fit for half floats.
#ifndef KILOLUX_LIB_FILTERED_LIGHT_GLSL
#define KILOLUX_LIB_FILTERED_LIGHT_GLSL
#include "../math/color.glsl"

const float kHalfMax = 65504.0;

vec3 yCoCgFromRgb(vec3 c) {
    return vec3(0.25 * (c.x + c.z) + 0.5 * c.y, 0.5 * (c.x - c.z), 0.5 * c.y - 0.25 * (c.x + c.z));
}

vec3 rgbFromYCoCg(vec3 c) {
    return vec3(c.x + c.y - c.z, c.x + c.z, c.x - c.y - c.z);
}

// False for NaN, too. A sum of what is not negative is finite where all of it is.
bool isFiniteLight(vec3 c) {
    float sum = abs(c.x) + abs(c.y) + abs(c.z);
    return sum < 3.0e38;
}

// What may enter a history: NaN and infinity become 0, the rest is brought into the range of half floats.
vec3 storableLight(vec3 c) {
    return isFiniteLight(c) ? clamp(c, vec3(0.0), vec3(kHalfMax)) : vec3(0.0);
}

#endif
