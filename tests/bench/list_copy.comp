#version 460
// Reads what visible_list.comp reads and writes as many bytes, without its work: what its time is held against. One
// workgroup per 8 x 8 tile; each lane reads two pixels. For tests/bench/loop_cost.cpp.
#include "lib/tile_order.glsl"
#include "shared/sampling.h"

layout(local_size_x = 32) in;

uniform usampler2DArray samples;
uniform usampler2DArray rayResults;
uniform usamplerBuffer visibleLists;
layout(scalar) writeonly buffer VisibleListsOut { uvec2 listsOut[]; };
layout(push_constant) uniform Push { uvec2 size; uvec2 tiles; uint chunks; uint rays; } push;

uvec2 folded(uvec2 pixel) {
    uvec2 sum = uvec2(0u);
    for (uint layer = 0u; layer < push.rays; ++layer) {
        uvec4 texel = texelFetch(samples, ivec3(pixel, layer), 0);
        sum ^= texel.xy ^ texel.zw ^ texelFetch(rayResults, ivec3(pixel, layer), 0).x;
    }
    return sum;
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    uvec2 tile = interleavedTile(gl_WorkGroupID.x, push.tiles, push.chunks);
    uvec2 pixel = tile * LIST_TILE_PX + uvec2(lane & 7u, lane >> 3u);
    uvec2 last = push.size - 1u;
    uint texel = (tile.y * push.tiles.x + tile.x) * LIST_TEXELS;
    uvec2 sum = folded(min(pixel, last)) ^ folded(min(pixel + uvec2(0u, 4u), last));
    sum ^= texelFetch(visibleLists, int(texel + 1u + lane)).xy;
    listsOut[texel + 1u + lane] = sum;
    listsOut[texel + LIST_CELLS_AT + lane] = texelFetch(visibleLists, int(texel + LIST_CELLS_AT + lane)).xy ^ sum;
    if (lane == 0u) listsOut[texel] = texelFetch(visibleLists, int(texel)).xy;
}
