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

#endif
