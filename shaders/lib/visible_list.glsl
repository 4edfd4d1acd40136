// Reading the visible light lists of the previous frame's tiles, and packing their entries.
#ifndef KILOLUX_LIB_VISIBLE_LIST_GLSL
#define KILOLUX_LIB_VISIBLE_LIST_GLSL
#include "frame.glsl"

struct VisibleEntry {
    uint slot;
    uint epoch; // low 4 bits of the slot's
    uint age;   // frames since a sample was last seen
};

uint packEntry(VisibleEntry e) {
    return e.slot | e.epoch << ENTRY_EPOCH_SHIFT | e.age << ENTRY_AGE_SHIFT;
}

VisibleEntry unpackEntry(uint word) {
    return VisibleEntry(word & ENTRY_SLOT_MASK, word >> ENTRY_EPOCH_SHIFT & 15u, word >> ENTRY_AGE_SHIFT & 15u);
}

// A list's first texel: x = length; y = entries that found no room, above them the share of the rays to lights off a
// full list that arrived lately, and for each of the first directional lights 4 bits: how many frames more it counts as
// seen. Later ones always do.
const uint HEAD_LOST_MASK = 0xffu;
const uint HEAD_ARRIVED_SHIFT = 8u;
const uint HEAD_ARRIVED_MASK = 0xffu; // and one over its unit
const uint HEAD_SUNS_SHIFT = 16u;
const uint HEAD_SUNS = 4u;

bool isSeenDirectional(uvec2 head, uint sun) {
    return sun >= HEAD_SUNS || (head.y >> (HEAD_SUNS_SHIFT + 4u * sun) & 15u) != 0u;
}

// In [0, 1].
float arrivedShare(uvec2 head) {
    return float(head.y >> HEAD_ARRIVED_SHIFT & HEAD_ARRIVED_MASK) / float(HEAD_ARRIVED_MASK);
}

// First texel of a tile's list. Tiles outside are clamped: a pixel that comes from beyond the border still gets
// the nearest list.
uint listTexel(ivec2 tile, uvec2 tiles) {
    uvec2 at = uvec2(clamp(tile, ivec2(0), ivec2(tiles) - 1));
    return (at.y * tiles.x + at.x) * LIST_TEXELS;
}

// Of the tile at a uv of the previous frame.
uint listTexelAt(vec2 uv) {
    return listTexel(ivec2(floor(uv * vec2(frame.previousSize) / float(LIST_TILE_PX))), frame.previousTiles);
}

// One of the four tiles nearest to a uv of the previous frame, by bilinear chance: borders between lists dissolve.
uint listTexelByChance(vec2 uv, vec2 numbers) {
    vec2 tileAt = uv * vec2(frame.previousSize) / float(LIST_TILE_PX) - 0.5;
    return listTexel(ivec2(floor(tileAt + numbers)), frame.previousTiles);
}

#endif
