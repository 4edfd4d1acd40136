#version 460
// Chooses the lights that a pixel's rays go to: all of a visible list of the previous frame, the fresh ones, and
// every N-th of the grid's cell, weighted by what they would give unshadowed (the MegaLights talk, SIGGRAPH 2025:
// "Sample Guiding", "Hidden Lights", "Sampling Lights", "Downsampled Sampling"). At half resolution one pixel of
// each 2 x 2 chooses for all four.
#include "shared/features.h"
#include "lib/dispatch.glsl"

layout(constant_id = CHOICE_HALF_SAMPLING) const int kHalfSampling = HALF_OFF;

#include "lib/count.glsl"
#include "lib/light_grid.glsl"
#include "lib/noise.glsl"
#include "lib/receiver.glsl"
#include "lib/reprojection.glsl"
#include "lib/sample.glsl"
#include "lib/sampled_pixel.glsl"
#include "lib/visible_list.glsl"
#include "math/area_mask.glsl"
#include "math/selection.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D previousDepth;
uniform usamplerBuffer visibleLists; // RG32UI, of the previous frame
layout(scalar) readonly buffer GridCells {
    GridCell gridCells[];
};
uniform usamplerBuffer gridIndices; // R32UI
layout(scalar) readonly buffer DirectionalSlots {
    uint directionalSlots[];
};
layout(rgba32ui) writeonly uniform uimage2DArray samplesOut;

uint visibleAt; // texel of the list's first entry
uint cellFirst;
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
#include "math/light_walk.glsl"

// The item that a candidate is known by: the slot, and above it the mask of its visible quarters.
const uint ITEM_MASK_SHIFT = 16u;

// The mask that an entry gives a light: none where it is not to be trusted.
uint maskOfEntry(VisibleEntry entry, LightHot light) {
    bool current = entry.epoch == (light.typeFlags >> LIGHT_EPOCH_SHIFT & LIGHT_EPOCH_MASK);
    return current && frame.sampling.areaMasks != 0u ? entry.recent | entry.older : 0u;
}

void main() {
    bool atHalf = kHalfSampling != HALF_OFF;
    uvec2 tiles = atHalf ? (frame.tiles + 1u) / 2u : frame.tiles;
    uvec2 pixel = interleavedTile(gl_WorkGroupID.x, tiles, frame.tileChunks) * 8u + gl_LocalInvocationID.xy;
    if (any(greaterThanEqual(pixel, atHalf ? (frame.size + 1u) / 2u : frame.size))) return;
    uvec2 stored = pixel; // texel of the samples
    SamplingConstants how = frame.sampling;
    if (atHalf) pixel = halfResolutionPixel(pixel, kHalfSampling, how.noiseFrame);
    Receiver receiver = loadReceiver(pixel);
    bool hasTurn = atHalf || isSampledPixel(pixel, how.pixelsPerRay, how.noiseFrame);
    if (!receiver.exists || !hasTurn) {
        for (uint i = 0u; i < how.choices; ++i)
            imageStore(samplesOut, ivec3(stored, i), uvec4(0u));
        return;
    }
    uint seed = pixelSeed(pixel, how.noiseFrame, frame.seed);
    Reprojection before = reproject(pixel);
    float foundM = texelFetch(previousDepth, ivec2(before.uv * vec2(frame.previousSize)), 0).x;
    float cosView = dot(receiver.surface.geoNormalWs, receiver.point.viewDirWs);
    bool missed = !before.onScreen || !sameDepth(foundM, before.depthM, cosView);

    uint first = listTexelByChance(before.uv, whiteNoise2(seed, 8u));
    uint visibleCount = how.guiding != 0u && frame.historyValid != 0u ? texelFetch(visibleLists, int(first)).x : 0u;
    visibleCount = min(visibleCount, LIST_CAPACITY);
    visibleAt = first + 1u;
    gridded = frame.grid.enabled != 0u;
    GridCell cell = GridCell(0u, frame.lightCount, 0u);
    if (gridded) cell = gridCells[gridCellOfPixel(pixel, receiver.depthM)];
    cellFirst = cell.first;
    uint stride = cellStride(cell.count, missed ? how.missCandidates : how.cellCandidates);
    uint offset = cellOffset(whiteNoise1(seed, 9u), stride);

    PixelNoise noise = pixelNoise(stored, how.noiseFrame, frame.seed);
    LightSelection selection = beginSelection(noise.numbers, how.choices);
    float albedo = luminance(diffuseAlbedo(receiver.surface)), f0 = luminance(specularF0(receiver.surface));
    LightWalk walk = beginWalk(visibleCount, how.freshCount, cell.count, stride, offset);
    // All and edited ones of what the list says there was, and of what its lights and the fresh ones may give now.
    vec2 listed = vec2(0.0), likely = vec2(0.0);
    uint candidates = 0u;
    for (uint sun = 0u;; ++sun) {
        bool directional = kDirectionalLights && sun < how.directionalCount;
        if (!directional && !nextLight(walk)) break;
        uint slot = directional ? directionalSlots[sun] : walk.slot;
        if (slot >= frame.lightCount) continue; // a foreign list
        LightHot light = loadOwnLightHot(slot);
        bool isEdited = (light.typeFlags & LIGHT_FLAG_EDITED) != 0u;
        uint mask = 0u;
        if (walk.maskEntry != KX_NO_LIGHT && !directional) {
            uvec2 entry = texelFetch(visibleLists, int(visibleAt + walk.maskEntry)).xy;
            float energy = float(entry.y);
            listed += vec2(energy, isEdited ? energy : 0.0);
            mask = maskOfEntry(unpackEntry(entry.x), light);
        }
        if (kDirectionalLights && !directional && lightType(light) == LIGHT_DIRECTIONAL) continue;
        float unshadowed = lightWeight(light, receiver.point, albedo, f0);
        float weight = perceptualWeight(unshadowed, frame.exposure);
        // What is nothing here may be something at a neighbour that takes this pixel's choice.
        if (atHalf && lightReaches(light, receiver.point.positionWs))
            weight = max(weight, max(how.dimThreshold, KX_LEAST_WEIGHT));
        uint list = directional ? LIST_DIRECTIONAL : (walk.visible ? LIST_VISIBLE : LIST_HIDDEN);
        if (list != LIST_HIDDEN) likely += vec2(weight, isEdited ? weight : 0.0);
        float dimNumber = weight < how.dimThreshold ? whiteNoise1(seed, 16u + slot) : 0.0;
        selectionAdd(selection, makeCandidate(slot | mask << ITEM_MASK_SHIFT, list, weight, stride, how.dimThreshold,
                                              how.dimMode, dimNumber));
        ++candidates;
    }

    SelectionBudget budget = SelectionBudget(missed ? how.missHiddenShare : how.hiddenShare, how.hiddenRelaxedBelow,
                                             how.directionalShare, how.directionalFreeBelow);
    float editedShare = max(listed.y / max(listed.x, 1.0e-20), likely.y / max(likely.x, 1.0e-20));
    uint flags = missed ? SAMPLE_MISSED : 0u;
    if (editedShare > 0.0) flags |= SAMPLE_EDITED | uint(ceil(min(editedShare, 1.0) * 255.0)) << SAMPLE_EDITED_SHIFT;
    uint chosen = 0u;
    for (uint i = 0u; i < how.choices; ++i) {
        LightChoice choice = selectionSample(selection, budget, i);
        StoredSample s = StoredSample(0u, LIST_VISIBLE, flags, vec2(0.5), 0.0, 0.0);
        if (choice.item != KX_NO_ITEM) {
            s.slot = choice.item & SAMPLE_SLOT_MASK;
            s.list = choice.list;
            LightHot light = loadOwnLightHot(s.slot);
            uint mask = choice.item >> ITEM_MASK_SHIFT & 15u;
            if (mask == 15u || lightDipsBelow(light, receiver.point)) mask = 0u;
            MaskedPoint point = areaMaskWarp(rotatedPoint(noise.point, i, how.choices), mask, how.maskHiddenShare);
            s.uv = point.uv;
            s.contribution = choice.contribution / (point.pdf * float(how.rays));
            s.weight = s.list == LIST_HIDDEN ? choice.weight / float(stride) : choice.weight;
            ++chosen;
        }
        imageStore(samplesOut, ivec3(stored, i), packSample(s));
    }
    countAll(COUNTER_CANDIDATES, candidates);
    countAll(COUNTER_SAMPLES, chosen);
    countAll(COUNTER_MISSED, missed ? 1u : 0u);
    countAll(COUNTER_SURFACE_PIXELS, 1u);
}
