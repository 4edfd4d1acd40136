// The structs of light selection (reservoir.glsl, selection.glsl, area_mask.glsl). Only declarations, so that
// C++ code compiled with double literals can read them in float too. An includer that takes few samples
// defines KX_MAX_SAMPLES first: the arrays live in registers.
#ifndef KILOLUX_MATH_SELECTION_TYPES_GLSL
#define KILOLUX_MATH_SELECTION_TYPES_GLSL

#ifndef KX_MAX_SAMPLES
#define KX_MAX_SAMPLES 16 // per pixel
#endif

const uint KX_NO_ITEM = 0xffffffffu;

// Which reservoir a candidate goes to.
const uint LIST_VISIBLE = 0u;     // on the visible list, or fresh
const uint LIST_HIDDEN = 1u;      // from the grid cell only
const uint LIST_DIRECTIONAL = 2u; // any directional light, whatever list it is on
const uint LIST_DOME = 3u;        // the dome, of which there is at most one

// What happens to weights under the threshold.
const uint DIM_ROULETTE = 0u; // unbiased
const uint DIM_DROP = 1u;     // loses hardDropLoss()
const uint DIM_KEEP = 2u;

// One choice among a stream of weighted items. Make it with emptyReservoir.
struct Reservoir {
    uint item;    // KX_NO_ITEM until one with a weight has come
    float weight; // of item
    float before; // sum of the weights that came before item
    float factor; // of item: 1 over the probability that it became a candidate with this weight
    float number; // uniform in [0, 1) whatever was chosen: what the choices so far have left of it
};

// A light that may be chosen. Make it with makeCandidate.
struct Candidate {
    uint item; // the caller's: a slot, or anything that leads to one; below 0xfffffff0
    uint list; // LIST_*
    float weight;
    float
        factor; // what makes its contribution right on average: the stride, and the roulette's 1/probability
};

// Caps on the share of the samples, and the sums of weights under which they give way.
struct SelectionBudget {
    float hiddenShare;          // of the local lights' samples, [0, 1]: 0.2; 0.5 where reprojection failed
    float hiddenArriving;       // of the rays to lights off a full list, [0, 1]: as much of them counts as visible
    float hiddenSeenShare;      // the cap on that part, [0, 1]: 0.8
    float hiddenRelaxedBelow;   // sum of visible weights; below it the share rises, to 1 at 0
    float directionalShare;     // of all samples, [0, 1]: 0.5
    float directionalFreeBelow; // sum of local weights, as merged; below it there is no cap
    float domeShare; // of all samples, [0, 1]: 0.5, with the same freedom
};

// The state of a pixel while it walks its candidates. Make it with beginSelection.
struct LightSelection {
    float visibleSum;
    float hiddenSum;
    float directionalSum;
    float domeSum; // the only candidate of its list
    float domeFactor;
    uint domeItem;
    uint sampleCount; // at most KX_MAX_SAMPLES
    Reservoir visible[KX_MAX_SAMPLES];
    Reservoir hidden[KX_MAX_SAMPLES];
    Reservoir directional[KX_MAX_SAMPLES];
};

// One chosen light, right on average over all of a pixel's samples. Light from it = BRDF x emission x
// visibility at a point, times contribution.
struct LightChoice {
    uint item;          // KX_NO_ITEM: nothing to choose from
    uint list;          // LIST_*
    float probability;  // that this sample takes this light, given the pixel's candidates; 0 without a light
    float contribution; // the candidate's factor / probability; 0 without a light
    float number;       // uniform in [0, 1) whatever was chosen, for further decisions
    float weight;       // the candidate's, its stride contained; 0 without a light
};

// The random numbers of a pixel in a frame (noise_tile.glsl, lib/noise.glsl), each uniform in [0, 1). For any
// more take whiteNoise1 and 2 of the same pixelSeed, at dimensions from 4 on.
struct PixelNoise {
    vec3 numbers; // for beginSelection: visible, hidden, directional list
    vec2 point;   // on the light
};

// A point of the unit square drawn through an area mask.
struct MaskedPoint {
    vec2 uv;
    float pdf; // over the square: 1 on average; its inverse belongs into the sample's weight
};

#endif
