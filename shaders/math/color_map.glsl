// Colour maps of the debug views: perceptual for amounts, categorical for ids; never a rainbow. Output is sRGB.
#ifndef KILOLUX_MATH_COLOR_MAP_GLSL
#define KILOLUX_MATH_COLOR_MAP_GLSL
#include "hash.glsl"
#include "prelude.glsl"

// Dark violet over blue-green to yellow with evenly rising lightness (the look of viridis: five of its colours,
// joined linearly). t in 0..1.
KX_INLINE vec3 amountColor(float t) {
    float x = saturate(t) * 4.0;
    vec3 color = mix(vec3(0.267, 0.005, 0.329), vec3(0.231, 0.318, 0.545), saturate(x));
    color = mix(color, vec3(0.128, 0.567, 0.551), saturate(x - 1.0));
    color = mix(color, vec3(0.369, 0.789, 0.383), saturate(x - 2.0));
    return mix(color, vec3(0.993, 0.906, 0.144), saturate(x - 3.0));
}

// Blue over light grey to red with like lightness on both sides: less, equal, more. t in -1..1.
KX_INLINE vec3 signedColor(float t) {
    float x = clamp(t, -1.0, 1.0);
    vec3 grey = vec3(0.865, 0.865, 0.865);
    return mix(grey, x < 0.0 ? vec3(0.120, 0.250, 0.640) : vec3(0.706, 0.080, 0.120), abs(x));
}

// What has no place on a scale.
const vec3 KX_CLIPPED_COLOR = vec3(0.92, 0.16, 0.12);
const vec3 KX_CRUSHED_COLOR = vec3(0.16, 0.30, 0.75);
const vec3 KX_NO_RAY_COLOR = vec3(0.0, 0.1, 0.4);
const vec3 KX_OVERFLOW_COLOR = vec3(1.0, 1.0, 1.0);

// A colour per id, of like lightness, neighbours unlike.
KX_INLINE vec3 idColor(uint id) {
    uint h = hashUint(id + 1u);
    vec3 color = vec3(unitFloat(h), unitFloat(hashUint(h)), unitFloat(hashUint(h ^ 77u)));
    return mix(vec3(0.25), vec3(0.9), color);
}

#endif
