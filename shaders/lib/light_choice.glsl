// What a pixel may choose its lights from, and how likely each is: all of a visible list of the previous frame, the
// fresh ones, and every N-th of the grid's cell, weighted by what they would give unshadowed (the MegaLights talk,
// SIGGRAPH 2025: "Sample Guiding", "Hidden Lights", "Sampling Lights"). sample_lights chooses by it, probe shows it.
#ifndef KILOLUX_LIB_LIGHT_CHOICE_GLSL
#define KILOLUX_LIB_LIGHT_CHOICE_GLSL
#include "light_grid.glsl"
#include "noise.glsl"
#include "receiver.glsl"
#include "reprojection.glsl"
#include "sample.glsl"
#include "sampled_pixel.glsl"
#include "visible_list.glsl"
#include "../math/selection.glsl"

layout(constant_id = CHOICE_HALF_SAMPLING) const int kHalfSampling = HALF_OFF;

uniform usampler2D previousSurface;
uniform usamplerBuffer visibleLists; // RG32UI, of the previous frame
layout(scalar) readonly buffer GridCells {
    GridCell gridCells[];
};
uniform usamplerBuffer gridIndices; // R32UI
layout(scalar) readonly buffer DirectionalSlots {
    uint directionalSlots[];
};

const uint kFirstDimNumber = 256u; // dimension of a dim light's number is this and its slot; below are others

uint visibleAt; // texel of the list's first entry
uint visibleCount;
uint cellFirst;
uint cellCount;
bool gridded;

uint fetchVisibleLight(uint at) {
    return texelFetch(visibleLists, int(visibleAt + at)).x & ENTRY_SLOT_MASK;
}
uint fetchFreshLight(uint at) {
    return at < 4u ? frame.sampling.fresh0[at] : frame.sampling.fresh1[at - 4u];
}
uint fetchCellLight(uint at) {
    return gridded ? texelFetch(gridIndices, int(cellFirst + at)).x : at;
}
#include "../math/light_walk.glsl"

// The includer's: what looks at each candidate. `weight` is that before the threshold and the stride, `light` the
// unshadowed luminance of the candidate and of those that the stride left out for it.
void seeCandidate(Candidate c, float weight, float light);

// Beside the selection: what was decided on the way.
struct ChoiceState {
    SelectionBudget budget;
    PixelNoise noise;
    uint stride; // the N of every N-th light of the cell
    uint candidates;
    uint flags; // SAMPLE_*
    uint ownList; // first texel of that of the tile where the pixel was; KX_NO_LIGHT without any
};

// Walks the candidates of a pixel that has a surface. `stored`: the texel that holds its samples.
ChoiceState considerLights(Receiver receiver, uvec2 pixel, uvec2 stored, inout LightSelection selection) {
    ChoiceState state;
    SamplingConstants how = frame.sampling;
    bool atHalf = kHalfSampling != HALF_OFF;
    uint seed = pixelSeed(pixel, how.noiseFrame, frame.seed);
    Reprojection before = reproject(pixel);
    vec2 beforePx = clamp(before.uv, 0.0, 1.0) * vec2(frame.previousSize);
    float foundM = surfaceDepthM(texelFetch(previousSurface, min(ivec2(beforePx), ivec2(frame.previousSize) - 1), 0));
    float cosView = dot(receiver.surface.geoNormalWs, receiver.point.viewDirWs);
    bool missed = !before.onScreen || !sameDepth(foundM, before.depthM, cosView);

    uint first = listTexelByChance(before.uv, whiteNoise2(seed, 8u));
    bool guided = how.guiding != 0u && frame.historyValid != 0u;
    state.ownList = guided ? listTexelAt(before.uv) : KX_NO_LIGHT;
    uvec2 head = guided ? texelFetch(visibleLists, int(first)).xy : uvec2(0u, 0xffffffffu);
    visibleCount = min(head.x, LIST_CAPACITY);
    visibleAt = first + 1u;
    gridded = frame.grid.enabled != 0u;
    GridCell cell = GridCell(0u, frame.lightCount, 0u);
    if (gridded) cell = gridCells[gridCellOfPixel(pixel, receiver.depthM)];
    cellFirst = cell.first;
    cellCount = cell.count;
    state.stride = cellStride(cell.count, missed ? how.missCandidates : how.cellCandidates);
    uint offset = cellOffset(offsetNumber(stored, how.noiseFrame, frame.seed), state.stride);

    state.noise = pixelNoise(stored, how.noiseFrame, frame.seed);
    selection = beginSelection(state.noise.numbers, how.choices);
    float albedo = luminance(diffuseAlbedo(receiver.surface)), f0 = luminance(specularF0(receiver.surface));
    LightWalk walk = beginWalk(visibleCount, how.freshCount, cell.count, state.stride, offset);
    // All and edited ones of what the list says there was, and of what its lights and the fresh ones may give now.
    vec2 listed = vec2(0.0), likely = vec2(0.0);
    state.candidates = 0u;
    float sunWeights = 0.0; // of those that the tile sees, which come first
    for (uint turn = 0u;; ++turn) {
        bool directional = (kDirectionalLights || kDome) && turn < 2u * how.directionalCount; // or the dome
        if (!directional && !nextLight(walk)) break;
        bool unseen = directional && turn >= how.directionalCount;
        uint sun = unseen ? turn - how.directionalCount : turn;
        if (directional && isSeenDirectional(head, sun) == unseen) continue; // not its turn
        uint slot = directional ? directionalSlots[sun] : walk.slot;
        if (slot >= frame.lightCount) continue; // a foreign list
        LightHot light = loadOwnLightHot(slot);
        // What the past must give up: twice as much in the first frames, when all of it is another light's.
        float edited = (light.typeFlags & LIGHT_FLAG_EDITED) == 0u ? 0.0
                       : (light.typeFlags & LIGHT_FLAG_JUST_EDITED) == 0u ? 1.0 : SAMPLE_MOST_EDITED;
        if (walk.visibleEntry != KX_NO_LIGHT && !directional) {
            float energy = float(texelFetch(visibleLists, int(visibleAt + walk.visibleEntry)).y);
            listed += vec2(energy, energy * edited);
        }
        if ((kDirectionalLights || kDome) && !directional && lightIsGlobal(light)) continue;
        float unshadowed = lightWeight(light, receiver.point, albedo, f0);
        float weight = perceptualWeight(unshadowed, frame.exposure);
        // A sun behind a wall would take half of all samples, and all of a dim sky's.
        if (unseen) weight = min(weight, max(sunWeights * how.hiddenShare, how.hiddenRelaxedBelow));
        if (directional && !unseen) sunWeights += weight;
        // What is nothing here may be something at a neighbour that takes this pixel's choice.
        if (atHalf && lightReaches(light, receiver.point.positionWs))
            weight = max(weight, max(how.dimThreshold, KX_LEAST_WEIGHT));
        uint list = directional ? LIST_DIRECTIONAL : (walk.visible ? LIST_VISIBLE : LIST_HIDDEN);
        if (kDome && lightType(light) == LIGHT_DOME) list = LIST_DOME;
        if (list != LIST_HIDDEN) likely += vec2(weight, weight * edited);
        float dimNumber = weight < how.dimThreshold ? whiteNoise1(seed, kFirstDimNumber + slot) : 0.0;
        Candidate candidate = makeCandidate(slot, list, weight, state.stride, how.dimThreshold, how.dimMode, dimNumber);
        seeCandidate(candidate, weight, list == LIST_HIDDEN ? unshadowed * float(state.stride) : unshadowed);
        selectionAdd(selection, candidate);
        ++state.candidates;
    }

    state.budget = SelectionBudget(missed ? how.missHiddenShare : how.hiddenShare, guided ? arrivedShare(head) : 0.0,
                                   how.hiddenSeenShare, how.hiddenRelaxedBelow, how.directionalShare,
                                   how.directionalFreeBelow, how.domeShare);
    float editedShare = max(listed.y / max(listed.x, 1.0e-20), likely.y / max(likely.x, 1.0e-20));
    state.flags = missed ? SAMPLE_MISSED : 0u;
    if (editedShare > 0.0)
        state.flags |= SAMPLE_EDITED | uint(ceil(min(editedShare / SAMPLE_MOST_EDITED, 1.0) * 255.0)) << SAMPLE_EDITED_SHIFT;
    return state;
}

#endif
