// Unit vectors in two numbers: octahedral mapping (Cigolle et al., "Survey of Efficient Representations for
// Independent Unit Vectors", JCGT 2014, section 3).
#ifndef KILOLUX_MATH_PACK_GLSL
#define KILOLUX_MATH_PACK_GLSL
#include "prelude.glsl"

KX_INLINE vec2 octFold(vec2 e) {
    return vec2((1.0 - abs(e.y)) * (e.x >= 0.0 ? 1.0 : -1.0), (1.0 - abs(e.x)) * (e.y >= 0.0 ? 1.0 : -1.0));
}

// Unit direction -> [-1, 1]^2.
KX_INLINE vec2 octFromDirection(vec3 dir) {
    float norm = abs(dir.x) + abs(dir.y) + abs(dir.z);
    vec2 e = vec2(dir.x, dir.y) * (1.0 / norm);
    return dir.z < 0.0 ? octFold(e) : e;
}

// [-1, 1]^2 -> unit direction; any input gives a unit vector.
KX_INLINE vec3 directionFromOct(vec2 e) {
    float z = 1.0 - abs(e.x) - abs(e.y);
    vec2 xy = z < 0.0 ? octFold(e) : e;
    return normalize(vec3(xy.x, xy.y, z));
}

KX_INLINE uint packOct16(vec3 dir) {
    return packSnorm2x16(octFromDirection(dir));
}

KX_INLINE vec3 unpackOct16(uint word) {
    return directionFromOct(vec2(unpackSnorm2x16(word)));
}

#endif
