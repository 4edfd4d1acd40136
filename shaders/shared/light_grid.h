// The light grid: froxels of the view, each with a sorted list of the lights that may reach it. Coarse cells
// are blocks of fine ones; a fine cell without room of its own points at its coarse cell's list.
#ifndef KILOLUX_SHARED_LIGHT_GRID_H
#define KILOLUX_SHARED_LIGHT_GRID_H
#include "base.h"

KX_SHARED_BEGIN

KX_CONST uint GRID_TILE_PX = 32u;       // width and height of a fine cell, pixels
KX_CONST uint GRID_SLICES = 24u;        // in depth: evenly spaced in log2 of linear depth
KX_CONST uint GRID_COARSE = 4u;         // fine cells along each side of a coarse one
KX_CONST uint GRID_MAX_LIGHTS = 16384u; // more lights than this are walked without a grid
KX_CONST uint GRID_GROUP = 64u; // threads that fill a coarse cell, and then its GRID_COARSE^3 fine ones
KX_CONST uint GRID_MAX_THREAD_LIGHTS =
    GRID_MAX_LIGHTS / GRID_GROUP; // longest coarse list that a thread walks alone

struct GridCell {
    uint first;    // into the index list
    uint count;    // lights, sorted by slot
    uint typeMask; // bit per LIGHT_* type: for shaders by class of tile, which lavapipe gains nothing by
};

// Words of the buffer `GridCounters`.
KX_CONST uint GRID_COUNTER_USED = 0u;   // indices asked for, coarse and fine; may exceed the capacity
KX_CONST uint GRID_COUNTER_COARSE = 1u; // cells that point at a coarse list for want of room
KX_CONST uint GRID_COUNTER_TESTS = 2u;  // light-cell tests of both passes
KX_CONST uint GRID_COUNTER_COUNT = 4u;

// What a frame knows of its grid; part of FrameConstants.
struct GridConstants {
    uvec3 fineSize; // cells
    uvec3 coarseSize;
    float firstDepthM; // the first slice ends here
    float slicesPerOctave;
    float lastDepthM; // the last slice reaches at least this far
    uint capacity;    // indices
    uint enabled;
    uint threadLights; // coarse lists up to this long go to the fine cells by a thread each, longer ones by
                       // the group
};

KX_SHARED_END
#endif
