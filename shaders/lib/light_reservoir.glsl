// Reservoirs of a light and a point on it, and the light that a surface gets through such a point: what resampling
// weighs candidates by, and what it estimates (Bitterli et al., "Spatiotemporal reservoir resampling for real-time ray
// tracing with dynamic direct lighting", 2020). Points are uv of the light's unit square, so that a sample means the
// same at every surface and reuse needs no Jacobian.
#ifndef KILOLUX_LIB_LIGHT_RESERVOIR_GLSL
#define KILOLUX_LIB_LIGHT_RESERVOIR_GLSL
#include "light_ray.glsl"
#include "../shared/resampling.h"

const float kLikeNormal = 0.9063; // 25 degrees: surfaces that turn no more may take each other's reservoirs

struct LightReservoir {
    uint slot; // NO_RESERVOIR without a light
    vec2 uv;
    float contribution;
    float count; // of candidates
};

LightReservoir emptyLightReservoir() {
    return LightReservoir(NO_RESERVOIR, vec2(0.0), 0.0, 0.0);
}

uvec4 packLightReservoir(LightReservoir r) {
    return uvec4(r.slot, packUnorm2x16(r.uv), floatBitsToUint(r.contribution), floatBitsToUint(r.count));
}

LightReservoir unpackLightReservoir(uvec4 texel) {
    return LightReservoir(texel.x, unpackUnorm2x16(texel.y), uintBitsToFloat(texel.z), uintBitsToFloat(texel.w));
}

struct PointLight {
    LightSample point;
    vec3 emission;
    vec3 terms;   // diffuse without albedo, specular for F0 and F90, over the density of the point: as ESTIMATOR_TRUE
    float target; // luminance of the unshadowed reflected light, the density p-hat of equation 6; 0: none
};

PointLight pointLight(Receiver receiver, uint slot, vec2 uv) {
    PointLight lit;
    lit.point = invalidSample(uv);
    lit.emission = vec3(0.0);
    lit.terms = vec3(0.0);
    lit.target = 0.0;
    if (slot >= frame.lightCount) return lit;
    LightHot light = loadOwnLightHot(slot);
    lit.emission = lightEvaluate(light, receiver.point.positionWs);
    if (luminance(lit.emission) <= 0.0 || !lightIncludes(light, receiver.point.channels)) return lit;
    lit.point = lightSample(light, receiver.point.positionWs, uv);
    if (!lit.point.valid || dot(receiver.point.normalWs, lit.point.dirWs) <= 0.0) return lit;
    lit.emission *= lightTint(light, lit.point);
    lit.terms = termsAtPoint(receiver, lit.point);
    vec3 reflectance = diffuseAlbedo(receiver.surface) * lit.terms.x + specularF0(receiver.surface) * lit.terms.y +
                       vec3(lit.terms.z);
    lit.target = luminance(lit.emission * reflectance);
    return lit;
}

// Takes the offer with probability weight over the sum up to now. `number` is uniform, of its own for each offer.
bool takesOffer(inout float sum, float weight, float number) {
    sum += weight;
    return weight > 0.0 && number * sum < weight;
}

#endif
