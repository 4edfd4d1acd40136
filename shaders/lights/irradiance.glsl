// Analytic irradiance of an outline: diffuse by Lambert's formula, GGX by linearly transformed cosines (Heitz et
// al. 2016), both clipped to the horizon, from one walk over the outline's edges. Where the walk says how much of
// the LTC the light covers and in which direction, the true GGX value over the LTC's there corrects the fit: that
// is exact for small lights and fades out for those that cover the lobe, whose integral is exact by the fit.
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

struct OutlineIntegral {
    vec3 diffuse;  // vector irradiance of unit radiance above the horizon, in world space
    vec3 specular; // the same in LTC space, above the horizon of both
};

// Adds an edge in LTC space, clipped to z >= 0; `exit_` and `entry` keep where the outline left and came back.
KX_INLINE vec3 specularEdge(vec3 a, vec3 b, INOUT(vec3) exit_, INOUT(vec3) entry) {
    if (a.z < 0.0 && b.z < 0.0)
        return vec3(0.0);
    vec3 from = a;
    vec3 to = b;
    if (a.z < 0.0) {
        from = horizonCrossing(a, a.z, b, b.z);
        entry = from;
    } else if (b.z < 0.0) {
        to = horizonCrossing(b, b.z, a, a.z);
        exit_ = to;
    }
    return edgeVectorIrradiance(from, to);
}

KX_INLINE OutlineIntegral integrateOutline(EmitterOutline outline, vec3 normal, LtcLobe lobe) {
    OutlineIntegral sum;
    sum.diffuse = vec3(0.0);
    sum.specular = vec3(0.0);
    vec3 worldExit = vec3(0.0); // where the outline goes below the horizon and comes up again
    vec3 worldEntry = vec3(0.0);
    vec3 ltcExit = vec3(0.0);
    vec3 ltcEntry = vec3(0.0);
    vec3 a = outlineVertex(outline, outline.count - 1);
    float heightA = dot(a, normal);
    // One turn more than there are edges: it closes the outline along the horizon.
    for (int i = 0; i <= outline.count; ++i) {
        vec3 from = worldExit;
        vec3 to = worldEntry;
        bool visible = true;
        if (i < outline.count) {
            vec3 b = outlineVertex(outline, i);
            float heightB = dot(b, normal);
            from = a;
            to = b;
            visible = heightA >= 0.0 || heightB >= 0.0;
            if (heightA < 0.0 && heightB >= 0.0) {
                from = horizonCrossing(a, heightA, b, heightB);
                worldEntry = from;
            } else if (heightA >= 0.0 && heightB < 0.0) {
                to = horizonCrossing(b, heightB, a, heightA);
                worldExit = to;
            }
            a = b;
            heightA = heightB;
        }
        if (visible) {
            sum.diffuse += edgeVectorIrradiance(from, to);
            sum.specular += specularEdge(lobe.ltcFromWorld * from, lobe.ltcFromWorld * to, ltcExit, ltcEntry);
        }
    }
    sum.specular += edgeVectorIrradiance(ltcExit, ltcEntry);
    sum.diffuse = sum.diffuse * 0.5;
    sum.specular = sum.specular * 0.5;
    return sum;
}

// The mean of max(cosine, 0) over a small round light at this cosine, whose extent along the normal is +-sine.
KX_INLINE float horizonCosine(float cosine, float sine) {
    float part = saturate((cosine + sine) / max(2.0 * sine, 1.0e-6));
    return cosine >= sine ? cosine : part * part * sine;
}

// A small light acts through its direction and solid angle alone.
KX_INLINE LightIrradiance smallIrradiance(EmitterOutline outline, ShadingPoint point, vec3 emission) {
    float cosine = dot(point.normalWs, outline.dirWs);
    float clipped = outline.angularRadius > 0.0 ? horizonCosine(cosine, outline.angularRadius) : max(cosine, 0.0);
    vec2 lobe = ggxTimesCosine(point.normalWs, point.viewDirWs, point.noV, outline.dirWs, point.alpha);
    float specular = outline.solidAngle * lobe.x;
    LightIrradiance result;
    result.emission = emission;
    result.diffuse = outline.solidAngle * clipped;
    result.specular = vec2(specular * (1.0 - lobe.y), specular * lobe.y);
    return result;
}

// `emission` is lightEvaluate() at the point.
KX_INLINE LightIrradiance outlineIrradiance(EmitterOutline outline, ShadingPoint point, LtcLobe lobe, vec3 emission) {
    float small_ = min(0.01, 0.1 * point.alpha);
    if (outline.solidAngle <= 0.0 || outline.angularRadius <= small_)
        return smallIrradiance(outline, point, emission);
    OutlineIntegral sum = integrateOutline(outline, point.normalWs, lobe);
    LightIrradiance result;
    result.emission = emission;
    result.diffuse = max(dot(sum.diffuse, point.normalWs), 0.0) * outline.correction;
    float covered = max(sum.specular.z, 0.0) * KX_INV_PI;
    vec3 meanDir = lobe.worldFromLtc * sum.specular;
    meanDir = meanDir * inversesqrt(max(dot(meanDir, meanDir), 1.0e-30));
    vec2 exact = ggxTimesCosine(point.normalWs, point.viewDirWs, point.noV, meanDir, point.alpha);
    float fitted = lobe.amplitude * ltcDensity(lobe, meanDir);
    float ratio = fitted > 0.0 ? min(exact.x / fitted, 8.0) : 1.0;
    ratio = mix(ratio, 1.0, covered);
    float specular = covered * lobe.amplitude * ratio;
    float fresnel = saturate(exact.y + covered * lobe.fresnelOffset);
    result.specular = vec2(specular * (1.0 - fresnel), specular * fresnel);
    return result;
}

#endif
