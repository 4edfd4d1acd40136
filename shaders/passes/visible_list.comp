#version 460
// The visible light list of each 8 x 8 tile for the next frame: lights of which a sample was visible, sorted by slot,
// with the cells of the light that were seen (the MegaLights talk, SIGGRAPH 2025, "Sample Guiding" and "Area Light
// Guiding"; the smallest slot by subgroup minimum is from Sousa and Geffroy, "The devil is in the details", 2016).
// Entries of the previous list stay for some frames without being seen. A workgroup is one subgroup, so that no
// barriers are needed; results do not depend on its size.
#include "shared/features.h"
#include "lib/frame.glsl"
#include "lib/lanes.glsl"
#include "lib/light_access.glsl"
#include "lib/reprojection.glsl"
#include "lib/sample.glsl"
#include "lib/tile_order.glsl"
#include "lib/visible_list.glsl"
#include "math/hash.glsl"

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
const uint kSun = 1u << 16u;  // beside a sample's slot: of a directional light or the dome
const uint kGone = 1u << 31u; // in an entry: not listed any more, unless it is seen again, and then begins anew
const uint kCountShift = 22u; // above the energy of up to 64 samples
const float kArrivedRays = 32.0; // that the share of arrived ones remembers, about three frames' of a tile
const uint kRoom = 128u; // of up to 32 entries that stay and those of one layer's 64 samples

shared uvec4 entries[2][kRoom]; // in turn the list so far and the next one; xy: as listed, zw: what was seen

// The entry as it goes into this frame: older by one, windows turned, and nothing believed of an edited light.
uvec4 carriedEntry(uvec2 texel, uvec2 seen) {
    VisibleEntry e = unpackEntry(texel.x);
    if (e.slot >= frame.lightCount) return uvec4(e.slot | kGone, uvec3(0u));
    uint typeFlags = loadLightHot(e.slot).typeFlags;
    // A light that went out or away stays as strong as it was while its edit is fresh: pixels that meet it cap their
    // history.
    bool off = (typeFlags & (LIGHT_FLAG_DEAD | LIGHT_FLAG_MUTED)) != 0u, edited = (typeFlags & LIGHT_FLAG_EDITED) != 0u;
    e.age = min(e.age + 1u, 15u);
    bool gone = (off || e.age > frame.sampling.listMemory) && !edited;
    uint epoch = typeFlags >> LIGHT_EPOCH_SHIFT & LIGHT_EPOCH_MASK;
    bool same = epoch == e.epoch;
    if (frame.frame % ENTRY_WINDOW == 0u) seen <<= SEEN_OLDER_SHIFT;
    e.epoch = epoch;
    return uvec4(packEntry(e) | (gone ? kGone : 0u), edited ? texel.y : texel.y - texel.y / 4u,
                 same ? seen : uvec2(0u));
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

// What a sample adds: x = slot, y = energy << 16 | bit of the cell; kNone for what was not seen.
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
    if (s.list == LIST_DIRECTIONAL || s.list == LIST_DOME) return uvec2(s.slot | kSun, 0u);
    uint energy = uint(clamp(s.weight * 256.0, 1.0, 65535.0));
    return uvec2(s.slot, energy << 16u | 1u << (result >> RAY_CELL_SHIFT & 15u));
}

// Those of slots[] among the directional lights and the dome that a list's head knows, as its bits.
uint sunsAmong(uint slots[kPixelsPerLane]) {
    uint suns = 0u;
    for (uint sun = 0u; sun < min(frame.sampling.directionalCount, HEAD_SUNS); ++sun) {
        for (int i = 0; i < kPixelsPerLane; ++i)
            suns |= slots[i] == (directionalSlots[sun] | kSun) ? 15u << 4u * sun : 0u;
    }
    return suns;
}

// An entry with what a layer's samples saw of its light: cells, and their count and energy as mergeLayer() packs them.
uvec4 withSeen(uvec4 entry, uint cells, uint sum) {
    if ((entry.x & kGone) != 0u) entry.yzw = uvec3(0u);
    if (sum != 0u) entry.x &= (1u << ENTRY_AGE_SHIFT) - 1u; // of age 0, and not gone
    entry.y = max(entry.y, sum & ((1u << kCountShift) - 1u));
    entry.z |= cells;
    entry.w += min(sum >> kCountShift, SEEN_MASK - (entry.w & SEEN_MASK));
    return entry;
}

// Merges the list in entries[from] (`count` long, sorted) with the samples of one layer; returns the new length. Lists
// are the first lane's: shared memory costs a CPU's vector as much as there are lanes that use it.
uint mergeLayer(uvec2 tile, uint layer, uint from, uint count, inout Tally tally) {
    uint slots[kPixelsPerLane], adds[kPixelsPerLane];
    for (int i = 0; i < kPixelsPerLane; ++i) {
        uint at = uint(i * kLanes) + gl_LocalInvocationID.x;
        uvec2 seen = seenSample(tile * LIST_TILE_PX + uvec2(at & 7u, at >> 3u), layer, tally);
        slots[i] = seen.x;
        adds[i] = seen.y;
    }
    if (kDirectionalLights || kDome) tally.suns |= sunsAmong(slots);
    for (int i = 0; i < kPixelsPerLane; ++i)
        slots[i] = slots[i] > ENTRY_SLOT_MASK ? kNone : slots[i];
    bool first = gl_LocalInvocationID.x == 0u;
    uint made = 0u, next = 0u;
    for (;;) {
        uint least = kNone;
        for (int i = 0; i < kPixelsPerLane; ++i)
            least = min(least, slots[i]);
        uvec4 entry = uvec4(kNone, uvec3(0u));
        uint listed = kNone;
        if (first && next < count) {
            entry = entries[from][next];
            listed = entry.x & ENTRY_SLOT_MASK;
        }
        uint slot = minOfLanes(min(least, listed));
        if (slot == kNone) break;
        uint cells = 0u, sum = 0u;
        for (int i = 0; i < kPixelsPerLane; ++i) {
            bool same = slots[i] == slot;
            cells |= same ? adds[i] & SEEN_MASK : 0u;
            sum += same ? 1u << kCountShift | adds[i] >> 16u : 0u;
            slots[i] = same ? kNone : slots[i]; // done with
        }
        cells = orOfLanes(cells);
        sum = sumOfLanes(sum);
        if (first) {
            if (listed == slot) {
                ++next;
            } else {
                uint epoch = loadLightHot(slot).typeFlags >> LIGHT_EPOCH_SHIFT & LIGHT_EPOCH_MASK;
                entry = uvec4(packEntry(VisibleEntry(slot, epoch, 0u)), uvec3(0u));
            }
            entry = withSeen(entry, cells, sum);
            if ((entry.x & kGone) == 0u) entries[1u - from][made++] = entry;
        }
    }
    shareAcrossLanes();
    return subgroupBroadcastFirst(made);
}

// The share of the rays to lights off the list that arrive: what those lights give for which there is no room. A
// running mean over rays, rounded by chance so that small steps are not lost.
uint arrivedBits(uvec2 tile, uvec2 head, Tally tally) {
    uint both = sumOfLanes(tally.hiddenRays << 16u | tally.hiddenArrived);
    float rays = float(both >> 16u), arrived = float(both & 0xffffu);
    float before = arrivedShare(head);
    float share = before + (arrived - rays * before) / (rays + kArrivedRays);
    float chance = whiteNoise1(pixelSeed(tile, frame.sampling.noiseFrame, frame.seed), 24u);
    return min(uint(share * float(HEAD_ARRIVED_MASK) + chance), HEAD_ARRIVED_MASK) << HEAD_ARRIVED_SHIFT;
}

// Marks the `surplus` entries of least energy, of equal ones the last, as gone.
void dropWeakest(uint from, uint count, uint surplus) {
    uint lane = gl_LocalInvocationID.x, lanes = uint(kLanes);
    for (uint mine = lane; mine - lane < count; mine += lanes) {
        uint energy = mine < count ? entries[from][mine].y : kNone, weaker = 0u;
        for (uint theirs = 0u; theirs < count; theirs += lanes) {
            uint energies = theirs + lane < count ? entries[from][theirs + lane].y : kNone;
            for (uint k = 0u; k < lanes; ++k) {
                uint other = subgroupBroadcast(energies, k);
                weaker += other < energy || (other == energy && theirs + k > mine) ? 1u : 0u;
            }
        }
        if (mine < count && weaker < surplus) entries[from][mine].x |= kGone;
    }
    shareAcrossLanes();
}

// Writes the entries that are not gone to the texels from `head` on; returns how many.
uint writeEntries(uint head, uint from, uint count) {
    uint lane = gl_LocalInvocationID.x, written = 0u;
    for (uint i = lane; i - lane < count; i += uint(kLanes)) {
        uvec4 entry = i < count ? entries[from][i] : uvec4(kGone);
        uint listed = (entry.x & kGone) == 0u ? 1u : 0u;
        uint place = written + sumOfLanesBefore(listed);
        if (listed != 0u) {
            listsOut[head + 1u + place] = entry.xy;
            listsOut[head + LIST_CELLS_AT + place] = entry.zw;
        }
        written += sumOfLanes(listed);
    }
    return written;
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    uvec2 tile = dispatchedTile(frame.tiles, frame.tileChunks);
    uvec2 middle = min(tile * LIST_TILE_PX + LIST_TILE_PX / 2u, frame.size - 1u);
    Reprojection before = reproject(middle);
    uint first = listTexel(ivec2(before.uv * vec2(frame.previousSize) / float(LIST_TILE_PX)), frame.previousTiles);
    uvec2 head = frame.historyValid != 0u ? texelFetch(visibleLists, int(first)).xy : uvec2(0u);
    uint count = min(head.x, LIST_CAPACITY), from = 0u;
    for (uint i = lane; i < count; i += uint(kLanes))
        entries[from][i] = carriedEntry(texelFetch(visibleLists, int(first + 1u + i)).xy,
                                        texelFetch(visibleLists, int(first + LIST_CELLS_AT + i)).xy);
    shareAcrossLanes();
    uint wanted = min(frame.sampling.listLength, LIST_CAPACITY), lost = 0u;
    Tally tally = Tally(0u, 0u, 0u);
    for (uint layer = 0u; layer < frame.sampling.rays; ++layer) {
        count = mergeLayer(tile, layer, from, count, tally);
        from = 1u - from;
        if (count > wanted) {
            dropWeakest(from, count, count - wanted);
            lost += count - wanted;
        }
    }
    // Where there is room, what arrived is on the list from now on, and nothing is to be expected of the others.
    if (lost == 0u) tally.hiddenArrived = 0u;
    uint more = arrivedBits(tile, head, tally);
    if (kDirectionalLights || kDome) more |= seenSuns(head.y, orOfLanes(tally.suns)) << HEAD_SUNS_SHIFT;
    uint out0 = (tile.y * frame.tiles.x + tile.x) * LIST_TEXELS;
    uint written = writeEntries(out0, from, count);
    if (lane == 0u) {
        listsOut[out0] = uvec2(written, min(lost, HEAD_LOST_MASK) | more);
        atomicAdd(counters[COUNTER_LIST_ENTRIES], written);
        if (lost > 0u) atomicAdd(counters[COUNTER_LIST_OVERFLOW], lost);
    }
}
