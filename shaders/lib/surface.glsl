// The surface that a camera ray meets on a known triangle: position, normals, material. Raster and nearest hit
// only say which triangle; everything else comes from here, so that both give the same G-buffer.
#ifndef KILOLUX_LIB_SURFACE_GLSL
#define KILOLUX_LIB_SURFACE_GLSL
#include "gbuffer.glsl"
#include "geometry.glsl"
#include "material.glsl"

layout(constant_id = FEATURE_TEXTURES) const bool kTextures = true;
uniform samplerBuffer uv1s; // RG32F, the second uv set of the primitives that have one

struct SurfaceHit {
    Surface surface;
    vec3 positionWs;
    vec3 positionLs; // in the instance's own space
    vec3 emissiveNit;
    float alpha; // base colour alpha, not tested
};

vec3 rowsTimes(GpuInstance i, vec3 v) {
    return vec3(dot(i.row0.xyz, v), dot(i.row1.xyz, v), dot(i.row2.xyz, v));
}

// Inverse transpose up to a positive factor, by cofactors; right for mirrored and uneven scales.
vec3 transformNormal(GpuInstance i, vec3 n) {
    vec3 x = vec3(i.row0.x, i.row1.x, i.row2.x), y = vec3(i.row0.y, i.row1.y, i.row2.y),
         z = vec3(i.row0.z, i.row1.z, i.row2.z);
    vec3 result = cross(y, z) * n.x + cross(z, x) * n.y + cross(x, y) * n.z;
    return (i.flags & INSTANCE_MIRRORED) != 0u ? -result : result;
}

vec3 normalizeOr(vec3 v, vec3 otherwise) {
    float length2 = dot(v, v);
    return length2 > 1.0e-30 ? v * inversesqrt(length2) : otherwise;
}

struct Corner {
    vec3 normal;
    vec4 tangent;
    vec2 uv;
    vec4 color;
};

Corner fetchCorner(uint vertex) {
    uint normal = texelFetch(vertices, int(vertex * VERTEX_TEXELS)).w;
    uvec4 rest = texelFetch(vertices, int(vertex * VERTEX_TEXELS + 1u));
    return Corner(unpackOct16(normal), vec4(unpackOct16(rest.x & ~1u), (rest.x & 1u) != 0u ? -1.0 : 1.0),
                  uintBitsToFloat(rest.yz), unpackUnorm4x8(rest.w));
}

vec2 fetchUv1(GpuInstance instance, uvec3 v, vec3 w) {
    if (instance.firstUv1 == NO_OFFSET) return vec2(0.0);
    uvec3 at = v - instance.firstVertex + instance.firstUv1;
    return w.x * texelFetch(uv1s, int(at.x)).xy + w.y * texelFetch(uv1s, int(at.y)).xy +
           w.z * texelFetch(uv1s, int(at.z)).xy;
}

// `viewDirWs`: unit, towards the viewer. `footprintM`: the pixel's width at the hit.
SurfaceHit evaluateSurface(uint instanceId, uint primitive, vec3 origin, vec3 dir, vec3 viewDirWs, float pixelAngleRad) {
    GpuInstance instance = instances[instanceId];
    uvec3 v = triangleVertices(instance, primitive);
    TrianglePositions t = trianglePositions(instance, v);
    vec2 bc = planeBarycentrics(t, origin, dir);
    vec3 w = vec3(1.0 - bc.x - bc.y, bc);
    Corner a = fetchCorner(v.x), b = fetchCorner(v.y), c = fetchCorner(v.z);
    GpuMaterial material = materials[instance.material];

    SurfaceHit hit;
    hit.positionWs = t.a + bc.x * (t.b - t.a) + bc.y * (t.c - t.a);
    hit.positionLs = w.x * vertexPosition(v.x) + w.y * vertexPosition(v.y) + w.z * vertexPosition(v.z);
    vec3 face = cross(t.b - t.a, t.c - t.a);
    vec3 ng = normalizeOr((instance.flags & INSTANCE_MIRRORED) != 0u ? -face : face, viewDirWs);
    vec3 ns = normalizeOr(transformNormal(instance, w.x * a.normal + w.y * b.normal + w.z * c.normal), ng);
    bool backFace = dot(ng, viewDirWs) < 0.0;

    // Ray cones (Akenine-Möller et al., "Texture Level of Detail Strategies for Real-Time Ray Tracing", 2019,
    // section 20.3.3): footprint in uv from the triangle's uv area against its world area.
    vec2 uvAb = b.uv - a.uv, uvAc = c.uv - a.uv;
    float uvArea = abs(uvAb.x * uvAc.y - uvAb.y * uvAc.x);
    float footprintM = length(hit.positionWs - origin) * pixelAngleRad / max(abs(dot(ng, viewDirWs)), 0.05);
    float lodBase = 0.5 * log2(max(uvArea, 1.0e-20) / max(length(face), 1.0e-20)) + log2(max(footprintM, 1.0e-12));
    vec2 uv0 = w.x * a.uv + w.y * b.uv + w.z * c.uv;
    vec2 uv1 = kTextures ? fetchUv1(instance, v, w) : vec2(0.0);

    vec4 baseColor = material.baseColor * (w.x * a.color + w.y * b.color + w.z * c.color);
    float roughness = material.roughness, metallic = material.metallic;
    vec3 emissive = material.emissive;
    // One call site for all four textures: the sampler code is expanded once.
    for (int slot = 0; kTextures && slot < 4; ++slot) {
        GpuTextureRef ref = slot == 0   ? material.baseColorTexture
                            : slot == 1 ? material.metallicRoughnessTexture
                            : slot == 2 ? material.normalTexture
                                        : material.emissiveTexture;
        if (ref.place == TEXTURE_NONE) continue;
        vec4 texel = sampleTexture(ref, uv0, uv1, lodBase, slot == 0 || slot == 3);
        if (slot == 0) {
            baseColor *= texel;
        } else if (slot == 1) {
            roughness *= texel.g;
            metallic *= texel.b;
        } else if (slot == 3) {
            emissive *= texel.rgb;
        } else if ((instance.flags & INSTANCE_HAS_TANGENTS) != 0u) {
            vec3 tangent = rowsTimes(instance, w.x * a.tangent.xyz + w.y * b.tangent.xyz + w.z * c.tangent.xyz);
            float handed = a.tangent.w * ((instance.flags & INSTANCE_MIRRORED) != 0u ? -1.0 : 1.0);
            tangent = normalizeOr(tangent - ns * dot(ns, tangent), vec3(0.0));
            vec3 bitangent = cross(ns, tangent) * handed;
            vec2 slope = (texel.rg * 2.0 - 1.0) * material.normalScale;
            ns = normalizeOr(tangent * slope.x + bitangent * slope.y + ns * (texel.b * 2.0 - 1.0), ns);
        }
    }
    if (backFace) {
        ng = -ng;
        ns = -ns;
    }
    // A shading normal that turns away from the viewer is bent until it is seen edge on.
    float facing = dot(ns, viewDirWs);
    if (facing < 1.0e-3) ns = normalizeOr(ns + viewDirWs * (1.0e-3 - facing), ng);
    hit.surface = Surface(ns, ng, baseColor.rgb, roughness, metallic);
    hit.emissiveNit = emissive;
    hit.alpha = baseColor.a;
    return hit;
}

#endif
