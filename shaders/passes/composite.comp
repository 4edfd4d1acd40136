#version 460
// Light times material plus emission: the picture before transparent surfaces, exposed.
#include "lib/dispatch.glsl"
#include "lib/gbuffer.glsl"

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
    vec3 color = texelFetch(gEmissive, at, 0).rgb + diffuseAlbedo(surface) * texelFetch(litDiffuse, at, 0).rgb +
                 texelFetch(litSpecular, at, 0).rgb;
    imageStore(sceneColorOut, at, vec4(color, 1.0));
}
