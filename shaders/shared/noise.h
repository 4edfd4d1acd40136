// Size of the project's masks of blue noise (content/blue_noise.bin), for the program that makes them, the
// loader and the shaders.
#ifndef KILOLUX_SHARED_NOISE_H
#define KILOLUX_SHARED_NOISE_H
#include "base.h"

KX_SHARED_BEGIN

const uint NOISE_TILE_PX = 64u; // width and height; a power of two
const uint NOISE_LAYERS = 32u;  // frames until values repeat; a power of two

KX_SHARED_END

#endif
