#version 460
// Lights of each fine cell, from its coarse cell's list. Cells in which the depth pyramid shows no surface stay
// empty; a cell without room in the index list takes its coarse cell's.
#include "shared/features.h"
#include "lib/light_cull.glsl"

layout(local_size_x = 64) in;
layout(scalar) readonly buffer CoarseCells {
    GridCell coarseCells[];
};
layout(scalar) writeonly buffer GridCells {
    GridCell gridCells[];
};
layout(scalar) buffer GridIndices {
    uint gridIndices[];
};
uniform sampler2D pyramid; // nearest and farthest depth of 2 x 2, 4 x 4, ... pixels

const int kPyramidLevel = 4; // one texel per 32 x 32 pixels

// Whether some surface of the cell's pixels lies within its depths. Odd sizes let a texel of the pyramid's last
// row or column stand for more pixels than the regular ones.
bool cellHasSurface(uvec2 cell, float nearM, float farM) {
    if (textureQueryLevels(pyramid) <= kPyramidLevel) return true; // a picture smaller than a cell
    ivec2 last = max(ivec2(frame.size >> uint(kPyramidLevel + 1)) - 1, ivec2(0));
    ivec2 at = min(ivec2(cell), last);
    vec2 range = texelFetch(pyramid, at, kPyramidLevel).xy;
    return range.x < DEPTH_SKY && range.x <= farM && range.y >= nearM;
}

void main() {
    uint thread = gl_LocalInvocationIndex;
    uvec3 cell = gl_WorkGroupID;
    float nearM = gridSliceDepth(cell.z), farM = gridSliceDepth(cell.z + 1u);
    uint index = gridFineIndex(cell);
    if (!cellHasSurface(cell.xy, nearM, farM)) {
        if (thread == 0u) gridCells[index] = GridCell(0u, 0u, 0u);
        return;
    }
    GridCell coarse = coarseCells[gridCoarseIndex(cell / GRID_COARSE)];
    CellBounds bounds = cellBounds(cell.xy * GRID_TILE_PX, min((cell.xy + 1u) * GRID_TILE_PX, frame.size), nearM, farM);
    clearList(thread);
    for (uint i = thread; i < coarse.count; i += GRID_GROUP) {
        LightHot light = loadLightHot(gridIndices[coarse.first + i]);
        if (lightMayReach(light, bounds)) markLight(i, lightType(light));
    }
    uint total;
    uint at = prefixOfThread(thread, total);
    uint firstIndex = takeRoom(thread, total);
    bool fits = firstIndex + total <= frame.grid.capacity;
    for (uint i = 0u; fits && i < kWordsPerThread; ++i) {
        uint word = thread * kWordsPerThread + i;
        for (uint bits = sharedMask[word]; bits != 0u; bits &= bits - 1u) {
            gridIndices[firstIndex + at++] = gridIndices[coarse.first + word * 32u + uint(findLSB(bits))];
        }
    }
    if (thread == 0u) {
        if (fits) {
            gridCells[index] = GridCell(firstIndex, total, sharedTypes);
        } else {
            gridCells[index] = coarse;
            atomicAdd(gridCounters[GRID_COUNTER_COARSE], 1u);
        }
        atomicAdd(gridCounters[GRID_COUNTER_TESTS], coarse.count);
    }
}
