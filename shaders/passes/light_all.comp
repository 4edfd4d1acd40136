#version 460
// Every light in range of each pixel: the methods 'all-lights' and 'shadow-maps' and both references. Split: analytic
// irradiance times the visibility of uniformly chosen points of the light, by rays (Heitz, Hill and McGuire, "Combining
// Analytic Direct Illumination and Stochastic Shadows", 2018). Maps: the same, by the light's shadow map where it has
// one. True: the BRDF at the chosen points. Terms that are zero cost no ray. Output is exposed; diffuse light is
// demodulated by the diffuse albedo.
#include "shared/features.h"
#include "lib/count.glsl"
#include "lib/dispatch.glsl"
#include "lib/light_grid.glsl"
#include "lib/light_ray.glsl"
#include "lib/shadow_map.glsl"
#include "math/color.glsl"

layout(constant_id = CHOICE_ESTIMATOR) const int kEstimator = ESTIMATOR_SPLIT;

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push {
    uint raysPerLight;
    uint shadowSamples; // of a shadow map, per light
};
layout(rgba32f) writeonly uniform image2D litDiffuseOut;
layout(rgba32f) writeonly uniform image2D litSpecularOut;
layout(r32ui) writeonly uniform uimage2D lightCountsOut;
layout(scalar) readonly buffer GridCells {
    GridCell gridCells[];
};
layout(scalar) readonly buffer GridIndices {
    uint gridIndices[];
};

void main() {
    uvec2 pixel = dispatchedPixel();
    if (!isInPicture(pixel)) return;
    ivec2 at = ivec2(pixel);
    Receiver receiver = loadReceiver(pixel);
    vec3 diffuse = vec3(0.0), specular = vec3(0.0);
    uint inRange = 0u, shining = 0u, rays = 0u;
    if (receiver.exists) {
        vec3 positionWs = receiver.point.positionWs;
        LtcLobe lobe = makeLtcLobe(receiver.point);
        vec3 f0 = specularF0(receiver.surface);
        uint seed = pixelSeed(pixel, frame.frame, frame.seed);
        // The grid's lists are sorted by slot, so that sums come out the same without a grid.
        bool gridded = frame.grid.enabled != 0u;
        GridCell cell = GridCell(0u, frame.lightCount, 0u);
        if (gridded) cell = gridCells[gridCellOfPixel(pixel, receiver.depthM)];
        for (uint i = 0u; i < cell.count; ++i) {
            uint slot = gridded ? gridIndices[cell.first + i] : i;
            LightHot light = loadLightHot(slot);
            if (!lightReaches(light, receiver.point)) continue;
            ++inRange;
            LightIrradiance unshadowed;
            if (kEstimator != ESTIMATOR_TRUE) {
                unshadowed = lightIrradiance(light, receiver.point, lobe);
                if (unshadowed.diffuse <= 0.0 && unshadowed.specular.x + unshadowed.specular.y <= 0.0) continue;
            } else {
                unshadowed.emission = unshadowed.specularEmission = lightEvaluate(light, positionWs);
                if (luminance(unshadowed.emission) <= 0.0) continue;
            }
            float sumVisible = 0.0;
            vec3 sumDiffuse = vec3(0.0), sumSpecular = vec3(0.0); // true: of emission
            bool mapped = kEstimator == ESTIMATOR_MAPS && shadowMaps[slot].faceMask != 0u;
            if (mapped)
                sumVisible = float(raysPerLight) * shadowMapVisibility(shadowMaps[slot], receiver,
                                                                      hashCombine(seed, slot * 16u), shadowSamples);
            for (uint ray = 0u; ray < raysPerLight && !mapped; ++ray) {
                uint sampleSeed = hashCombine(seed, slot * 16u + ray);
                LightSample s;
                bool usable = false;
                // Split wants points above the horizon only; true draws once, a zero is part of its mean.
                int draws = kEstimator == ESTIMATOR_TRUE ? 1 : mostDraws(light);
                for (int draw = 0; draw < draws && !usable; ++draw) {
                    s = lightSample(light, positionWs, whiteNoise2(sampleSeed, uint(draw)));
                    usable = s.valid && dot(receiver.point.normalWs, s.dirWs) > 0.0;
                }
                if (!usable) continue;
                bool traced;
                float visible = tracePoint(receiver, slot, s, traced) == RAY_VISIBLE ? 1.0 : 0.0;
                rays += traced ? 1u : 0u;
                sumVisible += visible;
                if (kEstimator == ESTIMATOR_TRUE && visible > 0.0) {
                    vec3 terms = termsAtPoint(receiver, s), emission = unshadowed.emission * lightTint(light, s);
                    sumDiffuse += emission * terms.x;
                    sumSpecular += emission * (f0 * terms.y + vec3(terms.z));
                }
            }
            if (kEstimator != ESTIMATOR_TRUE) {
                sumDiffuse = unshadowed.emission * (sumVisible * unshadowed.diffuse * KX_INV_PI);
                sumSpecular = unshadowed.specularEmission * sumVisible *
                              (f0 * unshadowed.specular.x + vec3(unshadowed.specular.y));
            }
            float exposed = frame.exposure / float(raysPerLight);
            diffuse += sumDiffuse * exposed;
            specular += sumSpecular * exposed;
            shining += sumVisible > 0.0 ? 1u : 0u;
        }
        countAll(COUNTER_RAYS, rays);
        countAll(COUNTER_LIGHTS_IN_RANGE, inRange);
        countAll(COUNTER_LIGHTS_TESTED, cell.count);
        countAll(COUNTER_SURFACE_PIXELS, 1u);
        countAll(COUNTER_COUNTED_PIXELS, 1u);
    }
    imageStore(litDiffuseOut, at, vec4(diffuse, 1.0));
    imageStore(litSpecularOut, at, vec4(specular, 1.0));
    imageStore(lightCountsOut, at, uvec4(min(inRange, 0xffffu) | min(shining, 0xffffu) << 16u));
}
