// glTF's metallic-roughness BRDF: Lambert without Fresnel coupling, and GGX with Smith height-correlated
// visibility and Schlick's Fresnel term (Walter et al. 2007; Heitz, "Understanding the Masking-Shadowing
// Function", JCGT 2014, section 6.3). alpha = roughness^2. Directions point away from the surface.
#ifndef KILOLUX_MATH_BRDF_GLSL
#define KILOLUX_MATH_BRDF_GLSL
#include "prelude.glsl"

const float KX_MIN_ROUGHNESS = 0.05;
const float KX_MIN_NOV = 1.0e-4;

KX_INLINE float alphaFromRoughness(float roughness) {
    return square(max(roughness, KX_MIN_ROUGHNESS));
}

// sin2NoH = |n x h|^2 is asked for beside the cosine because 1 - noH^2 has no digits left in float where a
// smooth lobe has its peak.
KX_INLINE float ggxD(float noH, float sin2NoH, float alpha) {
    float a2 = alpha * alpha;
    float d = noH * noH * a2 + sin2NoH;
    return a2 / max(KX_PI * d * d, 1.0e-30);
}

// Smith height-correlated G2 / (4 noL noV).
KX_INLINE float ggxV(float noL, float noV, float alpha) {
    float a2 = alpha * alpha;
    float shadow = noL * sqrt(noV * noV * (1.0 - a2) + a2);
    float mask = noV * sqrt(noL * noL * (1.0 - a2) + a2);
    return 0.5 / max(shadow + mask, 1.0e-20);
}

// Schlick's weight (1 - loH)^5: F = F0 * (1 - weight) + F90 * weight.
KX_INLINE float schlickWeight(float loH) {
    float m = saturate(1.0 - loH);
    return m * m * m * m * m;
}

// x: D * V * noL, y: Schlick's weight, for unit normal, view and light directions. 0 below the horizon. noV
// is asked for because callers clamp it.
KX_INLINE vec2 ggxTimesCosine(vec3 normal, vec3 viewDir, float noV, vec3 lightDir, float alpha) {
    float noL = dot(normal, lightDir);
    vec3 halfSum = viewDir + lightDir;
    float halfLength2 = max(dot(halfSum, halfSum), 1.0e-20);
    vec3 across = cross(normal, halfSum);
    float invLength = inversesqrt(halfLength2);
    float noH = dot(normal, halfSum) * invLength;
    float loH = dot(lightDir, halfSum) * invLength;
    float value = ggxD(noH, dot(across, across) / halfLength2, alpha) * ggxV(max(noL, 0.0), noV, alpha);
    return vec2(value * max(noL, 0.0), schlickWeight(loH));
}

struct BrdfTimesCosine {
    float diffuse; // noL / pi, to be multiplied by the diffuse albedo
    vec2 specular; // D * V * noL split for Fresnel: specular = F0 * x + F90 * y
};

// Both lobes in 1/sr, the cosine of the light direction contained; 0 below the horizon.
KX_INLINE BrdfTimesCosine brdfTimesCosine(vec3 normal, vec3 viewDir, float noV, vec3 lightDir, float alpha) {
    vec2 lobe = ggxTimesCosine(normal, viewDir, noV, lightDir, alpha);
    BrdfTimesCosine value;
    value.diffuse = max(dot(normal, lightDir), 0.0) * KX_INV_PI;
    value.specular = vec2(lobe.x * (1.0 - lobe.y), lobe.x * lobe.y);
    return value;
}

#endif
