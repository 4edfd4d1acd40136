// How compute passes over the picture find their pixel.
#ifndef KILOLUX_LIB_DISPATCH_GLSL
#define KILOLUX_LIB_DISPATCH_GLSL
#include "frame.glsl"
#include "tile_order.glsl"

// Pixel of an invocation of an 8 x 8 workgroup in a one-dimensional dispatch over frame.tiles. May lie outside
// the picture: such lanes stay alive for barriers and subgroup operations.
uvec2 dispatchedPixel() {
    return interleavedTile(gl_WorkGroupID.x, frame.tiles, frame.tileChunks) * 8u + gl_LocalInvocationID.xy;
}

bool isInPicture(uvec2 pixel) {
    return all(lessThan(pixel, frame.size));
}

// The same for passes over the shown picture, which may be larger than the part that the frame renders.
uvec2 dispatchedOutputPixel() {
    return interleavedTile(gl_WorkGroupID.x, (frame.outputSize + 7u) / 8u, frame.tileChunks) * 8u +
           gl_LocalInvocationID.xy;
}

bool isInOutput(uvec2 pixel) {
    return all(lessThan(pixel, frame.outputSize));
}

// Where a shown pixel's centre lies in the rendered part, in its pixels.
vec2 renderedFromOutput(uvec2 pixel) {
    return (vec2(pixel) + 0.5) * (vec2(frame.size) / vec2(frame.outputSize));
}

#endif
