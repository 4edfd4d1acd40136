// Walks the lights that a pixel evaluates: all of its visible list, all fresh ones (just edited), and every
// N-th of its grid cell, by least slot, each light once. Lists are taken as sorted; of one that is not, only
// the entries above all before them count, so that a broken visible list costs guiding but never a light.
//
// The includer declares what reads the lists, each called with an index below the count given to beginWalk:
//     uint fetchVisibleLight(uint at);  // slots; KX_NO_LIGHT for empty entries
//     uint fetchFreshLight(uint at);
//     uint fetchCellLight(uint at);     // strictly increasing, as the stride counts entries
#ifndef KILOLUX_MATH_LIGHT_WALK_GLSL
#define KILOLUX_MATH_LIGHT_WALK_GLSL
#include "prelude.glsl"

const uint KX_NO_LIGHT = 0xffffffffu;

// Make it with beginWalk; nextLight sets the first three.
struct LightWalk {
    uint slot;      // the light to evaluate
    bool visible;   // it is on the visible or the fresh list; else it is a hidden one, of the cell only
    uint visibleEntry; // its index on the visible list, KX_NO_LIGHT if it is not on that one
    uint visibleCount, freshCount, cellCount;
    uint stride;                           // the N of every N-th, at least 1
    uint visibleAt, freshAt, cellAt;       // where each list stands,
    uint visibleSlot, freshSlot, cellSlot; // and the slot there, KX_NO_LIGHT at its end
};

// Each moves to the next entry of at least `least`.
KX_INLINE void seekVisible(INOUT(LightWalk) w, uint least) {
    w.visibleSlot = KX_NO_LIGHT;
    for (; w.visibleAt < w.visibleCount; ++w.visibleAt) {
        uint slot = fetchVisibleLight(w.visibleAt);
        if (slot >= least && slot != KX_NO_LIGHT) {
            w.visibleSlot = slot;
            return;
        }
    }
}

KX_INLINE void seekFresh(INOUT(LightWalk) w, uint least) {
    w.freshSlot = KX_NO_LIGHT;
    for (; w.freshAt < w.freshCount; ++w.freshAt) {
        uint slot = fetchFreshLight(w.freshAt);
        if (slot >= least && slot != KX_NO_LIGHT) {
            w.freshSlot = slot;
            return;
        }
    }
}

KX_INLINE void seekCell(INOUT(LightWalk) w, uint least) {
    w.cellSlot = KX_NO_LIGHT;
    for (; w.cellAt < w.cellCount; w.cellAt += w.stride) {
        uint slot = fetchCellLight(w.cellAt);
        if (slot >= least && slot != KX_NO_LIGHT) {
            w.cellSlot = slot;
            return;
        }
    }
}

// `stride` from cellStride() and `offset` from cellOffset().
KX_INLINE LightWalk beginWalk(uint visibleCount, uint freshCount, uint cellCount, uint stride, uint offset) {
    LightWalk w;
    w.slot = KX_NO_LIGHT;
    w.visible = false;
    w.visibleEntry = KX_NO_LIGHT;
    w.visibleCount = visibleCount;
    w.freshCount = freshCount;
    w.cellCount = cellCount;
    w.stride = max(stride, 1u);
    w.visibleAt = 0u;
    w.freshAt = 0u;
    w.cellAt = offset;
    seekVisible(w, 0u);
    seekFresh(w, 0u);
    seekCell(w, 0u);
    return w;
}

// False when no light is left.
KX_INLINE bool nextLight(INOUT(LightWalk) w) {
    uint slot = min(min(w.visibleSlot, w.freshSlot), w.cellSlot);
    w.slot = slot;
    if (slot == KX_NO_LIGHT) return false;
    bool onVisible = w.visibleSlot == slot;
    bool onFresh = w.freshSlot == slot;
    w.visible = onVisible || onFresh;
    w.visibleEntry = onVisible ? w.visibleAt : KX_NO_LIGHT;
    if (onVisible) seekVisible(w, slot + 1u);
    if (onFresh) seekFresh(w, slot + 1u);
    if (w.cellSlot == slot) seekCell(w, slot + 1u);
    return true;
}

#endif
