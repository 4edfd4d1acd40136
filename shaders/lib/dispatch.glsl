// How compute passes over the picture find their pixel.
#ifndef KILOLUX_LIB_DISPATCH_GLSL
#define KILOLUX_LIB_DISPATCH_GLSL
#include "../shared/features.h"
#include "frame.glsl"
#include "tile_order.glsl"

uvec2 dispatchedPixelOf(uvec2 tiles) {
    uvec2 tile = dispatchedTile(tiles, frame.tileChunks);
    return tile * 8u + blockedPixel(gl_LocalInvocationIndex, 2u);
}

// Pixel of an invocation of an 8 x 8 workgroup in a dispatch over frame.tiles. May lie outside the picture.
uvec2 dispatchedPixel() {
    return dispatchedPixelOf(frame.tiles);
}

bool isInPicture(uvec2 pixel) {
    return all(lessThan(pixel, frame.size));
}

// The same for passes that mostly read and write images: CPU drivers keep them row by row, and their threads find
// 64 successive pixels in the cache lines and prefetched streams that 8 rows of 8 are not in (denoise_temporal and
// composite take 0.7 and 0.5 of the time so). Pictures of up to 2^24 pixels.
layout(constant_id = CHOICE_PIXEL_ROWS) const bool kPixelRows = false;
uvec2 streamedPixelOf(uvec2 size) {
    uvec2 tiles = (size + 7u) / 8u;
    if (!kPixelRows) return dispatchedTile(tiles, frame.tileChunks) * 8u + gl_LocalInvocationID.xy;
    uint run = interleavedTile(dispatchedGroup(tiles), uvec2(tiles.x * tiles.y, 1u), frame.tileChunks).x;
    uint at = run * 64u + gl_LocalInvocationIndex;
    uint row = quotientOf24Bits(at, size.x);
    return uvec2(at - row * size.x, row);
}

uvec2 streamedPixel() {
    return streamedPixelOf(frame.size);
}

// For passes over the shown picture, which may be larger than the part that the frame renders.
uvec2 streamedOutputPixel() {
    return streamedPixelOf(frame.outputSize);
}

bool isInOutput(uvec2 pixel) {
    return all(lessThan(pixel, frame.outputSize));
}

// Where a shown pixel's centre lies in the rendered part, in its pixels.
vec2 renderedFromOutput(uvec2 pixel) {
    return (vec2(pixel) + 0.5) * (vec2(frame.size) / vec2(frame.outputSize));
}

#endif
