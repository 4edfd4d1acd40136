// Rays and hits, and how a ray leaves a surface; in the subset that C++ compiles too.
#ifndef KILOLUX_RAY_GLSL
#define KILOLUX_RAY_GLSL
#include "../math/prelude.glsl"
#include "../shared/channels.h"

// Points origin + t * dir for tMinM <= t < tMaxM. `dir` is unit length, so t is metres; tMinM >= 0.
struct Ray {
    vec3 origin; // metres, world minus anchor
    float tMinM;
    vec3 dir;
    float tMaxM;
    uint channels; // CHANNELS_LIMITED + those of the meshes that stop it, or CHANNELS_ALL
};

const uint HIT_NONE = 0xFFFFFFFFu;

struct Hit {
    float tM;
    uint instance;     // HIT_NONE: the ray has met nothing
    uint primitive;    // index of the triangle within the instance's mesh primitive
    vec2 barycentrics; // weights of its second and third corner
    bool backFace;     // seen from behind, by glTF's rule: a mirroring transform turns the winding round
};

KX_INLINE Hit noHit() {
    Hit hit;
    hit.tM = KX_INFINITY;
    hit.instance = HIT_NONE;
    hit.primitive = HIT_NONE;
    hit.barycentrics = vec2(0.0, 0.0);
    hit.backFace = false;
    return hit;
}

KX_INLINE Ray makeRay(vec3 origin, vec3 dir, float tMaxM) {
    Ray ray;
    ray.origin = origin;
    ray.tMinM = 0.0;
    ray.dir = dir;
    ray.tMaxM = tMaxM;
    ray.channels = CHANNELS_ALL;
    return ray;
}

// How far a surface point may be off its surface, metres, when it was interpolated from its triangle's corners by
// barycentrics: a dozen roundings of 2^-24 of its magnitude (Pharr, Jakob and Humphreys, "Physically Based
// Rendering", section 3.9.4). Positions from a ray's t are worse by the triangle's size: interpolate instead.
KX_INLINE float positionErrorM(vec3 position) {
    vec3 size = abs(position);
    return 7.5e-7 * max(size.x, max(size.y, size.z));
}

// The same for a point from a rasterized depth: corners are snapped to 1/256 of a pixel before depth is
// interpolated, which shifts the surface by half of that at most; the depth itself has a dozen roundings.
// `pixelAngleRad`: 2 tan(fovY / 2) / height in pixels.
KX_INLINE float rasterPositionErrorM(vec3 position, float viewDistanceM, float pixelAngleRad) {
    return positionErrorM(position) + viewDistanceM * (pixelAngleRad * (1.0 / 512.0) + 7.5e-7);
}

// The origin of a ray that leaves a surface: moved off it along the geometric normal `ng`, to the side that
// `dir` looks to, by the point's error. Errors of the tracer's own arithmetic are not part of it; the tracer
// knows the sizes of its triangles and bounds them itself (originInPlane in trace_core.glsl).
KX_INLINE vec3 offsetRayOrigin(vec3 position, vec3 ng, vec3 dir, float errorM) {
    // |ng|_1 carries an error of errorM per axis over to the normal (Pharr et al., section 3.9.5).
    float distanceM = errorM * (abs(ng.x) + abs(ng.y) + abs(ng.z));
    return position + ng * (dot(ng, dir) < 0.0 ? -distanceM : distanceM);
}

#endif
