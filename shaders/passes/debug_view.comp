#version 460
// One view of the frame's targets, in display values; the raw value goes to viewValues for files and probes.
#include "shared/features.h"
#include "shared/views.h"
#include "lib/dispatch.glsl"
#include "lib/environment_brdf_table.glsl"
#include "lib/gbuffer.glsl"
#include "lib/sample.glsl"
#include "lib/visible_list.glsl"
#include "math/color.glsl"
#include "math/false_color.glsl"
#include "math/tone_map.glsl"

layout(constant_id = CHOICE_DEMODULATED) const bool kDemodulated = false;
layout(constant_id = CHOICE_VIEW) const int kView = VIEW_DIFFUSE;
layout(constant_id = CHOICE_TONE_MAP) const int kToneMap = TONE_MAP_NEUTRAL;

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant, scalar) uniform Push {
    ViewConstants scale;
};
uniform usampler2D visibility;
uniform usampler2D gSurface;
uniform usampler2D gMaterial;
uniform sampler2D gEmissive;
uniform sampler2D litDiffuse;
uniform sampler2D litSpecular;
uniform usampler2D lightCounts;
uniform sampler2D pyramid;
uniform usampler2DArray samples;
uniform usampler2DArray rayResults;
uniform usamplerBuffer visibleLists; // this frame's
uniform sampler2D historyDiffuse;
uniform sampler2D historyMoments;
uniform sampler2D denoiseTrace;
uniform sampler2D denoisedDiffuse;
uniform sampler2D denoisedSpecular;
uniform sampler2D picture; // that tone_map shows
layout(rgba8) writeonly uniform image2D displayOut;
layout(rgba32f) writeonly uniform image2D viewValuesOut;

// A value's colour on the view's scale.
vec3 scaleColor(float value) {
    return amountColor(scalePosition(value, scale.low, scale.high));
}

// Half of the scale at scale.low, its end at infinity.
float depthShare(float depthM) {
    return depthM >= DEPTH_SKY ? 1.0 : depthM / (depthM + scale.low);
}

// What false colour measures at a rendered pixel. x: on the scale (stops or decades), y: the number itself.
vec2 measured(ivec2 at) {
    vec3 exposed = texelFetch(picture, at, 0).rgb;
    if (kView == VIEW_STOPS) return vec2(stopsFromGrey(luminance(exposed)));
    if (kView == VIEW_ILLUMINANCE) {
        exposed = scale.denoised != 0u ? texelFetch(denoisedDiffuse, at, 0).rgb : texelFetch(litDiffuse, at, 0).rgb;
        exposed *= KX_PI; // light without albedo is irradiance / pi
    }
    float value = luminance(exposed) / frame.exposure;
    return vec2(decadesOf(value), value);
}

// The band that a pixel and its neighbours lie in on average: noise alone should draw no isolines.
float bandAt(ivec2 at) {
    ivec2 last = ivec2(frame.size) - 1;
    float sum = 0.0;
    for (int i = 0; i < 9; ++i)
        sum += measured(clamp(at + ivec2(i % 3 - 1, i / 3 - 1), ivec2(0), last)).x;
    return kView == VIEW_STOPS ? stopBand(sum / 9.0) : decadeBand(sum / 9.0);
}

// False colour with isolines where the band changes to the right or below.
vec3 showMeasured(uvec2 shownPixel, ivec2 at, out vec3 value) {
    vec2 here = measured(at);
    value = vec3(here.y);
    ivec2 last = ivec2(frame.size) - 1;
    ivec2 right = min(ivec2(renderedFromOutput(shownPixel + uvec2(1u, 0u))), last);
    ivec2 below = min(ivec2(renderedFromOutput(shownPixel + uvec2(0u, 1u))), last);
    float band = bandAt(at);
    bool line = bandAt(right) != band || bandAt(below) != band;
    vec3 color = kView == VIEW_STOPS ? signedColor(2.0 * scalePosition(here.x, scale.low, scale.high) - 1.0) : scaleColor(here.x);
    return line ? color * 0.35 : color;
}

// Grey where the display can show it, red where a channel is clipped, blue where all is black.
vec3 showClipping(ivec2 at, out vec3 value) {
    vec3 color = max(texelFetch(picture, at, 0).rgb, vec3(0.0));
    if (kToneMap == TONE_MAP_NEUTRAL) color = toneMapNeutral(color);
    vec3 level = 255.0 * srgbFromLinear(clamp(color, 0.0, 1.0));
    float most = max(level.x, max(level.y, level.z));
    value = vec3(most >= KX_CLIPPED_LEVEL ? 1.0 : (most <= KX_CRUSHED_LEVEL ? -1.0 : 0.0));
    if (value.x > 0.0) return KX_CLIPPED_COLOR;
    if (value.x < 0.0) return KX_CRUSHED_COLOR;
    return vec3(luminance(level) / 255.0 * 0.8 + 0.1);
}

// Views of the stochastic method's samples and lists; `value` is the raw value.
vec3 showSampling(uvec2 pixel, out vec3 value) {
    float chosen = 0.0, seen = 0.0, hidden = 0.0, rays = 0.0;
    for (uint i = 0u; i < frame.sampling.rays; ++i) {
        StoredSample s = unpackSample(texelFetch(samples, ivec3(pixel, i), 0));
        uint state = texelFetch(rayResults, ivec3(pixel, i), 0).x & RAY_STATE_MASK;
        rays += state == RAY_NONE ? 0.0 : 1.0;
        seen += state == RAY_VISIBLE ? 1.0 : 0.0;
        chosen += s.contribution > 0.0 ? 1.0 : 0.0;
        hidden += s.contribution > 0.0 && s.list == LIST_HIDDEN ? 1.0 : 0.0;
    }
    StoredSample first = unpackSample(texelFetch(samples, ivec3(pixel, 0), 0));
    if (kView == VIEW_CHOSEN_LIGHT) {
        value = vec3(chosen > 0.0 ? float(first.slot) : -1.0);
        return first.contribution > 0.0 ? idColor(first.slot) : vec3(0.0);
    }
    if (kView == VIEW_VISIBILITY) {
        value = vec3(rays > 0.0 ? seen / rays : -1.0);
        return rays > 0.0 ? vec3(value.x) : KX_NO_RAY_COLOR;
    }
    if (kView == VIEW_HIDDEN_SHARE) {
        value = vec3(chosen > 0.0 ? hidden / chosen : 0.0);
        return scaleColor(value.x);
    }
    if (kView == VIEW_SAMPLE_WEIGHT) {
        value = vec3(first.weight);
        return scaleColor(first.weight);
    }
    if (kView == VIEW_REPROJECTION) {
        value = vec3(uvec3(first.flags & SAMPLE_MISSED, first.flags & SAMPLE_RECONSTRUCTED,
                           first.flags & SAMPLE_EDITED)) * vec3(1.0 / float(SAMPLE_MISSED),
                                                                1.0 / float(SAMPLE_RECONSTRUCTED),
                                                                1.0 / float(SAMPLE_EDITED));
        return value;
    }
    uint texel = listTexel(ivec2(pixel / LIST_TILE_PX), frame.tiles);
    uvec2 head = texelFetch(visibleLists, int(texel)).xy & uvec2(0xffffffffu, HEAD_LOST_MASK);
    float ages = 0.0;
    for (uint i = 0u; i < min(head.x, LIST_CAPACITY); ++i)
        ages += float(unpackEntry(texelFetch(visibleLists, int(texel + 1u + i)).x).age);
    value = kView == VIEW_LIST_LENGTH ? vec3(head, 0.0) : vec3(head.x > 0u ? ages / float(head.x) : 0.0);
    if (kView == VIEW_LIST_LENGTH) return head.y > 0u ? KX_OVERFLOW_COLOR : scaleColor(float(head.x));
    return scaleColor(value.x);
}

// The views of the denoiser.
vec3 showFilters(ivec2 at, Surface s, out vec3 value) {
    if (kView == VIEW_HISTORY_LENGTH) {
        value = vec3(texelFetch(historyDiffuse, at, 0).a);
        return scaleColor(value.x);
    }
    if (kView == VIEW_DEVIATION) {
        vec4 moments = texelFetch(historyMoments, at, 0);
        value = vec3(moments.y / max(moments.x, 1.0e-4));
        return scaleColor(value.x);
    }
    if (kView == VIEW_REJECTED_HISTORY) {
        value = 1.0 - texelFetch(denoiseTrace, at, 0).zxy;
        return srgbFromLinear(value);
    }
    value = kView == VIEW_DENOISED_DIFFUSE ? texelFetch(denoisedDiffuse, at, 0).rgb
                                           : texelFetch(denoisedSpecular, at, 0).rgb * environmentBrdfAt(s, uvec2(at));
    vec3 shown = srgbFromLinear(clamp(toneMapNeutral(value), 0.0, 1.0));
    value /= frame.exposure;
    return shown;
}

void main() {
    uvec2 shownPixel = streamedOutputPixel();
    if (!isInOutput(shownPixel)) return;
    uvec2 pixel = min(uvec2(renderedFromOutput(shownPixel)), frame.size - 1u);
    ivec2 at = ivec2(pixel);
    uvec4 surface = texelFetch(gSurface, at, 0);
    float depthM = surfaceDepthM(surface);
    uvec2 ids = texelFetch(visibility, at, 0).xy;
    uint counts = texelFetch(lightCounts, at, 0).x;
    float inRange = float(counts & 0xffffu), seen = float(counts >> 16u);
    Surface s = unpackSurface(surface, texelFetch(gMaterial, at, 0).x);
    vec2 range = textureLod(pyramid, (vec2(pixel) + 0.5) / vec2(textureSize(gSurface, 0)), 2.0).xy;

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
        shown = scaleColor(value.x);
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
        shown = scaleColor(value.x);
    } else if (kView == VIEW_SEEN_SHARE) {
        value = vec3(inRange > 0.0 ? seen / inRange : 0.0);
        shown = scaleColor(value.x);
    }
    if (kView >= VIEW_CHOSEN_LIGHT && kView <= VIEW_REPROJECTION) shown = showSampling(pixel, value);
    if (kView >= VIEW_HISTORY_LENGTH && kView <= VIEW_DENOISED_SPECULAR) shown = showFilters(at, s, value);
    if (kView >= VIEW_LUMINANCE && kView <= VIEW_STOPS) shown = showMeasured(shownPixel, at, value);
    if (kView == VIEW_CLIPPING) shown = showClipping(at, value);
    if (depthM >= DEPTH_SKY) shown = vec3(0.0);
    imageStore(displayOut, ivec2(shownPixel), vec4(shown, 1.0));
    imageStore(viewValuesOut, ivec2(shownPixel), vec4(value, 1.0));
}
