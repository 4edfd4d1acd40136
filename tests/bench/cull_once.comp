#version 460
// The light grid in one pass, for comparison: a group of threads per fine cell walks all lights, without coarse cells.
// For tests/bench/grid_bench.cpp.
#include "shared/features.h"
#include "lib/light_cull.glsl"

layout(local_size_x = 64) in;
layout(scalar) writeonly buffer GridCells {
    GridCell gridCells[];
};
layout(scalar) writeonly buffer GridIndices {
    uint gridIndices[];
};

void main() {
    uint thread = groupThread();
    uvec3 cell = gl_WorkGroupID;
    vec2 depthsM = surfaceDepths(cell.xy, kPyramidFine, gridSliceDepth(cell.z), gridSliceDepth(cell.z + 1u));
    if (depthsM.y < depthsM.x) {
        if (thread == 0u) gridCells[gridFineIndex(cell)] = GridCell(0u, 0u, 0u);
        return;
    }
    CellBounds bounds = cellBounds(cell.xy * GRID_TILE_PX, min((cell.xy + 1u) * GRID_TILE_PX, frame.size), depthsM);
    clearList(thread);
    for (uint slot = thread; slot < frame.lightCount; slot += GRID_GROUP) {
        LightReach light = lightReach(loadLightHot(slot));
        if (mayReach(light, slot, bounds)) markLight(slot, light.type);
    }
    uint total;
    uint at = prefixOf(markedByThread(thread), total);
    uint firstIndex = takeRoom(thread, total);
    bool fits = firstIndex + total <= frame.grid.capacity;
    for (uint i = 0u; fits && i < kWordsPerThread; ++i) {
        uint word = thread * kWordsPerThread + i;
        for (uint bits = sharedMask[word]; bits != 0u; bits &= bits - 1u) {
            gridIndices[firstIndex + at++] = word * 32u + uint(findLSB(bits));
        }
    }
    if (thread == 0u) {
        gridCells[gridFineIndex(cell)] = GridCell(firstIndex, fits ? total : 0u, sharedTypes);
        atomicAdd(gridCounters[GRID_COUNTER_TESTS], frame.lightCount);
    }
}
