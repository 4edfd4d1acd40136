// The lights with their bindings: loadLightHot(slot), loadLightCold(slot), the LTC table, features by type. Hot
// records come from a uniform block up to 1,024 slots (fastest on CPU drivers), from a texel buffer above.
#ifndef KILOLUX_LIB_LIGHT_ACCESS_GLSL
#define KILOLUX_LIB_LIGHT_ACCESS_GLSL
#include "../math/prelude.glsl"
#include "../shared/features.h"
#include "../shared/gpu_light.h"

#define KX_HAS_LIGHT_TYPES
#define KX_HAS_LIGHT(UPPER, Name, place) \
    layout(constant_id = FEATURE_##UPPER##_LIGHTS) const bool k##Name##Lights = true; \
    const bool KX_HAS_##UPPER = k##Name##Lights;
KX_LIGHT_TYPES(KX_HAS_LIGHT)
#undef KX_HAS_LIGHT
layout(constant_id = FEATURE_DOME) const bool kDome = true;
layout(constant_id = FEATURE_BARN_DOORS) const bool kBarnDoors = true;
layout(constant_id = FEATURE_IES_PROFILES) const bool kIesProfiles = true;
layout(constant_id = FEATURE_LIGHT_FUNCTIONS) const bool kLightFunctions = true;
layout(constant_id = FEATURE_LIGHT_CHANNELS) const bool kLightChannels = true;
layout(constant_id = FEATURE_TEXTURED_LIGHTS) const bool kTexturedLights = true;
layout(constant_id = CHOICE_LIGHTS_IN_UNIFORM) const bool kLightsInUniform = false;
#define KX_HAS_DOME kDome
#define KX_HAS_BARN_DOORS kBarnDoors
#define KX_HAS_IES kIesProfiles
#define KX_HAS_LIGHT_FUNCTIONS kLightFunctions
#define KX_HAS_LIGHT_CHANNELS kLightChannels
#define KX_HAS_PICTURES kTexturedLights

uniform sampler2D ltcParameters;
uniform sampler2D ltcScales;
vec4 ltcLookup0(vec2 uv) {
    return textureLod(ltcParameters, uv, 0.0);
}
vec4 ltcLookup1(vec2 uv) {
    return textureLod(ltcScales, uv, 0.0);
}
layout(scalar) readonly buffer LightShapings {
    LightShaping lightShapings[];
};
LightShaping lightShapingLookup(uint place) {
    return lightShapings[place];
}
uniform sampler2DArray iesProfiles;
float profileLookup(uint layer, vec2 uv) {
    return textureLod(iesProfiles, vec3(uv, float(layer)), 0.0).x;
}
uniform sampler2DArray functionImages;
float functionImageLookup(uint layer, vec2 uv) {
    return textureLod(functionImages, vec3(uv, float(layer)), 0.0).x;
}
uniform sampler2D domeRadiances;
uniform sampler2D domeIrradiances;
uniform samplerBuffer domeDistribution;
vec3 domeRadianceLookup(vec2 uv, float level) {
    return textureLod(domeRadiances, uv, level).rgb;
}
vec3 domeIrradianceLookup(vec2 uv) {
    // Nodes: the first and the last row are the poles.
    vec2 size = vec2(textureSize(domeIrradiances, 0));
    return textureLod(domeIrradiances, vec2(uv.x + 0.5 / size.x, (uv.y * (size.y - 1.0) + 0.5) / size.y), 0.0).rgb;
}
float domeDistributionLookup(uint place) {
    return texelFetch(domeDistribution, int(place)).x;
}
uniform sampler2DArray lightPictures;
vec3 lightPictureLookup(uint layer, vec2 uv, float level) {
    return textureLod(lightPictures, vec3(uv, float(layer)), level).xyz;
}
layout(scalar) readonly buffer LightWarps {
    float lightWarps[];
};
float lightWarpLookup(uint index) {
    return lightWarps[index];
}
#include "../lights/light.glsl"

layout(scalar) uniform LightsHot {
    LightHot lightsHot[LIGHT_UNIFORM_SLOTS];
};
uniform usamplerBuffer lightsHotTexels; // RGBA32_UINT, 4 a record
layout(scalar) readonly buffer LightsCold {
    LightCold lightsCold[];
};

// For lanes that each want a light of their own: 4 wide fetches a lane are 15 % faster than 16 scalar ones from the
// uniform block (sample_lights on lavapipe); for one light at a time the block is.
LightHot loadOwnLightHot(uint slot) {
    int texel = int(slot * 4u);
    uvec4 a = texelFetch(lightsHotTexels, texel), b = texelFetch(lightsHotTexels, texel + 1),
          c = texelFetch(lightsHotTexels, texel + 2), d = texelFetch(lightsHotTexels, texel + 3);
    return LightHot(uintBitsToFloat(a.xyz), uintBitsToFloat(a.w), uintBitsToFloat(b.xyz), b.w,
                    uintBitsToFloat(c.xyz), c.w, uintBitsToFloat(d.xy), uintBitsToFloat(d.zw));
}

LightHot loadLightHot(uint slot) {
    if (kLightsInUniform) return lightsHot[slot];
    return loadOwnLightHot(slot);
}

LightCold loadLightCold(uint slot) {
    return lightsCold[slot];
}

// Whether the light is on and may shine on the point: within its range, and in its cone or on its side. Culling by
// the light grid is conservative, this is not: lights in range are counted the same with and without it.
bool lightReaches(LightHot light, vec3 positionWs) {
    LightBounds bounds = lightBounds(light);
    vec3 to = positionWs - bounds.centerWs;
    float distance2 = dot(to, to);
    if (lightIsGlobal(light)) return lightIsOn(light);
    bool within = distance2 * light.invRange * light.invRange < 1.0;
    bool inCone = dot(to, bounds.axisWs) >= (bounds.cosHalfAngle - 1.0e-6) * sqrt(distance2);
    return lightIsOn(light) && within && inCone;
}

// And whether it reaches the point's mesh.
bool lightReaches(LightHot light, ShadingPoint point) {
    return lightReaches(light, point.positionWs) && lightIncludes(light, point.channels);
}

#endif
