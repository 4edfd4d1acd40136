#version 460
// One view of the frame's targets, in display values; the raw value goes to viewValues for files and probes.
#include "shared/features.h"
#include "shared/views.h"
#include "lib/dispatch.glsl"
#include "lib/environment_brdf_table.glsl"
#include "lib/gbuffer.glsl"
#include "math/color_map.glsl"
#include "math/tone_map.glsl"

layout(constant_id = CHOICE_DEMODULATED) const bool kDemodulated = false;
layout(constant_id = CHOICE_VIEW) const int kView = VIEW_DIFFUSE;

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push {
    float depthScaleM; // linear depth shown in the middle of the scale
};
uniform usampler2D visibility;
uniform sampler2D gDepth;
uniform usampler2D gNormals;
uniform usampler2D gMaterial;
uniform sampler2D gEmissive;
uniform sampler2D litDiffuse;
uniform sampler2D litSpecular;
uniform usampler2D lightCounts;
uniform sampler2D pyramid;
layout(rgba8) writeonly uniform image2D displayOut;
layout(rgba32f) writeonly uniform image2D viewValuesOut;

const float kCountScale = 64.0;

// Half of the scale at depthScaleM, its end at infinity.
float depthShare(float depthM) {
    return depthM >= DEPTH_SKY ? 1.0 : depthM / (depthM + depthScaleM);
}

void main() {
    uvec2 pixel = dispatchedPixel();
    if (!isInPicture(pixel)) return;
    ivec2 at = ivec2(pixel);
    float depthM = texelFetch(gDepth, at, 0).x;
    uvec2 ids = texelFetch(visibility, at, 0).xy;
    uint counts = texelFetch(lightCounts, at, 0).x;
    float inRange = float(counts & 0xffffu), seen = float(counts >> 16u);
    Surface s = unpackSurface(texelFetch(gNormals, at, 0).xy, texelFetch(gMaterial, at, 0).xy);
    vec2 range = textureLod(pyramid, (vec2(pixel) + 0.5) / vec2(textureSize(gDepth, 0)), 2.0).xy;

    vec3 value = vec3(0.0), shown = vec3(0.0);
    if (kView == VIEW_DIFFUSE || kView == VIEW_SPECULAR || kView == VIEW_EMISSIVE) {
        value = kView == VIEW_DIFFUSE    ? texelFetch(litDiffuse, at, 0).rgb
                : kView == VIEW_SPECULAR ? texelFetch(litSpecular, at, 0).rgb
                                         : texelFetch(gEmissive, at, 0).rgb;
        if (kView == VIEW_SPECULAR && kDemodulated) value *= environmentBrdfAt(s, pixel);
        shown = srgbFromLinear(clamp(toneMapNeutral(value), 0.0, 1.0));
        value /= frame.exposure;
    } else if (kView == VIEW_NORMAL || kView == VIEW_GEOMETRIC_NORMAL) {
        value = kView == VIEW_NORMAL ? s.normalWs : s.geoNormalWs;
        shown = value * 0.5 + 0.5;
    } else if (kView == VIEW_BASE_COLOR) {
        value = s.baseColor;
        shown = srgbFromLinear(value);
    } else if (kView == VIEW_ROUGHNESS || kView == VIEW_METALLIC) {
        value = vec3(kView == VIEW_ROUGHNESS ? s.roughness : s.metallic);
        shown = amountColor(value.x);
    } else if (kView == VIEW_DEPTH) {
        value = vec3(depthM);
        shown = amountColor(1.0 - depthShare(depthM));
    } else if (kView == VIEW_DEPTH_RANGE) {
        value = vec3(range, 0.0);
        shown = amountColor(depthShare(range.y) - depthShare(range.x));
    } else if (kView == VIEW_INSTANCE || kView == VIEW_PRIMITIVE) {
        uint id = kView == VIEW_INSTANCE ? ids.x : hashCombine(ids.x, ids.y);
        value = vec3(ids, 0.0);
        shown = idColor(id);
    } else if (kView == VIEW_LIGHTS_IN_RANGE || kView == VIEW_LIGHTS_SEEN) {
        value = vec3(kView == VIEW_LIGHTS_IN_RANGE ? inRange : seen);
        shown = amountColor(value.x / kCountScale);
    } else if (kView == VIEW_SEEN_SHARE) {
        value = vec3(inRange > 0.0 ? seen / inRange : 0.0);
        shown = amountColor(value.x);
    }
    if (depthM >= DEPTH_SKY) shown = vec3(0.0);
    imageStore(displayOut, at, vec4(shown, 1.0));
    imageStore(viewValuesOut, at, vec4(value, 1.0));
}
