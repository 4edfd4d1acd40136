// alphaPasses(instance, primitive, barycentrics) with its bindings: for raster passes that need no tracing, and
// for both tracing back ends.
#ifndef KILOLUX_ALPHA_GLSL
#define KILOLUX_ALPHA_GLSL
#include "../math/prelude.glsl"
#include "../shared/bvh.h"

uniform usamplerBuffer traceInstances; // R32G32_UINT: TraceInstance
uniform samplerBuffer alphaTexels;     // R8_UNORM
uniform usamplerBuffer alphaRecords;   // R32G32B32A32_UINT: AlphaRecord
uniform usamplerBuffer alphaTriangles; // R32G32B32A32_UINT: AlphaTriangle

uvec2 fetchTraceInstance(uint instance) {
    return texelFetch(traceInstances, int(instance)).xy;
}
float fetchAlphaTexel(uint texel) {
    return texelFetch(alphaTexels, int(texel)).x;
}
uvec4 fetchAlphaRecord(uint texel) {
    return texelFetch(alphaRecords, int(texel));
}
uvec4 fetchAlphaTriangle(uint texel) {
    return texelFetch(alphaTriangles, int(texel));
}

#include "alpha_core.glsl"

#endif
