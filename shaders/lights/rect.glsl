// Rectangle light: one-sided Lambert emitter of radiance intensity / area. uv: u along local X, v along local
// Y, both from the negative side.
#ifndef KILOLUX_LIGHTS_RECT_GLSL
#define KILOLUX_LIGHTS_RECT_GLSL
#include "shaping.glsl"

KX_INLINE float rectAreaM2(LightHot light) {
    return max(4.0 * light.sizeM.x * light.sizeM.y, KX_MIN_AREA_M2);
}

KX_INLINE LightBounds rectBounds(LightHot light) {
    return oneSidedBounds(light);
}

KX_INLINE vec3 rectEvaluate(LightHot light, vec3 receiverWs) {
    return oneSidedEvaluate(light, receiverWs, rectAreaM2(light));
}

// The four corners are an ellipse's points at 45, 135, 225 and 315 degrees.
KX_INLINE EmitterOutline rectOutline(LightHot light, vec3 receiverWs, float alpha) {
    vec3 toCenter = light.positionWs - receiverWs;
    float distance2 = dot(toCenter, toCenter);
    float height = -dot(light.dirWs, toCenter);
    if (height <= 0.0 || distance2 <= 1.0e-24) return unlitOutline();
    float invDistance = inversesqrt(distance2);
    mat3 frame = lightFrame(light);
    EmitterOutline outline =
        pointOutline(toCenter * invDistance, rectAreaM2(light) * height * invDistance / distance2);
    outline.centerA = outline.dirWs;
    outline.axisXA = frame[0] * (1.41421356237309504880 * light.sizeM.x * invDistance);
    outline.axisYA = frame[1] * (1.41421356237309504880 * light.sizeM.y * invDistance);
    outline.arcA = vec2(0.5 * KX_HALF_PI, KX_HALF_PI);
    outline.countA = 4;
    outline.count = 4;
    outline.sectors = 4;
    outline.angularRadius = min(length(light.sizeM) * invDistance, 1.0);
    return outline;
}

KX_INLINE LightSample rectSample(LightHot light, vec3 receiverWs, vec2 uv) {
    mat3 frame = lightFrame(light);
    vec3 toPoint = light.positionWs - receiverWs + frame[0] * ((2.0 * uv.x - 1.0) * light.sizeM.x) +
                   frame[1] * ((2.0 * uv.y - 1.0) * light.sizeM.y);
    return areaSample(toPoint, receiverWs, light.dirWs, uv, 1.0 / rectAreaM2(light));
}

KX_INLINE LightHit rectIntersect(LightHot light, vec3 originWs, vec3 dirWs) {
    float cosEmitter = -dot(light.dirWs, dirWs);
    vec3 toCenter = light.positionWs - originWs;
    float height = -dot(light.dirWs, toCenter);
    if (cosEmitter <= 0.0 || height <= 0.0) return noLightHit();
    float distanceM = height / cosEmitter;
    vec3 fromCenter = dirWs * distanceM - toCenter;
    mat3 frame = lightFrame(light);
    vec2 p = vec2(dot(fromCenter, frame[0]) / max(light.sizeM.x, 1.0e-12),
                  dot(fromCenter, frame[1]) / max(light.sizeM.y, 1.0e-12));
    if (max(abs(p.x), abs(p.y)) > 1.0) return noLightHit();
    return areaHit(distanceM, p * 0.5 + vec2(0.5), 1.0 / rectAreaM2(light), cosEmitter);
}

KX_INLINE float rectFlux(LightHot light) {
    return KX_PI * luminance(light.intensity);
}

#endif
