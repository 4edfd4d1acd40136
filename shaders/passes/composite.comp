#version 460
// Light times material plus emission: the picture before transparent surfaces, exposed.
#include "lib/dispatch.glsl"
#include "shared/features.h"
#include "lib/environment_brdf_table.glsl"
#include "lib/gbuffer.glsl"

layout(constant_id = CHOICE_DEMODULATED) const bool kDemodulated = false;

layout(local_size_x = 8, local_size_y = 8) in;
uniform usampler2D gMaterial;
uniform usampler2D gNormals;
uniform sampler2D gEmissive;
uniform sampler2D litDiffuse;
uniform sampler2D litSpecular;
layout(rgba32f) writeonly uniform image2D sceneColorOut;

void main() {
    uvec2 pixel = dispatchedPixel();
    if (!isInPicture(pixel)) return;
    ivec2 at = ivec2(pixel);
    Surface surface = unpackSurface(texelFetch(gNormals, at, 0).xy, texelFetch(gMaterial, at, 0).xy);
    vec3 specular = texelFetch(litSpecular, at, 0).rgb;
    if (kDemodulated) specular *= environmentBrdfAt(surface, pixel);
    vec3 color =
        texelFetch(gEmissive, at, 0).rgb + diffuseAlbedo(surface) * texelFetch(litDiffuse, at, 0).rgb + specular;
    imageStore(sceneColorOut, at, vec4(color, 1.0));
}
