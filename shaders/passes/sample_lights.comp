#version 460
// Chooses the lights that a pixel's rays go to among those of lib/light_choice.glsl, and a point on each. At half
// resolution one pixel of each 2 x 2 chooses for all four (the MegaLights talk, SIGGRAPH 2025, "Downsampled Sampling").
#include "shared/features.h"
#include "lib/count.glsl"
#include "lib/dispatch.glsl"
#include "lib/light_mask.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba32ui) writeonly uniform uimage2DArray samplesOut;

layout(constant_id = CHOICE_DIM_DROP) const bool kDimDrop = false;

vec2 droppedOfAll; // light of the candidates, as they stand for all: what the hard drop loses, and the whole

void seeCandidate(Candidate c, float weight, float light) {
    if (kDimDrop) droppedOfAll += vec2(hardDropLoss(light, weight, frame.sampling.dimThreshold), light);
}

void main() {
    bool atHalf = kHalfSampling != HALF_OFF;
    uvec2 tiles = atHalf ? (frame.tiles + 1u) / 2u : frame.tiles;
    uvec2 pixel = dispatchedPixelOf(tiles);
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
    droppedOfAll = vec2(0.0);
    LightSelection selection;
    ChoiceState state = considerLights(receiver, pixel, stored, selection);
    uint chosen = 0u;
    for (uint i = 0u; i < how.choices; ++i) {
        LightChoice choice = selectionSample(selection, state.budget, i);
        StoredSample s = StoredSample(0u, LIST_VISIBLE, state.flags, vec2(0.5), 0.0, 0.0);
        if (choice.item != KX_NO_ITEM) {
            s.slot = choice.item;
            s.list = choice.list;
            bool local = s.list == LIST_VISIBLE || s.list == LIST_HIDDEN;
            uint mask = 0u;
            if (local && state.ownList != KX_NO_LIGHT)
                mask = areaMaskOf(state.ownList, s.slot, loadOwnLightHot(s.slot), receiver);
            MaskedPoint point = areaMaskWarp(rotatedPoint(state.noise.point, i, how.choices), mask, how.maskHiddenShare);
            s.uv = point.uv;
            s.contribution = choice.contribution / (point.pdf * float(how.rays));
            s.weight = s.list == LIST_HIDDEN ? choice.weight / float(state.stride) : choice.weight;
            ++chosen;
        }
        imageStore(samplesOut, ivec3(stored, i), packSample(s));
    }
    countAll(COUNTER_CANDIDATES, state.candidates);
    countAll(COUNTER_SAMPLES, chosen);
    uint standsFor = atHalf ? 4u : 1u; // pixels of the full resolution
    countAll(COUNTER_MISSED, (state.flags & SAMPLE_MISSED) != 0u ? standsFor : 0u);
    countAll(COUNTER_SURFACE_PIXELS, standsFor);
    if (kDimDrop) {
        float share = min(droppedOfAll.x / max(droppedOfAll.y, 1.0e-30), 1.0);
        float number = whiteNoise1(pixelSeed(pixel, how.noiseFrame, frame.seed), 10u); // small shares are counted as well
        countAll(COUNTER_DROPPED, standsFor * uint(share * float(DROPPED_STEPS) + number));
    }
}
