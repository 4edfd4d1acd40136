#version 460
// Light times material plus emission: the picture before transparent surfaces, exposed. Where light was filtered and
// the mean of the frames needs it as it was sampled, both pictures come from one look at the material. Here the picture
// gets what is no direct light, too: the dome behind the scene, and the fill.
#include "lib/dispatch.glsl"
#include "shared/features.h"
#include "lib/environment_brdf_table.glsl"
#include "lib/gbuffer.glsl"
#include "math/panorama.glsl"

layout(constant_id = FEATURE_BACKGROUND) const bool kBackground = true;
layout(constant_id = FEATURE_FILL) const bool kFill = true;
layout(constant_id = CHOICE_DEMODULATED) const bool kDemodulated = false;

layout(local_size_x = 8, local_size_y = 8) in;
uniform usampler2D gSurface;
uniform usampler2D gMaterial;
uniform sampler2D gEmissive;
uniform sampler2D litDiffuse;
uniform sampler2D litSpecular;
uniform sampler2D rawDiffuse;
uniform sampler2D rawSpecular;
uniform sampler2D domeRadiances;
layout(rgba32f) writeonly uniform image2D sceneColorOut;
layout(rgba32f) writeonly uniform image2D rawColorOut; // a dummy where there is one picture

const float kMostLight = 65504.0; // what later passes hold

// What lies behind the scene, exposed.
vec3 backgroundAt(uvec2 pixel) {
    vec3 dir = normalize(cameraRay(pixel).dir);
    vec2 turn = frame.backgroundTurn;
    vec3 dirLs = vec3(dir.x * turn.x - dir.z * turn.y, dir.y, dir.x * turn.y + dir.z * turn.x);
    vec2 uv = panoramaUv(dirLs);
    float halfTexel = 0.5 / float(textureSize(domeRadiances, 0).y);
    vec3 texel = textureLod(domeRadiances, vec2(uv.x, clamp(uv.y, halfTexel, 1.0 - halfTexel)), 0.0).rgb;
    return min(texel * frame.backgroundNit * frame.exposure, vec3(kMostLight));
}

void main() {
    uvec2 pixel = streamedPixel();
    if (!isInPicture(pixel)) return;
    ivec2 at = ivec2(pixel);
    uvec4 texel = texelFetch(gSurface, at, 0);
    if (kBackground && surfaceDepthM(texel) >= DEPTH_SKY) {
        vec4 behind = vec4(backgroundAt(pixel), 1.0);
        imageStore(sceneColorOut, at, behind);
        if (all(lessThan(at, imageSize(rawColorOut)))) imageStore(rawColorOut, at, behind);
        return;
    }
    Surface surface = unpackSurface(texel, texelFetch(gMaterial, at, 0).x);
    vec3 environment = kDemodulated ? environmentBrdfAt(surface, pixel) : vec3(1.0);
    vec3 emissive = texelFetch(gEmissive, at, 0).rgb;
    // Plain ambient light is no direct light: base colour times its luminance, whatever the surface.
    if (kFill) emissive += surface.baseColor * frame.fillNit * frame.exposure;
    vec3 albedo = diffuseAlbedo(surface);
    vec3 color = emissive + albedo * texelFetch(litDiffuse, at, 0).rgb + environment * texelFetch(litSpecular, at, 0).rgb;
    imageStore(sceneColorOut, at, vec4(color, 1.0));
    if (any(greaterThanEqual(at, imageSize(rawColorOut)))) return;
    color = emissive + albedo * texelFetch(rawDiffuse, at, 0).rgb + environment * texelFetch(rawSpecular, at, 0).rgb;
    imageStore(rawColorOut, at, vec4(color, 1.0));
}
