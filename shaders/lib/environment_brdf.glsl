// The pre-integrated environment BRDF by which specular light is demodulated (Zhuang et al., "Real-time Denoising
// Using BRDF Pre-integration Factorization", 2021). Needs ltcLookup1 (lib/light_access.glsl or its like).
#ifndef KILOLUX_LIB_ENVIRONMENT_BRDF_GLSL
#define KILOLUX_LIB_ENVIRONMENT_BRDF_GLSL
#include "../math/ltc.glsl"

// Of LtcLobe::albedo. Never 0, so that it can be divided by.
vec3 environmentBrdf(vec2 albedo, vec3 f0) {
    return max(f0 * albedo.x + vec3(albedo.y), vec3(1.0e-3));
}

vec3 environmentBrdf(float noV, float roughness, vec3 f0) {
    vec4 scales = ltcLookup1(ltcUv(noV, roughness));
    return environmentBrdf(scales.yz, f0);
}

#endif
