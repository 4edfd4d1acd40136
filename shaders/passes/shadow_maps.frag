#version 460
// Depth of what casts a light's shadow: nothing inside its source or within its ray end bias, and of alpha-tested
// instances what the tracer's own test lets stand.
#include "shared/features.h"
#include "lib/geometry.glsl"
#include "lib/alpha.glsl"
#include "shared/shadow_map.h"

layout(constant_id = FEATURE_ALPHA_MASK) const bool kAlphaMask = true;

layout(scalar) readonly buffer ShadowMaps {
    ShadowMap shadowMaps[];
};
layout(location = 0) flat in uint instanceId;
layout(location = 1) flat in uint mapOfFace;
layout(location = 2) in vec3 positionWs;

// The part of `to` that lies within a half extent of the source.
vec3 alongSource(vec3 to, vec3 halfWs) {
    return clamp(dot(to, halfWs) / max(dot(halfWs, halfWs), 1.0e-20), -1.0, 1.0) * halfWs;
}

bool isAtSource(ShadowMap map) {
    if (map.directional != 0u) return false;
    vec3 to = positionWs - map.centerWs;
    vec3 nearest = alongSource(to, map.sourceXWs) + alongSource(to, map.sourceYWs);
    return length(to - nearest) - map.sourceRadiusM < map.endBiasM;
}

void main() {
    if (isAtSource(shadowMaps[mapOfFace])) discard;
    if (kAlphaMask && (instances[instanceId].flags & INSTANCE_ALPHA_TESTED) != 0u) {
        GpuInstance instance = instances[instanceId];
        TrianglePositions t = trianglePositions(instance, triangleVertices(instance, uint(gl_PrimitiveID)));
        vec3 across = cross(t.b - t.a, t.c - t.a);
        if (!alphaPasses(instanceId, uint(gl_PrimitiveID), planeBarycentrics(t, positionWs, across))) discard;
    }
}
