// Chooses lights for a pixel from a stream of candidates: perceptual weights, a threshold for dim ones, one
// reservoir each for visible, hidden and directional lights, merged under budgets (the MegaLights talk,
// SIGGRAPH 2025: "Hidden Lights", "Directional Light", "Sampling Lights"). Every choice carries its exact
// probability, so budgets, strides and thresholds change the variance and never the mean; only DIM_DROP does.
#ifndef KILOLUX_MATH_SELECTION_GLSL
#define KILOLUX_MATH_SELECTION_GLSL
#include "reservoir.glsl"

// What a reservoir's winner is called while the reservoirs themselves are drawn from.
const uint KX_WINNER_HIDDEN = 0xfffffffeu;
const uint KX_WINNER_DIRECTIONAL = 0xfffffffdu;
const uint KX_WINNER_DOME = 0xfffffffcu;

#ifndef KX_HAS_DOME
#define KX_HAS_DOME true
#endif

const float KX_LEAST_SHARE = 0.0009765625;  // of the samples: a budget of 0 would make the mean wrong
const float KX_LEAST_PROBABILITY = 1.0e-30; // below, 1 / probability could be infinite

// log2(1 + x) of the exposed luminance of unshadowed BRDF x light. Below 1/16 by series, as 1 + x would round
// x away; relative error under 1e-5, and positive for every positive x. Infinite x are cut.
KX_INLINE float perceptualWeight(float luminance, float exposure) {
    float x = luminance * exposure;
    if (!(x > 0.0)) return 0.0;
    float series = x * (1.0 - x * (0.5 - x * (0.33333333 - x * 0.25))) * 1.44269504;
    float weight = x < 0.0625 ? series : log2(1.0 + min(x, 1.0e30));
    return max(weight, KX_LEAST_WEIGHT);
}

// Exposed luminance of a weight: the inverse, for thresholds that are stated in what one sees.
KX_INLINE float luminanceFromWeight(float weight) {
    float x = weight * 0.69314718;
    return weight < 0.03125 ? x * (1.0 + x * (0.5 + x * 0.16666667)) : exp2(weight) - 1.0;
}

// Light that the hard drop would lose here; add up over a pixel's candidates, times their factors.
KX_INLINE float hardDropLoss(float contribution, float weight, float threshold) {
    return weight < threshold ? contribution : 0.0;
}

// `weight` is perceptualWeight(), `stride` the N of every N-th light for LIST_HIDDEN (others are always
// candidates, and it is not used), `dimNumber` a uniform number of this light's own, used under the
// threshold. A dim weight is raised to the threshold with probability weight / threshold, else it is 0: a
// light that is hardly ever chosen then never counts for more than one at the threshold.
KX_INLINE Candidate makeCandidate(uint item, uint list, float weight, uint stride, float threshold,
                                  uint dimMode, float dimNumber) {
    Candidate c;
    c.item = item;
    c.list = list;
    c.weight = weight;
    c.factor = 1.0;
    if (weight < threshold && dimMode != DIM_KEEP) {
        bool survives = dimMode == DIM_ROULETTE && dimNumber * threshold < weight;
        c.weight = survives ? threshold : 0.0;
        c.factor = survives ? threshold / weight : 0.0;
    }
    if (list == LIST_HIDDEN) {
        c.weight *= float(stride);
        c.factor *= float(stride);
    }
    c.weight = min(c.weight, KX_LARGEST_WEIGHT);
    return c;
}

// The N that evaluates at most `most` of `count` lights of a cell; one for all candidates of a pixel.
KX_INLINE uint cellStride(uint count, uint most) {
    uint divisor = max(most, 1u);
    return max((count + divisor - 1u) / divisor, 1u);
}

// The first light: even over 0 .. stride - 1, so each light is a candidate with probability 1 / stride. The
// number must be independent of those of the selection and of the choice of a tile.
KX_INLINE uint cellOffset(float number, uint stride) {
    return min(uint(number * float(stride)), stride - 1u);
}

// The numbers are uniform and independent of one another: for visible, hidden, directional lights. The first
// one's property matters most: it decides between lists as well.
KX_INLINE LightSelection beginSelection(vec3 numbers, uint sampleCount) {
    LightSelection s;
    s.visibleSum = 0.0;
    s.hiddenSum = 0.0;
    s.directionalSum = 0.0;
    s.domeSum = 0.0;
    s.domeFactor = 1.0;
    s.domeItem = KX_NO_ITEM;
    s.sampleCount = min(sampleCount, uint(KX_MAX_SAMPLES));
    for (uint i = 0u; i < s.sampleCount; ++i) {
        s.visible[i] = emptyReservoir(ditheredNumber(numbers.x, i, s.sampleCount));
        s.hidden[i] = emptyReservoir(rotatedNumber(numbers.y, i, s.sampleCount));
        s.directional[i] = emptyReservoir(rotatedNumber(numbers.z, i, s.sampleCount));
    }
    return s;
}

KX_INLINE void selectionAdd(INOUT(LightSelection) s, Candidate c) {
    if (!(c.weight >= KX_LEAST_WEIGHT)) return;
    if (KX_HAS_DOME && c.list == LIST_DOME) {
        s.domeSum = c.weight;
        s.domeFactor = c.factor;
        s.domeItem = c.item;
        return;
    }
    bool hidden = c.list == LIST_HIDDEN;
    bool directional = c.list == LIST_DIRECTIONAL;
    float sumBefore = directional ? s.directionalSum : (hidden ? s.hiddenSum : s.visibleSum);
    for (uint i = 0u; i < s.sampleCount; ++i) {
        Reservoir local = s.visible[i]; if(hidden) local = s.hidden[i];
        Reservoir changed = local; if (directional) changed = s.directional[i];
        reservoirAdd(changed, sumBefore, c.item, c.weight, c.factor);
        if (directional)
            s.directional[i] = changed;
        else if (hidden)
            s.hidden[i] = changed;
        else
            s.visible[i] = changed;
    }
    float sum = sumBefore + c.weight;
    if (directional)
        s.directionalSum = sum;
    else if (hidden)
        s.hiddenSum = sum;
    else
        s.visibleSum = sum;
}

// `sum` so that it gets at most `share` beside `others`. One that is not 0 stays so, or its lights were lost.
KX_INLINE float cappedSum(float sum, float others, float share) {
    float given = clamp(share, KX_LEAST_SHARE, KX_BELOW_ONE);
    float capped = min(sum, given / (1.0 - given) * others);
    return sum > 0.0 ? max(capped, KX_LEAST_WEIGHT) : 0.0;
}

// What the hidden and the directional sum count for when the lists are merged. Under hiddenRelaxedBelow the
// cap stays that of the threshold, so that the hidden share rises without a step to 1 where nothing is
// visible.
KX_INLINE vec2 budgetedSums(float visibleSum, float hiddenSum, float directionalSum, SelectionBudget budget) {
    float hidden = hiddenSum;
    if (visibleSum > 0.0) {
        float others = max(visibleSum, budget.hiddenRelaxedBelow);
        float seen = cappedSum(hiddenSum * budget.hiddenArriving, others, budget.hiddenSeenShare);
        hidden = max(cappedSum(hiddenSum, others, budget.hiddenShare), seen);
    }
    float local = visibleSum + hidden;
    float directional = directionalSum;
    if (local > 0.0 && local >= budget.directionalFreeBelow)
        directional = cappedSum(directionalSum, local, budget.directionalShare);
    return vec2(hidden, directional);
}

// What the dome counts for beside the others as they are merged. Local lights hold it down, directional ones do not.
KX_INLINE float budgetedDome(float domeSum, float localSum, float directionalSum, SelectionBudget budget) {
    if (!(localSum > 0.0) || localSum < budget.directionalFreeBelow) return domeSum;
    return cappedSum(domeSum, localSum + directionalSum, budget.domeShare);
}

// The probability that selectionSample() takes a candidate of this list and weight (its stride contained). `sums` are
// those of the selection: visible, hidden, directional, dome.
KX_INLINE float candidateProbability(vec4 sums, SelectionBudget budget, uint list, float weight) {
    if (!(weight >= KX_LEAST_WEIGHT)) return 0.0;
    vec2 given = budgetedSums(sums.x, sums.y, sums.z, budget);
    float dome = KX_HAS_DOME ? budgetedDome(sums.w, sums.x + given.x, given.y, budget) : 0.0;
    float total = max(sums.x + given.x + given.y + dome, KX_LEAST_WEIGHT);
    if (list == LIST_DOME) return dome / total;
    if (list == LIST_HIDDEN) return given.x / total * (weight / sums.y);
    if (list == LIST_DIRECTIONAL) return given.y / total * (weight / sums.z);
    return weight / total;
}

// The index-th sample of the pixel, once all candidates have been added. The hidden and the directional
// winner and the dome are offered to the visible reservoir as one item each, with what is left of the visible list's
// number, which so decides alone wherever that list is all there is.
KX_INLINE LightChoice selectionSample(LightSelection s, SelectionBudget budget, uint index) {
    vec2 sums = budgetedSums(s.visibleSum, s.hiddenSum, s.directionalSum, budget);
    Reservoir winner = s.visible[index];
    reservoirAdd(winner, s.visibleSum, KX_WINNER_HIDDEN, sums.x, 1.0);
    reservoirAdd(winner, s.visibleSum + sums.x, KX_WINNER_DIRECTIONAL, sums.y, 1.0);
    float dome = KX_HAS_DOME ? budgetedDome(s.domeSum, s.visibleSum + sums.x, sums.y, budget) : 0.0;
    if (KX_HAS_DOME) reservoirAdd(winner, s.visibleSum + sums.x + sums.y, KX_WINNER_DOME, dome, 1.0);
    LightChoice choice;
    choice.item = winner.item;
    choice.list = LIST_VISIBLE;
    choice.number = winner.number;
    choice.probability = winner.weight / max(s.visibleSum + sums.x + sums.y + dome, KX_LEAST_WEIGHT);
    choice.weight = winner.weight;
    float factor = winner.factor;
    if (winner.item == KX_WINNER_HIDDEN) {
        choice.item = s.hidden[index].item;
        choice.list = LIST_HIDDEN;
        choice.probability *= s.hidden[index].weight / s.hiddenSum;
        factor = s.hidden[index].factor;
        choice.weight = s.hidden[index].weight;
    } else if (winner.item == KX_WINNER_DIRECTIONAL) {
        choice.item = s.directional[index].item;
        choice.list = LIST_DIRECTIONAL;
        choice.probability *= s.directional[index].weight / s.directionalSum;
        factor = s.directional[index].factor;
        choice.weight = s.directional[index].weight;
    } else if (KX_HAS_DOME && winner.item == KX_WINNER_DOME) {
        choice.item = s.domeItem;
        choice.list = LIST_DOME;
        factor = s.domeFactor;
        choice.weight = s.domeSum;
    }
    choice.contribution = choice.probability > KX_LEAST_PROBABILITY ? factor / choice.probability : 0.0;
    return choice;
}

#endif
