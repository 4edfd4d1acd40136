#version 460
// Writes which triangle is seen: instance and primitive. Alpha-tested instances ask the tracer's own test.
#include "shared/features.h"
#include "lib/frame.glsl"
#include "lib/geometry.glsl"
#include "lib/alpha.glsl"

layout(constant_id = FEATURE_ALPHA_MASK) const bool kAlphaMask = true;

layout(location = 0) flat in uint instanceId;
layout(location = 0) out uvec2 outVisibility;

void main() {
    if (kAlphaMask && (instances[instanceId].flags & INSTANCE_ALPHA_TESTED) != 0u) {
        CameraRay ray = cameraRay(gl_FragCoord.xy);
        GpuInstance instance = instances[instanceId];
        TrianglePositions t = trianglePositions(instance, triangleVertices(instance, uint(gl_PrimitiveID)));
        if (!alphaPasses(instanceId, uint(gl_PrimitiveID), planeBarycentrics(t, ray.originWs, ray.dir))) discard;
    }
    outVisibility = uvec2(instanceId, uint(gl_PrimitiveID));
}
