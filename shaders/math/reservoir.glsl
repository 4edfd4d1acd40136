// Weighted reservoir sampling with one random number for a whole list. Each decision splits the number's
// range and stretches the part taken back to [0, 1), so that one lookup of blue noise serves any number of
// lights (Ogaki, "Vectorized Reservoir Sampling", SIGGRAPH Asia 2021). Several samples of a pixel split the
// number first (Georgiev and Fajardo, "Blue-noise Dithered Sampling", SIGGRAPH 2016).
#ifndef KILOLUX_MATH_RESERVOIR_GLSL
#define KILOLUX_MATH_RESERVOIR_GLSL
#include "hash.glsl"
#include "selection_types.glsl"

const float KX_BELOW_ONE = 0.99999994;  // the largest float under 1
const float KX_LEAST_WEIGHT = 1.0e-20;  // far from where dividing by it would give infinities
const float KX_PRODUCT_SCALE = 1.0e+10; // of weights: keeps products of two least and of two largest in range
const float KX_LARGEST_WEIGHT = 1.0e+6; // an exposed luminance of 1e30 has weight 100

KX_INLINE Reservoir emptyReservoir(float number) {
    Reservoir r;
    r.item = KX_NO_ITEM;
    r.weight = 0.0;
    r.before = 0.0;
    r.factor = 0.0;
    r.number = number;
    return r;
}

// Offers an item to a reservoir that has seen weights of `sumBefore`; weights below KX_LEAST_WEIGHT count as
// 0. Afterwards item i is held with probability weight_i / sum.
//
// When a new item wins, the plain method forgets which one lost, and with it the bits of the earlier choices:
// over n equal lights log2(n)^2 / 2.9 + 1.44 ln(n) in all, 30 for 256 of them. Here the rest of the number
// becomes where in the list of losers it stood. The map from the number to (item, rest) is then one to one, a
// choice costs no more than its log2(1 / probability) bits, and an item's range falls into at most as many
// pieces as there are items instead of exponentially many, so that blue noise keeps more of its spectrum.
// Measured in float, 256 equal lights, numbers of 16 bits: shares wrong by at most 6 % and 0.09 bits lost
// beyond log2(256) (plain: 39 % and 2.0); of 24 bits: 0.4 % and 0.004 (plain: 11 % and 1.8).
KX_INLINE void reservoirAdd(INOUT(Reservoir) r, float sumBefore, uint item, float weight, float factor) {
    if (!(weight >= KX_LEAST_WEIGHT)) return;
    float at = r.number * (sumBefore + weight);
    bool taken = at < weight || sumBefore <= 0.0;
    // One division for both cases: two cost a twentieth of a candidate more on CPU drivers.
    float scaled = weight * KX_PRODUCT_SCALE;
    float rest = taken ? r.before * scaled + at * (r.weight * KX_PRODUCT_SCALE) : (at - weight) * scaled;
    float stretched = rest * KX_PRODUCT_SCALE / max(sumBefore * KX_PRODUCT_SCALE * scaled, KX_LEAST_WEIGHT);
    r.number = min(sumBefore > 0.0 ? stretched : r.number, KX_BELOW_ONE);
    r.item = taken ? item : r.item;
    r.weight = taken ? weight : r.weight;
    r.before = taken ? sumBefore : r.before;
    r.factor = taken ? factor : r.factor;
}

// The number of the index-th of `count` samples of a pixel: one in each of count equal ranges, so uniform
// over all samples together but not for one of them. Two consequences: only one decision of a sample may be
// made so, and where the samples go to different pixels, which goes where must be shuffled evenly at random.
KX_INLINE float ditheredNumber(float number, uint index, uint count) {
    return min((float(index) + number) / float(count), KX_BELOW_ONE);
}

// The same for a sample's further decisions: also one in each range, but each sample is uniform by itself,
// and so independent of the range that ditheredNumber put it in.
KX_INLINE float rotatedNumber(float number, uint index, uint count) {
    return min(fract(number + float(index) / float(count)), KX_BELOW_ONE);
}

// The point of the index-th of `count` samples: a rank-1 lattice of golden ratio, shifted by the noise around
// the square. Each is uniform by itself.
KX_INLINE vec2 rotatedPoint(vec2 number, uint index, uint count) {
    return vec2(rotatedNumber(number.x, index, count),
                min(fract(number.y + float(index) * 0.61803399), KX_BELOW_ONE));
}

// Blue noise of 16 bits, continued with 8 white ones. Without them a light of probability 1e-5 would get none
// of the 65,536 values, or one too many, for as long as the mask repeats.
KX_INLINE float numberFromNoise16(uint noise16, uint whiteBits) {
    return unitFloat((noise16 << 16u) | (whiteBits >> 16u));
}

#endif
