#version 460
// Draws instances into one face of a light's shadow map; see shared/shadow_map.h. A mesh that does not cast the
// light's shadow falls outside.
#include "lib/geometry.glsl"
#include "shared/shadow_map.h"

layout(push_constant) uniform Push {
    ShadowFacePush face;
};
layout(scalar) readonly buffer ShadowMaps {
    ShadowMap shadowMaps[];
};

layout(location = 0) flat out uint instanceId;
layout(location = 1) flat out uint mapOfFace;
layout(location = 2) out vec3 positionWs;

void main() {
    instanceId = uint(gl_InstanceIndex);
    mapOfFace = face.map;
    GpuInstance instance = instances[instanceId];
    positionWs = transformPoint(instance, vertexPosition(uint(gl_VertexIndex)));
    uint wanted = shadowMaps[face.map].shadowChannels;
    bool casts = wanted == CHANNELS_ALL || (instance.flags >> INSTANCE_CHANNELS_SHIFT & wanted) != 0u;
    gl_Position = casts ? face.clipFromWorld * vec4(positionWs, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}
