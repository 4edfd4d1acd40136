// Directional light: a disk of constant radiance at infinity around -dirWs, sizeM.x the tangent of its
// angular radius; a delta direction below KX_DELTA_TANGENT. intensity is the illuminance of a surface that
// faces it. uv: concentric map to equal solid angles, u along local X, v along local Y.
#ifndef KILOLUX_LIGHTS_DIRECTIONAL_GLSL
#define KILOLUX_LIGHTS_DIRECTIONAL_GLSL
#include "shaping.glsl"

KX_INLINE bool directionalIsDelta(LightHot light) {
    return light.sizeM.x < KX_DELTA_TANGENT;
}

KX_INLINE float directionalSin2(LightHot light) {
    float tan2 = square(light.sizeM.x);
    return tan2 / (1.0 + tan2);
}

KX_INLINE float directionalOneMinusCos(LightHot light) {
    float sin2 = directionalSin2(light);
    return sin2 / (1.0 + sqrt(1.0 - sin2));
}

KX_INLINE LightBounds directionalBounds(LightHot light) {
    LightBounds bounds = rangeBounds(light);
    bounds.radiusM = KX_INFINITY;
    return bounds;
}

KX_INLINE vec3 directionalEvaluate(LightHot light, vec3 receiverWs) {
    if (directionalIsDelta(light)) return light.intensity;
    return light.intensity * (KX_INV_PI / directionalSin2(light));
}

KX_INLINE EmitterOutline directionalOutline(LightHot light, vec3 receiverWs, float alpha) {
    if (directionalIsDelta(light)) return pointOutline(-light.dirWs, 1.0);
    return coneOutline(-light.dirWs, sqrt(directionalSin2(light)), alpha);
}

KX_INLINE LightSample directionalSample(LightHot light, vec3 receiverWs, vec2 uv) {
    LightSample s = invalidSample(uv);
    s.valid = true;
    s.distanceM = KX_INFINITY;
    s.dirWs = -light.dirWs;
    s.geometry = 1.0;
    if (!directionalIsDelta(light)) {
        mat3 frame = lightFrame(light);
        vec2 p = diskFromSquare(uv);
        float full = directionalOneMinusCos(light);
        float oneMinusCos = dot(p, p) * full;
        float stretch = sqrt(full * (2.0 - oneMinusCos)); // sine over the radius in the unit disk
        s.dirWs = frame[0] * (p.x * stretch) + frame[1] * (p.y * stretch) + frame[2] * (1.0 - oneMinusCos);
        s.geometry = KX_TWO_PI * full;
        s.pdfSolidAngle = 1.0 / s.geometry;
        s.pdfArea = s.pdfSolidAngle;
    }
    s.emitterNormalWs = -s.dirWs;
    s.positionWs = receiverWs + s.dirWs;
    return s;
}

KX_INLINE LightHit directionalIntersect(LightHot light, vec3 originWs, vec3 dirWs) {
    mat3 frame = lightFrame(light);
    vec2 aside = vec2(dot(dirWs, frame[0]), dot(dirWs, frame[1]));
    float sin2 = dot(aside, aside);
    float cosine = dot(dirWs, frame[2]);
    if (directionalIsDelta(light) || cosine <= 0.0 || sin2 > directionalSin2(light)) return noLightHit();
    float full = directionalOneMinusCos(light);
    LightHit hit;
    hit.hit = true;
    hit.distanceM = KX_INFINITY;
    hit.uv = squareFromDisk(aside * inversesqrt(full * (1.0 + cosine)));
    hit.pdfSolidAngle = 1.0 / (KX_TWO_PI * full);
    hit.pdfArea = hit.pdfSolidAngle;
    return hit;
}

// Endless; 0 by definition.
KX_INLINE float directionalFlux(LightHot light) {
    return 0.0;
}

#endif
