// Disk light: one-sided Lambert emitter of radiance intensity / area. uv: concentric map, u along local X, v
// along local Y.
#ifndef KILOLUX_LIGHTS_DISK_GLSL
#define KILOLUX_LIGHTS_DISK_GLSL
#include "shaping.glsl"

KX_INLINE float diskAreaM2(LightHot light) {
    return max(KX_PI * light.sizeM.x * light.sizeM.x, KX_MIN_AREA_M2);
}

KX_INLINE LightBounds diskBounds(LightHot light) {
    return oneSidedBounds(light);
}

KX_INLINE vec3 diskEvaluate(LightHot light, vec3 receiverWs) {
    return oneSidedEvaluate(light, receiverWs, diskAreaM2(light));
}

KX_INLINE EmitterOutline diskOutline(LightHot light, vec3 receiverWs, float alpha) {
    vec3 toCenter = light.positionWs - receiverWs;
    float distance2 = dot(toCenter, toCenter);
    float height = -dot(light.dirWs, toCenter);
    if (height <= 0.0 || distance2 <= 1.0e-24) return unlitOutline();
    float invDistance = inversesqrt(distance2);
    mat3 frame = lightFrame(light);
    float radius = light.sizeM.x * invDistance;
    EmitterOutline outline =
        pointOutline(toCenter * invDistance, diskAreaM2(light) * height * invDistance / distance2);
    int vertices = radius > 0.5 ? 2 * KX_CIRCLE_VERTICES : circleVertices(radius, alpha);
    outline.centerA = outline.dirWs;
    outline.axisXA = frame[0] * radius;
    outline.axisYA = frame[1] * radius;
    outline.arcA = vec2(0.0, KX_TWO_PI / float(vertices));
    outline.bulge = vec2(circleBulge(vertices));
    outline.countA = vertices;
    outline.count = vertices;
    outline.sectors = KX_CIRCLE_SECTORS;
    outline.angularRadius = min(radius, 1.0);
    return outline;
}

KX_INLINE LightSample diskSample(LightHot light, vec3 receiverWs, vec2 uv) {
    mat3 frame = lightFrame(light);
    vec2 p = diskFromSquare(uv) * light.sizeM.x;
    vec3 toPoint = light.positionWs - receiverWs + frame[0] * p.x + frame[1] * p.y;
    return areaSample(toPoint, receiverWs, light.dirWs, uv, 1.0 / diskAreaM2(light));
}

KX_INLINE LightHit diskIntersect(LightHot light, vec3 originWs, vec3 dirWs) {
    float cosEmitter = -dot(light.dirWs, dirWs);
    vec3 toCenter = light.positionWs - originWs;
    float height = -dot(light.dirWs, toCenter);
    if (cosEmitter <= 0.0 || height <= 0.0) return noLightHit();
    float distanceM = height / cosEmitter;
    vec3 fromCenter = dirWs * distanceM - toCenter;
    mat3 frame = lightFrame(light);
    vec2 p = vec2(dot(fromCenter, frame[0]), dot(fromCenter, frame[1])) / max(light.sizeM.x, 1.0e-12);
    if (dot(p, p) > 1.0) return noLightHit();
    return areaHit(distanceM, squareFromDisk(p), 1.0 / diskAreaM2(light), cosEmitter);
}

KX_INLINE float diskFlux(LightHot light) {
    return KX_PI * luminance(light.intensity);
}

#endif
