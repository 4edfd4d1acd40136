// The cheap weight by which candidate lights are chosen: about the luminance of unshadowed BRDF x light, without
// tables, edges and trigonometry. One formula serves all types, because the lanes of a SIMD group hold different
// ones; the type only chooses what goes in. Never 0 for a light that contributes. How well it follows the analytic
// irradiance is measured in tests/unit/lights/weight_test.cpp.
#ifndef KILOLUX_LIGHTS_WEIGHT_GLSL
#define KILOLUX_LIGHTS_WEIGHT_GLSL
#include "../math/brdf.glsl"
#include "barn_doors.glsl"
#include "light_filter.glsl"
#include "picture.glsl"

// A light's extent: along `longWs` and `shortWs`, which are square to each other, and for a sphere or a tube
// halfWidthM in every direction. Directional lights are at a distance of 1. Of a rectangle with barn doors it is the
// part that the receiver sees.
struct LightExtent {
    vec3 toCenter; // from the receiver, m
    float distance2; // m^2, to the middle of the whole light
    float share;     // that barn doors leave of the area
    vec3 longWs;   // unit, or 0 for what is round
    vec3 shortWs;
    float halfLengthM;
    float halfWidthM;
    float aheadM; // how far the receiver is on the side that the light looks to
    bool round_;  // sphere, spot, directional
    bool flat_;   // rectangle, disk
};

KX_INLINE LightExtent lightExtent(LightHot light, vec3 receiverWs) {
    uint type = lightType(light);
    bool directional = KX_HAS_DIRECTIONAL && type == LIGHT_DIRECTIONAL;
    bool rect = KX_HAS_RECT && type == LIGHT_RECT;
    bool disk = KX_HAS_DISK && type == LIGHT_DISK;
    bool tube = KX_HAS_TUBE && type == LIGHT_TUBE;
    LightExtent e;
    e.toCenter = directional ? -light.dirWs : light.positionWs - receiverWs;
    e.distance2 = max(dot(e.toCenter, e.toCenter), 1.0e-12);
    e.share = 1.0;
    e.aheadM = -dot(light.dirWs, e.toCenter);
    e.round_ = !rect && !disk && !tube;
    e.flat_ = rect || disk;
    vec3 tangent = vec3(0.0);
    if (rect || tube) tangent = unpackOct16(light.tangentOct);
    // A disk has no axes of its own: one is taken towards the receiver.
    vec3 aside = e.toCenter + light.dirWs * e.aheadM;
    if (disk) tangent = aside * inversesqrt(max(dot(aside, aside), 1.0e-20));
    bool turned = rect && light.sizeM.y > light.sizeM.x;
    vec3 bitangent = cross(light.dirWs, tangent);
    vec2 halfM = light.sizeM;
    if (KX_HAS_BARN_DOORS && rect) {
        // The bitangent here is local -Y.
        RectPart part = rectPart(light, vec2(-dot(e.toCenter, tangent), dot(e.toCenter, bitangent)), e.aheadM);
        e.toCenter += tangent * part.centerM.x - bitangent * part.centerM.y;
        e.share = part.share;
        halfM = part.halfM;
        turned = halfM.y > halfM.x;
    }
    e.longWs = turned ? bitangent : tangent;
    e.shortWs = turned ? tangent : bitangent;
    if (!e.flat_) e.shortWs = vec3(0.0);
    float radius = light.sizeM.x;
    if (directional) radius *= inversesqrt(1.0 + radius * radius);
    if (tube) radius = max(radius, 1.0e-4);
    e.halfLengthM = rect ? max(halfM.x, halfM.y) : (tube ? light.sizeM.y : (disk ? radius : 0.0));
    e.halfWidthM = rect ? min(halfM.x, halfM.y) : radius;
    return e;
}

// How far the light reaches from its centre along a unit direction and against it, at least.
KX_INLINE float extentAlong(LightExtent e, vec3 dirWs) {
    float across = e.flat_ ? abs(dot(e.shortWs, dirWs)) : 1.0;
    return e.halfLengthM * abs(dot(e.longWs, dirWs)) + e.halfWidthM * across;
}

// Whether a part of the light may be below the horizon of a receiver, or is behind barn doors. Below the horizon
// points are drawn again until one is above, and points between doors are those of the part that is seen: masks of
// the whole light's cells fit neither.
KX_INLINE bool lightIsCut(LightHot light, ShadingPoint point) {
    LightExtent e = lightExtent(light, point.positionWs);
    float slackM = 1.0e-3 * (e.halfLengthM + e.halfWidthM); // tangents are rounded
    return e.share < 1.0 || dot(point.normalWs, e.toCenter) < extentAlong(e, point.normalWs) + slackM;
}

// The light as the receiver sees it.
struct LightView {
    vec3 dirWs;       // unit, about towards the middle of what is seen; shorter inside a round light
    float solidAngle; // over the emitting area (tube: its side view); 1/m^2; round lights: 1 / distance^2
    float sinLong;    // of half the angle along the long axis
    float sinShort;   // and across
};

// Twice the sine of half the angle that from .. to fills at a distance: the angle itself for narrow ones, 2 for one
// that fills the half plane. `widthM` is asked for because to - from has no digits left of a narrow one.
KX_INLINE float seenWidth(float from, float to, float widthM, float distanceM, float invFrom, float invTo) {
    float cosine = min((from * to + distanceM * distanceM) * invFrom * invTo, 1.0);
    float sine = widthM * distanceM * invFrom * invTo;
    return sqrt(cosine > 0.0 ? sine * sine / (0.5 + 0.5 * cosine) : 2.0 - 2.0 * cosine);
}

// A light this much farther away than it reaches is a small one: every part of it is seen alike, to about 2 %.
const float KX_SMALL_LIGHT_RATIO2 = 64.0; // of squares

// A flat light fills two angles, one along each axis, each seen from the distance that is left where the light is
// nearest along the other. With the cosine at that nearest point, their product is the solid angle for small
// lights and about right for one that fills half of the sky, however near the receiver is to its plane or to its
// edges. A tube is as wide a strip that faces the receiver, and a sphere at the nearest point of its axis.
KX_INLINE LightView lightView(LightExtent e) {
    LightView view;
    float distance2 = max(dot(e.toCenter, e.toCenter), 1.0e-12);
    // Inside a round light the direction is short instead of uncertain.
    float invDistance2 = 1.0 / max(distance2, e.halfWidthM * e.halfWidthM);
    float invDistance = sqrt(invDistance2);
    view.dirWs = e.toCenter * invDistance;
    view.solidAngle = invDistance2;
    view.sinLong = 0.0;
    view.sinShort = e.halfWidthM * invDistance;
    if (e.round_) return view;
    float reachM = e.halfLengthM + e.halfWidthM;
    if (reachM * reachM * KX_SMALL_LIGHT_RATIO2 < distance2) {
        float alongAxis = dot(view.dirWs, e.longWs);
        float sideways = sqrt(max(1.0 - alongAxis * alongAxis, 0.0));
        float side = 4.0 * e.halfLengthM, end = KX_PI * e.halfWidthM;
        float facing = (side * sideways + end) / max(side + end, 1.0e-12);
        view.solidAngle = invDistance2 * (e.flat_ ? e.aheadM * invDistance : facing);
        view.sinLong = e.halfLengthM * invDistance * sideways;
        return view;
    }
    float a = e.halfLengthM, b = e.halfWidthM;
    float x = dot(e.toCenter, e.longWs), y = dot(e.toCenter, e.shortWs);
    float height2 = e.flat_ ? e.aheadM * e.aheadM : max(distance2 - x * x, b * b);
    height2 = max(height2, 1.0e-14);
    float besideX = max(abs(x) - a, 0.0), besideY = max(abs(y) - b, 0.0);
    float fromX2 = height2 + besideY * besideY, fromY2 = height2 + besideX * besideX;
    float fromX = sqrt(fromX2), fromY = sqrt(fromY2);
    float x0 = x - a, x1 = x + a, y0 = y - b, y1 = y + b;
    float invX0 = inversesqrt(x0 * x0 + fromX2), invX1 = inversesqrt(x1 * x1 + fromX2);
    float invY0 = inversesqrt(y0 * y0 + fromY2), invY1 = inversesqrt(y1 * y1 + fromY2);
    float widthX = seenWidth(x0, x1, 2.0 * a, fromX, invX0, invX1);
    float widthY = seenWidth(y0, y1, 2.0 * b, fromY, invY0, invY1);
    float nearest2 = fromX2 + besideX * besideX;
    float cosines = sqrt(height2 * nearest2) / (fromX * fromY);
    view.solidAngle = widthX * widthY * (1.0 + 0.143 * widthX * widthY) * cosines;
    // The area is written so that no compiler factors it differently where it knows the type.
    float endM2 = e.flat_ ? 0.0 : KX_PI * b * b;
    float areaM2 = b * (4.0 * a + (e.flat_ ? 0.0 : KX_PI * b));
    view.solidAngle = (view.solidAngle + endM2 / nearest2) / max(areaM2, KX_MIN_AREA_M2);
    // The middle of each angle.
    float middleX = (x0 * invX0 + x1 * invX1) / (invX0 + invX1);
    float middleY = (y0 * invY0 + y1 * invY1) / (invY0 + invY1);
    vec3 dir = e.toCenter + e.longWs * (middleX - x) + e.shortWs * (middleY - y);
    view.dirWs = dir * inversesqrt(max(dot(dir, dir), 1.0e-20));
    view.sinLong = 0.5 * widthX;
    view.sinShort = 0.5 * widthY;
    return view;
}

// About the luminance of the unshadowed reflected light; > 0 wherever that is. `diffuseAlbedo` is the luminance
// of baseColor * (1 - metallic), `f0` that of F0. Directions are only met in products with the normal, the view
// and the light's long axis, so that the lobe needs no vectors.
KX_INLINE float lightWeight(LightHot light, ShadingPoint point, float diffuseAlbedo, float f0) {
    if (KX_HAS_DOME && lightType(light) == LIGHT_DOME)
        return lightIsOn(light) ? domeWeight(light, point, diffuseAlbedo, f0) : 0.0;
    float intensity = luminance(light.intensity);
    LightExtent e = lightExtent(light, point.positionWs);
    // Limits are a little wide, and what is left of them above 0, so that rounding loses no light.
    float distance2 = e.distance2;
    float ratio2 = lightType(light) == LIGHT_DIRECTIONAL ? 0.0 : distance2 * light.invRange * light.invRange;
    float above = dot(point.normalWs, e.toCenter) + 1.001 * (e.halfLengthM + e.halfWidthM);
    bool dark = intensity <= 0.0 || !lightIsOn(light) || ratio2 > 1.00001 || above < 0.0;
    if (dark || (e.flat_ && e.aheadM <= 0.0) || !lightIncludes(light, point.channels)) return 0.0;
    if (KX_HAS_BARN_DOORS && e.share <= 0.0) return 0.0;
    intensity *= e.share * max(1.0 - ratio2 * ratio2, 1.0e-6);
    if (KX_HAS_SPOT && lightType(light) == LIGHT_SPOT) {
        float cone = e.aheadM * inversesqrt(distance2) * light.shaping.x + light.shaping.y;
        if (cone < -1.0e-4) return 0.0;
        intensity *= square(clamp(cone, 1.0e-4, 1.0));
    }
    intensity *= lightFilter(light, point.positionWs);
    LightView view = lightView(e);
    float noVRaw = dot(point.normalWs, point.viewDirWs);
    float nDir = dot(point.normalWs, view.dirWs), vDir = dot(point.viewDirWs, view.dirWs);
    float nLong = dot(point.normalWs, e.longWs), vLong = dot(point.viewDirWs, e.longWs);
    float dirLong = dot(view.dirWs, e.longWs);

    // Cosine over what is above the horizon: a parabola where the light is cut by it.
    float sine = view.sinLong * abs(nLong) + view.sinShort;
    float cut = clamp(nDir + sine, 0.0, 2.0 * sine);
    float diffuse = max(nDir - sine, 0.0) + 0.25 * cut * cut / max(sine, 1.0e-6) + 1.0e-5 + 1.0e-3 * sine;

    // The lobe sees the light's point nearest to the mirror direction m, and is as wide as both together:
    // toLobe = dir + long * shift + across * nearer, with across = m - dir * dot(m, dir) - long * along.
    float mDir = 2.0 * noVRaw * nDir - vDir;
    float along = 2.0 * noVRaw * nLong - vLong - mDir * dirLong;
    float across2 = max(1.0 - mDir * mDir - along * along, 1.0e-12);
    float nearer = min(view.sinShort * inversesqrt(across2), 1.0);
    float shift = clamp(along, -view.sinLong, view.sinLong);
    float nAcross = noVRaw - mDir * nDir - along * nLong;
    float vAcross = 2.0 * noVRaw * noVRaw - 1.0 - mDir * vDir - along * vLong;
    float length2 = 1.0 + shift * shift + across2 * nearer * nearer + 2.0 * dirLong * (shift - nearer * along);
    float invLength = inversesqrt(max(length2, 1.0e-6));
    float noL = (nDir + nLong * shift + nAcross * nearer) * invLength;
    float loV = (vDir + vLong * shift + vAcross * nearer) * invLength;
    // With h the sum of both directions: dot(h, h) = 2 + 2 loV, and all divisions of D and V in one.
    float half2 = max(2.0 + 2.0 * loV, 1.0e-6);
    float noHalf = noL + noVRaw;
    float awry = saturate(1.0 - 0.5 * sqrt(half2)); // from Schlick's Fresnel term
    float wide = min(point.alpha + 0.25 * (view.sinLong + view.sinShort), 1.0);
    float a2 = wide * wide;
    float d = half2 - min(noHalf * noHalf, half2) * (1.0 - a2);
    float facing = max(noL, 1.0e-3);
    // Smith's visibility as Hammon approximates it ("PBR Diffuse Lighting for GGX+Smith Microsurfaces", 2017),
    // with D and the cosine of the light.
    float lobe = a2 * half2 * half2 * facing * (0.5 * KX_INV_PI) /
                 max(d * d * mix(2.0 * facing * point.noV, facing + point.noV, wide), 1.0e-20);
    float specular = lobe * mix(f0, 1.0, square(awry * awry) * awry);

    if (lightHasPicture(light)) {
        vec2 tint = pictureWeights(light, point);
        diffuse *= tint.x;
        specular *= tint.y;
    }
    return intensity * view.solidAngle * (diffuseAlbedo * KX_INV_PI * diffuse + specular);
}

#endif
