// Sphere light: a Lambert emitter of constant radiance intensity / (pi r^2), seen as a disk that faces the
// receiver; a point below KX_POINT_RADIUS_M. Inside the sphere there is no light. uv: z = 1 - 2 v along local
// Z, u turns about it from local X.
#ifndef KILOLUX_LIGHTS_SPHERE_GLSL
#define KILOLUX_LIGHTS_SPHERE_GLSL
#include "shaping.glsl"

KX_INLINE bool sphereIsPoint(LightHot light) {
    return light.sizeM.x < KX_POINT_RADIUS_M;
}

KX_INLINE LightBounds sphereBounds(LightHot light) {
    return rangeBounds(light);
}

KX_INLINE vec3 sphereEvaluate(LightHot light, vec3 receiverWs) {
    float window = rangeWindow(light, length(receiverWs - light.positionWs));
    float perArea = sphereIsPoint(light) ? 1.0 : KX_INV_PI / square(light.sizeM.x);
    return light.intensity * (window * perArea);
}

KX_INLINE EmitterOutline sphereOutline(LightHot light, vec3 receiverWs, float alpha) {
    vec3 toCenter = light.positionWs - receiverWs;
    float distance2 = dot(toCenter, toCenter);
    if (distance2 <= max(square(light.sizeM.x), 1.0e-24)) return unlitOutline();
    float invDistance = inversesqrt(distance2);
    if (sphereIsPoint(light)) return pointOutline(toCenter * invDistance, invDistance * invDistance);
    return coneOutline(toCenter * invDistance, min(light.sizeM.x * invDistance, 1.0), alpha);
}

// Points that face away are mirrored in the plane through the centre that faces the receiver, then moved so
// that they fill the visible cap evenly: continuous, and every sample is valid. The uv returned is the moved
// point's.
KX_INLINE LightSample sphereSample(LightHot light, vec3 receiverWs, vec2 uv) {
    vec3 toCenter = light.positionWs - receiverWs;
    float distanceM = length(toCenter);
    float radius = light.sizeM.x;
    LightSample s = invalidSample(uv);
    if (distanceM <= max(radius, 1.0e-12)) return s;
    vec3 axis = -toCenter / distanceM;
    if (sphereIsPoint(light)) {
        s = areaSample(toCenter, receiverWs, axis, uv, 1.0);
        s.pdfArea = 0.0;
        s.pdfSolidAngle = 0.0;
        return s;
    }
    mat3 frame = lightFrame(light);
    vec3 normal = frame * sphereFromSquare(uv);
    float height = dot(normal, axis);
    vec3 outward = normal - axis * height;
    float outwardLength = length(outward);
    outward = outwardLength > 1.0e-6 ? outward / outwardLength : basisFromNormal(axis)[0];
    float capHeight = min(radius / distanceM, 1.0);
    float moved = mix(capHeight, 1.0, min(abs(height), 1.0));
    normal = axis * moved + outward * sqrt(max(1.0 - moved * moved, 0.0));
    float pdfArea = 1.0 / (KX_TWO_PI * radius * radius * max(1.0 - capHeight, 1.0e-7));
    return areaSample(toCenter + normal * radius, receiverWs, normal,
                      squareFromSphere(transpose(frame) * normal), pdfArea);
}

KX_INLINE LightHit sphereIntersect(LightHot light, vec3 originWs, vec3 dirWs) {
    vec3 toCenter = light.positionWs - originWs;
    float radius = light.sizeM.x;
    float distance2 = dot(toCenter, toCenter);
    float along = dot(toCenter, dirWs);
    vec3 aside = toCenter - dirWs * along;
    float inside2 = radius * radius - dot(aside, aside);
    if (sphereIsPoint(light) || distance2 <= radius * radius || along <= 0.0 || inside2 < 0.0)
        return noLightHit();
    float distanceM = along - sqrt(inside2);
    vec3 normal = normalize(dirWs * distanceM - toCenter);
    float capHeight = min(radius * inversesqrt(distance2), 1.0);
    float pdfArea = 1.0 / (KX_TWO_PI * radius * radius * max(1.0 - capHeight, 1.0e-7));
    vec2 uv = squareFromSphere(transpose(lightFrame(light)) * normal);
    return areaHit(distanceM, uv, pdfArea, -dot(normal, dirWs));
}

KX_INLINE float sphereFlux(LightHot light) {
    return 4.0 * KX_PI * luminance(light.intensity);
}

#endif
