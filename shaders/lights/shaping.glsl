// What all light types share: type and flags, the light's frame, range window and cone. Shaping is far-field:
// it depends on the receiver and on the light's centre only, so it multiplies the whole light and leaves
// analytic irradiance exact.
#ifndef KILOLUX_LIGHTS_SHAPING_GLSL
#define KILOLUX_LIGHTS_SHAPING_GLSL
#include "../math/approx.glsl"
#include "../math/basis.glsl"
#include "../math/color.glsl"
#include "../math/pack.glsl"
#include "../math/warp.glsl"
#include "../shared/gpu_light.h"
#include "light_types.glsl"

const float KX_POINT_RADIUS_M = 1.0e-5; // a smaller sphere is a point
const float KX_DELTA_TANGENT = 1.0e-5;  // a smaller directional disk is a delta
const float KX_MIN_AREA_M2 = 1.0e-12;
// Vertices of the polygon that stands for a circle, and sectors in which the fit is corrected. Measured over
// random lights (tests/unit/lights): with 4 sectors the 95th percentile of the GGX error is 3 to 6 %, with 8
// it is 1.5 to 4 %.
const int KX_CIRCLE_VERTICES = 16;
const int KX_CIRCLE_SECTORS = 8;

KX_INLINE uint lightType(LightHot light) {
    return light.typeFlags & LIGHT_TYPE_MASK;
}

// Without a place: it reaches everything.
KX_INLINE bool lightIsGlobal(LightHot light) {
    return lightType(light) == LIGHT_DIRECTIONAL || lightType(light) == LIGHT_DOME;
}

KX_INLINE bool lightHasShaping(LightHot light) {
    return light.typeFlags >> LIGHT_SHAPING_SHIFT != 0u;
}

// Of a light that has one.
KX_INLINE LightShaping lightShaping(LightHot light) {
    return lightShapingLookup((light.typeFlags >> LIGHT_SHAPING_SHIFT) - 1u);
}

// Whether the light reaches a mesh of these channels (ShadingPoint::channels).
KX_INLINE bool lightIncludes(LightHot light, uint channels) {
    if (!KX_HAS_LIGHT_CHANNELS || !lightHasShaping(light)) return true;
    uint asked = lightShaping(light).channels;
    return asked == CHANNELS_ALL || (asked & channels) != 0u;
}

// Neither dead nor muted.
KX_INLINE bool lightIsOn(LightHot light) {
    return (light.typeFlags & (LIGHT_FLAG_DEAD | LIGHT_FLAG_MUTED)) == 0u;
}

// Columns: the light's local X, Y, Z; it looks along -Z.
KX_INLINE mat3 lightFrame(LightHot light) {
    return basisFromNormalTangent(-light.dirWs, unpackOct16(light.tangentOct));
}

// glTF's recommendation, not squared: max(1 - (d / range)^4, 0).
KX_INLINE float rangeWindow(LightHot light, float distanceM) {
    float ratio2 = square(min(distanceM * light.invRange, 1.0));
    return 1.0 - ratio2 * ratio2;
}

KX_INLINE float spotCone(LightHot light, vec3 dirFromLightWs) {
    return square(saturate(dot(light.dirWs, dirFromLightWs) * light.shaping.x + light.shaping.y));
}

// A light that is narrow against the lobe needs half the vertices.
KX_INLINE int circleVertices(float sinRadius, float alpha) {
    return sinRadius < alpha ? KX_CIRCLE_VERTICES / 2 : KX_CIRCLE_VERTICES;
}

// A polygon that stands for a circle has its area when its corners lie this much outside.
KX_INLINE float circleBulge(int vertices) {
    float step_ = KX_TWO_PI / float(vertices);
    return sqrt(step_ / sin(step_));
}

KX_INLINE EmitterOutline unlitOutline() {
    EmitterOutline outline;
    outline.centerA = vec3(0.0);
    outline.axisXA = vec3(0.0);
    outline.axisYA = vec3(0.0);
    outline.centerB = vec3(0.0);
    outline.axisXB = vec3(0.0);
    outline.axisYB = vec3(0.0);
    outline.arcA = vec2(0.0);
    outline.arcB = vec2(0.0);
    outline.bulge = vec2(1.0);
    outline.endVertices = 0;
    outline.countA = 0;
    outline.count = 0;
    outline.sectors = 1;
    outline.correction = 1.0;
    outline.dirWs = vec3(0.0, 0.0, 1.0);
    outline.angularRadius = 0.0;
    outline.solidAngle = 0.0;
    return outline;
}

KX_INLINE EmitterOutline pointOutline(vec3 dirWs, float solidAngle) {
    EmitterOutline outline = unlitOutline();
    outline.dirWs = dirWs;
    outline.solidAngle = solidAngle;
    return outline;
}

// A right circular cone of directions: a sphere, or the directional light's disk.
KX_INLINE EmitterOutline coneOutline(vec3 dirWs, float sinRadius, float alpha) {
    EmitterOutline outline = unlitOutline();
    float cosRadius = sqrt(max(1.0 - sinRadius * sinRadius, 0.0));
    mat3 basis = basisFromNormal(dirWs);
    outline.centerA = dirWs * cosRadius;
    outline.axisXA = basis[0] * sinRadius;
    outline.axisYA = basis[1] * sinRadius;
    int vertices = circleVertices(sinRadius, alpha);
    float step_ = KX_TWO_PI / float(vertices);
    outline.arcA = vec2(0.0, step_);
    outline.bulge = vec2(circleBulge(vertices));
    outline.countA = vertices;
    outline.count = vertices;
    outline.sectors = KX_CIRCLE_SECTORS;
    outline.dirWs = dirWs;
    outline.angularRadius = sinRadius;
    outline.solidAngle = KX_PI * sinRadius * sinRadius;
    // One edge of the polygon at its corners (R, 0, c) and (R cos, R sin, c): its plane's normal times its
    // angle.
    float corner2 = square(sinRadius * outline.bulge.x);
    float up = corner2 * sin(step_);
    float sideways = sqrt(2.0 * corner2 * (1.0 - cos(step_))) * cosRadius;
    float sine = sqrt(up * up + sideways * sideways);
    float edge =
        angleFromCosSin(corner2 * cos(step_) + cosRadius * cosRadius, sine) * up / max(sine, 1.0e-30);
    outline.correction = outline.solidAngle / max(0.5 * float(vertices) * edge, 1.0e-30);
    return outline;
}

KX_INLINE LightSample invalidSample(vec2 uv) {
    LightSample s;
    s.positionWs = vec3(0.0);
    s.dirWs = vec3(0.0, 0.0, 1.0);
    s.distanceM = 0.0;
    s.emitterNormalWs = vec3(0.0, 0.0, 1.0);
    s.uv = uv;
    s.pdfArea = 0.0;
    s.pdfSolidAngle = 0.0;
    s.geometry = 0.0;
    s.tint = vec3(1.0);
    s.valid = false;
    return s;
}

// A sample at a point with an emitter normal; pdfArea 0 makes it a delta light's.
KX_INLINE LightSample areaSample(vec3 toPoint, vec3 receiverWs, vec3 emitterNormalWs, vec2 uv,
                                 float pdfArea) {
    LightSample s = invalidSample(uv);
    float distance2 = dot(toPoint, toPoint);
    if (distance2 <= 1.0e-30) return s;
    s.distanceM = sqrt(distance2);
    s.dirWs = toPoint / s.distanceM;
    s.positionWs = receiverWs + toPoint;
    s.emitterNormalWs = emitterNormalWs;
    s.pdfArea = pdfArea;
    float cosEmitter = -dot(emitterNormalWs, s.dirWs);
    s.valid = cosEmitter > 0.0;
    s.pdfSolidAngle = s.valid ? pdfArea * distance2 / max(cosEmitter, 1.0e-12) : 0.0;
    s.geometry = s.valid ? cosEmitter / (distance2 * pdfArea) : 0.0;
    return s;
}

KX_INLINE LightHit noLightHit() {
    LightHit hit;
    hit.hit = false;
    hit.distanceM = KX_INFINITY;
    hit.uv = vec2(0.0);
    hit.pdfArea = 0.0;
    hit.pdfSolidAngle = 0.0;
    return hit;
}

KX_INLINE LightHit areaHit(float distanceM, vec2 uv, float pdfArea, float cosEmitter) {
    LightHit hit;
    hit.hit = cosEmitter > 0.0;
    hit.distanceM = distanceM;
    hit.uv = uv;
    hit.pdfArea = pdfArea;
    hit.pdfSolidAngle = pdfArea * distanceM * distanceM / max(cosEmitter, 1.0e-12);
    return hit;
}

KX_INLINE LightBounds rangeBounds(LightHot light) {
    LightBounds bounds;
    bounds.centerWs = light.positionWs;
    bounds.radiusM = light.invRange > 0.0 ? 1.0 / light.invRange : KX_INFINITY;
    bounds.axisWs = light.dirWs;
    bounds.cosHalfAngle = -1.0;
    return bounds;
}

// Rectangle and disk shine on the side they look to only: a half space, and a radiance of intensity / area there.
KX_INLINE LightBounds oneSidedBounds(LightHot light) {
    LightBounds bounds = rangeBounds(light);
    bounds.cosHalfAngle = 0.0;
    return bounds;
}

KX_INLINE vec3 oneSidedEvaluate(LightHot light, vec3 receiverWs, float areaM2) {
    vec3 fromCenter = receiverWs - light.positionWs;
    float side = dot(light.dirWs, fromCenter) > 0.0 ? 1.0 : 0.0;
    return light.intensity * (side * rangeWindow(light, length(fromCenter)) / areaM2);
}

#endif
