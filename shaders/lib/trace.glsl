// World tracing by the compute BVH, on every device: bool occluded(Ray) and Hit nearest(Ray). The second back
// end, trace_ray_query.glsl, has the same interface; a shader includes one of them.
#ifndef KILOLUX_TRACE_GLSL
#define KILOLUX_TRACE_GLSL
#include "../math/prelude.glsl"
#include "../shared/bvh.h"
#include "../shared/features.h"
#include "alpha.glsl"
#include "ray.glsl"

layout(constant_id = FEATURE_ALPHA_MASK) const bool kTraceAlpha = true;

// Texel buffers, because on CPU drivers they read faster than storage buffers.
uniform usamplerBuffer traceNodes;   // R32G32B32A32_UINT: BvhNode
uniform samplerBuffer tracePairs;    // R32G32B32A32_SFLOAT: BvhPair
uniform usamplerBuffer tracePairIds; // R32G32_UINT
uniform usamplerBuffer traceEntries; // R32G32B32A32_UINT: BvhEntry

uvec4 fetchNode(uint texel) {
    return texelFetch(traceNodes, int(texel));
}
vec4 fetchPair(uint texel) {
    return texelFetch(tracePairs, int(texel));
}
uvec2 fetchPairIds(uint pair) {
    return texelFetch(tracePairIds, int(pair)).xy;
}
uvec4 fetchEntry(uint texel) {
    return texelFetch(traceEntries, int(texel));
}
uint traceInstanceCount() {
    return uint(textureSize(traceInstances));
}

#include "trace_core.glsl"

bool occluded(Ray ray) {
    return occludedByBvh(ray);
}

Hit nearest(Ray ray) {
    return nearestInBvh(ray);
}

#endif
