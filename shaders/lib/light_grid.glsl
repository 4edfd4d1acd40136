// Cells of the light grid: which one a point lies in, and what a cell's corners are.
#ifndef KILOLUX_LIB_LIGHT_GRID_GLSL
#define KILOLUX_LIB_LIGHT_GRID_GLSL
#include "../shared/light_grid.h"
#include "frame.glsl"

uint gridSlice(float depthM) {
    float slice = log2(max(depthM / frame.grid.firstDepthM, 1.0)) * frame.grid.slicesPerOctave;
    return depthM < frame.grid.firstDepthM ? 0u : min(1u + uint(slice), GRID_SLICES - 1u);
}

// Depth at which a slice begins; `slice` may be GRID_SLICES.
float gridSliceDepth(uint slice) {
    if (slice == 0u) return 0.0;
    float depthM = frame.grid.firstDepthM * exp2(float(slice - 1u) / frame.grid.slicesPerOctave);
    return slice >= GRID_SLICES ? max(depthM, frame.grid.lastDepthM) : depthM;
}

uint gridFineIndex(uvec3 cell) {
    return (cell.z * frame.grid.fineSize.y + cell.y) * frame.grid.fineSize.x + cell.x;
}

uint gridCoarseIndex(uvec3 cell) {
    return (cell.z * frame.grid.coarseSize.y + cell.y) * frame.grid.coarseSize.x + cell.x;
}

uint gridCellOfPixel(uvec2 pixel, float depthM) {
    return gridFineIndex(uvec3(pixel / GRID_TILE_PX, gridSlice(depthM)));
}

#endif
