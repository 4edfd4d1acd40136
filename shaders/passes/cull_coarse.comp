#version 460
// Lights of each coarse cell of the grid: a group of threads per cell walks all lights once. Cells in which the depth
// pyramid shows no surface stay empty.
#include "shared/features.h"
#include "lib/light_cull.glsl"

layout(local_size_x = 64) in;
layout(scalar) writeonly buffer CoarseCells {
    GridCell coarseCells[];
};
layout(scalar) writeonly buffer GridIndices {
    uint gridIndices[];
};

void main() {
    uint thread = groupThread();
    uvec3 cell = gl_WorkGroupID;
    uvec3 first = cell * GRID_COARSE, end = min(first + GRID_COARSE, frame.grid.fineSize);
    vec2 depthsM = surfaceDepths(cell.xy, kPyramidCoarse, gridSliceDepth(first.z), gridSliceDepth(end.z));
    if (depthsM.y < depthsM.x) {
        if (thread == 0u) coarseCells[gridCoarseIndex(cell)] = GridCell(0u, 0u, 0u);
        return;
    }
    CellBounds bounds = cellBounds(first.xy * GRID_TILE_PX, min(end.xy * GRID_TILE_PX, frame.size), depthsM);
    clearList(thread);
    for (uint slot = thread; slot < frame.lightCount; slot += GRID_GROUP) {
        LightReach light = lightReach(loadLightHot(slot));
        if (mayReach(light, slot, bounds)) markLight(slot, light.type);
    }
    uint total;
    uint at = prefixOf(markedByThread(thread), total);
    uint firstIndex = takeRoom(thread, total);
    // The index list is at least as long as all coarse lists can be.
    for (uint i = 0u; i < kWordsPerThread; ++i) {
        uint word = thread * kWordsPerThread + i;
        for (uint bits = sharedMask[word]; bits != 0u; bits &= bits - 1u) {
            gridIndices[firstIndex + at++] = word * 32u + uint(findLSB(bits));
        }
    }
    if (thread == 0u) {
        coarseCells[gridCoarseIndex(cell)] = GridCell(firstIndex, total, sharedTypes);
        atomicAdd(gridCounters[GRID_COUNTER_TESTS], frame.lightCount);
    }
}
