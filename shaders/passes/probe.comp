#version 460
// Everything that is known of one pixel: its surface, every light with weight, probability, energy and visibility, and
// how the frame chose among them. One workgroup; its first lane walks the candidates with the very functions of
// sample_lights (lib/light_choice.glsl), then each lane takes lights of its own.
#include "shared/features.h"
#include "shared/probe.h"
#include "lib/light_choice.glsl"
#include "lib/light_ray.glsl"
#include "math/area_mask.glsl"

layout(local_size_x = PROBE_LANES) in;
layout(push_constant, scalar) uniform Push {
    ProbeRequest request;
};
uniform usampler2D visibility;
uniform sampler2D picture;
uniform sampler2D viewValues; // the picture, where it is not a view
uniform sampler2D litDiffuse; // the denoiser's, where it ran
uniform usampler2DArray samples;
uniform usampler2DArray rayResults; // at full resolution
layout(scalar) writeonly buffer ProbeSurfaceOut {
    ProbeSurface surfaceOut;
};
layout(scalar) coherent buffer ProbeLights {
    ProbeLight lights[]; // by slot
};
layout(scalar) writeonly buffer ProbeRays {
    vec4 rayEnds[]; // PROBE_RAYS a slot: point on the light, RAY_*
};

shared vec4 sums;
shared SelectionBudget budget;

void seeCandidate(Candidate c, float weight, float light) {
    uint slot = c.item;
    lights[slot].flags |= PROBE_CANDIDATE;
    lights[slot].list = c.list;
    lights[slot].weight = weight;
    lights[slot].offered = c.weight;
}

// The pixel whose choice the probed one lives by.
uvec2 choosingPixel() {
    if (kHalfSampling == HALF_OFF) return request.renderedPx;
    return halfResolutionPixel(request.renderedPx / 2u, kHalfSampling, frame.sampling.noiseFrame);
}

void probeSurface(Receiver receiver, uvec2 pixel) {
    ivec2 at = ivec2(request.renderedPx);
    surfaceOut.pixel = pixel;
    surfaceOut.exists = receiver.exists ? 1u : 0u;
    surfaceOut.hasTurn = kHalfSampling != HALF_OFF ||
                         isSampledPixel(pixel, frame.sampling.pixelsPerRay, frame.sampling.noiseFrame) ? 1u : 0u;
    surfaceOut.positionWs = receiver.point.positionWs;
    surfaceOut.depthM = receiver.depthM;
    surfaceOut.normalWs = receiver.point.normalWs;
    surfaceOut.geoNormalWs = receiver.surface.geoNormalWs;
    surfaceOut.viewDirWs = receiver.point.viewDirWs;
    surfaceOut.baseColor = receiver.surface.baseColor;
    surfaceOut.roughness = receiver.surface.roughness;
    surfaceOut.metallic = receiver.surface.metallic;
    uvec2 ids = texelFetch(visibility, ivec2(pixel), 0).xy;
    surfaceOut.instance = ids.x;
    surfaceOut.primitive = ids.y;
    surfaceOut.pictureNit = texelFetch(picture, at, 0).rgb / frame.exposure;
    surfaceOut.viewValue = texelFetch(viewValues, ivec2(request.shownPx), 0).rgb;
    surfaceOut.irradianceLux = texelFetch(litDiffuse, at, 0).rgb * (KX_PI / frame.exposure);
    surfaceOut.candidates = 0u;
    surfaceOut.cellLights = 0u;
    surfaceOut.stride = 0u;
    surfaceOut.listLights = 0u;
    surfaceOut.listTile = uvec2(0u);
    surfaceOut.missed = 0u;
    surfaceOut.sums = vec4(0.0);
    surfaceOut.budgeted = vec3(0.0);
}

// What sample_lights knew of this pixel.
void probeChoice(Receiver receiver, uvec2 pixel, uvec2 stored) {
    LightSelection selection;
    ChoiceState state = considerLights(receiver, pixel, stored, selection);
    sums = vec4(selection.visibleSum, selection.hiddenSum, selection.directionalSum, selection.domeSum);
    budget = state.budget;
    surfaceOut.candidates = state.candidates;
    surfaceOut.cellLights = cellCount;
    surfaceOut.stride = state.stride;
    surfaceOut.listLights = visibleCount;
    uint tile = (visibleAt - 1u) / LIST_TEXELS;
    surfaceOut.listTile = uvec2(tile % frame.previousTiles.x, tile / frame.previousTiles.x);
    surfaceOut.missed = state.flags & SAMPLE_MISSED;
    surfaceOut.sums = sums;
    vec2 budgeted = budgetedSums(sums.x, sums.y, sums.z, budget);
    surfaceOut.budgeted = vec3(budgeted, budgetedDome(sums.w, sums.x + budgeted.x, budgeted.y, budget));
    for (uint i = 0u; i < visibleCount; ++i) {
        uint word = texelFetch(visibleLists, int(visibleAt + i)).x;
        uint slot = word & ENTRY_SLOT_MASK;
        if (slot >= frame.lightCount) continue;
        lights[slot].flags |= PROBE_LISTED;
        lights[slot].entry = word;
        uint cells = texelFetch(visibleLists, int(visibleAt - 1u + LIST_CELLS_AT + i)).x;
        lights[slot].cells = (cells | cells >> SEEN_OLDER_SHIFT) & SEEN_MASK;
    }
    for (uint i = 0u; i < cellCount; ++i) {
        uint slot = fetchCellLight(i);
        if (slot < frame.lightCount) lights[slot].flags |= PROBE_IN_CELL;
    }
    for (uint i = 0u; i < frame.sampling.freshCount; ++i)
        lights[fetchFreshLight(i)].flags |= PROBE_FRESH;
    for (uint i = 0u; i < frame.sampling.choices; ++i) {
        StoredSample s = unpackSample(texelFetch(samples, ivec3(stored, i), 0));
        if (s.contribution > 0.0) ++lights[s.slot].chosen;
        // Rays belong to full-resolution pixels, which at half resolution may take a neighbour's sample.
        if (kHalfSampling != HALF_OFF || !(s.contribution > 0.0)) continue;
        uint state = texelFetch(rayResults, ivec3(stored, i), 0).x & RAY_STATE_MASK;
        lights[s.slot].chosenVisible += state == RAY_VISIBLE ? 1u : 0u;
    }
}

void probeLight(Receiver receiver, uint slot, LtcLobe lobe) {
    LightHot light = loadOwnLightHot(slot);
    ProbeLight found = lights[slot];
    found.probability = candidateProbability(sums, budget, found.list, found.offered);
    bool reaches = lightReaches(light, receiver.point);
    if (reaches) found.flags |= PROBE_REACHES;
    float albedo = luminance(diffuseAlbedo(receiver.surface));
    vec3 f0 = specularF0(receiver.surface);
    if ((found.flags & PROBE_CANDIDATE) == 0u)
        found.weight = perceptualWeight(lightWeight(light, receiver.point, albedo, luminance(f0)), frame.exposure);
    LightIrradiance lit = lightIrradiance(light, receiver.point, lobe);
    found.irradianceLux = lit.emission * lit.diffuse;
    found.reflectedNit = lit.emission * diffuseAlbedo(receiver.surface) * (lit.diffuse * KX_INV_PI) +
                         lit.specularEmission * (f0 * lit.specular.x + vec3(lit.specular.y));
    uint seed = hashCombine(pixelSeed(request.renderedPx, 0u, 0u), slot);
    for (uint i = 0u; i < PROBE_RAYS; ++i) {
        LightSample s;
        uint state = RAY_NONE;
        vec2 uv = rotatedPoint(vec2(0.03125, 0.5), i, PROBE_RAYS);
        if (reaches && usablePoint(receiver, light, uv, hashCombine(seed, i), s)) {
            bool traced;
            state = tracePoint(receiver, slot, s, traced);
            ++found.rays;
            found.raysVisible += state == RAY_VISIBLE ? 1u : 0u;
            rayEnds[slot * PROBE_RAYS + i] = vec4(s.positionWs, float(state));
        } else {
            rayEnds[slot * PROBE_RAYS + i] = vec4(0.0);
        }
    }
    lights[slot] = found;
}

void main() {
    uint lane = gl_LocalInvocationIndex;
    uvec2 pixel = choosingPixel();
    Receiver receiver = loadReceiver(pixel);
    if (lane == 0u) probeSurface(receiver, pixel);
    if (!receiver.exists || request.lights == 0u) return; // the same for all lanes
    for (uint slot = lane; slot < frame.lightCount; slot += PROBE_LANES)
        lights[slot] = ProbeLight(0u, LIST_HIDDEN, 0u, 0u, 0.0, 0.0, 0.0, 0u, 0u, 0u, 0u, vec3(0.0), vec3(0.0));
    if (lane == 0u) sums = vec4(0.0);
    memoryBarrierBuffer();
    barrier();
    if (lane == 0u && request.stochastic != 0u)
        probeChoice(receiver, pixel, kHalfSampling != HALF_OFF ? request.renderedPx / 2u : pixel);
    memoryBarrierBuffer();
    barrier();
    LtcLobe lobe = makeLtcLobe(receiver.point);
    for (uint slot = lane; slot < frame.lightCount; slot += PROBE_LANES)
        probeLight(receiver, slot, lobe);
}
