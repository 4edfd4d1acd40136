// Tube light: a capsule along local X (radius sizeM.x, half length sizeM.y between the centres of its ends),
// a Lambert emitter of radiance intensity / (4 r h + pi r^2), which is what its side shows. Seen from outside
// its silhouette is two arcs and the two edges where planes through the receiver touch the cylinder. uv: u
// along the axis from end to end (a capsule has the same area per axial length everywhere), v turns about it
// from local Y.
#ifndef KILOLUX_LIGHTS_TUBE_GLSL
#define KILOLUX_LIGHTS_TUBE_GLSL
#include "shaping.glsl"

KX_INLINE float tubeRadiusM(LightHot light) {
    return max(light.sizeM.x, 1.0e-4);
}

KX_INLINE float tubeAreaM2(LightHot light) {
    return 2.0 * KX_TWO_PI * tubeRadiusM(light) * (light.sizeM.y + tubeRadiusM(light));
}

// Of the side view.
KX_INLINE float tubeProfileM2(LightHot light) {
    float radius = tubeRadiusM(light);
    return radius * (4.0 * light.sizeM.y + KX_PI * radius);
}

KX_INLINE LightBounds tubeBounds(LightHot light) {
    return rangeBounds(light);
}

KX_INLINE vec3 tubeEvaluate(LightHot light, vec3 receiverWs) {
    float window = rangeWindow(light, length(receiverWs - light.positionWs));
    return light.intensity * (window / tubeProfileM2(light));
}

struct TubeCap {
    vec3 center;
    vec3 axisX; // away from the other end
    vec3 axisY;
    vec2 arc;
    float bulge;
};

// The arc of one end's silhouette circle between the two edges. `outward` points away from the other end;
// `fromAxis` is the receiver's distance to the tube's axis, > radius.
KX_INLINE TubeCap tubeCap(vec3 toEnd, vec3 outward, float fromAxis, float radius, int vertices) {
    float distance2 = dot(toEnd, toEnd);
    float invDistance = inversesqrt(distance2);
    vec3 dir = toEnd * invDistance;
    float slant = dot(dir, outward);
    float shrink2 = max(1.0 - radius * radius / distance2, 0.0); // of the circle that the receiver sees
    float ring = radius * sqrt(shrink2);
    vec3 x = normalize(outward - dir * slant);
    float contactY = radius * sqrt(max(fromAxis * fromAxis - radius * radius, 0.0)) / fromAxis;
    float contactX = radius * radius * slant / fromAxis;
    float halfArc = angleFromCosSin(contactX, contactY);
    float segments = float(vertices - 1);
    float step_ = 2.0 * halfArc / segments;
    float wanted = segments * (step_ / max(sin(step_), 1.0e-6));
    wanted = step_ < 1.0e-3 ? segments : wanted;
    TubeCap cap;
    cap.center = toEnd * shrink2;
    cap.axisX = x * ring;
    cap.axisY = cross(dir, x) * ring;
    cap.arc = vec2(-halfArc, step_);
    cap.bulge = (sqrt(1.0 + (segments - 2.0) * wanted) - 1.0) / (segments - 2.0);
    return cap;
}

KX_INLINE EmitterOutline tubeOutline(LightHot light, vec3 receiverWs, float alpha) {
    vec3 axis = lightFrame(light)[0];
    float radius = tubeRadiusM(light);
    vec3 toCenter = light.positionWs - receiverWs;
    float distanceM = length(toCenter);
    float along = dot(toCenter, axis);
    float nearest = clamp(-along, -light.sizeM.y, light.sizeM.y);
    vec3 toAxis = toCenter + axis * nearest;
    float nearest2 = dot(toAxis, toAxis);
    if (nearest2 <= radius * radius || distanceM <= 1.0e-12) return unlitOutline();
    vec3 foot = toCenter - axis * along;
    float fromAxis = length(foot);
    EmitterOutline outline;
    if (fromAxis <= radius * 1.0001 || light.sizeM.y <= radius * 1.0e-4) {
        // Seen end-on the nearer end hides the rest; a tube without length is a sphere.
        float invNearest = inversesqrt(nearest2);
        outline = coneOutline(toAxis * invNearest, min(radius * invNearest, 1.0), alpha);
    } else {
        float invDistance = 1.0 / distanceM;
        int vertices = circleVertices(radius * invDistance, alpha) / 2;
        TubeCap a = tubeCap(toCenter - axis * light.sizeM.y, -axis, fromAxis, radius, vertices);
        TubeCap b = tubeCap(toCenter + axis * light.sizeM.y, axis, fromAxis, radius, vertices);
        outline = unlitOutline();
        outline.centerA = a.center * invDistance;
        outline.axisXA = a.axisX * invDistance;
        outline.axisYA = a.axisY * invDistance;
        outline.arcA = a.arc;
        outline.centerB = b.center * invDistance;
        outline.axisXB = b.axisX * invDistance;
        outline.axisYB = b.axisY * invDistance;
        outline.arcB = b.arc;
        outline.bulge = vec2(a.bulge, b.bulge);
        outline.endVertices = 1;
        outline.countA = vertices;
        outline.count = 2 * vertices;
        outline.sectors = KX_CIRCLE_SECTORS;
    }
    outline.dirWs = toCenter / distanceM;
    outline.angularRadius = min((light.sizeM.y + radius) / distanceM, 1.0);
    float profile = radius * (4.0 * light.sizeM.y * (fromAxis / distanceM) + KX_PI * radius);
    outline.solidAngle = profile / (distanceM * distanceM);
    return outline;
}

// Points that face away are mirrored through the centre; one of the two faces the receiver, or neither does
// and the sample is invalid. Never both, so the density over what is seen is even.
KX_INLINE LightSample tubeSample(LightHot light, vec3 receiverWs, vec2 uv) {
    mat3 frame = lightFrame(light);
    float radius = tubeRadiusM(light);
    float halfLength = light.sizeM.y;
    float x = (2.0 * uv.x - 1.0) * (halfLength + radius);
    float onAxis = clamp(x, -halfLength, halfLength);
    float normalX = clamp((x - onAxis) / radius, -1.0, 1.0);
    float ring = sqrt(max(1.0 - normalX * normalX, 0.0));
    float phi = KX_TWO_PI * uv.y;
    vec3 normal = frame * vec3(normalX, ring * cos(phi), ring * sin(phi));
    vec3 offset = frame[0] * onAxis + normal * radius;
    vec3 toCenter = light.positionWs - receiverWs;
    bool mirrored = dot(normal, toCenter + offset) >= 0.0;
    normal = mirrored ? -normal : normal;
    offset = mirrored ? -offset : offset;
    float turned = uv.y < 0.5 ? uv.y + 0.5 : uv.y - 0.5;
    vec2 used = mirrored ? vec2(1.0 - uv.x, turned) : uv;
    return areaSample(toCenter + offset, receiverWs, normal, used, 2.0 / tubeAreaM2(light));
}

KX_INLINE LightHit tubeIntersect(LightHot light, vec3 originWs, vec3 dirWs) {
    mat3 frame = lightFrame(light);
    float radius = tubeRadiusM(light);
    vec3 from = transpose(frame) * (originWs - light.positionWs); // the axis is x
    vec3 dir = transpose(frame) * dirWs;
    vec3 outside = from - vec3(clamp(from.x, -light.sizeM.y, light.sizeM.y), 0.0, 0.0);
    if (dot(outside, outside) <= radius * radius) return noLightHit();
    // The cylinder first; beyond its ends the sphere of that end.
    float across2 = dir.y * dir.y + dir.z * dir.z;
    float end = dir.x < 0.0 ? light.sizeM.y : -light.sizeM.y;
    if (across2 > 1.0e-12) {
        float middle = -(from.y * dir.y + from.z * dir.z) / across2;
        float asideX = from.y * dir.z - from.z * dir.y;
        float inside2 = radius * radius * across2 - asideX * asideX;
        if (inside2 < 0.0) return noLightHit();
        float x = from.x + dir.x * (middle - sqrt(inside2) / across2);
        end = clamp(x, -light.sizeM.y, light.sizeM.y);
    }
    // Nearest approach to the sphere about (end, 0, 0), or to the cylinder's circle there: the same point.
    vec3 toEnd = vec3(end, 0.0, 0.0) - from;
    float along = dot(toEnd, dir);
    vec3 aside = toEnd - dir * along;
    float inside2 = radius * radius - dot(aside, aside);
    if (inside2 < 0.0) return noLightHit();
    float distanceM = along - sqrt(inside2);
    if (distanceM <= 0.0) return noLightHit();
    vec3 normal = (dir * distanceM - toEnd) / radius;
    float x = clamp(from.x + dir.x * distanceM, -light.sizeM.y - radius, light.sizeM.y + radius);
    vec2 uv = vec2(saturate(0.5 + 0.5 * x / (light.sizeM.y + radius)), turnFromPlane(normal.y, normal.z));
    return areaHit(distanceM, uv, 2.0 / tubeAreaM2(light), -dot(normal, dir));
}

KX_INLINE float tubeFlux(LightHot light) {
    return KX_PI * tubeAreaM2(light) / tubeProfileM2(light) * luminance(light.intensity);
}

#endif
