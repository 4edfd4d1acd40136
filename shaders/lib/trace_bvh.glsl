// The compute BVH as tracing back end, see trace.glsl.
#ifndef KILOLUX_TRACE_BVH_GLSL
#define KILOLUX_TRACE_BVH_GLSL

uniform usamplerBuffer traceNodes; // R32G32B32A32_UINT: BvhNode

uvec4 fetchNode(uint texel) {
    return texelFetch(traceNodes, int(texel));
}

// traceEntries[0] again: where every ray starts, at a scalar load's cost.
layout(scalar) uniform TraceWorld { BvhEntry traceWorld; };

BvhEntry worldEntry() {
    return traceWorld;
}

#include "trace_core.glsl"

bool occluded(Ray ray) {
    return occludedByBvh(ray);
}

Hit nearest(Ray ray) {
    return nearestInBvh(ray);
}

#endif
