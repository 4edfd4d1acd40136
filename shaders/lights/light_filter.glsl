// What multiplies a whole light by the direction from its centre to the receiver, so that analytic irradiance stays
// exact: photometric profiles, and light functions, which are masks laid over the plane 1 m ahead (of a directional
// light over the plane of its node, in metres). The includer declares profileLookup(layer, uv) and
// functionImageLookup(layer, uv).
#ifndef KILOLUX_LIGHTS_LIGHT_FILTER_GLSL
#define KILOLUX_LIGHTS_LIGHT_FILTER_GLSL
#include "shaping.glsl"

// A profile image has a row per half degree from straight ahead to behind, and a column per 2.5 degrees of turn from
// local X towards Y, the first one repeated at the end.
const float KX_PROFILE_ROWS = 361.0;
const float KX_PROFILE_COLUMNS = 145.0;
// A profile on a flat light is divided by the cosine, so that the light's intensity is the profile's, down to this one
// (87 degrees); beyond, the light falls off as the cosine does.
const float KX_LEAST_PROFILE_COSINE = 0.05;

KX_INLINE vec2 profileUv(vec3 dirLs) {
    float vertical = angleFromCosSin(-dirLs.z, sqrt(dirLs.x * dirLs.x + dirLs.y * dirLs.y)) * KX_INV_PI;
    float turn = turnFromPlane(dirLs.x, dirLs.y);
    return vec2((turn * (KX_PROFILE_COLUMNS - 1.0) + 0.5) / KX_PROFILE_COLUMNS,
                (vertical * (KX_PROFILE_ROWS - 1.0) + 0.5) / KX_PROFILE_ROWS);
}

// Intensity of the bare light in a direction of its frame over that along its axis.
KX_INLINE float ownDistribution(LightHot light, vec3 dirLs) {
    uint type = lightType(light);
    if (type == LIGHT_RECT || type == LIGHT_DISK) return max(-dirLs.z, KX_LEAST_PROFILE_COSINE);
    if (type != LIGHT_TUBE) return 1.0;
    float side = 4.0 * light.sizeM.y, end = KX_PI * max(light.sizeM.x, 1.0e-4);
    return (side * sqrt(dirLs.y * dirLs.y + dirLs.z * dirLs.z) + end) / (side + end);
}

KX_INLINE float profileFactor(LightHot light, LightShaping shaping, vec3 dirLs) {
    if (shaping.profile == 0u) return 1.0;
    float value = profileLookup(shaping.profile - 1u, profileUv(dirLs));
    return shaping.profileIsShape != 0u ? value / ownDistribution(light, dirLs) : value;
}

// 1 where a pattern is open, `at` its edge; soft over `softness`.
KX_INLINE float openUpTo(float at, float distance_, float softness) {
    float t = saturate((at - distance_) / max(softness, 1.0e-3) + 0.5);
    return t * t * (3.0 - 2.0 * t);
}

// Of a pattern that repeats every 1: the share of light that it lets through.
KX_INLINE float functionPattern(LightShaping shaping, vec2 at) {
    uint kind = shaping.functionKind;
    float softness = shaping.functionMap.z;
    vec2 fromMiddle = abs(fract(at) - vec2(0.5)) * 2.0;
    if (kind == LIGHT_FUNCTION_FLICKER) return shaping.functionPhase;
    if (kind == LIGHT_FUNCTION_IMAGE)
        return functionImageLookup(shaping.functionImage, vec2(at.x + 0.5, 0.5 - at.y));
    if (kind == LIGHT_FUNCTION_GRID)
        return openUpTo(0.85, fromMiddle.x, softness) * openUpTo(0.85, fromMiddle.y, softness);
    if (kind == LIGHT_FUNCTION_BLINDS) return openUpTo(0.5, fromMiddle.y, softness);
    // Caustics: bright where three waves, bent by each other, cancel.
    vec2 a = fract(at) * KX_TWO_PI;
    float phase = shaping.functionPhase;
    vec2 bend = vec2(sin(a.y + phase), sin(a.x - phase)) * 0.8;
    float waves = sin(a.x + bend.x + phase) + sin(a.y + bend.y - phase) + sin(a.x - a.y + bend.x - bend.y);
    return pow(1.0 - abs(waves) * (1.0 / 3.0), 1.0 + 7.0 * (1.0 - softness));
}

KX_INLINE float functionFactor(LightShaping shaping, vec2 plane) {
    vec4 map = shaping.functionMap;
    vec2 at = vec2(plane.x * map.x + plane.y * map.y, plane.y * map.x - plane.x * map.y);
    return 1.0 - map.w * (1.0 - functionPattern(shaping, at));
}

// At least 0; at most 1 but for profiles that are the shape of flat lights and tubes.
KX_INLINE float lightFilter(LightHot light, vec3 receiverWs) {
    if (!(KX_HAS_IES || KX_HAS_LIGHT_FUNCTIONS) || !lightHasShaping(light)) return 1.0;
    LightShaping shaping = lightShaping(light);
    bool directional = lightType(light) == LIGHT_DIRECTIONAL;
    vec3 from = receiverWs - (directional ? shaping.functionOriginWs : light.positionWs);
    mat3 frame = lightFrame(light);
    vec3 dirLs = vec3(dot(from, frame[0]), dot(from, frame[1]), dot(from, frame[2]));
    if (!directional) dirLs = dirLs * inversesqrt(max(dot(dirLs, dirLs), 1.0e-24));
    float factor = 1.0;
    if (KX_HAS_IES && !directional) factor = profileFactor(light, shaping, dirLs);
    if (KX_HAS_LIGHT_FUNCTIONS && shaping.functionKind != LIGHT_FUNCTION_NONE) {
        vec2 plane = vec2(dirLs.x, dirLs.y) / (directional ? 1.0 : max(abs(dirLs.z), 1.0e-4));
        factor *= functionFactor(shaping, plane);
    }
    return max(factor, 0.0);
}

// Narrowed to where the profile has light.
KX_INLINE LightBounds profileBounds(LightHot light, LightBounds bounds) {
    if (!KX_HAS_IES || !lightHasShaping(light)) return bounds;
    LightShaping shaping = lightShaping(light);
    bool everywhere = bounds.cosHalfAngle <= -1.0;
    if (shaping.profile == 0u) return bounds;
    if (shaping.profileSide < 0.0 && !everywhere) {
        // All of the profile is behind, where the light has no front.
        if (shaping.profileCosine >= 0.0 && bounds.cosHalfAngle >= 0.0) bounds.radiusM = 0.0;
        return bounds;
    }
    bounds.axisWs = bounds.axisWs * shaping.profileSide;
    bounds.cosHalfAngle = max(bounds.cosHalfAngle, shaping.profileCosine);
    return bounds;
}

#endif
