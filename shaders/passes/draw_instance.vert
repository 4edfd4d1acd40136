#version 460
// Draws instances: one draw each, gl_InstanceIndex is its id; vertices are pulled from the texel buffer that the
// tracing and shading passes read too.
#include "lib/frame.glsl"
#include "lib/geometry.glsl"

layout(location = 0) flat out uint instanceId;

void main() {
    instanceId = uint(gl_InstanceIndex);
    GpuInstance instance = instances[instanceId];
    vec3 positionWs = transformPoint(instance, vertexPosition(uint(gl_VertexIndex)));
    gl_Position = frame.clipFromWorld * vec4(positionWs, 1.0);
}
