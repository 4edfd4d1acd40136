#version 460
// Spatial filter of what the temporal one left noisy (the MegaLights talk, SIGGRAPH 2025, "Spatial Filter"): one
// sparse disk of taps, turned per pixel and frame; depth, normal and deviation stop it at edges (Schied et al.,
// "Spatiotemporal Variance-Guided Filtering", 2017, section 4.4). Its result is shown and never fed back.
//
// Every weight is the same seen from either of its two pixels, and taps pull the pixel towards them rather than
// being normalized: what one pixel gives away another one gets, so energy stays. Histories of up to 4 frames take
// more taps; those of the very first are the exception to the rest: sums in tone-mapped space, which darkens
// (Karis, "Tone Mapping", 2013) and ends by and by. Deviation stops taps from the first frame on: it is that of
// the neighbourhood then, and without it light would spread over the edges of shadows by the whole radius.
#include "shared/features.h"
#include "lib/dispatch.glsl"
#include "lib/gbuffer.glsl"
#include "lib/filtered_light.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform usampler2D gSurface;
uniform sampler2D historyDiffuse;
uniform sampler2D historySpecular;
uniform sampler2D historyMoments;
layout(rgba16f) writeonly uniform image2D denoisedDiffuseOut;
layout(rgba16f) writeonly uniform image2D denoisedSpecularOut;

const float kSqueezedFrames = 0.65; // of the first frames, whose sums are tone-mapped in full,
const float kUnsqueezed = 1.75;     // and the shortest history after an edit: from there on none is
const float kDarkest = 1.0e-3;   // of display white: noise below is not seen
const mat2 kGoldenTurn = mat2(-0.73736888, 0.67549029, -0.67549029, -0.73736888); // the golden angle
const float kRoughLobe = 0.4;    // roughness from which on specular light takes the whole radius

struct Place {
    vec3 positionWs;
    vec3 normalWs;
    vec3 geoNormalWs;
    float depthM;
    float roughness;
};

bool loadPlace(ivec2 at, out Place place) {
    uvec4 texel = texelFetch(gSurface, at, 0);
    place.depthM = surfaceDepthM(texel);
    if (place.depthM >= DEPTH_SKY) return false;
    CameraRay camera = cameraRay(uvec2(at));
    place.positionWs = camera.originWs + camera.dir * place.depthM;
    place.normalWs = surfaceNormalWs(texel);
    place.geoNormalWs = surfaceGeoNormalWs(texel);
    place.roughness = surfaceRoughnessClass(texel);
    return true;
}

// One signal at one pixel.
struct Signal {
    vec3 rgb;
    float y;     // mean luminance of the neighbourhood: a pixel's own would stop at its noise
    float error; // standard error of the pixel's luminance
    float need;
    float isNew;   // 1: the first frame of a history, 0 from spatialNewFrames on
    float squeeze; // how far sums are tone-mapped: not where an edit shortened a history, as that would darken it
};

// `moments`: mean and standard deviation of luminance around the pixel and over time.
Signal makeSignal(vec4 light, vec2 moments) {
    Signal s;
    s.rgb = light.rgb;
    s.y = moments.x;
    float newFrames = frame.denoising.spatialNewFrames;
    s.isNew = saturate((newFrames - light.a) / (newFrames - 1.0));
    s.squeeze = saturate((kUnsqueezed - light.a) / (kUnsqueezed - kSqueezedFrames));
    // An exponential mean over n frames has the error of 2 n - 1 independent ones.
    s.error = moments.y * inversesqrt(max(2.0 * light.a - 1.0, 1.0));
    float relative = s.error / (s.y + kDarkest);
    float threshold = frame.denoising.spatialThreshold;
    s.need = max(smoothstep(threshold, 2.0 * threshold, relative), s.isNew);
    return s;
}

// The same for both orders of its arguments.
float mixWeight(Signal a, Signal b) {
    float error = sqrt(a.error * a.error + b.error * b.error);
    float apart = abs(a.y - b.y) / (frame.denoising.spatialDeviations * error + 1.0e-5);
    return min(a.need, b.need) / (1.0 + apart * apart);
}

vec3 compressed(vec3 rgb, float amount) {
    return rgb / (1.0 + amount * luminance(rgb));
}

vec3 expanded(vec3 rgb, float amount) {
    return rgb / max(1.0 - amount * luminance(rgb), 1.0e-3);
}

// How well two places mix: on one another's plane, facing one way.
float placeWeight(Place a, Place b) {
    vec3 d = b.positionWs - a.positionWs;
    float footprintM = 0.5 * (a.depthM + b.depthM) * max(frame.pixelAngleRad, 1.0e-5);
    float planeM = frame.denoising.spatialPlanePx * footprintM;
    float off = max(abs(dot(a.geoNormalWs, d)), abs(dot(b.geoNormalWs, d))) / planeM;
    float facing = saturate(1.0 - frame.denoising.spatialNormal * (1.0 - dot(a.normalWs, b.normalWs)));
    return saturate(1.5 - off) * facing * facing;
}

// Interleaved gradient noise (Jimenez, "Next Generation Post Processing in Call of Duty", SIGGRAPH 2014): each 3 x 3
// pixels have angles spread evenly, which anti-aliasing then averages. x: angle, y: radius, both of a turn.
vec2 diskTurn(uvec2 pixel) {
    vec2 at = vec2(pixel) + 5.588238 * float(frame.sampling.noiseFrame & 63u);
    float x = fract(52.9829189 * fract(dot(at, vec2(0.06711056, 0.00583715))));
    return vec2(x, fract(x * 7.0 + 0.618034 * float(frame.sampling.noiseFrame & 63u)));
}

void main() {
    uvec2 pixel = streamedPixel();
    if (!isInPicture(pixel)) return;
    ivec2 at = ivec2(pixel);
    vec4 diffuse = texelFetch(historyDiffuse, at, 0), specular = texelFetch(historySpecular, at, 0);
    vec4 moments = texelFetch(historyMoments, at, 0);
    Signal d = makeSignal(diffuse, moments.xy), s = makeSignal(specular, moments.zw);
    Place here;
    if (max(d.need, s.need) > 0.0 && loadPlace(at, here)) {
        float radiusPx = frame.denoising.spatialRadiusPx;
        float isNew = max(d.isNew, s.isNew);
        int taps = int(mix(frame.denoising.spatialTaps, frame.denoising.spatialTapsNew, isNew) + 0.5);
        vec2 turn = diskTurn(pixel);
        float lobe = saturate(here.roughness / kRoughLobe);
        vec3 hereD = compressed(d.rgb, d.squeeze), hereS = compressed(s.rgb, s.squeeze);
        vec3 sumD = hereD, sumS = hereS;
        float share = 1.0 / float(taps + 1);
        vec2 dir = vec2(cos(turn.x * KX_TWO_PI), sin(turn.x * KX_TWO_PI));
        for (int i = 0; i < taps; ++i) {
            float radius = radiusPx * sqrt((float(i) + turn.y) / float(taps));
            vec2 offset = radius * dir;
            dir = kGoldenTurn * dir;
            ivec2 other = ivec2(floor(vec2(at) + 0.5 + offset));
            if (any(lessThan(other, ivec2(0))) || any(greaterThanEqual(other, ivec2(frame.size)))) continue;
            vec4 lightD = texelFetch(historyDiffuse, other, 0);
            Place there;
            if (lightD.a <= 0.0 || !loadPlace(other, there)) continue;
            float w = placeWeight(here, there);
            if (w <= 0.0) continue;
            vec4 momentsThere = texelFetch(historyMoments, other, 0);
            if (d.need > 0.0) {
                Signal dThere = makeSignal(lightD, momentsThere.xy);
                sumD += share * w * mixWeight(d, dThere) * (compressed(dThere.rgb, d.squeeze) - hereD);
            }
            if (s.need <= 0.0) continue;
            // Smooth surfaces show sharp highlights: their taps end sooner.
            float reach = radiusPx * min(lobe, saturate(there.roughness / kRoughLobe));
            float wS = w * saturate(2.0 - 2.0 * radius / max(reach, 1.0e-3));
            if (wS <= 0.0) continue;
            Signal sThere = makeSignal(texelFetch(historySpecular, other, 0), momentsThere.zw);
            sumS += share * wS * mixWeight(s, sThere) * (compressed(sThere.rgb, s.squeeze) - hereS);
        }
        diffuse.rgb = expanded(sumD, d.squeeze);
        specular.rgb = expanded(sumS, s.squeeze);
    }
    imageStore(denoisedDiffuseOut, at, vec4(storableLight(diffuse.rgb), diffuse.a));
    imageStore(denoisedSpecularOut, at, vec4(storableLight(specular.rgb), specular.a));
}
