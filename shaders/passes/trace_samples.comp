#version 460
// One shadow ray per sample, from the pixel's own surface to the sampled point of the light.
#include "shared/features.h"
#include "lib/count.glsl"
#include "lib/light_ray.glsl"
#include "lib/ray_list.glsl"
#include "lib/sample.glsl"
#include "math/area_mask.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push {
    uint layer; // the pixel's how many-th ray
};
uniform usampler2DArray samples;
layout(r32ui) writeonly uniform uimage2DArray rayResultsOut;

void main() {
    uvec2 pixel = pixelOfRay(layer);
    if (!isInPicture(pixel)) return;
    StoredSample chosen = unpackSample(texelFetch(samples, ivec3(pixel, layer), 0));
    uint result = RAY_NONE;
    if (chosen.contribution > 0.0) {
        Receiver receiver = loadReceiver(pixel);
        LightHot light = loadOwnLightHot(chosen.slot);
        uint seed = hashCombine(pixelSeed(pixel, frame.sampling.noiseFrame, frame.seed), 128u + layer);
        LightSample s;
        if (usablePoint(receiver, light, chosen.uv, seed, s)) {
            bool traced;
            result = tracePoint(receiver, chosen.slot, s, traced);
            countAll(COUNTER_RAYS, traced ? 1u : 0u);
            countAll(COUNTER_USEFUL_RAYS, traced && result == RAY_VISIBLE ? 1u : 0u);
            if (result == RAY_VISIBLE) result |= areaMaskCell(s.uv) << RAY_CELL_SHIFT;
        }
    }
    imageStore(rayResultsOut, ivec3(pixel, layer), uvec4(result));
}
