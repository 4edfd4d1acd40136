// What the passes of stochastic direct lighting share: the numbers that steer sampling, the packing of
// samples and of the visible light lists.
#ifndef KILOLUX_SHARED_SAMPLING_H
#define KILOLUX_SHARED_SAMPLING_H
#include "base.h"

KX_SHARED_BEGIN

// --- Samples: RGBA32UI, one layer per ray of a pixel -----------------------------------------------------
// x: slot in the low 16 bits, list (LIST_* of math/selection_types.glsl) in bits 16 and 17, SAMPLE_* flags
// y: point on the light's unit square, 2 x 16 bits; what lightSample() was given
// z: contribution (float): 1 over the probabilities of light and point, over the rays; 0 without a light
// w: perceptual weight of the light here (float)
KX_CONST uint SAMPLE_SLOT_MASK = 0xffffu;
KX_CONST uint SAMPLE_LIST_SHIFT = 16u;
KX_CONST uint SAMPLE_LIST_MASK = 3u;
KX_CONST uint SAMPLE_EDITED = 1u << 18u; // a light that reaches the pixel, or did, was just edited
// Share of such lights in the pixel's light, in the first frames counted SAMPLE_MOST_EDITED times: 8 bits for
// what goes up to that, rounded up.
KX_CONST uint SAMPLE_EDITED_SHIFT = 24u;
KX_CONST float SAMPLE_MOST_EDITED = 2.0f;
KX_CONST uint SAMPLE_MISSED = 1u << 19u;        // reprojection failed
KX_CONST uint SAMPLE_RECONSTRUCTED = 1u << 20u; // no neighbour fitted when samples were brought to full size
KX_CONST uint SAMPLE_LIGHT_LIMIT = 0xffffu;     // slots below this fit

// What became of a sample: R32UI, one layer per ray.
KX_CONST uint RAY_NONE = 0u;    // nothing was traced: no light, or it is behind the surface
KX_CONST uint RAY_VISIBLE = 1u; // with the cell of the light's unit square in 4 bits from RAY_CELL_SHIFT
KX_CONST uint RAY_HIDDEN = 2u;
KX_CONST uint RAY_STATE_MASK = 3u;
KX_CONST uint RAY_CELL_SHIFT = 2u;

// --- List of rays: a word per ray, x | y << 16 of its pixel, by tiles and in them by light --------------
KX_CONST uint RAY_TILE_PX = 32u;
KX_CONST uint RAY_GROUP = 64u;         // rays that a workgroup takes
KX_CONST uint RAY_GROUPS_ROW = 32768u; // workgroups in a dispatch's first dimension

// How long the list is. The first three words are the arguments of an indirect dispatch over it.
struct RayListHead {
    uint groupsX;
    uint groupsY;
    uint groupsZ;
    uint count;
};

// --- Visible light lists: RG32UI texels, LIST_TEXELS a tile ---------------------------------------------
// Texel 0, the head: entries, and what lib/visible_list.glsl packs beside. Then the entries, sorted by slot:
// x: slot, epoch and age; y: energy, the sum over visible samples of their weights times 256
// From texel LIST_CELLS_AT on, in the same order, what was seen of each light in the present window of
// ENTRY_WINDOW frames (low 16 bits) and in the window before (high): x: cells of its unit square, a bit each
// (math/area_mask.glsl); y: visible samples
KX_CONST uint LIST_TILE_PX = 8u;
KX_CONST uint LIST_CAPACITY = 32u;
KX_CONST uint LIST_CELLS_AT = 33u;
KX_CONST uint LIST_TEXELS = 65u;
KX_CONST uint ENTRY_SLOT_MASK = 0xffffu;
KX_CONST uint ENTRY_EPOCH_SHIFT = 16u; // 4 bits, as LIGHT_EPOCH_MASK of gpu_light.h
KX_CONST uint ENTRY_AGE_SHIFT = 20u;   // frames since a sample of it was last seen, 0 to 15
KX_CONST uint ENTRY_WINDOW = 8u;
KX_CONST uint SEEN_OLDER_SHIFT = 16u; // of both words: the window before
KX_CONST uint SEEN_MASK = 0xffffu;

KX_CONST uint FRESH_LIGHTS = 8u; // that there is room for

// Settings of the same names; see renderer/settings_table.cpp for ranges and defaults.
struct SamplingConstants {
    uint rays; // per pixel that is sampled
    uint
        choices; // samples that one evaluation of the candidates yields: rays, or 4 x rays at half resolution
    uint pixelsPerRay; // 1; 2 or 4: only every so many pixels are sampled, another one each frame
    uint guiding;
    uint areaMasks;
    float maskHiddenShare;
    float maskSizeTiles; // least length of a light with a mask of quarters; twice that: of 4 x 4 cells
    float maskSamples;   // visible ones that a mask needs for each of its cells
    float hiddenShare;
    float missHiddenShare;
    float hiddenSeenShare;
    float hiddenRelaxedBelow; // a weight
    float directionalShare;
    float directionalFreeBelow; // a weight
    float domeShare;
    uint cellCandidates;
    uint missCandidates;
    float dimThreshold;   // a weight
    uint dimMode;         // DIM_*
    uint listLength;      // at most LIST_CAPACITY
    uint listMemory;      // frames that an entry stays without being seen
    float editHistory;    // frames that a history may hold where all light was edited
    float upsampleDepth;  // halvings per share of the depth
    float upsampleNormal; // power of the cosine
    float upsampleLeast;  // likeness
    float upsampleReachPx;
    uint noiseFrame; // stands still when the noise is frozen
    uint directionalCount;
    uint freshCount;
    uvec4 fresh0; // slots of the lights edited in the last frames, ascending
    uvec4 fresh1;
};

KX_SHARED_END
#endif
