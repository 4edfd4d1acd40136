// The tracer's data as the shaders read it: a two-wide BVH with boxes of 16 bits per plane, leaves of
// triangle pairs, and entries that place one BVH in another. Every buffer is a texel buffer of 16-byte
// texels.
#ifndef KILOLUX_SHARED_BVH_H
#define KILOLUX_SHARED_BVH_H
#include "base.h"
#include "channels.h"

KX_SHARED_BEGIN

// A reference names what a traversal visits next. The top two bits are its kind:
//   0, 1  inner node: the index of a BvhNode
//   2     leaf: pair count - 1 (3 bits), index of its first BvhPair (27 bits)
//   3     entry: enter (bit 29 clear) or return to (bit 29 set) the space of a BvhEntry
KX_CONST uint BVH_REF_LEAF = 0x80000000u;
KX_CONST uint BVH_REF_ENTER = 0xC0000000u;
KX_CONST uint BVH_REF_RETURN = 0xE0000000u;
KX_CONST uint BVH_REF_DONE = 0xFFFFFFFFu;
KX_CONST uint BVH_LEAF_COUNT_SHIFT = 27u;
KX_CONST uint BVH_LEAF_FIRST_MASK = 0x07FFFFFFu;
KX_CONST uint BVH_ENTRY_MASK = 0x1FFFFFFFu;
KX_CONST uint BVH_MAX_LEAF_PAIRS = 8u;
// Pushes on the deepest path: one per level of the top level (18 for 65,536 moving instances), a return, one
// per level of an entered BVH (40) and of the grids that nest in it (3).
KX_CONST uint BVH_STACK_SIZE = 64u;

KX_CONST uint BVH_NODE_TEXELS = 2u;
KX_CONST uint BVH_PAIR_TEXELS = 3u;
KX_CONST uint BVH_ENTRY_TEXELS = 6u;
KX_CONST uint ALPHA_RECORD_TEXELS = 4u;
KX_CONST uint ALPHA_TRIANGLE_TEXELS = 2u;

// Two child boxes on the entry's grid: plane = gridMin + gridStep * q, low q in the low half word, high q in
// the high one.
struct BvhNode {
    uvec3 box0; // x, y, z
    uint ref0;
    uvec3 box1;
    uint ref1;
};

// Triangles (a, b, c) and (c, b, d) share the edge b c. A lone triangle has d = c.
struct BvhPair {
    vec3 a; // metres, in the space of the BVH
    vec3 b;
    vec3 c;
    vec3 d;
};

// Id of each triangle of a pair: index within the entry (29 bits), then how the corners were turned to fit
// the pair (0 to 2 rotations; + 3 when corners 1 and 2 were exchanged first; 3 bits). The texel has one word
// each.
KX_CONST uint BVH_ID_TURN_BITS = 3u;
KX_CONST uint BVH_ID_TURN_MASK = 7u;
// Ids of alpha-tested triangles carry the top bit.
KX_CONST uint BVH_ID_ALPHA = 0x80000000u;
KX_CONST uint BVH_ID_NONE = 0x7FFFFFFFu;

// A BVH in its own space. local = linear * (world - pivotWs) + pivotLs: subtracting the pivot first keeps the
// rounding error relative to the distance from the instance, not from the world's origin.
struct BvhEntry {
    vec3 linear0; // rows of the linear part
    vec3 linear1;
    vec3 linear2;
    vec3 pivotWs; // metres
    vec3 pivotLs;
    vec3 gridMin;
    vec3 gridStep;
    uint rootRef;
    uint firstTriangle; // added to the ids of its triangles: gives the id over all instances
    uint unused;
};

// Per instance: id of its first triangle, and its alpha record or this. Above that the lighting channels of
// its mesh.
KX_CONST uint ALPHA_RECORD_NONE = 0x00FFFFFFu;
KX_CONST uint TRACE_CHANNELS_SHIFT = 24u;
struct TraceInstance {
    uint firstTriangle;
    uint alphaRecordAndChannels;
};

KX_CONST uint ALPHA_WRAP_REPEAT = 0u;
KX_CONST uint ALPHA_WRAP_CLAMP = 1u;
KX_CONST uint ALPHA_WRAP_MIRROR = 2u;
KX_CONST uint ALPHA_WRAP_T_SHIFT = 2u;
KX_CONST uint ALPHA_FLAG_NEAREST = 16u;

// How an alpha-tested instance finds its alpha: factor * texel(uv) * vertex alpha, tested against the cutoff.
struct AlphaRecord {
    uint firstTexel; // into the R8 alpha texels
    uint width;      // texels; 0 when the material has no texture
    uint height;
    uint flags;   // ALPHA_WRAP_* of s, of t << ALPHA_WRAP_T_SHIFT, ALPHA_FLAG_*
    vec3 uvRow0;  // u' = dot(uvRow0, (u, v, 1))
    float factor; // base colour alpha
    vec3 uvRow1;
    float cutoff;
    uint firstTriangle; // into the alpha triangles
    uvec3 unused;
};

// Corner attributes of an alpha-tested triangle, in the primitive's own corner order.
struct AlphaTriangle {
    vec2 uv0;
    vec2 uv1;
    vec2 uv2;
    uint alpha8x3; // vertex alpha of corner 0, 1, 2 as unorm8, low byte first
    uint unused;
};

KX_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(kilolux::shared::BvhNode) == 16 * kilolux::shared::BVH_NODE_TEXELS);
static_assert(sizeof(kilolux::shared::BvhPair) == 16 * kilolux::shared::BVH_PAIR_TEXELS);
static_assert(sizeof(kilolux::shared::BvhEntry) == 16 * kilolux::shared::BVH_ENTRY_TEXELS);
static_assert(sizeof(kilolux::shared::AlphaRecord) == 16 * kilolux::shared::ALPHA_RECORD_TEXELS);
static_assert(sizeof(kilolux::shared::AlphaTriangle) == 16 * kilolux::shared::ALPHA_TRIANGLE_TEXELS);
#endif
#endif
