#version 460
// One level of the depth pyramid: nearest (x) and farthest (y) linear depth of the 2 x 2 texels below, with the
// odd last row and column taken in, so that no texel of the level below is left out.
#include "shared/frame.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push {
    uvec2 sourceSize; // of the part that this frame uses
    uvec2 targetSize;
    uint firstLevel; // 1: the source is gDepth
};
uniform sampler2D gDepth;
layout(rg32f) readonly uniform image2D pyramidIn;
layout(rg32f) writeonly uniform image2D pyramidOut;

void main() {
    uvec2 target = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(target, targetSize))) return;
    ivec2 first = ivec2(target * 2u);
    ivec2 last = ivec2(sourceSize) - 1;
    ivec2 span = ivec2(target.x + 1u == targetSize.x ? int(sourceSize.x) - first.x : 2,
                       target.y + 1u == targetSize.y ? int(sourceSize.y) - first.y : 2);
    vec2 range = vec2(DEPTH_SKY, 0.0);
    for (int y = 0; y < span.y; ++y) {
        for (int x = 0; x < span.x; ++x) {
            ivec2 at = min(first + ivec2(x, y), last);
            vec2 depth = firstLevel != 0u ? texelFetch(gDepth, at, 0).xx : imageLoad(pyramidIn, at).xy;
            range = vec2(min(range.x, depth.x), max(range.y, depth.y));
        }
    }
    imageStore(pyramidOut, ivec2(target), vec4(range, 0.0, 0.0));
}
