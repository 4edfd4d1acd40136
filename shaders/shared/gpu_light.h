// The light records that cross from the document to the shaders. All values are photometric and never
// pre-exposed. The hot record is what candidate weights and culling need, in exactly 64 bytes; the cold one
// holds the rest. Shaders read them only through loadLightHot(slot) and loadLightCold(slot). A third record,
// which the hot one points to, exists for lights that are shaped by more than a cone and a range.
#ifndef KILOLUX_SHARED_GPU_LIGHT_H
#define KILOLUX_SHARED_GPU_LIGHT_H
#include "base.h"
#include "channels.h"

KX_SHARED_BEGIN

// LightHot::typeFlags: low 4 bits are the type, the rest are flags.
KX_CONST uint LIGHT_DIRECTIONAL = 0u;
KX_CONST uint LIGHT_SPHERE = 1u;           // a point when sizeM.x is 0
KX_CONST uint LIGHT_SPOT = 2u;             // a sphere source shaped by a cone about dirWs
KX_CONST uint LIGHT_TUBE = 3u;             // a capsule along the tangent
KX_CONST uint LIGHT_RECT = 4u;             // one-sided, tangent is the width axis
KX_CONST uint LIGHT_DISK = 5u;             // one-sided
KX_CONST uint LIGHT_DOME = 6u;             // light from all around by a picture; at most one
KX_CONST uint LIGHT_UNIFORM_SLOTS = 1024u; // hot records that a uniform block holds: 64 KiB
KX_CONST uint LIGHT_TYPE_MASK = 15u;
KX_CONST uint LIGHT_FLAG_DEAD = 16u;   // freed or never used slot: weight 0
KX_CONST uint LIGHT_FLAG_MUTED = 32u;  // weight 0, slot kept
KX_CONST uint LIGHT_FLAG_EDITED = 64u; // changed in the last frames (setting editFrames), or just died
KX_CONST uint LIGHT_FLAG_JUST_EDITED =
    128u; // in the first frames of such edits (editFirstFrames), however long they go on
KX_CONST uint LIGHT_EPOCH_SHIFT = 8u; // the low 4 bits of the slot's epoch, which every edit raises
KX_CONST uint LIGHT_EPOCH_MASK = 15u;

KX_CONST uint LIGHT_FUNCTION_NONE = 0u;
KX_CONST uint LIGHT_FUNCTION_IMAGE = 1u;
KX_CONST uint LIGHT_FUNCTION_GRID = 2u;   // panes of a window
KX_CONST uint LIGHT_FUNCTION_BLINDS = 3u; // slats along local X
KX_CONST uint LIGHT_FUNCTION_CAUSTICS = 4u;
KX_CONST uint LIGHT_FUNCTION_FLICKER = 5u;
// Above the epoch: one more than the place of the light's LightShaping, 0 for a light without.
KX_CONST uint LIGHT_SHAPING_SHIFT = 12u;
KX_CONST uint LIGHT_MAX_SHAPINGS = 0xfffffu;

#include "light_hot.inl" // struct LightHot

#include "light_shaping.inl" // struct LightShaping

struct LightCold {
    float rayEndBiasM;   // shadow rays stop this far before the sampled point
    float penumbraScale; // of the source's size as shadow rays see it, >= 0
    uint epoch;          // increases when the slot gets a new light
    uint node;           // document light index, for views and probes
    float fluxLm;        // total emitted, luminance-weighted; directional: 0
};

KX_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(kilolux::shared::LightHot) == 64);
static_assert(sizeof(kilolux::shared::LightCold) == 20);
static_assert(sizeof(kilolux::shared::LightShaping) == 116);
#endif
#endif
