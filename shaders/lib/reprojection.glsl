// Where a pixel was in the previous frame. `motion` (RGBA16F): uv offset to the previous position and the linear
// depth that its surface had there; exactly 0 for what stands still. Histories are addressed by uv over the
// sub-rectangle that their frame rendered, so a change of the internal resolution keeps them.
#ifndef KILOLUX_LIB_REPROJECTION_GLSL
#define KILOLUX_LIB_REPROJECTION_GLSL
#include "frame.glsl"

uniform sampler2D motion;

struct Reprojection {
    vec2 uv;       // in the previous frame; may lie outside
    float depthM;  // that the surface had there
    bool onScreen; // inside the previous picture, and there was one
};

Reprojection reproject(uvec2 pixel) {
    vec3 moved = texelFetch(motion, ivec2(pixel), 0).xyz;
    Reprojection r;
    r.uv = (vec2(pixel) + 0.5) / vec2(frame.size) + moved.xy;
    r.depthM = moved.z;
    r.onScreen = frame.historyValid != 0u && all(greaterThanEqual(r.uv, vec2(0.0))) && all(lessThan(r.uv, vec2(1.0)));
    return r;
}

// By which share depth may differ within one surface over so many pixels: more where the surface is seen at a slant
// (`cosView`: of its geometric normal and the view).
float depthTolerance(float cosView, float px) {
    return frame.denoising.depthTolerance + px * frame.pixelAngleRad / max(cosView, 0.02);
}

// Whether a depth found in the previous frame is the same surface.
bool sameDepth(float foundM, float expectedM, float cosView) {
    return abs(foundM - expectedM) <= depthTolerance(cosView, 2.0) * expectedM;
}

#endif
