// How much of a light a receiver sees, by the light's shadow map: percentage-closer soft shadows (Fernando,
// "Percentage-Closer Soft Shadows", SIGGRAPH 2005 sketches). A search finds how far away what is in between is on
// average, which tells the penumbra's width, and so wide a part of the map is compared with the receiver. The search
// looks along the whole cone between receiver and light, closer together near the receiver, in place of a square on
// the near plane: it counts only what stands in between, and finds contact shadows. Depths are compared on the
// receiver's plane at the texel's centre, so that slopes need no bias. What it gets wrong is the method's own: one map
// from the light's middle sees no sides of a blocker, and all blockers count as one at their mean distance.
#ifndef KILOLUX_LIB_SHADOW_MAP_GLSL
#define KILOLUX_LIB_SHADOW_MAP_GLSL
#include "receiver.glsl"
#include "../math/basis.glsl"
#include "../math/hash.glsl"
#include "../math/warp.glsl"
#include "../shared/shadow_map.h"

uniform sampler2D shadowDepths;
layout(scalar) readonly buffer ShadowMaps {
    ShadowMap shadowMaps[];
};

// A texel's line of sight: from `originWs` along `dirWs`, whose length is 1 along the face.
struct ShadowTexel {
    vec3 originWs;
    vec3 dirWs;
    float depthM; // of what is drawn there, along the face
    float widthM; // of the texel, at a depth of 1 (directional: anywhere)
};

ShadowTexel unblockedTexel() {
    return ShadowTexel(vec3(0.0), vec3(0.0), KX_INFINITY, 0.0);
}

// Depth as drawn, reversed: 0 where nothing is.
float shadowDepthAt(ShadowMap map, uint tile, ivec2 px) {
    int perRow = textureSize(shadowDepths, 0).x / int(map.tilePx);
    ivec2 corner = ivec2(int(tile) % perRow, int(tile) / perRow) * int(map.tilePx);
    return texelFetch(shadowDepths, corner + px, 0).x;
}

ivec2 texelOfPicture(ShadowMap map, vec2 clip) {
    return clamp(ivec2(floor((clip * 0.5 + 0.5) * float(map.tilePx))), ivec2(0), ivec2(int(map.tilePx) - 1));
}

vec2 pictureOfTexel(ShadowMap map, ivec2 px) {
    return (vec2(px) + 0.5) * (2.0 / float(map.tilePx)) - 1.0;
}

ShadowTexel directionalTexel(ShadowMap map, vec3 positionWs, vec2 aside) {
    vec3 to = positionWs - map.centerWs;
    float perPx = 2.0 / float(map.tilePx);
    ivec2 px = texelOfPicture(map, vec2(dot(to, map.axisXWs), dot(to, map.axisYWs)) / map.tanHalf + aside * perPx);
    vec2 atM = pictureOfTexel(map, px) * map.tanHalf;
    ShadowTexel texel;
    texel.originWs = map.centerWs + map.axisXWs * atM.x + map.axisYWs * atM.y;
    texel.dirWs = map.forwardWs;
    float depth = shadowDepthAt(map, map.firstTile, px);
    texel.depthM = depth > 0.0 ? (1.0 - depth) * map.nearM : KX_INFINITY;
    texel.widthM = map.tanHalf * perPx;
    return texel;
}

// The texel that is met from the map's centre in a direction of any length.
ShadowTexel localTexel(ShadowMap map, vec3 toWs, vec2 aside) {
    vec3 local = vec3(dot(toWs, map.forwardWs), dot(toWs, map.axisXWs), dot(toWs, map.axisYWs));
    vec3 size = abs(local);
    int axis = 0;
    if (map.faceMask != SHADOW_FORWARD_FACE) axis = size.x >= max(size.y, size.z) ? 0 : size.y >= size.z ? 1 : 2;
    uint face = 2u * uint(axis) + (local[axis] < 0.0 ? 1u : 0u);
    if ((map.faceMask >> face & 1u) == 0u) return unblockedTexel();
    int right = axis == 2 ? 0 : axis + 1, up = axis == 0 ? 2 : axis - 1;
    float perPx = 2.0 / float(map.tilePx);
    vec2 clip = vec2(local[right], local[up]) / (max(size[axis], 1.0e-20) * map.tanHalf);
    ivec2 px = texelOfPicture(map, clip + aside * perPx);
    vec2 at = pictureOfTexel(map, px) * map.tanHalf;
    vec3 dir = vec3(0.0);
    dir[axis] = local[axis] < 0.0 ? -1.0 : 1.0;
    dir[right] = at.x;
    dir[up] = at.y;
    uint tile = map.firstTile + uint(bitCount(map.faceMask & ((1u << face) - 1u)));
    ShadowTexel texel;
    texel.originWs = map.centerWs;
    texel.dirWs = map.forwardWs * dir.x + map.axisXWs * dir.y + map.axisYWs * dir.z;
    float depth = shadowDepthAt(map, tile, px);
    texel.depthM = depth > 0.0 ? map.nearM / depth : KX_INFINITY;
    texel.widthM = map.tanHalf * perPx;
    return texel;
}

// Directional: of a position; else of a direction from the map's centre. `aside`: moved by so much of a texel.
ShadowTexel shadowTexel(ShadowMap map, vec3 at, vec2 aside) {
    if (map.directional != 0u) return directionalTexel(map, at, aside);
    return localTexel(map, at, aside);
}

// From the source's middle to a point of it.
vec3 sourcePoint(ShadowMap map, vec3 toReceiverWs, vec2 uv) {
    vec2 square = 2.0 * uv - 1.0, disk = diskFromSquare(uv);
    if (map.source == SHADOW_SOURCE_RECT) return map.sourceXWs * square.x + map.sourceYWs * square.y;
    if (map.source == SHADOW_SOURCE_DISK) return map.sourceXWs * disk.x + map.sourceYWs * disk.y;
    if (map.source == SHADOW_SOURCE_SPHERE) {
        mat3 facing = basisFromNormal(normalize(toReceiverWs));
        return (facing[0] * disk.x + facing[1] * disk.y) * map.sourceRadiusM;
    }
    vec3 aside = cross(toReceiverWs, map.sourceXWs);
    return map.sourceXWs * square.x + aside * (inversesqrt(max(dot(aside, aside), 1.0e-20)) * map.sourceRadiusM * square.y);
}

// Depth of the receiver's plane along a texel's line of sight; that of the receiver where the line misses the plane.
float planeDepthM(Receiver receiver, ShadowTexel texel) {
    vec3 to = receiver.point.positionWs - texel.originWs;
    vec3 normal = receiver.surface.geoNormalWs;
    float facing = dot(normal, texel.dirWs), heightM = dot(normal, to);
    bool met = facing < -1.0e-4 && heightM < 0.0;
    return met ? heightM / facing : dot(to, texel.dirWs) / dot(texel.dirWs, texel.dirWs);
}

// What is nearer to the plane than this casts no shadow on it: rounding, and surfaces that are bent within a texel.
float shadowBiasM(ShadowMap map, ShadowTexel texel, float planeM) {
    return 0.5 * texel.widthM * (map.directional != 0u ? 1.0 : planeM) + 1.0e-3 * planeM;
}

// Two numbers per sample that fill the square evenly (Roberts' R2 sequence), turned for each pixel, and a third.
vec3 shadowNumbers(vec3 turn, uint index) {
    return fract(turn + float(index) * vec3(0.7548777, 0.5698403, 0.6180340));
}

float shadowMapVisibility(ShadowMap map, Receiver receiver, uint seed, uint samples) {
    bool directional = map.directional != 0u;
    vec3 toReceiver = receiver.point.positionWs - map.centerWs;
    vec3 turn = vec3(whiteNoise2(seed, 0u), whiteNoise1(seed, 1u));
    float mostM = dot(toReceiver, map.forwardWs); // directional: as far as anything can be in between
    // How far along the way to the light what is in between is: a share of it, directional in m.
    float sumAlong = 0.0;
    uint blockers = 0u;
    for (uint i = 0u; i < samples; ++i) {
        vec3 numbers = shadowNumbers(turn, i);
        vec3 source = sourcePoint(map, toReceiver, numbers.xy);
        float share = i == 0u ? 0.0 : (float(i) + numbers.z - 0.5) / float(samples);
        share *= sqrt(share);
        vec3 at = directional ? receiver.point.positionWs + source * (share * mostM) : mix(toReceiver, source, share);
        ShadowTexel texel = shadowTexel(map, at, vec2(0.0));
        if (texel.depthM >= KX_INFINITY) continue;
        float planeM = planeDepthM(receiver, texel);
        if (texel.depthM >= planeM - shadowBiasM(map, texel, planeM)) continue;
        // What is met there stands before the source only if the line through it ends within the source's outline.
        vec2 reach = abs(2.0 * numbers.xy - 1.0);
        float outline = max(reach.x, reach.y) * share, beforeM = planeM - texel.depthM;
        if (directional ? outline * mostM > beforeM : outline * texel.depthM > beforeM * (1.0 - share)) continue;
        sumAlong += directional ? beforeM : texel.depthM / planeM;
        ++blockers;
    }
    if (blockers == 0u) return 1.0;
    float along = sumAlong / float(blockers);
    // The penumbra on the receiver, of the source's size: (receiver - blocker) / blocker.
    float width = directional ? along : 1.0 / max(along, 1.0e-3) - 1.0;
    uint seen = 0u;
    for (uint i = 0u; i < samples; ++i) {
        vec3 numbers = shadowNumbers(turn, i + samples);
        vec3 offset = sourcePoint(map, toReceiver, numbers.xy) * width;
        vec2 aside = vec2(numbers.z, fract(numbers.z * 16.0)) - 0.5; // over a texel: its edges are soft as well
        ShadowTexel texel = shadowTexel(map, (directional ? receiver.point.positionWs : toReceiver) + offset, aside);
        float planeM = planeDepthM(receiver, texel);
        seen += texel.depthM >= planeM - shadowBiasM(map, texel, planeM) ? 1u : 0u;
    }
    return float(seen) / float(samples);
}

#endif
