// A pixel's light samples as they lie in the image `samples`; see shared/sampling.h.
#ifndef KILOLUX_LIB_SAMPLE_GLSL
#define KILOLUX_LIB_SAMPLE_GLSL
#include "../math/selection_types.glsl"
#include "../shared/sampling.h"

struct StoredSample {
    uint slot;
    uint list;  // LIST_*
    uint flags; // SAMPLE_EDITED and the like
    vec2 uv;
    float contribution; // 0 without a light
    float weight;
};

uvec4 packSample(StoredSample s) {
    return uvec4(s.slot | s.list << SAMPLE_LIST_SHIFT | s.flags, packUnorm2x16(s.uv), floatBitsToUint(s.contribution),
                 floatBitsToUint(s.weight));
}

StoredSample unpackSample(uvec4 texel) {
    return StoredSample(texel.x & SAMPLE_SLOT_MASK, texel.x >> SAMPLE_LIST_SHIFT & SAMPLE_LIST_MASK,
                        texel.x & ~(SAMPLE_SLOT_MASK | SAMPLE_LIST_MASK << SAMPLE_LIST_SHIFT), unpackUnorm2x16(texel.y),
                        uintBitsToFloat(texel.z), uintBitsToFloat(texel.w));
}

#endif
