// Spot light: a sphere source (or a point) shaped by a cone about dirWs with its apex at the centre.
#ifndef KILOLUX_LIGHTS_SPOT_GLSL
#define KILOLUX_LIGHTS_SPOT_GLSL
#include "sphere.glsl"

KX_INLINE LightBounds spotBounds(LightHot light) {
    LightBounds bounds = rangeBounds(light);
    bounds.cosHalfAngle = clamp(-light.shaping.y / max(light.shaping.x, 1.0e-6), -1.0, 1.0);
    return bounds;
}

KX_INLINE vec3 spotEvaluate(LightHot light, vec3 receiverWs) {
    vec3 fromCenter = receiverWs - light.positionWs;
    vec3 dirFromLight = fromCenter * inversesqrt(max(dot(fromCenter, fromCenter), 1.0e-24));
    return sphereEvaluate(light, receiverWs) * spotCone(light, dirFromLight);
}

KX_INLINE EmitterOutline spotOutline(LightHot light, vec3 receiverWs, float alpha) {
    return sphereOutline(light, receiverWs, alpha);
}

KX_INLINE LightSample spotSample(LightHot light, vec3 receiverWs, vec2 uv) {
    return sphereSample(light, receiverWs, uv);
}

KX_INLINE LightHit spotIntersect(LightHot light, vec3 originWs, vec3 dirWs) {
    return sphereIntersect(light, originWs, dirWs);
}

// 2 pi I times the integral of (cos * scale + offset)^2 over the cosines where it is below 1, plus the rest.
KX_INLINE float spotFlux(LightHot light) {
    float scale = max(light.shaping.x, 1.0e-6);
    float atAxis = saturate(scale + light.shaping.y);
    float cosInner = min((1.0 - light.shaping.y) / scale, 1.0);
    float edge = atAxis * atAxis * atAxis / (3.0 * scale);
    return KX_TWO_PI * (edge + 1.0 - cosInner) * luminance(light.intensity);
}

#endif
