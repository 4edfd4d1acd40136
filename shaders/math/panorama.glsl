// Directions of a latitude-longitude picture, whose middle lies towards -Z and whose first row is +Y.
#ifndef KILOLUX_MATH_PANORAMA_GLSL
#define KILOLUX_MATH_PANORAMA_GLSL
#include "approx.glsl"
#include "warp.glsl"

// `turn` from 0 to 1 along a row, `cosine` of the angle from +Y.
KX_INLINE vec3 panoramaDirection(float turn, float cosine) {
    float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
    float phi = (turn - 0.5) * KX_TWO_PI;
    return vec3(sine * sin(phi), cosine, -sine * cos(phi));
}

// Both as the picture's uv: the turn, and the angle over pi.
KX_INLINE vec2 panoramaUv(vec3 dir) {
    float sine = sqrt(dir.x * dir.x + dir.z * dir.z);
    float turn = turnFromPlane(-dir.z, dir.x) + 0.5;
    return vec2(turn >= 1.0 ? turn - 1.0 : turn, angleFromCosSin(dir.y, sine) * KX_INV_PI);
}

#endif
