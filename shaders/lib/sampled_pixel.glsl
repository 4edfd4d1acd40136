// Which pixels choose lights in a frame: below one ray per pixel only every second or fourth, and at half
// resolution one of each 2 x 2. The patterns change from frame to frame so that every pixel has its turn.
#ifndef KILOLUX_LIB_SAMPLED_PIXEL_GLSL
#define KILOLUX_LIB_SAMPLED_PIXEL_GLSL
#include "../math/hash.glsl"
#include "../shared/features.h"

// The order in which the four pixels of a 2 x 2 block take turns: across, so that two frames make a checkerboard.
uint turnInBlock(uvec2 pixel) {
    uint place = (pixel.x & 1u) + 2u * (pixel.y & 1u);
    return place == 0u ? 0u : (place == 3u ? 1u : (place == 1u ? 2u : 3u));
}

bool isSampledPixel(uvec2 pixel, uint pixelsPerRay, uint frameIndex) {
    if (pixelsPerRay <= 1u) return true;
    uint start = hashCombine(pixel.x >> 1u, pixel.y >> 1u); // blocks out of step with one another
    uint turn = (frameIndex + start) & 3u;
    uint mine = turnInBlock(pixel);
    return pixelsPerRay == 2u ? (mine >> 1u) == (turn & 1u) : mine == turn;
}

// The full-resolution pixel that stands for a half-resolution one. Checkerboard: the diagonals in turn, so that
// rows and columns of the full picture are all met over two neighbours. Rooks: in blocks of 2 x 2 half pixels
// every row and column of the 4 x 4 full ones is met once (four rooks that do not threaten one another).
uvec2 halfResolutionPixel(uvec2 halfPixel, int pattern, uint frameIndex) {
    uint place = (halfPixel.x & 1u) + 2u * (halfPixel.y & 1u);
    uvec2 within;
    if (pattern == HALF_CHECKERBOARD) {
        uint turn = frameIndex & 3u;
        uint parity = (halfPixel.x + halfPixel.y + turn) & 1u;
        uint flip = turn >> 1u;
        within = uvec2(parity ^ flip, flip);
    } else {
        within = uvec2(place >> 1u, (place ^ place >> 1u) & 1u);
        uint turn = hashCombine(frameIndex, 0x51u) & 3u;
        within ^= uvec2(turn & 1u, turn >> 1u);
    }
    return min(halfPixel * 2u + within, frame.size - 1u);
}

#endif
