// The G-buffer's packing. Images: gDepth (R32F, linear depth in metres, DEPTH_SKY without a surface), gNormals
// (RG32UI: shading normal, geometric normal, both octahedral 2 x 16), gMaterial (RG32UI: base colour; roughness,
// metallic, flags), gEmissive (RGBA16F, exposed), visibility (RG32UI: instance, primitive).
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

// Base colour by its square root in 11, 11 and 10 bits: finer than 8-bit sRGB everywhere.
uvec2 packMaterial(Surface s) {
    vec3 root = sqrt(clamp(s.baseColor, 0.0, 1.0)) * vec3(2047.0, 2047.0, 1023.0) + 0.5;
    uvec3 q = uvec3(root);
    uint rough = uint(clamp(s.roughness, 0.0, 1.0) * 65535.0 + 0.5);
    uint metal = uint(clamp(s.metallic, 0.0, 1.0) * 65535.0 + 0.5);
    return uvec2(q.x | q.y << 11u | q.z << 22u, rough | metal << 16u);
}

uvec2 packNormals(Surface s) {
    return uvec2(packOct16(s.normalWs), packOct16(s.geoNormalWs));
}

// Of the second word of a material.
float unpackRoughness(uint word) {
    return float(word & 0xffffu) * (1.0 / 65535.0);
}

Surface unpackSurface(uvec2 normals, uvec2 material) {
    Surface s;
    s.normalWs = unpackOct16(normals.x);
    s.geoNormalWs = unpackOct16(normals.y);
    vec3 root = vec3(material.x & 2047u, material.x >> 11u & 2047u, material.x >> 22u) *
                vec3(1.0 / 2047.0, 1.0 / 2047.0, 1.0 / 1023.0);
    s.baseColor = root * root;
    s.roughness = unpackRoughness(material.y);
    s.metallic = float(material.y >> 16u) * (1.0 / 65535.0);
    return s;
}

vec3 diffuseAlbedo(Surface s) {
    return s.baseColor * (1.0 - s.metallic);
}

vec3 specularF0(Surface s) {
    return mix(vec3(0.04), s.baseColor, s.metallic);
}

#endif
