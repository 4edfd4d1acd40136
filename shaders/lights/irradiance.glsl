// Analytic irradiance of an outline: diffuse by Lambert's formula, GGX by linearly transformed cosines (Heitz
// et al. 2016), both clipped to the horizon. The LTC is only a fit, so its integral is taken over sectors of
// the light and each is corrected by the true GGX over the LTC in the sector's mean direction, under the
// lobe: exact for small lights, and a good cubature for large ones. Measured against quadrature in
// tests/unit/lights/accuracy_test.cpp.
#ifndef KILOLUX_LIGHTS_IRRADIANCE_GLSL
#define KILOLUX_LIGHTS_IRRADIANCE_GLSL
#include "../math/ltc.glsl"
#include "shaping.glsl"

KX_INLINE vec3 outlineVertex(EmitterOutline outline, int index) {
    bool onB = index >= outline.countA;
    int k = onB ? index - outline.countA : index;
    int last = (onB ? outline.count - outline.countA : outline.countA) - 1;
    vec2 arc = onB ? outline.arcB : outline.arcA;
    float angle = arc.x + arc.y * float(k);
    bool inner = k >= outline.endVertices && k <= last - outline.endVertices;
    float bulge = inner ? (onB ? outline.bulge.y : outline.bulge.x) : 1.0;
    float x = cos(angle) * bulge;
    float y = sin(angle) * bulge;
    vec3 atA = outline.centerA + outline.axisXA * x + outline.axisYA * y;
    vec3 atB = outline.centerB + outline.axisXB * x + outline.axisYB * y;
    return onB ? atB : atA;
}

// A polygon walked edge by edge in LTC space and clipped to z >= 0 there.
struct LtcWalk {
    vec3 sum;   // twice the vector irradiance so far
    vec3 exit_; // where the walk went below and came up again
    vec3 entry;
};

KX_INLINE LtcWalk startWalk() {
    LtcWalk walk;
    walk.sum = vec3(0.0);
    walk.exit_ = vec3(0.0);
    walk.entry = vec3(0.0);
    return walk;
}

KX_INLINE void walkEdge(INOUT(LtcWalk) walk, vec3 a, vec3 b, vec3 plane) {
    if (a.z < 0.0 && b.z < 0.0) return;
    vec3 from = a;
    vec3 to = b;
    if (a.z < 0.0) {
        from = horizonCrossing(a, a.z, b, b.z);
        walk.entry = from;
    } else if (b.z < 0.0) {
        to = horizonCrossing(b, b.z, a, a.z);
        walk.exit_ = to;
    }
    walk.sum += edgeVectorIrradiance(from, to, plane);
}

KX_INLINE vec3 walkSum(LtcWalk walk) {
    return (walk.sum + edgeVectorIrradiance(walk.exit_, walk.entry, vec3(0.0, 0.0, 1.0))) * 0.5;
}

// The outline edge by edge in world space, clipped to the horizon.
struct OutlineWalk {
    vec3 vertex; // the last one reached, and its height above the horizon
    float height;
    vec3 exit_; // where the outline went below and came up again
    vec3 entry;
    vec3 from; // the current edge, where `visible`
    vec3 to;
    bool visible;
    bool begins; // the edge begins a sector
    bool ends;
};

KX_INLINE OutlineWalk startOutlineWalk(EmitterOutline outline, vec3 normal) {
    OutlineWalk walk;
    walk.vertex = outlineVertex(outline, outline.count - 1);
    walk.height = dot(walk.vertex, normal);
    walk.exit_ = vec3(0.0);
    walk.entry = vec3(0.0);
    walk.from = walk.vertex;
    walk.to = walk.vertex;
    walk.visible = false;
    walk.begins = false;
    walk.ends = false;
    return walk;
}

// Edge `index` ends at that vertex; the one after the last closes the outline along the horizon.
KX_INLINE void stepOutline(INOUT(OutlineWalk) walk, EmitterOutline outline, vec3 normal, int index) {
    walk.from = walk.exit_;
    walk.to = walk.entry;
    walk.visible = true;
    walk.begins = true;
    walk.ends = true;
    if (index >= outline.count) return;
    vec3 next = outlineVertex(outline, index);
    float heightNext = dot(next, normal);
    walk.from = walk.vertex;
    walk.to = next;
    walk.visible = walk.height >= 0.0 || heightNext >= 0.0;
    walk.begins = index * outline.sectors % outline.count == 0;
    walk.ends = (index + 1) * outline.sectors % outline.count == 0;
    if (walk.height < 0.0 && heightNext >= 0.0) {
        walk.from = horizonCrossing(walk.vertex, walk.height, next, heightNext);
        walk.entry = walk.from;
        walk.begins = true;
    } else if (walk.height >= 0.0 && heightNext < 0.0) {
        walk.to = horizonCrossing(next, heightNext, walk.vertex, walk.height);
        walk.exit_ = walk.to;
        walk.ends = true;
    }
    walk.vertex = next;
    walk.height = heightNext;
}

// The fitted lobe over a sector with this vector irradiance in LTC space, times GGX over the LTC in its mean
// direction; split for Fresnel. A wide sector's mean under the cosine lies nearer the lobe's axis than its
// vector irradiance does: 2.28 makes it right for a quarter of the hemisphere.
KX_INLINE vec2 correctedSector(ShadingPoint point, LtcLobe lobe, vec3 sector) {
    float share = sector.z * KX_INV_PI;
    if (share <= 0.0) return vec2(0.0);
    vec3 dir = lobe.worldFromLtc * vec3(sector.x, sector.y, sector.z * (1.0 + 2.28 * share));
    dir = dir * inversesqrt(max(dot(dir, dir), 1.0e-30));
    vec2 exact = ggxTimesCosine(point.normalWs, point.viewDirWs, point.noV, dir, point.alpha);
    float density = ltcDensity(lobe, dir);
    float value = density > 0.0 ? share * min(exact.x / density, 100.0 * lobe.amplitude) : 0.0;
    return vec2(value * (1.0 - exact.y), value * exact.y);
}

struct OutlineIntegral {
    vec3 diffuse;  // vector irradiance of unit radiance above the horizon, in world space
    float covered; // share of the LTC
    vec2 specular; // split for Fresnel
};

// Two turns around the outline: the first finds the middle of what the lobe sees, the second sums the sectors
// about it.
KX_INLINE OutlineIntegral integrateOutline(EmitterOutline outline, ShadingPoint point, LtcLobe lobe) {
    OutlineIntegral result;
    result.diffuse = vec3(0.0);
    result.covered = 0.0;
    result.specular = vec2(0.0);
    // Planes are found in world space and transformed: in LTC space, stretched by 1 / alpha, they would drown
    // in rounding where a smooth surface lies near a large light.
    mat3 ltcPlaneFromWorld = transpose(lobe.worldFromLtc);
    vec3 middle = vec3(0.0);
    vec3 ltcMiddle = vec3(0.0);
    LtcWalk part = startWalk(); // of the whole light, then of a sector
    for (int turn = 0; turn < 2; ++turn) {
        OutlineWalk walk = startOutlineWalk(outline, point.normalWs);
        for (int i = 0; i <= outline.count; ++i) {
            stepOutline(walk, outline, point.normalWs, i);
            if (!walk.visible) continue;
            vec3 plane = i == outline.count ? point.normalWs : edgePlane(walk.from, walk.to);
            vec3 from = lobe.ltcFromWorld * walk.from;
            vec3 to = lobe.ltcFromWorld * walk.to;
            if (turn == 0) result.diffuse += edgeVectorIrradiance(walk.from, walk.to, plane) * 0.5;
            if (turn == 1 && walk.begins) {
                part = startWalk();
                walkEdge(part, ltcMiddle, from, ltcPlaneFromWorld * edgePlane(middle, walk.from));
            }
            walkEdge(part, from, to, ltcPlaneFromWorld * plane);
            if (turn == 1 && walk.ends) {
                walkEdge(part, to, ltcMiddle, ltcPlaneFromWorld * edgePlane(walk.to, middle));
                result.specular += correctedSector(point, lobe, walkSum(part));
            }
        }
        if (turn == 0) {
            ltcMiddle = walkSum(part);
            result.covered = max(ltcMiddle.z, 0.0) * KX_INV_PI;
            middle = lobe.worldFromLtc * ltcMiddle;
            middle = middle * inversesqrt(max(dot(middle, middle), 1.0e-30));
            ltcMiddle =
                lobe.ltcFromWorld * middle; // anew, so that both name the same point to the last digit
        }
    }
    return result;
}

// What the horizon leaves of a small round light: x its share in area, y the mean cosine of that part.
// `cosine` is the centre's, `sine` the radius.
KX_INLINE vec2 horizonCut(float cosine, float sine) {
    float height = clamp(cosine / max(sine, 1.0e-12), -1.0, 1.0);
    float chord = sqrt(1.0 - height * height);
    float share = (angleFromCosSin(-height, chord) + height * chord) * KX_INV_PI;
    float moment =
        max(height * share + (2.0 / 3.0) * KX_INV_PI * chord * chord * chord, 0.0); // in units of sine
    vec2 cut = vec2(share, moment * sine / max(share, 1.0e-12));
    return cosine >= sine ? vec2(1.0, cosine) : cut;
}

// A small light acts through its direction and solid angle alone.
KX_INLINE LightIrradiance smallIrradiance(EmitterOutline outline, ShadingPoint point, vec3 emission) {
    float cosine = dot(point.normalWs, outline.dirWs);
    vec2 cut = horizonCut(cosine, outline.angularRadius);
    float solidAngle = cosine + outline.angularRadius > 0.0 ? outline.solidAngle * cut.x : 0.0;
    vec3 dir = normalize(outline.dirWs + point.normalWs * max(cut.y - cosine, 0.0));
    vec2 lobe = ggxTimesCosine(point.normalWs, point.viewDirWs, point.noV, dir, point.alpha);
    float specular = solidAngle * lobe.x;
    LightIrradiance result;
    result.emission = emission;
    result.specularEmission = emission;
    result.diffuse = solidAngle * cut.y;
    result.specular = vec2(specular * (1.0 - lobe.y), specular * lobe.y);
    return result;
}

// No light of this solid angle can give more: GGX where the light's bounding cone comes nearest the mirror
// direction. Keeps rounding in the far tail of smooth lobes from lighting anything.
KX_INLINE float specularBound(EmitterOutline outline, ShadingPoint point, float solidAngle) {
    vec3 mirrorDir = point.normalWs * (2.0 * point.noV) - point.viewDirWs;
    float cosAngle = dot(mirrorDir, outline.dirWs);
    float sinAngle = length(cross(mirrorDir, outline.dirWs));
    float cosRadius = sqrt(max(1.0 - outline.angularRadius * outline.angularRadius, 0.0));
    // Half vectors turn half as far as the light does; the radius is taken a little wide.
    float cosGap = cosAngle * cosRadius + sinAngle * outline.angularRadius;
    bool apart = cosAngle < cosRadius && outline.angularRadius < 1.0; // from inside the cone is all around
    float sin2Half = apart ? 0.5 * (1.0 - min(cosGap, 1.0)) * 0.9 : 0.0;
    float a2 = point.alpha * point.alpha;
    float masking = 0.5 * inversesqrt(point.noV * point.noV * (1.0 - a2) + a2); // of V * noL
    return solidAngle * masking * ggxD(sqrt(1.0 - sin2Half), sin2Half, point.alpha);
}

// `emission` is lightEvaluate() at the point.
KX_INLINE LightIrradiance outlineIrradiance(EmitterOutline outline, ShadingPoint point, LtcLobe lobe,
                                            vec3 emission) {
    float cosine = dot(point.normalWs, outline.dirWs);
    float radius = outline.angularRadius;
    bool small_ = radius <= min(0.01, 0.1 * point.alpha) || (abs(cosine) < radius && radius < 0.01);
    // A cone of directions above the horizon has its diffuse light in closed form, so only the lobe limits its size:
    // over one of 0.15 alpha the lobe's mean is within 0.6 % of its middle.
    bool isCone = abs(outline.solidAngle - KX_PI * radius * radius) <= 1.0e-6 * outline.solidAngle;
    small_ = small_ || (isCone && cosine >= radius && radius <= 0.15 * point.alpha);
    bool edgeOn =
        outline.solidAngle < 1.0e-3 * radius * radius && radius < 0.25; // a sliver, lost in rounding
    if (small_ || edgeOn || outline.solidAngle <= 0.0 || cosine + radius <= 0.0)
        return smallIrradiance(outline, point, emission);
    OutlineIntegral sum = integrateOutline(outline, point, lobe);
    LightIrradiance result;
    result.emission = emission;
    result.specularEmission = emission;
    result.diffuse = max(dot(sum.diffuse, point.normalWs), 0.0) * outline.correction;
    // A light that covers the whole lobe gives the lobe's integral.
    float ofLobe = saturate(sum.covered * lobe.amplitude / max(lobe.albedo.x + lobe.albedo.y, 1.0e-6));
    float whole = square(square(square(ofLobe)));
    vec2 fitted = mix(sum.specular, lobe.albedo * ofLobe, whole);
    // The fitted lobe ends at a plane of its own. Where the light lies about there or beyond and is narrow
    // against the lobe, its solid angle times GGX at its middle is better.
    float solidAngle = length(sum.diffuse);
    vec3 middle = sum.diffuse / max(solidAngle, 1.0e-20);
    vec3 ltcMiddle = lobe.ltcFromWorld * middle;
    float beyond =
        1.0 - smoothstep(0.0, 0.2, ltcMiddle.z * inversesqrt(max(dot(ltcMiddle, ltcMiddle), 1.0e-30)));
    float narrow = 1.0 - smoothstep(0.15, 0.6, sqrt(solidAngle * KX_INV_PI) / point.alpha);
    vec2 ggx = ggxTimesCosine(point.normalWs, point.viewDirWs, point.noV, middle, point.alpha);
    float direct = solidAngle * ggx.x;
    result.specular = mix(fitted, vec2(direct * (1.0 - ggx.y), direct * ggx.y), beyond * narrow);
    // Nor more than from light of this radiance all around.
    float most = min(specularBound(outline, point, solidAngle * 1.1), lobe.albedo.x + lobe.albedo.y);
    result.specular = result.specular * min(1.0, most / max(result.specular.x + result.specular.y, 1.0e-30));
    return result;
}

#endif
