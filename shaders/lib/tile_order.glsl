// The order of tiles in a dispatch. CPU drivers hand each of their threads one contiguous run of workgroups;
// neighbouring tiles cost alike, so runs of a picture's top and bottom do not balance. Dealing tiles out in turn
// does (5 to 20 % on lavapipe with two threads). In the subset that C++ compiles too.
#ifndef KILOLUX_TILE_ORDER_GLSL
#define KILOLUX_TILE_ORDER_GLSL
#include "../math/prelude.glsl"

// a / b for numbers of up to 24 bits. SIMD lanes of CPUs have no integer division: each would be divided alone.
KX_INLINE uint quotientOf24Bits(uint a, uint b) {
    uint q = uint(float(a) / float(b)); // may be off by one
    int rest = int(a) - int(q * b);
    return rest < 0 ? q - 1u : (rest >= int(b) ? q + 1u : q);
}

// Tile of workgroup `group` of tileCount.x * tileCount.y, so that each of `chunks` (at least 1) runs of
// workgroups gets every chunks-th tile. A bijection for any sizes; the identity for one chunk.
KX_INLINE uvec2 interleavedTile(uint group, uvec2 tileCount, uint chunks) {
    uint total = tileCount.x * tileCount.y;
    uint size = total / chunks;
    uint longer = total - size * chunks; // the first `longer` runs have one more
    uint split = longer * (size + 1u);
    bool inLonger = group < split;
    uint runSize = inLonger ? size + 1u : max(size, 1u);
    uint offset = inLonger ? group : group - split;
    uint run = offset / runSize;
    uint tile = (offset - run * runSize) * chunks + (inLonger ? run : run + longer);
    return uvec2(tile % tileCount.x, tile / tileCount.x);
}

#ifndef __cplusplus
// The workgroup's number in a dispatch of one per tile, row by row.
uint dispatchedGroup(uvec2 tileCount) {
    return gl_WorkGroupID.y * tileCount.x + gl_WorkGroupID.x;
}

uvec2 dispatchedTile(uvec2 tileCount, uint chunks) {
    return interleavedTile(dispatchedGroup(tileCount), tileCount, chunks);
}
#endif

// Place of the at-th pixel of a tile that is 4 * blocksPerRow (a power of two) pixels wide: eight successive ones are a
// block of 4 x 2, so that the lanes of a short subgroup look at nearly the same (primary rays take 0.92 of the time of
// rows of 8, choices of lights 0.96, on lavapipe). Longer subgroups hold the same pixels in either order.
KX_INLINE uvec2 blockedPixel(uint at, uint blocksPerRow) {
    uint block = at >> 3u;
    return uvec2((at & 3u) + 4u * (block & (blocksPerRow - 1u)), (at >> 2u & 1u) + 2u * (block / blocksPerRow));
}

#endif
