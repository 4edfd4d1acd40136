// Maps from the unit square that preserve area and are continuous, with their inverses, so that a mask or a
// blue-noise pattern over the square keeps its properties on the light (mission G3).
#ifndef KILOLUX_MATH_WARP_GLSL
#define KILOLUX_MATH_WARP_GLSL
#include "prelude.glsl"

// Square -> unit disk, concentric (Shirley and Chiu, "A Low Distortion Map Between Disk and Square", 1997).
KX_INLINE vec2 diskFromSquare(vec2 uv) {
    float x = 2.0 * uv.x - 1.0;
    float y = 2.0 * uv.y - 1.0;
    if (abs(x) > abs(y)) {
        float phi = (KX_PI / 4.0) * (y / x);
        return vec2(x * cos(phi), x * sin(phi));
    }
    if (y == 0.0) return vec2(0.0);
    float phi = (KX_PI / 4.0) * (x / y);
    return vec2(y * sin(phi), y * cos(phi));
}

KX_INLINE vec2 squareFromDisk(vec2 p) {
    float radius = length(p);
    vec2 xy = vec2(0.0);
    if (abs(p.x) > abs(p.y)) {
        float side = p.x >= 0.0 ? radius : -radius;
        xy = vec2(side, side * atan(p.y / p.x) * (4.0 / KX_PI));
    } else if (p.y != 0.0) {
        float side = p.y >= 0.0 ? radius : -radius;
        xy = vec2(side * atan(p.x / p.y) * (4.0 / KX_PI), side);
    }
    return clamp(xy * 0.5 + vec2(0.5), vec2(0.0), vec2(1.0));
}

// Square -> unit sphere, by Archimedes' cylinder: u turns about +z from +x, v runs from +z to -z.
KX_INLINE vec3 sphereFromSquare(vec2 uv) {
    float z = 1.0 - 2.0 * uv.y;
    float ring = 2.0 * sqrt(max(uv.y * (1.0 - uv.y), 0.0));
    float phi = KX_TWO_PI * uv.x;
    return vec3(ring * cos(phi), ring * sin(phi), z);
}

// The turn in [0, 1) of a plane vector from +x; (0, 0) gives 0.
KX_INLINE float turnFromPlane(float x, float y) {
    if (x == 0.0 && y == 0.0) return 0.0;
    float turn = atan(y, x) * (1.0 / KX_TWO_PI);
    turn = turn < 0.0 ? turn + 1.0 : turn;
    return turn >= 1.0 ? 0.0 : turn;
}

KX_INLINE vec2 squareFromSphere(vec3 dir) {
    return vec2(turnFromPlane(dir.x, dir.y), saturate(0.5 - 0.5 * dir.z));
}

// Square -> cosine-weighted hemisphere about +z, pdf = z / pi.
KX_INLINE vec3 cosineHemisphereFromSquare(vec2 uv) {
    vec2 p = diskFromSquare(uv);
    return vec3(p.x, p.y, sqrt(max(1.0 - dot(p, p), 0.0)));
}

#endif
