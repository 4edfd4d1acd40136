// Draws a point of a light's unit square so that cells of which a sample was seen get more (mission G3 and G4): one
// split by rows, one within the row, each in halves of halves that are stretched linearly, which keeps a blue or
// stratified pattern so (Clarberg et al., "Wavelet Importance Sampling", SIGGRAPH 2005, section 4). Bit column + 4 * row
// of the mask stands for a cell of 4 x 4; masks of quarters and of columns are such masks too.
#ifndef KILOLUX_MATH_AREA_MASK_GLSL
#define KILOLUX_MATH_AREA_MASK_GLSL
#include "reservoir.glsl"

const float KX_BELOW_HALF = 0.49999997; // the largest float under 0.5
const uint KX_ALL_CELLS = 0xffffu;

// The cell of a point, as the number of its bit.
KX_INLINE uint areaMaskCell(vec2 uv) {
    return min(uint(uv.x * 4.0), 3u) + 4u * min(uint(uv.y * 4.0), 3u);
}

// Quarters of which a cell was seen, whole.
KX_INLINE uint areaMaskQuarters(uint mask) {
    uint lowest = (mask | mask >> 1u | mask >> 4u | mask >> 5u) & 0x0505u;
    return lowest * 0x33u;
}

// The same of the four columns.
KX_INLINE uint areaMaskColumns(uint mask) {
    return ((mask | mask >> 4u | mask >> 8u | mask >> 12u) & 15u) * 0x1111u;
}

KX_INLINE float areaMaskCount(uint mask) {
    uint pairs = (mask & 0x5555u) + (mask >> 1u & 0x5555u);
    uint fours = (pairs & 0x3333u) + (pairs >> 2u & 0x3333u);
    uint eights = (fours & 0x0f0fu) + (fours >> 4u & 0x0f0fu);
    return float((eights & 255u) + (eights >> 8u));
}

// Probability of a hidden (x) and of a visible cell (y). A hidden quarter gets `hiddenShare` (0.1), the visible cells
// share the rest evenly: with 1, 2, 3 visible quarters one gets 0.7, 0.4, 0.3. With none visible nothing is known: all
// get the same, as where all are. The share is kept above 0, or what is hidden could never be seen again.
KX_INLINE vec2 areaMaskShares(uint mask, float hiddenShare) {
    float count = areaMaskCount(mask);
    if (count == 0.0) return vec2(0.0625);
    float hidden = 0.25 * clamp(hiddenShare, 0.001, 0.25);
    return vec2(hidden, (1.0 - hidden * (16.0 - count)) / count);
}

// Of the cells of a row, and of the four rows.
KX_INLINE vec4 areaMaskRow(uint mask, uint row, vec2 shares) {
    uint cells = mask >> (4u * row);
    float more = shares.y - shares.x;
    return vec4(shares.x) + vec4(float(cells & 1u), float(cells >> 1u & 1u), float(cells >> 2u & 1u),
                                 float(cells >> 3u & 1u)) * more;
}

KX_INLINE vec4 areaMaskRows(uint mask, vec2 shares) {
    float more = shares.y - shares.x;
    return vec4(4.0 * shares.x) +
           vec4(areaMaskCount(mask & 15u), areaMaskCount(mask >> 4u & 15u), areaMaskCount(mask >> 8u & 15u),
                areaMaskCount(mask >> 12u & 15u)) * more;
}

// Where the lower half of four parts ends, and where the first part ends within the lower (y) and the upper (z) half.
KX_INLINE vec3 areaMaskSplits(vec4 parts) {
    float lower = parts.x + parts.y, upper = parts.z + parts.w;
    return vec3(lower / (lower + upper), parts.x / lower, parts.z / upper);
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

// The same of four parts, each of which becomes a quarter.
KX_INLINE float fourthsFromSplits(float number, vec3 splits) {
    float halves = halvesFromSplit(number, splits.x);
    float base = halves >= 0.5 ? 1.0 : 0.0;
    float inside = halvesFromSplit(2.0 * halves - base, base > 0.0 ? splits.z : splits.y);
    return min(0.5 * (base + inside), KX_BELOW_ONE);
}

KX_INLINE float splitsFromFourths(float at, vec3 splits) {
    float base = at >= 0.5 ? 1.0 : 0.0;
    float inside = splitFromHalves(2.0 * at - base, base > 0.0 ? splits.z : splits.y);
    return splitFromHalves(min(0.5 * (base + inside), base > 0.0 ? KX_BELOW_ONE : KX_BELOW_HALF), splits.x);
}

KX_INLINE float areaMaskPdfOfCell(uint mask, uint cell, vec2 shares) {
    return 16.0 * ((mask >> cell & 1u) != 0u ? shares.y : shares.x);
}

KX_INLINE MaskedPoint areaMaskWarp(vec2 number, uint mask, float hiddenShare) {
    vec2 shares = areaMaskShares(mask, hiddenShare);
    MaskedPoint p;
    p.uv.y = fourthsFromSplits(number.y, areaMaskSplits(areaMaskRows(mask, shares)));
    uint row = areaMaskCell(vec2(0.0, p.uv.y)) / 4u;
    p.uv.x = fourthsFromSplits(number.x, areaMaskSplits(areaMaskRow(mask, row, shares)));
    p.pdf = areaMaskPdfOfCell(mask, areaMaskCell(p.uv), shares);
    return p;
}

// Density of areaMaskWarp at uv, for weights of points that came by another way.
KX_INLINE float areaMaskPdf(vec2 uv, uint mask, float hiddenShare) {
    return areaMaskPdfOfCell(mask, areaMaskCell(uv), areaMaskShares(mask, hiddenShare));
}

// The number that areaMaskWarp takes to uv.
KX_INLINE vec2 areaMaskUnwarp(vec2 uv, uint mask, float hiddenShare) {
    vec2 shares = areaMaskShares(mask, hiddenShare);
    vec3 across = areaMaskSplits(areaMaskRow(mask, areaMaskCell(uv) / 4u, shares));
    return vec2(splitsFromFourths(uv.x, across), splitsFromFourths(uv.y, areaMaskSplits(areaMaskRows(mask, shares))));
}

#endif
