// The environment BRDF for passes that have no lights: with the table's own binding.
#ifndef KILOLUX_LIB_ENVIRONMENT_BRDF_TABLE_GLSL
#define KILOLUX_LIB_ENVIRONMENT_BRDF_TABLE_GLSL
#include "frame.glsl"
#include "gbuffer.glsl"

uniform sampler2D ltcScales;
vec4 ltcLookup1(vec2 uv) {
    return textureLod(ltcScales, uv, 0.0);
}
#include "environment_brdf.glsl"

vec3 environmentBrdfAt(Surface surface, uvec2 pixel) {
    float noV = clamp(dot(surface.normalWs, -normalize(cameraRay(pixel).dir)), KX_MIN_NOV, 1.0);
    return environmentBrdf(noV, clamp(surface.roughness, KX_MIN_ROUGHNESS, 1.0), specularF0(surface));
}

#endif
