#version 460
// Adds what a transparent surface emits itself.
#include "shared/features.h"
#include "lib/transparent.glsl"

layout(location = 0) flat in uint instanceId;
layout(location = 0) out vec4 outEmission;

void main() {
    SurfaceHit hit = transparentSurface(instanceId);
    outEmission = vec4(hit.emissiveNit * frame.exposure, 1.0);
}
