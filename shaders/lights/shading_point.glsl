// Makes the inputs of the light functions. Needs ltcLookup0 and ltcLookup1 (see math/ltc.glsl) declared
// before.
#ifndef KILOLUX_LIGHTS_SHADING_POINT_GLSL
#define KILOLUX_LIGHTS_SHADING_POINT_GLSL
#include "../math/ltc.glsl"
#include "../shared/channels.h"

// `normalWs` should face the viewer; noV is clamped where it does not. Lights of all channels reach it.
KX_INLINE ShadingPoint makeShadingPoint(vec3 positionWs, vec3 normalWs, vec3 viewDirWs, float roughness) {
    ShadingPoint point;
    point.positionWs = positionWs;
    point.normalWs = normalWs;
    point.viewDirWs = viewDirWs;
    point.noV = clamp(dot(normalWs, viewDirWs), KX_MIN_NOV, 1.0);
    point.roughness = clamp(roughness, KX_MIN_ROUGHNESS, 1.0);
    point.alpha = point.roughness * point.roughness;
    point.channels = CHANNELS_MASK;
    return point;
}

KX_INLINE LtcLobe makeLtcLobe(ShadingPoint point) {
    vec2 uv = ltcUv(point.noV, point.roughness);
    vec4 scales = ltcLookup1(uv);
    mat3 worldFromSurface = basisFromNormalTangent(point.normalWs, point.viewDirWs);
    LtcLobe lobe = ltcLobeFromParameters(worldFromSurface, point.noV, point.alpha, ltcLookup0(uv));
    lobe.amplitude = scales.x;
    lobe.albedo = vec2(scales.y, scales.z);
    return lobe;
}

#endif
