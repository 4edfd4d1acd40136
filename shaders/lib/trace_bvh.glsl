// The compute BVH as tracing back end, see trace.glsl.
#ifndef KILOLUX_TRACE_BVH_GLSL
#define KILOLUX_TRACE_BVH_GLSL

uniform usamplerBuffer traceNodes; // R32G32B32A32_UINT: BvhNode

uvec4 fetchNode(uint texel) {
    return texelFetch(traceNodes, int(texel));
}

#include "trace_core.glsl"

bool occluded(Ray ray) {
    return occludedByBvh(ray);
}

Hit nearest(Ray ray) {
    return nearestInBvh(ray);
}

#endif
