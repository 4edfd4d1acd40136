#version 460
// Light times material plus emission: the picture before transparent surfaces, exposed. Where light was filtered and
// the mean of the frames needs it as it was sampled, both pictures come from one look at the material.
#include "lib/dispatch.glsl"
#include "shared/features.h"
#include "lib/environment_brdf_table.glsl"
#include "lib/gbuffer.glsl"

layout(constant_id = CHOICE_DEMODULATED) const bool kDemodulated = false;

layout(local_size_x = 8, local_size_y = 8) in;
uniform usampler2D gSurface;
uniform usampler2D gMaterial;
uniform sampler2D gEmissive;
uniform sampler2D litDiffuse;
uniform sampler2D litSpecular;
uniform sampler2D rawDiffuse;
uniform sampler2D rawSpecular;
layout(rgba32f) writeonly uniform image2D sceneColorOut;
layout(rgba32f) writeonly uniform image2D rawColorOut; // a dummy where there is one picture

void main() {
    uvec2 pixel = streamedPixel();
    if (!isInPicture(pixel)) return;
    ivec2 at = ivec2(pixel);
    Surface surface = unpackSurface(texelFetch(gSurface, at, 0), texelFetch(gMaterial, at, 0).x);
    vec3 environment = kDemodulated ? environmentBrdfAt(surface, pixel) : vec3(1.0);
    vec3 emissive = texelFetch(gEmissive, at, 0).rgb, albedo = diffuseAlbedo(surface);
    vec3 color = emissive + albedo * texelFetch(litDiffuse, at, 0).rgb + environment * texelFetch(litSpecular, at, 0).rgb;
    imageStore(sceneColorOut, at, vec4(color, 1.0));
    if (any(greaterThanEqual(at, imageSize(rawColorOut)))) return;
    color = emissive + albedo * texelFetch(rawDiffuse, at, 0).rgb + environment * texelFetch(rawSpecular, at, 0).rgb;
    imageStore(rawColorOut, at, vec4(color, 1.0));
}
