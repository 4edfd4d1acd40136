#version 460
// The visible light list of each 8 x 8 tile for the next frame: lights of which a sample was visible, sorted by slot,
// with the cells of the light that were seen (the MegaLights talk, SIGGRAPH 2025, "Sample Guiding" and "Area Light
// Guiding"; the smallest slot by subgroup minimum is from Sousa and Geffroy, "The devil is in the details", 2016).
// Entries of the previous list stay for some frames without being seen. A workgroup is one subgroup, so that no
// barriers are needed; results do not depend on its size.
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "shared/features.h"
#include "lib/frame.glsl"
#include "lib/light_access.glsl"
#include "lib/reprojection.glsl"
#include "lib/sample.glsl"
#include "lib/tile_order.glsl"
#include "lib/visible_list.glsl"
#include "math/hash.glsl"

layout(constant_id = CHOICE_LANES) const int kLanes = 8;
const int kPixelsPerLane = 64 / kLanes;

layout(local_size_x_id = CHOICE_LANES) in;
uniform usampler2DArray samples;
uniform usampler2DArray rayResults;
uniform usamplerBuffer visibleLists; // of the previous frame
layout(scalar) readonly buffer DirectionalSlots {
    uint directionalSlots[];
};
layout(scalar) writeonly buffer VisibleListsOut {
    uvec2 listsOut[];
};
layout(scalar) buffer Counters {
    uint counters[];
};

const uint kNone = 0xffffffffu;
const float kArrivedRays = 32.0; // that the share of arrived ones remembers, about three frames' of a tile
const uint kRoom = 128u; // of one layer's 64 samples and the entries before, which are at most 33 + 64 long

shared uvec4 entries[2][kRoom]; // in turn the list so far and the next one; xy: as listed, zw: what was seen

// The entry as it goes into this frame: older by one, windows turned, and nothing believed of an edited light.
uvec4 carriedEntry(uvec2 texel, uvec2 seen) {
    VisibleEntry e = unpackEntry(texel.x);
    uvec4 none = uvec4(kNone, uvec3(0u));
    if (e.slot >= frame.lightCount) return none;
    uint typeFlags = loadLightHot(e.slot).typeFlags;
    // A light that went out or away stays as strong as it was while its edit is fresh: pixels that meet it cap their
    // history.
    bool off = (typeFlags & (LIGHT_FLAG_DEAD | LIGHT_FLAG_MUTED)) != 0u, edited = (typeFlags & LIGHT_FLAG_EDITED) != 0u;
    if (off && !edited) return none;
    e.age = min(e.age + 1u, 15u);
    if (e.age > frame.sampling.listMemory && !edited) return none;
    uint epoch = typeFlags >> LIGHT_EPOCH_SHIFT & LIGHT_EPOCH_MASK;
    bool same = epoch == e.epoch;
    if (frame.frame % ENTRY_WINDOW == 0u) seen <<= SEEN_OLDER_SHIFT;
    e.epoch = epoch;
    return uvec4(packEntry(e), edited ? texel.y : texel.y - texel.y / 4u, same ? seen : uvec2(0u));
}

// The bits of a directional light or the dome among those that a list's head knows.
uint bitsOfSun(uint slot) {
    uint bits = 0u;
    for (uint i = 0u; i < min(frame.sampling.directionalCount, HEAD_SUNS); ++i)
        bits |= directionalSlots[i] == slot ? 15u << 4u * i : 0u;
    return bits;
}

// What is left of the frames for which the directional lights of a head count as seen.
uint seenSuns(uint headY, uint seenNow) {
    uint frames = 0u;
    for (uint shift = 0u; shift < 4u * HEAD_SUNS; shift += 4u) {
        uint before = headY >> (HEAD_SUNS_SHIFT + shift) & 15u;
        bool now = (seenNow >> shift & 1u) != 0u;
        frames |= (now ? clamp(frame.sampling.listMemory, 1u, 15u) : before - min(before, 1u)) << shift;
    }
    return frames;
}

// What the samples of a lane's pixels tell beside the lights that they saw.
struct Tally {
    uint suns;          // bits of those of a list's head
    uint hiddenRays;    // to lights off the list,
    uint hiddenArrived; // and those of them that arrived
};

// What a sample adds: x = slot, y = energy << 16 | bit of the cell; kNone for what was not seen, or is directional.
uvec2 seenSample(uvec2 pixel, uint layer, inout Tally tally) {
    if (any(greaterThanEqual(pixel, frame.size))) return uvec2(kNone, 0u);
    uint result = texelFetch(rayResults, ivec3(pixel, layer), 0).x;
    bool visible = (result & RAY_STATE_MASK) == RAY_VISIBLE;
    StoredSample s = unpackSample(texelFetch(samples, ivec3(pixel, layer), 0));
    if (s.list == LIST_HIDDEN && s.contribution > 0.0) {
        ++tally.hiddenRays;
        tally.hiddenArrived += visible ? 1u : 0u;
    }
    if (!visible) return uvec2(kNone, 0u);
    if (s.list == LIST_DIRECTIONAL || s.list == LIST_DOME) {
        tally.suns |= bitsOfSun(s.slot);
        return uvec2(kNone, 0u);
    }
    uint energy = uint(clamp(s.weight * 256.0, 1.0, 65535.0));
    return uvec2(s.slot, energy << 16u | 1u << (result >> RAY_CELL_SHIFT & 15u));
}

// Merges the list in entries[from] (`count` long, sorted) with the samples of one layer; returns the new length.
uint mergeLayer(uvec2 tile, uint layer, uint from, uint count, inout Tally tally) {
    uint lane = gl_LocalInvocationID.x;
    uint slots[kPixelsPerLane], adds[kPixelsPerLane];
    for (int i = 0; i < kPixelsPerLane; ++i) {
        uint at = uint(i * kLanes) + lane;
        uvec2 seen = seenSample(tile * LIST_TILE_PX + uvec2(at & 7u, at >> 3u), layer, tally);
        slots[i] = seen.x;
        adds[i] = seen.y;
    }
    uint made = 0u, next = 0u;
    for (;;) {
        uint mine = kNone;
        for (int i = 0; i < kPixelsPerLane; ++i)
            mine = min(mine, slots[i]);
        uvec4 before = next < count ? entries[from][next] : uvec4(kNone, uvec3(0u));
        uint beforeSlot = before.x == kNone ? kNone : before.x & ENTRY_SLOT_MASK;
        uint slot = min(subgroupMin(mine), beforeSlot);
        if (slot == kNone) break;
        uint cells = 0u, energy = 0u, samplesOf = 0u;
        for (int i = 0; i < kPixelsPerLane; ++i) {
            bool same = slots[i] == slot;
            cells |= same ? adds[i] & SEEN_MASK : 0u;
            energy += same ? adds[i] >> 16u : 0u;
            samplesOf += same ? 1u : 0u;
            slots[i] = same ? kNone : slots[i]; // done with
        }
        cells = subgroupOr(cells);
        energy = subgroupAdd(energy);
        samplesOf = subgroupAdd(samplesOf);
        VisibleEntry e = VisibleEntry(slot, 0u, 0u);
        uvec2 seen = uvec2(0u);
        if (beforeSlot == slot) {
            e = unpackEntry(before.x);
            energy = max(energy, before.y);
            seen = before.zw;
            ++next;
        } else {
            e.epoch = loadLightHot(slot).typeFlags >> LIGHT_EPOCH_SHIFT & LIGHT_EPOCH_MASK;
        }
        if (cells != 0u) e.age = 0u;
        seen.x |= cells;
        seen.y += min(samplesOf, SEEN_MASK - (seen.y & SEEN_MASK));
        if (lane == 0u) entries[1u - from][made] = uvec4(packEntry(e), energy, seen);
        ++made;
    }
    subgroupMemoryBarrierShared();
    subgroupBarrier();
    return made;
}

// The share of the rays to lights off the list that arrive: what those lights give for which there is no room. A
// running mean over rays, rounded by chance so that small steps are not lost.
uint arrivedBits(uvec2 tile, uvec2 head, Tally tally) {
    float rays = float(subgroupAdd(tally.hiddenRays)), arrived = float(subgroupAdd(tally.hiddenArrived));
    float before = arrivedShare(head);
    float share = before + (arrived - rays * before) / (rays + kArrivedRays);
    float chance = whiteNoise1(pixelSeed(tile, frame.sampling.noiseFrame, frame.seed), 24u);
    return min(uint(share * float(HEAD_ARRIVED_MASK) + chance), HEAD_ARRIVED_MASK) << HEAD_ARRIVED_SHIFT;
}

// Takes out the entry of least energy, of equal ones the last, by moving up what is behind it.
void dropWeakest(uint from, uint count) {
    uint weakest = 0u;
    for (uint i = 1u; i < count; ++i)
        if (entries[from][i].y <= entries[from][weakest].y) weakest = i;
    for (uint i = weakest; i + 1u < count; ++i)
        entries[from][i] = entries[from][i + 1u];
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    uvec2 tile = dispatchedTile(frame.tiles, frame.tileChunks);
    uvec2 middle = min(tile * LIST_TILE_PX + LIST_TILE_PX / 2u, frame.size - 1u);
    Reprojection before = reproject(middle);
    uint first = listTexel(ivec2(before.uv * vec2(frame.previousSize) / float(LIST_TILE_PX)), frame.previousTiles);
    uvec2 head = frame.historyValid != 0u ? texelFetch(visibleLists, int(first)).xy : uvec2(0u);
    uint stored = min(head.x, LIST_CAPACITY);
    Tally tally = Tally(0u, 0u, 0u);
    for (uint i = lane; i < stored; i += uint(kLanes))
        entries[1][i] = carriedEntry(texelFetch(visibleLists, int(first + 1u + i)).xy,
                                     texelFetch(visibleLists, int(first + LIST_CELLS_AT + i)).xy);
    subgroupMemoryBarrierShared();
    subgroupBarrier();
    uint count = 0u, from = 0u;
    if (lane == 0u) {
        for (uint i = 0u; i < stored; ++i)
            if (entries[1][i].x != kNone) entries[0][count++] = entries[1][i];
    }
    count = subgroupMax(count);
    subgroupMemoryBarrierShared();
    subgroupBarrier();
    uint wanted = min(frame.sampling.listLength, LIST_CAPACITY), lost = 0u;
    for (uint layer = 0u; layer < frame.sampling.rays; ++layer) {
        count = mergeLayer(tile, layer, from, count, tally);
        from = 1u - from;
        while (count > wanted) {
            if (lane == 0u) dropWeakest(from, count);
            --count;
            ++lost;
        }
        subgroupMemoryBarrierShared();
        subgroupBarrier();
    }
    // Where there is room, what arrived is on the list from now on, and nothing is to be expected of the others.
    if (lost == 0u) tally.hiddenArrived = 0u;
    uint more = arrivedBits(tile, head, tally);
    if (kDirectionalLights || kDome) more |= seenSuns(head.y, subgroupOr(tally.suns)) << HEAD_SUNS_SHIFT;
    uint out0 = (tile.y * frame.tiles.x + tile.x) * LIST_TEXELS;
    if (lane == 0u) {
        listsOut[out0] = uvec2(count, min(lost, HEAD_LOST_MASK) | more);
        atomicAdd(counters[COUNTER_LIST_ENTRIES], count);
        if (lost > 0u) atomicAdd(counters[COUNTER_LIST_OVERFLOW], lost);
    }
    for (uint i = lane; i < count; i += uint(kLanes)) {
        listsOut[out0 + 1u + i] = entries[from][i].xy;
        listsOut[out0 + LIST_CELLS_AT + i] = entries[from][i].zw;
    }
}
