#version 460
// Lights of the fine cells of each coarse cell, from its list. A group of threads first gathers the cells in which the
// depth pyramid shows a surface, the others stay empty. Then, by the length of the list, each thread fills a cell of
// its own, or all together fill one after another. A cell without room in the index list takes its coarse cell's.
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

shared uint sharedCells; // with surfaces
shared uint sharedCellIndex[GRID_GROUP];
shared CellBounds sharedBounds[GRID_GROUP];
shared LightReach sharedLights[GRID_GROUP];

void gatherCells(uint thread) {
    if (thread == 0u) sharedCells = 0u;
    barrier();
    const uint kSide = GRID_COARSE;
    uvec3 cell = gl_WorkGroupID * kSide + uvec3(thread % kSide, thread / kSide % kSide, thread / (kSide * kSide));
    if (all(lessThan(cell, frame.grid.fineSize))) {
        vec2 depthsM = surfaceDepths(cell.xy, kPyramidFine, gridSliceDepth(cell.z), gridSliceDepth(cell.z + 1u));
        if (depthsM.y < depthsM.x) {
            gridCells[gridFineIndex(cell)] = GridCell(0u, 0u, 0u);
        } else {
            uint at = atomicAdd(sharedCells, 1u);
            uvec2 endPx = min((cell.xy + 1u) * GRID_TILE_PX, frame.size);
            sharedBounds[at] = cellBounds(cell.xy * GRID_TILE_PX, endPx, depthsM);
            sharedCellIndex[at] = gridFineIndex(cell);
        }
    }
    barrier();
}

// Whether the list has room; else the cell takes its coarse cell's.
bool writeCell(uint index, GridCell cell, GridCell coarse) {
    bool fits = cell.first + cell.count <= frame.grid.capacity;
    gridCells[index] = fits ? cell : coarse;
    if (!fits) atomicAdd(gridCounters[GRID_COUNTER_COARSE], 1u);
    return fits;
}

void fillByThreads(uint thread, GridCell coarse) {
    bool busy = thread < sharedCells;
    CellBounds bounds = sharedBounds[busy ? thread : 0u];
    uint count = 0u, types = 0u;
    for (uint first = 0u; first < coarse.count; first += GRID_GROUP) {
        barrier();
        if (first + thread < coarse.count) {
            sharedLights[thread] = lightReach(loadLightHot(gridIndices[coarse.first + first + thread]));
        }
        barrier();
        uvec2 bits = uvec2(0u);
        for (uint i = 0u; busy && i < min(GRID_GROUP, coarse.count - first); ++i) {
            LightReach light = sharedLights[i];
            if (!mayReach(light, gridIndices[coarse.first + first + i], bounds)) continue;
            bits |= i < 32u ? uvec2(1u << i, 0u) : uvec2(0u, 1u << (i - 32u));
            types |= 1u << light.type;
        }
        // Two words of the mask, read by this thread alone.
        sharedMask[(first >> 5u) * GRID_GROUP + thread] = bits.x;
        sharedMask[((first >> 5u) + 1u) * GRID_GROUP + thread] = bits.y;
        count += uint(bitCount(bits.x) + bitCount(bits.y));
    }
    uint total;
    uint at = prefixOf(count, total);
    at += takeRoom(thread, total);
    if (!busy || !writeCell(sharedCellIndex[thread], GridCell(at, count, types), coarse)) return;
    for (uint word = 0u; word * 32u < coarse.count; ++word) {
        for (uint bits = sharedMask[word * GRID_GROUP + thread]; bits != 0u; bits &= bits - 1u) {
            gridIndices[at++] = gridIndices[coarse.first + word * 32u + uint(findLSB(bits))];
        }
    }
}

void fillByGroup(uint thread, uint place, GridCell coarse) {
    CellBounds bounds = sharedBounds[place];
    clearList(thread);
    for (uint i = thread; i < coarse.count; i += GRID_GROUP) {
        uint slot = gridIndices[coarse.first + i];
        LightReach light = lightReach(loadLightHot(slot));
        if (mayReach(light, slot, bounds)) markLight(i, light.type);
    }
    uint total;
    uint at = prefixOf(markedByThread(thread), total);
    uint firstIndex = takeRoom(thread, total);
    bool fits = firstIndex + total <= frame.grid.capacity;
    for (uint i = 0u; fits && i < kWordsPerThread; ++i) {
        uint word = thread * kWordsPerThread + i;
        for (uint bits = sharedMask[word]; bits != 0u; bits &= bits - 1u) {
            gridIndices[firstIndex + at++] = gridIndices[coarse.first + word * 32u + uint(findLSB(bits))];
        }
    }
    if (thread == 0u) writeCell(sharedCellIndex[place], GridCell(firstIndex, total, sharedTypes), coarse);
    barrier(); // the next cell clears the mask
}

void main() {
    uint thread = groupThread();
    GridCell coarse = coarseCells[gridCoarseIndex(gl_WorkGroupID)];
    gatherCells(thread);
    uint cells = sharedCells;
    if (coarse.count <= frame.grid.threadLights) {
        fillByThreads(thread, coarse);
    } else {
        for (uint place = 0u; place < cells; ++place) fillByGroup(thread, place, coarse);
    }
    if (thread == 0u) atomicAdd(gridCounters[GRID_COUNTER_TESTS], cells * coarse.count);
}
