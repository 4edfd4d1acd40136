// The G-buffer's packing. Images: gSurface (RGBA32UI: linear depth in metres, DEPTH_SKY without a surface; shading
// normal, octahedral 2 x 16; geometric normal, octahedral 2 x 14, and the class of roughness; base colour): what filters
// ask of a neighbour comes in one fetch. gMaterial (R32UI: roughness and metallic share in 12 bits, lighting channels in 8),
// gDepth (R32F: the depth once more, where only that is read), gEmissive (RGBA16F, exposed), visibility (RG32UI: instance, primitive).
#ifndef KILOLUX_LIB_GBUFFER_GLSL
#define KILOLUX_LIB_GBUFFER_GLSL
#include "../math/pack.glsl"

struct Surface {
    vec3 normalWs;     // shading normal, unit
    vec3 geoNormalWs;  // unit, on the viewer's side
    vec3 baseColor;
    float roughness;
    float metallic;
};

const float kOct14Half = 8191.0; // steps from 0 to 1: the axes are exact
const float kClassRoughness = 0.6; // from which on a surface is of the roughest class

vec3 unpackOct14(uint word) {
    return directionFromOct(vec2(word & 16383u, word >> 14u & 16383u) * (1.0 / kOct14Half) - 1.0);
}

// The best of the four roundings: off by at most 1.7e-4 rad, where the nearest one is off by 2.5e-4.
uint packOct14(vec3 dir) {
    uvec2 least = uvec2((octFromDirection(dir) + 1.0) * kOct14Half);
    uint best = 0u;
    float bestOff = 8.0;
    for (uint i = 0u; i < 4u; ++i) {
        uvec2 q = min(least + uvec2(i & 1u, i >> 1u), uvec2(2.0 * kOct14Half));
        uint word = q.x | q.y << 14u;
        vec3 off = unpackOct14(word) - dir;
        if (dot(off, off) < bestOff) {
            best = word;
            bestOff = dot(off, off);
        }
    }
    return best;
}

// Base colour by its square root in 11, 11 and 10 bits: finer than 8-bit sRGB everywhere.
uvec4 packSurface(float depthM, Surface s) {
    uvec3 color = uvec3(sqrt(clamp(s.baseColor, 0.0, 1.0)) * vec3(2047.0, 2047.0, 1023.0) + 0.5);
    uint roughClass = uint(clamp(s.roughness / kClassRoughness, 0.0, 1.0) * 15.0 + 0.5);
    return uvec4(floatBitsToUint(depthM), packOct16(s.normalWs), packOct14(s.geoNormalWs) | roughClass << 28u,
                 color.x | color.y << 11u | color.z << 22u);
}

uint packMaterial(Surface s, uint channels) {
    uvec2 rest = uvec2(clamp(vec2(s.roughness, s.metallic), 0.0, 1.0) * 4095.0 + 0.5);
    return rest.x | rest.y << 12u | channels << 24u;
}

uint materialChannels(uint material) {
    return material >> 24u;
}

uvec4 noSurface() {
    return uvec4(floatBitsToUint(DEPTH_SKY), 0u, 0u, 0u);
}

// Each of a texel of gSurface. Those of noSurface() but its depth are of no use.
float surfaceDepthM(uvec4 texel) {
    return uintBitsToFloat(texel.x);
}

vec3 surfaceNormalWs(uvec4 texel) {
    return unpackOct16(texel.y);
}

vec3 surfaceGeoNormalWs(uvec4 texel) {
    return unpackOct14(texel.z);
}

// Roughness for filters: in steps of 0.04 and at most kClassRoughness.
float surfaceRoughnessClass(uvec4 texel) {
    return float(texel.z >> 28u) * (kClassRoughness / 15.0);
}

Surface unpackSurface(uvec4 texel, uint material) {
    vec3 root = vec3(texel.w & 2047u, texel.w >> 11u & 2047u, texel.w >> 22u) *
                vec3(1.0 / 2047.0, 1.0 / 2047.0, 1.0 / 1023.0);
    vec2 rest = vec2(material & 4095u, material >> 12u & 4095u) * (1.0 / 4095.0);
    return Surface(surfaceNormalWs(texel), surfaceGeoNormalWs(texel), root * root, rest.x, rest.y);
}

vec3 diffuseAlbedo(Surface s) {
    return s.baseColor * (1.0 - s.metallic);
}

vec3 specularF0(Surface s) {
    return mix(vec3(0.04), s.baseColor, s.metallic);
}

#endif
