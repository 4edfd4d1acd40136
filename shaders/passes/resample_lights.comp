#version 460
// A light and a point on it for every pixel, resampled from candidates by the light that they would give, and, with
// reuse, from what the pixel held in the frame before (Bitterli et al. 2020, algorithms 3 and 5: the winner's shadow ray
// comes before all reuse). With one candidate this is plain sampling by its source: evenly, by power, down a tree of
// lights, or what a direction drawn by the BRDF meets.
#include "shared/features.h"
#include "lib/brdf_sample.glsl"
#include "lib/count.glsl"
#include "lib/dispatch.glsl"
#include "lib/light_grid.glsl"
#include "lib/light_reservoir.glsl"
#include "lib/light_tree.glsl"
#include "lib/reprojection.glsl"

layout(constant_id = CHOICE_DRAW_FROM) const int kDrawFrom = DRAW_FROM_CELL;

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant, scalar) uniform Push {
    ResamplingConstants how;
};
uniform usampler2D previousSurface;
uniform usampler2D previousReservoirs;
layout(scalar) readonly buffer GridCells {
    GridCell gridCells[];
};
uniform usamplerBuffer gridIndices;
layout(scalar) readonly buffer LightPowers {
    LightPower lightPowers[];
};
layout(rgba32ui) writeonly uniform uimage2D reservoirsOut;

LightReservoir reservoirBefore(uvec2 pixel, Receiver receiver) {
    Reprojection before = reproject(pixel);
    if (!before.onScreen) return emptyLightReservoir();
    ivec2 at = ivec2(before.uv * vec2(frame.previousSize));
    uvec4 surface = texelFetch(previousSurface, at, 0);
    float cosView = dot(receiver.surface.geoNormalWs, receiver.point.viewDirWs);
    bool same = sameDepth(surfaceDepthM(surface), before.depthM, cosView) &&
                dot(surfaceNormalWs(surface), receiver.surface.normalWs) >= kLikeNormal;
    if (!same) return emptyLightReservoir();
    LightReservoir r = unpackLightReservoir(texelFetch(previousReservoirs, at, 0));
    r.count = min(r.count, how.mostHistory);
    return r;
}

uint slotInCell(GridCell cell, bool gridded, uint at) {
    return gridded ? texelFetch(gridIndices, int(cell.first + at)).x : at;
}

// One of the lights that a direction drawn by the BRDF meets, by their luminance; or, half of the time where there
// are any, one of those without size, which no direction meets.
void drawWhatIsMet(Receiver receiver, GridCell cell, bool gridded, uint seed, inout LightReservoir r) {
    BrdfDirection drawn = drawByBrdf(receiver, r.uv, whiteNoise1(seed, 0x100u));
    float metSum = 0.0, metWeight = 0.0, metPdf = 0.0;
    uint metSlot = NO_RESERVOIR, points = 0u, pointSlot = NO_RESERVOIR;
    bool extended = false;
    vec2 metUv = vec2(0.0);
    for (uint i = 0u; i < cell.count; ++i) {
        uint slot = slotInCell(cell, gridded, i);
        LightHot light = loadLightHot(slot);
        float number = whiteNoise1(seed, 0x200u + i);
        if (lightIsDelta(light)) {
            ++points;
            if (number * float(points) < 1.0) pointSlot = slot;
            continue;
        }
        extended = true;
        LightHit hit = lightIntersect(light, receiver.point.positionWs, drawn.dirWs);
        if (!hit.hit || drawn.pdf <= 0.0) continue;
        float weight = luminance(lightEvaluate(light, receiver.point.positionWs));
        if (!takesOffer(metSum, weight, number)) continue;
        metSlot = slot;
        metUv = hit.uv;
        metPdf = hit.pdfSolidAngle;
        metWeight = weight;
    }
    float pointShare = points == 0u ? 0.0 : (extended ? 0.5 : 1.0);
    bool takePoint = whiteNoise1(seed, 0x101u) < pointShare;
    r.slot = takePoint ? pointSlot : metSlot;
    if (takePoint) r.contribution = float(points) / pointShare;
    if (takePoint || metSlot == NO_RESERVOIR) return;
    r.uv = unpackUnorm2x16(packUnorm2x16(metUv));
    // Densities over the light's unit square: that of a direction over lightSample()'s there.
    r.contribution = metPdf / drawn.pdf * (metSum / metWeight) / (1.0 - pointShare);
}

// One candidate, with 1 over the probability of its light.
LightReservoir drawLight(Receiver receiver, GridCell cell, bool gridded, uint seed, uint index) {
    vec2 number = whiteNoise2(seed, 3u * index);
    LightReservoir r = emptyLightReservoir();
    r.uv = unpackUnorm2x16(packUnorm2x16(whiteNoise2(seed, 3u * index + 1u)));
    r.count = 1.0;
    uint lights = kDrawFrom == DRAW_FROM_POWER ? frame.lightCount : cell.count;
    uint at = min(uint(number.x * float(lights)), max(lights, 1u) - 1u);
    if (kDrawFrom == DRAW_FROM_TREE) {
        float probability;
        r.slot = drawFromTree(receiver, number.x, probability);
        r.contribution = 1.0 / max(probability, 1.0e-30);
    } else if (lights == 0u) {
        return r;
    } else if (kDrawFrom == DRAW_FROM_POWER) {
        r.slot = number.y < lightPowers[at].keep ? at : lightPowers[at].other;
        r.contribution = 1.0 / max(lightPowers[r.slot].probability, 1.0e-30);
    } else if (kDrawFrom == DRAW_FROM_BRDF) {
        drawWhatIsMet(receiver, cell, gridded, seed, r);
    } else {
        r.slot = slotInCell(cell, gridded, at);
        r.contribution = float(lights);
    }
    return r;
}

void main() {
    uvec2 pixel = dispatchedPixel();
    if (!isInPicture(pixel)) return;
    Receiver receiver = loadReceiver(pixel);
    LightReservoir chosen = emptyLightReservoir();
    if (receiver.exists) {
        bool gridded = frame.grid.enabled != 0u;
        GridCell cell = GridCell(0u, frame.lightCount, 0u);
        if (gridded) cell = gridCells[gridCellOfPixel(pixel, receiver.depthM)];
        uint seed = hashCombine(pixelSeed(pixel, frame.frame, frame.seed), 0x7e5au);
        float sum = 0.0, target = 0.0;
        LightSample point = invalidSample(vec2(0.0));
        uint rays = 0u;
        // The last turn of the loop is the frame before: so each function has one call site, which compiles faster.
        for (uint i = 0u; i < how.candidates + (how.reuse != 0u ? 1u : 0u); ++i) {
            LightReservoir offered;
            if (i < how.candidates) {
                offered = drawLight(receiver, cell, gridded, seed, i);
            } else {
                if (target > 0.0) {
                    bool traced;
                    if (tracePoint(receiver, chosen.slot, point, traced) != RAY_VISIBLE) sum = 0.0;
                    rays += traced ? 1u : 0u;
                }
                offered = reservoirBefore(pixel, receiver);
            }
            PointLight lit = pointLight(receiver, offered.slot, offered.uv);
            chosen.count += offered.count;
            if (!takesOffer(sum, lit.target * offered.contribution * offered.count, whiteNoise1(seed, 3u * i + 2u))) continue;
            chosen.slot = offered.slot;
            chosen.uv = offered.uv;
            target = lit.target;
            point = lit.point;
        }
        chosen.contribution = target > 0.0 ? sum / (target * chosen.count) : 0.0;
        countAll(COUNTER_CANDIDATES, how.candidates);
        countAll(COUNTER_RAYS, rays);
        countAll(COUNTER_SURFACE_PIXELS, 1u);
    }
    imageStore(reservoirsOut, ivec2(pixel), packLightReservoir(chosen));
}
