#version 460
// Temporal anti-aliasing: jittered frames averaged where they belong (Karis, "High Quality Temporal Supersampling",
// SIGGRAPH 2014), history clipped to the variance of the 3 x 3 neighbourhood in YCoCg (Salvi, GDC 2016) or, where
// that is more, to the variance that the pixel itself has shown over the last frames: a lamp's edge that jitter
// meets in one frame of ten is in no box of the other nine, and clipping would take it away. Only what stands still
// has such a past: behind what moves, it would keep ghosts. What something hid before, in a picture that moves, begins
// anew: clipping alone smears bars that pass over all that is patterned or noisy behind them. And where the denoiser,
// which tells change from noise, holds all the frames that it may, light did not change: boxes are wide there. Each clip
// costs energy, as it takes what is rare and bright more often than what is dark.
//
// Jitter is drawn from the pixel filter, so frames count alike, and light is averaged as it is: a still picture
// converges to the supersampled one. (Weights by tone mapping would darken the rims of lamps.)
#include "shared/features.h"
#include "lib/dispatch.glsl"
#include "lib/gbuffer.glsl"
#include "lib/history.glsl"
#include "lib/reprojection.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D gDepth;
uniform usampler2D gSurface;
uniform usampler2D previousSurface;
uniform sampler2D sceneColor;
uniform sampler2D litSpecular; // a: frames that history may hold, HISTORY_FREE_FRAMES where no light was edited
uniform sampler2D historyDiffuse; // a: frames that the denoiser holds; both are absent without it
uniform sampler2D historySpecular;
uniform sampler2D previousAntiAliased; // filtered linearly
uniform sampler2D previousPixelMoments;
layout(rgba16f) writeonly uniform image2D antiAliasedOut;
layout(rgba16f) writeonly uniform image2D pixelMomentsOut; // of this pixel's light while still: mean, deviation, frames

const float kStillPx = 1.0 / 64.0;
const float kRounding = 1.0 / 512.0; // of the light: several steps of a half float
const float kDepthPx = 4.0; // over which depth may differ within one surface
const float kLeastSure = 0.75; // share of the denoiser's frames from which on it counts

// Catmull-Rom by five bilinear fetches; the corners' weights are small and left out.
vec4 historySharp(vec2 uv) {
    vec2 size = vec2(textureSize(previousAntiAliased, 0));
    vec2 at = uv * vec2(frame.previousSize) - 0.5;
    vec2 corner = floor(at), f = at - corner;
    vec2 w0 = f * (-0.5 + f * (1.0 - 0.5 * f)), w1 = 1.0 + f * f * (-2.5 + 1.5 * f);
    vec2 w2 = f * (0.5 + f * (2.0 - 1.5 * f)), w3 = f * f * (-0.5 + 0.5 * f);
    vec2 w12 = w1 + w2;
    vec2 lowest = vec2(0.5), highest = vec2(frame.previousSize) - 0.5;
    vec2 p0 = clamp(corner - 0.5, lowest, highest) / size, p3 = clamp(corner + 2.5, lowest, highest) / size;
    vec2 p12 = clamp(corner + 0.5 + w2 / w12, lowest, highest) / size;
    vec4 sum = textureLod(previousAntiAliased, p12, 0.0) * (w12.x * w12.y);
    float weight = w12.x * w12.y;
    sum += textureLod(previousAntiAliased, vec2(p0.x, p12.y), 0.0) * (w0.x * w12.y);
    sum += textureLod(previousAntiAliased, vec2(p3.x, p12.y), 0.0) * (w3.x * w12.y);
    sum += textureLod(previousAntiAliased, vec2(p12.x, p0.y), 0.0) * (w12.x * w0.y);
    sum += textureLod(previousAntiAliased, vec2(p12.x, p3.y), 0.0) * (w12.x * w3.y);
    weight += (w0.x + w3.x) * w12.y + w12.x * (w0.y + w3.y);
    return max(sum / weight, vec4(0.0));
}

// 1 where the denoiser's histories are as long as they get.
float denoiserSure(ivec2 at) {
    if (textureSize(historyDiffuse, 0) != textureSize(gDepth, 0)) return 0.0;
    float diffuse = texelFetch(historyDiffuse, at, 0).a / frame.denoising.diffuseFrames;
    float specular = texelFetch(historySpecular, at, 0).a / frame.denoising.specularFrames;
    return smoothstep(kLeastSure, 1.0, min(diffuse, specular));
}

// Whether something stood in front of the surface that the neighbourhood of `nearest` shows, around the place where
// that was in the previous frame: history is what stood in front, and clipping leaves of it what its box allows.
bool wasHidden(ivec2 nearest, Reprojection r, vec2 foundPx) {
    uvec4 surface = texelFetch(gSurface, nearest, 0);
    bool sky = surfaceDepthM(surface) >= DEPTH_SKY;
    float cosView = sky ? 1.0 : abs(dot(surfaceGeoNormalWs(surface), normalize(cameraRay(uvec2(nearest)).dir)));
    float leastM = r.depthM * (1.0 - min(depthTolerance(cosView, kDepthPx), 0.9));
    ivec2 centre = ivec2(floor(foundPx + 0.5));
    for (int i = 0; i < 5; ++i) {
        ivec2 offset = i == 4 ? ivec2(0) : 2 * ivec2(i & 1, i >> 1) - 1;
        ivec2 there = clamp(centre + offset, ivec2(0), ivec2(frame.previousSize) - 1);
        if (surfaceDepthM(texelFetch(previousSurface, there, 0)) < leastM) return true;
    }
    return false;
}

void main() {
    uvec2 pixel = streamedPixel();
    if (!isInPicture(pixel)) return;
    ivec2 at = ivec2(pixel);
    DenoisingConstants how = frame.denoising;
    vec3 color = storableLight(texelFetch(sceneColor, at, 0).rgb), now = yCoCgFromRgb(color);
    // The nearest surface of the neighbourhood says where to look: edges move with what is in front.
    vec3 mean = vec3(0.0), square = vec3(0.0);
    float nearestM = DEPTH_SKY;
    ivec2 nearest = at;
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            ivec2 other = clamp(at + ivec2(x, y), ivec2(0), ivec2(frame.size) - 1);
            vec3 c = yCoCgFromRgb(storableLight(texelFetch(sceneColor, other, 0).rgb));
            mean += c;
            square += c * c;
            float depthM = texelFetch(gDepth, other, 0).x;
            if (depthM < nearestM) {
                nearestM = depthM;
                nearest = other;
            }
        }
    }
    mean /= 9.0;
    vec3 spread = sqrt(max(square / 9.0 - mean * mean, vec3(0.0)));

    Reprojection r = reproject(uvec2(nearest));
    r.uv += (vec2(pixel) - vec2(nearest)) / vec2(frame.size);
    float frames = 1.0;
    vec3 moments = vec3(now.x, 0.0, 0.0);
    if (r.onScreen && all(greaterThanEqual(r.uv, vec2(0.0))) && all(lessThan(r.uv, vec2(1.0)))) {
        vec2 foundPx = r.uv * vec2(frame.previousSize) - 0.5;
        vec2 movedPx = abs(foundPx - vec2(pixel));
        bool still = max(movedPx.x, movedPx.y) < kStillPx;
        vec4 history = readHistory(still ? texelFetch(previousAntiAliased, at, 0) : historySharp(r.uv));
        vec4 texel = texelFetch(previousPixelMoments, at, 0);
        // Where a light was just edited the past says nothing of the present, and half of what the denoiser may keep
        // is kept here: the two follow each other.
        float allowed = texelFetch(litSpecular, at, 0).a;
        bool edited = allowed < HISTORY_FREE_FRAMES;
        if (still && !edited) moments = vec3(readMomentHistory(texel).xy, texel.z);
        vec3 before = yCoCgFromRgb(history.rgb);
        vec3 hue = abs(before) / max(before.x, 1.0e-6);
        float clip = how.antiAliasClip * (still && !edited ? mix(1.0, how.antiAliasSureClip, denoiserSure(at)) : 1.0);
        // The box holds the present colour as well: what is small and bright stands outside its neighbours' spread.
        vec3 extent = max(clip * max(spread, moments.y * hue), abs(now - mean));
        // Towards the middle of the box until inside, which keeps the hue better than clamping by component.
        // The rounding of what is stored is no change either: without a floor a grey pixel's hue would clip it.
        vec3 off = abs(before - mean) / max(extent, vec3(kRounding * before.x + 1.0e-5));
        float farthest = max(off.x, max(off.y, off.z));
        vec3 clipped = farthest > 1.0 ? mean + (before - mean) / farthest : before;
        float confidence = saturate(1.0 - length((clipped - before) / max(extent, vec3(how.antiAliasExtent))));
        float most = still ? how.antiAliasFrames : min(how.antiAliasFrames, how.antiAliasMovingFrames);
        if (!still && wasHidden(nearest, r, foundPx)) most = 1.0;
        if (edited) most = min(most, max(0.5 * allowed, 1.0));
        frames = min(history.a + 1.0, mix(min(how.antiAliasLeastFrames, most), most, confidence));
        if (still) {
            float count = min(moments.z + 1.0, how.antiAliasMomentFrames);
            float share = 1.0 / count, change = now.x - moments.x;
            float variance = (1.0 - share) * (moments.y * moments.y + share * change * change);
            moments = vec3(moments.x + share * change, sqrt(variance), count);
        }
        now = mix(clipped, now, 1.0 / frames);
    }
    vec3 result = roundedToHalf(storableLight(rgbFromYCoCg(now)), pixelSeed(pixel, frame.frame, frame.seed ^ 0xaau));
    imageStore(antiAliasedOut, at, vec4(result, frames));
    imageStore(pixelMomentsOut, at, vec4(storableLight(moments), 0.0));
}
