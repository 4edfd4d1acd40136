// The pre-integrated environment BRDF by which specular light is demodulated (Zhuang et al., "Real-time Denoising
// Using BRDF Pre-integration Factorization", 2021). Needs ltcLookup1 (lib/light_access.glsl or its like).
#ifndef KILOLUX_LIB_ENVIRONMENT_BRDF_GLSL
#define KILOLUX_LIB_ENVIRONMENT_BRDF_GLSL
#include "../math/ltc.glsl"

// Never 0, so that it can be divided by.
vec3 environmentBrdf(float noV, float roughness, vec3 f0) {
    vec4 scales = ltcLookup1(ltcUv(noV, roughness));
    return max(f0 * scales.y + vec3(scales.z), vec3(1.0e-3));
}

#endif
