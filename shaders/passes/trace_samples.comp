#version 460
// One shadow ray per sample, from the pixel's own surface to the sampled point of the light.
#include "shared/features.h"
#include "lib/count.glsl"
#include "lib/ray_list.glsl"
#include "lib/receiver.glsl"
#include "lib/sample.glsl"
#include "lib/trace.glsl"
#include "math/area_mask.glsl"
#include "math/hash.glsl"

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
        bool usable = false;
        vec2 uv = chosen.uv;
        // A pixel that took its neighbour's choice may have all of the light below its horizon.
        LightExtent extent = lightExtent(light, receiver.point.positionWs);
        float highest = dot(receiver.point.normalWs, extent.toCenter) + extentAlong(extent, receiver.point.normalWs);
        int draws = highest > 0.0 ? kMaxDraws : 0;
        for (int draw = 0; draw < draws && !usable; ++draw) {
            s = lightSample(light, receiver.point.positionWs, uv);
            usable = s.valid && dot(receiver.point.normalWs, s.dirWs) > 0.0;
            // From behind or inside all points are invalid; of a tube seen along its axis only some are.
            if (!s.valid && lightType(light) != LIGHT_TUBE) break;
            uv = whiteNoise2(seed, uint(draw));
        }
        if (usable) {
            result = RAY_HIDDEN;
            if (dot(receiver.surface.geoNormalWs, s.dirWs) > 0.0) {
                Ray ray = shadowRay(receiver, s, loadLightCold(chosen.slot).rayEndBiasM);
                bool hidden = false;
                if (ray.tMaxM > 0.0) {
                    hidden = occluded(ray);
                    countAll(COUNTER_RAYS, 1u);
                    countAll(COUNTER_USEFUL_RAYS, hidden ? 0u : 1u);
                }
                if (!hidden) result = RAY_VISIBLE | areaMaskQuarter(s.uv) << RAY_QUARTER_SHIFT;
            }
        }
    }
    imageStore(rayResultsOut, ivec3(pixel, layer), uvec4(result));
}
