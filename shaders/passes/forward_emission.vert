#version 460
// Transparent instances, drawn over the lit picture; the fragment stages test depth against the G-buffer.
#include "lib/frame.glsl"
#include "lib/geometry.glsl"

layout(location = 0) flat out uint instanceId;

void main() {
    instanceId = uint(gl_InstanceIndex);
    GpuInstance instance = instances[instanceId];
    gl_Position = frame.clipFromWorld * vec4(transformPoint(instance, vertexPosition(uint(gl_VertexIndex))), 1.0);
}
