#version 460
// Multiplies what is behind a transparent surface by what it lets through.
#include "shared/features.h"
#include "lib/transparent.glsl"

layout(location = 0) flat in uint instanceId;
layout(location = 0) out vec4 outTint;

void main() {
    SurfaceHit hit = transparentSurface(instanceId);
    outTint = vec4(transmittance(hit, materials[instances[instanceId].material]), 1.0);
}
