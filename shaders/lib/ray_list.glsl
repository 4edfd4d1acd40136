// How trace_samples and shade_samples find their pixel: from the list of rays, or as other passes over the picture do.
#ifndef KILOLUX_LIB_RAY_LIST_GLSL
#define KILOLUX_LIB_RAY_LIST_GLSL
#include "../shared/features.h"
#include "../shared/sampling.h"
#include "dispatch.glsl"

layout(constant_id = CHOICE_COMPACT_RAYS) const bool kCompactRays = false;

layout(scalar) readonly buffer RayListHeads {
    RayListHead rayListHeads[]; // by layer
};
uniform usamplerBuffer rayList;

const uvec2 kNoPixel = uvec2(0xffffffffu);

// Outside the picture where there is nothing to do.
uvec2 pixelOfRay(uint layer) {
    if (!kCompactRays) return dispatchedPixel();
    uint group = gl_WorkGroupID.y * RAY_GROUPS_ROW + gl_WorkGroupID.x;
    uint at = group * RAY_GROUP + gl_LocalInvocationIndex;
    if (at >= rayListHeads[layer].count) return kNoPixel;
    uint word = texelFetch(rayList, int(at)).x;
    return uvec2(word & 0xffffu, word >> 16u);
}

#endif
