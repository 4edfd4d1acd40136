// What the resampling baselines share: the numbers that steer them, the table from which lights are drawn by
// power, the tree down which they are found, and the packing of reservoirs.
#ifndef KILOLUX_SHARED_RESAMPLING_H
#define KILOLUX_SHARED_RESAMPLING_H
#include "base.h"

KX_SHARED_BEGIN

// --- Reservoirs: RGBA32UI --------------------------------------------------------------------------------
// x: slot, NO_RESERVOIR without a light; y: point on the light's unit square, 2 x 16 bits; z: contribution
// (float), about 1 over the probability of light and point; w: candidates that it stands for (float)
KX_CONST uint NO_RESERVOIR = 0xffffffffu;

// How a taken point is weighed by the pixels that were asked (Bitterli et al. 2020, section 4.3).
KX_CONST uint REUSE_BY_COUNTS = 0u;  // as if each could have drawn it: 1 / count, algorithm 4
KX_CONST uint REUSE_BY_TARGETS = 1u; // by what it would give each of them unshadowed
KX_CONST uint REUSE_BY_RAYS = 2u;    // by what it gives each of them: unbiased, at a ray each

// Push constants of resample_lights and reuse_reservoirs; settings of about the same names.
struct ResamplingConstants {
    uint candidates;   // lights that a pixel draws anew
    uint reuse;        // reservoirs of the frame before and of neighbours
    float mostHistory; // candidates that the frame before may stand for
    uint neighbours;
    float radiusPx; // within which they are
    uint weights;   // REUSE_BY_*
};

// An entry of the alias table (Walker 1977; Vose, "A linear algorithm for generating random numbers with a
// given distribution", 1991): an even choice of an entry gives its own slot with probability `keep`, else
// `other`.
struct LightPower {
    float keep;
    uint other;
    float probability; // that a draw gives this slot; 0 for lights without power
};

// A node of the tree of lights: a box about its lights, a cone about the directions that they look to, and
// how strong they are together (Conty Estevez and Kulla, "Importance Sampling of Many Lights with Adaptive
// Tree Splitting", HPG 2018, section 4). Children lie behind their parent, the first at once.
struct LightTreeNode {
    vec3 leastWs; // of the box, m, relative to the frame's anchor
    uint slot;    // of a leaf; NO_RESERVOIR: it has children, or there is no light at all
    vec3 mostWs;
    uint second;       // place of the second child
    vec3 axisWs;       // unit, the middle of the directions
    float intensity;   // sum of luminances, cd; distant: lux
    float cosSpread;   // of half the angle about the axis that holds all directions
    float cosEmission; // of the angle beyond it up to which they emit; at most pi / 2
    float reachM;      // of the light that reaches farthest
    uint distant;      // 1: directional lights, which have no box
};

KX_SHARED_END
#endif
