// Display transforms. 'neutral' is the Khronos PBR Neutral tone mapper (specification of May 2024): base colours
// come through unchanged below 0.8, brighter light is compressed and desaturated.
#ifndef KILOLUX_MATH_TONE_MAP_GLSL
#define KILOLUX_MATH_TONE_MAP_GLSL
#include "prelude.glsl"

KX_INLINE vec3 toneMapNeutral(vec3 color) {
    const float startCompression = 0.8 - 0.04;
    const float desaturation = 0.15;
    float x = min(color.x, min(color.y, color.z));
    float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
    vec3 c = color - vec3(offset);
    float peak = max(c.x, max(c.y, c.z));
    if (peak < startCompression) return c;
    float d = 1.0 - startCompression;
    float newPeak = 1.0 - d * d / (peak + d - startCompression);
    c = c * (newPeak / peak);
    float g = 1.0 - 1.0 / (desaturation * (peak - newPeak) + 1.0);
    return mix(c, vec3(newPeak), g);
}

// The encoding of IEC 61966-2-1, for 0..1.
KX_INLINE float srgbFromLinear1(float x) {
    return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1.0 / 2.4) - 0.055;
}

KX_INLINE vec3 srgbFromLinear(vec3 c) {
    return vec3(srgbFromLinear1(c.x), srgbFromLinear1(c.y), srgbFromLinear1(c.z));
}

#endif
