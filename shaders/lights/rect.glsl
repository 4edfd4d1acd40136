// Rectangle light: one-sided Lambert emitter of radiance intensity / area, times its picture. uv: u along local X, v
// along local Y, both from the negative side; on a picture warped so that samples follow its luminance. Of the part that
// barn doors leave, samples are even (or so warped) over that part and their uv still that of the whole light.
#ifndef KILOLUX_LIGHTS_RECT_GLSL
#define KILOLUX_LIGHTS_RECT_GLSL
#include "picture.glsl"

KX_INLINE float rectAreaM2(LightHot light) {
    return max(4.0 * light.sizeM.x * light.sizeM.y, KX_MIN_AREA_M2);
}

KX_INLINE LightBounds rectBounds(LightHot light) {
    return oneSidedBounds(light);
}

KX_INLINE vec3 rectEvaluate(LightHot light, vec3 receiverWs) {
    bool seen = rectPartFrom(light, lightFrame(light), receiverWs).share > 0.0;
    return seen ? oneSidedEvaluate(light, receiverWs, rectAreaM2(light)) : vec3(0.0);
}

// The four corners are an ellipse's points at 45, 135, 225 and 315 degrees.
KX_INLINE EmitterOutline rectOutline(LightHot light, vec3 receiverWs, float alpha) {
    mat3 frame = lightFrame(light);
    RectPart part = rectPartFrom(light, frame, receiverWs);
    vec3 toCenter =
        light.positionWs - receiverWs + (frame[0] * part.centerM.x + frame[1] * part.centerM.y);
    float distance2 = dot(toCenter, toCenter);
    float height = -dot(light.dirWs, light.positionWs - receiverWs);
    if (height <= 0.0 || distance2 <= 1.0e-24 || part.share <= 0.0) return unlitOutline();
    float invDistance = inversesqrt(distance2);
    EmitterOutline outline = pointOutline(
        toCenter * invDistance, part.share * rectAreaM2(light) * height * invDistance / distance2);
    outline.centerA = outline.dirWs;
    outline.axisXA = frame[0] * (1.41421356237309504880 * part.halfM.x * invDistance);
    outline.axisYA = frame[1] * (1.41421356237309504880 * part.halfM.y * invDistance);
    outline.arcA = vec2(0.5 * KX_HALF_PI, KX_HALF_PI);
    outline.countA = 4;
    outline.count = 4;
    outline.sectors = 4;
    outline.angularRadius = min(length(part.halfM) * invDistance, 1.0);
    return outline;
}

struct RectUv {
    vec2 low;
    vec2 high;
};

KX_INLINE RectUv partUv(RectPart part, vec2 sizeM) {
    RectUv seen;
    seen.low = vec2(0.0);
    seen.high = vec2(1.0);
    if (part.share >= 1.0) return seen;
    seen.low = clamp(0.5 * (part.centerM - part.halfM) / sizeM + vec2(0.5), 0.0, 1.0);
    seen.high = clamp(0.5 * (part.centerM + part.halfM) / sizeM + vec2(0.5), 0.0, 1.0);
    return seen;
}

KX_INLINE LightSample rectSample(LightHot light, vec3 receiverWs, vec2 uv) {
    mat3 frame = lightFrame(light);
    RectPart part = rectPartFrom(light, frame, receiverWs);
    if (part.share <= 0.0) return invalidSample(uv);
    vec2 atM = part.centerM + (2.0 * uv - vec2(1.0)) * part.halfM;
    vec2 sizeM = max(light.sizeM, vec2(1.0e-9));
    vec2 used = part.share < 1.0 ? clamp(0.5 * atM / sizeM + vec2(0.5), 0.0, 1.0) : uv;
    float density = 1.0 / part.share; // over uv
    vec3 tint = vec3(1.0);
    if (lightHasPicture(light)) {
        LightShaping shaping = lightShaping(light);
        RectUv seen = partUv(part, sizeM);
        PicturePoint point = pictureWarp(shaping, uv, seen.low, seen.high);
        atM = (2.0 * point.uv - vec2(1.0)) * light.sizeM;
        used = point.squareUv;
        density = point.density;
        tint = pictureAt(shaping, point.uv, 0.0);
    }
    vec3 toPoint = light.positionWs - receiverWs + frame[0] * atM.x + frame[1] * atM.y;
    LightSample s = areaSample(toPoint, receiverWs, light.dirWs, used, density / rectAreaM2(light));
    s.tint = tint;
    return s;
}

KX_INLINE LightHit rectIntersect(LightHot light, vec3 originWs, vec3 dirWs) {
    float cosEmitter = -dot(light.dirWs, dirWs);
    vec3 toCenter = light.positionWs - originWs;
    float height = -dot(light.dirWs, toCenter);
    if (cosEmitter <= 0.0 || height <= 0.0) return noLightHit();
    float distanceM = height / cosEmitter;
    vec3 fromCenter = dirWs * distanceM - toCenter;
    mat3 frame = lightFrame(light);
    RectPart part = rectPartFrom(light, frame, originWs);
    vec2 atM = vec2(dot(fromCenter, frame[0]), dot(fromCenter, frame[1]));
    vec2 inPart = (atM - part.centerM) / max(part.halfM, vec2(1.0e-12));
    if (max(abs(inPart.x), abs(inPart.y)) > 1.0 || part.share <= 0.0) return noLightHit();
    vec2 uv = clamp(atM / max(light.sizeM, vec2(1.0e-12)) * 0.5 + vec2(0.5), 0.0, 1.0);
    float density = 1.0 / part.share;
    if (lightHasPicture(light)) {
        RectUv seen = partUv(part, max(light.sizeM, vec2(1.0e-9)));
        PicturePoint point = pictureUnwarp(lightShaping(light), uv, seen.low, seen.high);
        uv = point.squareUv;
        density = point.density;
    }
    return areaHit(distanceM, uv, density / rectAreaM2(light), cosEmitter);
}

KX_INLINE float rectFlux(LightHot light) {
    return KX_PI * luminance(light.intensity);
}

#endif
