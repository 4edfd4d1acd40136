// GGX as a linearly transformed cosine (Heitz, Dupuy, Hill and Neubelt, "Real-Time Polygonal-Light Shading
// with Linearly Transformed Cosines", 2016). The matrix is stored relative to the mirror direction and to
// alpha, so that its entries vary slowly even for smooth surfaces:
//   worldFromLtc = [tangent, bitangent, normal] * turn(mirror + a t) * [a x, 0, 0; 0, a y, 0; a s, 0, 1]
// with a = alpha. content/make/ltc_fit fits x, y, s, t per (noV, roughness); the includer provides
// ltcLookup0(uv) = (x, y, s / sin(viewAngle), t / sin(viewAngle)) and
// ltcLookup1(uv) = (amplitude, albedo for F0, albedo for F90, the fit's error), both linearly filtered.
#ifndef KILOLUX_MATH_LTC_GLSL
#define KILOLUX_MATH_LTC_GLSL
#include "../lights/light_types.glsl"
#include "approx.glsl"
#include "basis.glsl"
#include "brdf.glsl"

const float KX_LTC_SIZE = 64.0; // nodes along noV and along roughness

// Table coordinates in nodes 0..1 -> inputs and back: finer towards grazing views.
KX_INLINE vec2 ltcNodeFromInputs(float noV, float roughness) {
    return vec2(sqrt(saturate(noV)), saturate((roughness - KX_MIN_ROUGHNESS) / (1.0 - KX_MIN_ROUGHNESS)));
}

KX_INLINE vec2 ltcInputsFromNode(vec2 node) {
    return vec2(max(node.x * node.x, KX_MIN_NOV), mix(KX_MIN_ROUGHNESS, 1.0, node.y));
}

KX_INLINE vec2 ltcUv(float noV, float roughness) {
    return (ltcNodeFromInputs(noV, roughness) * (KX_LTC_SIZE - 1.0) + vec2(0.5)) * (1.0 / KX_LTC_SIZE);
}

// The lobe from its four parameters (ltcLookup0), in the frame whose columns are tangent (towards the
// viewer), bitangent, normal. Amplitude and albedo are left 1 and 0.
KX_INLINE LtcLobe ltcLobeFromParameters(mat3 worldFromSurface, float noV, float alpha, vec4 parameters) {
    float sinView = sqrt(max(1.0 - noV * noV, 0.0));
    float tilt = parameters.w * alpha * sinView;
    float cosTilt = cos(tilt);
    float sinTilt = sin(tilt);
    float cosLobe =
        noV * cosTilt - sinView * sinTilt; // the lobe's angle from the normal, away from the viewer
    float sinLobe = sinView * cosTilt + noV * sinTilt;
    mat3 surfaceFromLobe =
        mat3(vec3(cosLobe, 0.0, sinLobe), vec3(0.0, 1.0, 0.0), vec3(-sinLobe, 0.0, cosLobe));
    mat3 worldFromLobe = worldFromSurface * surfaceFromLobe;
    float x = alpha * parameters.x;
    float y = alpha * parameters.y;
    float skew = alpha * parameters.z * sinView;
    LtcLobe lobe;
    lobe.worldFromLtc = worldFromLobe * mat3(vec3(x, 0.0, skew), vec3(0.0, y, 0.0), vec3(0.0, 0.0, 1.0));
    lobe.ltcFromWorld = mat3(vec3(1.0 / x, 0.0, -skew / x), vec3(0.0, 1.0 / y, 0.0), vec3(0.0, 0.0, 1.0)) *
                        transpose(worldFromLobe);
    lobe.density = KX_INV_PI / (x * y);
    lobe.amplitude = 1.0;
    lobe.albedo = vec2(0.0);
    return lobe;
}

// The share of the LTC that lies above the surface's horizon: a lune of the cosine (form factor of two
// planes).
KX_INLINE float ltcShareAboveHorizon(LtcLobe lobe, vec3 normal) {
    vec3 plane = transpose(lobe.worldFromLtc) * normal;
    return 0.5 + 0.5 * plane.z * inversesqrt(max(dot(plane, plane), 1.0e-30));
}

// The LTC's density in a direction, 1/sr; integrates to 1 over the sphere. Not scaled by the amplitude.
KX_INLINE float ltcDensity(LtcLobe lobe, vec3 dirWs) {
    vec3 cosineDir = lobe.ltcFromWorld * dirWs;
    float length2 = dot(cosineDir, cosineDir);
    return lobe.density * max(cosineDir.z, 0.0) / (length2 * length2);
}

// The plane through two points and the receiver: a normal of any length. The difference of two near points is
// exact, their cross product is not: written with it, a light of 1/1000 of its distance keeps four digits in
// float.
KX_INLINE vec3 edgePlane(vec3 a, vec3 b) {
    return cross(a, b - a);
}

// An edge's share of the vector irradiance of a polygon of unit radiance, doubled: the unit normal of the
// edge's plane times the angle between its ends. The plane is asked for because near and opposite ends do not
// tell it.
KX_INLINE vec3 edgeVectorIrradiance(vec3 a, vec3 b, vec3 plane) {
    float angle = angleFromCosSin(dot(a, b), length(cross(a, b - a)));
    float length2 = dot(plane, plane);
    return length2 > 0.0 ? plane * (angle * inversesqrt(length2)) : vec3(0.0);
}

// Where the segment from `below` (height < 0) to `above` (height >= 0) crosses height 0.
KX_INLINE vec3 horizonCrossing(vec3 below, float heightBelow, vec3 above, float heightAbove) {
    return mix(below, above, heightBelow / min(heightBelow - heightAbove, -1.0e-30));
}

#endif
