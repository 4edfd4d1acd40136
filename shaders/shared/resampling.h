// What the resampling baselines share: the numbers that steer them, the table from which lights are drawn by
// power, and the packing of reservoirs.
#ifndef KILOLUX_SHARED_RESAMPLING_H
#define KILOLUX_SHARED_RESAMPLING_H
#include "base.h"

KX_SHARED_BEGIN

// --- Reservoirs: RGBA32UI --------------------------------------------------------------------------------
// x: slot, NO_RESERVOIR without a light; y: point on the light's unit square, 2 x 16 bits; z: contribution
// (float), about 1 over the probability of light and point; w: candidates that it stands for (float)
KX_CONST uint NO_RESERVOIR = 0xffffffffu;

// Push constants of resample_lights and reuse_reservoirs; settings of about the same names.
struct ResamplingConstants {
    uint candidates;   // lights that a pixel draws anew
    uint byPower;      // of all lights, by power; else evenly of those of the pixel's cell
    uint reuse;        // reservoirs of the frame before and of neighbours
    float mostHistory; // candidates that the frame before may stand for
    uint neighbours;
    float radiusPx; // within which they are
    uint unbiased;  // weighted by who could have drawn what was taken, at a ray each
};

// An entry of the alias table (Walker 1977; Vose, "A linear algorithm for generating random numbers with a
// given distribution", 1991): an even choice of an entry gives its own slot with probability `keep`, else
// `other`.
struct LightPower {
    float keep;
    uint other;
    float probability; // that a draw gives this slot; 0 for lights without power
};

KX_SHARED_END
#endif
