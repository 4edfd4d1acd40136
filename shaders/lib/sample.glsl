// A pixel's light samples as they lie in the image `samples`; see shared/sampling.h.
#ifndef KILOLUX_LIB_SAMPLE_GLSL
#define KILOLUX_LIB_SAMPLE_GLSL
#include "../math/selection_types.glsl"
#include "frame.glsl"

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

// What the denoiser is told of a pixel, by the texel of its first sample. x: 1 sampled, 0.5 reconstructed, 0 without a
// turn (its texel is all 0; one without any light has at least a point). y: frames that its history may hold.
// The setting is for light that was edited as a whole: half of it in the first frames, more for a part of it.
vec2 sampledState(uvec4 texel) {
    bool sampled = (texel.y | texel.z) != 0u;
    float valid = !sampled ? 0.0 : ((texel.x & SAMPLE_RECONSTRUCTED) != 0u ? 0.5 : 1.0);
    float editedShare = float(texel.x >> SAMPLE_EDITED_SHIFT) * (SAMPLE_MOST_EDITED / 255.0);
    float frames = editedShare > 0.0 ? frame.sampling.editHistory / editedShare : HISTORY_FREE_FRAMES;
    return vec2(valid, min(frames, HISTORY_FREE_FRAMES));
}

#endif
