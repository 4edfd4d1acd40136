// World tracing: bool occluded(Ray) and Hit nearest(Ray). Two back ends with the same answers within ties at
// shared edges: the compute BVH, on every device, and with KX_RAY_QUERY defined VK_KHR_ray_query.
#ifndef KILOLUX_TRACE_GLSL
#define KILOLUX_TRACE_GLSL
#include "../math/prelude.glsl"
#include "../shared/bvh.h"
#include "../shared/features.h"
#include "alpha.glsl"
#include "ray.glsl"

layout(constant_id = FEATURE_ALPHA_MASK) const bool kTraceAlpha = true;
layout(constant_id = FEATURE_CHANNEL_SHADOWS) const bool kTraceChannels = true;

// Texel buffers, because on CPU drivers they read faster than storage buffers.
uniform samplerBuffer tracePairs;    // R32G32B32A32_SFLOAT: BvhPair
uniform usamplerBuffer tracePairIds; // R32G32_UINT
uniform usamplerBuffer traceEntries; // R32G32B32A32_UINT: BvhEntry

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

#include "trace_hit.glsl"
#ifdef KX_RAY_QUERY
#include "trace_ray_query.glsl"
#else
#include "trace_bvh.glsl"
#endif

#endif
