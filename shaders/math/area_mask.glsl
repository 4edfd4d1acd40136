// Draws a point of a light's unit square so that quarters of which a sample was seen get more (mission G3):
// one split by rows, one within the row, each stretched linearly, which keeps a blue or stratified pattern so
// (Clarberg et al., "Wavelet Importance Sampling", SIGGRAPH 2005, section 4). Bit column + 2 * row of the
// mask stands for the quarter, column 1 from u = 0.5 and row 1 from v = 0.5 on.
#ifndef KILOLUX_MATH_AREA_MASK_GLSL
#define KILOLUX_MATH_AREA_MASK_GLSL
#include "reservoir.glsl"

const float KX_BELOW_HALF = 0.49999997; // the largest float under 0.5

// Probability of each quarter. Hidden quarters get `hiddenShare` each (0.1), the visible ones share the rest
// evenly: with 1, 2, 3 visible a visible one gets 0.7, 0.4, 0.3. With none visible nothing is known: all get
// 0.25, as with four. The share is kept above 0, or what is hidden could never be seen again.
KX_INLINE vec4 areaMaskShares(uint mask, float hiddenShare) {
    vec4 seen =
        vec4(float(mask & 1u), float((mask >> 1u) & 1u), float((mask >> 2u) & 1u), float((mask >> 3u) & 1u));
    float count = seen.x + seen.y + seen.z + seen.w;
    if (count == 0.0) return vec4(0.25);
    float hidden = clamp(hiddenShare, 0.001, 0.25);
    float visible = (1.0 - hidden * (4.0 - count)) / count;
    return vec4(hidden) + seen * (visible - hidden);
}

// The quarter of a point, as the number of its bit.
KX_INLINE uint areaMaskQuarter(vec2 uv) {
    return (uv.x >= 0.5 ? 1u : 0u) + (uv.y >= 0.5 ? 2u : 0u);
}

// Stretches [0, split) to the lower half and the rest to the upper half. A device's division may round up
// by a few ulps, out of the half; where it is rounded correctly the ends change nothing.
KX_INLINE float halvesFromSplit(float number, float split) {
    return number < split ? min(0.5 * number / split, KX_BELOW_HALF)
                          : min(0.5 + 0.5 * (number - split) / (1.0 - split), KX_BELOW_ONE);
}

KX_INLINE float splitFromHalves(float at, float split) {
    return at < 0.5 ? min(2.0 * at * split, KX_BELOW_ONE)
                    : min(split + (2.0 * at - 1.0) * (1.0 - split), KX_BELOW_ONE);
}

// Where the lower row ends, and where the left column ends within the lower (y) and the upper (z) row.
KX_INLINE vec3 areaMaskSplits(vec4 shares) {
    float lower = shares.x + shares.y;
    return vec3(lower, shares.x / lower, shares.z / (shares.z + shares.w));
}

KX_INLINE MaskedPoint areaMaskWarp(vec2 number, uint mask, float hiddenShare) {
    vec4 shares = areaMaskShares(mask, hiddenShare);
    vec3 splits = areaMaskSplits(shares);
    MaskedPoint p;
    float v = halvesFromSplit(number.y, splits.x);
    bool upper = v >= 0.5;
    float u = halvesFromSplit(number.x, upper ? splits.z : splits.y);
    p.uv = vec2(u, v);
    float left = upper ? shares.z : shares.x;
    float right = upper ? shares.w : shares.y;
    p.pdf = 4.0 * (u >= 0.5 ? right : left);
    return p;
}

// Density of areaMaskWarp at uv, for weights of points that came by another way.
KX_INLINE float areaMaskPdf(vec2 uv, uint mask, float hiddenShare) {
    vec4 shares = areaMaskShares(mask, hiddenShare);
    float left = uv.y >= 0.5 ? shares.z : shares.x;
    float right = uv.y >= 0.5 ? shares.w : shares.y;
    return 4.0 * (uv.x >= 0.5 ? right : left);
}

// The number that areaMaskWarp takes to uv.
KX_INLINE vec2 areaMaskUnwarp(vec2 uv, uint mask, float hiddenShare) {
    vec3 splits = areaMaskSplits(areaMaskShares(mask, hiddenShare));
    return vec2(splitFromHalves(uv.x, uv.y >= 0.5 ? splits.z : splits.y), splitFromHalves(uv.y, splits.x));
}

#endif
