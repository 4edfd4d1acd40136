// Material textures: four layered arrays, each with a linear and an sRGB view, so that one set of bindings serves
// raster and compute without descriptor indexing.
#ifndef KILOLUX_LIB_MATERIAL_GLSL
#define KILOLUX_LIB_MATERIAL_GLSL
#include "../shared/geometry.h"

layout(scalar) readonly buffer Materials {
    GpuMaterial materials[];
};
uniform sampler2DArray textures0;
uniform sampler2DArray textures1;
uniform sampler2DArray textures2;
uniform sampler2DArray textures3;
uniform sampler2DArray texturesSrgb0;
uniform sampler2DArray texturesSrgb1;
uniform sampler2DArray texturesSrgb2;
uniform sampler2DArray texturesSrgb3;

// The arrays repeat; the other modes are folded into them, half a texel from the border.
float wrapTexture(float x, uint mode, float halfTexel) {
    if (mode == TEXTURE_WRAP_CLAMP) return clamp(x, halfTexel, 1.0 - halfTexel);
    if (mode == TEXTURE_WRAP_MIRROR) {
        float folded = abs(x - 2.0 * floor(0.5 * x + 0.5));
        return clamp(folded, halfTexel, 1.0 - halfTexel);
    }
    return x;
}

const float kTextureSize[4] = float[4](256.0, 512.0, 1024.0, 2048.0);

// `lodBase`: log2 of the pixel's footprint in uv units; the image's size is added here.
vec4 sampleTexture(GpuTextureRef ref, vec2 uv0, vec2 uv1, float lodBase, bool srgb) {
    uint textureClass = ref.place >> TEXTURE_CLASS_SHIFT;
    float size = kTextureSize[textureClass];
    vec3 uvw = vec3((ref.flags & TEXTURE_UV1) != 0u ? uv1 : uv0, 1.0);
    vec2 uv = vec2(dot(ref.uvRow0, uvw), dot(ref.uvRow1, uvw));
    float scale = max(length(ref.uvRow0.xy), length(ref.uvRow1.xy));
    float lod = max(lodBase + log2(max(size * scale, 1.0e-6)), 0.0);
    if ((ref.flags & TEXTURE_NEAREST) != 0u) {
        uv = (floor(uv * size) + 0.5) / size;
        lod = 0.0;
    }
    float halfTexel = 0.5 / size * exp2(lod);
    vec3 at = vec3(wrapTexture(uv.x, ref.flags & 3u, halfTexel),
                   wrapTexture(uv.y, ref.flags >> TEXTURE_WRAP_T_SHIFT & 3u, halfTexel),
                   float(ref.place & 0xffffu));
    if (srgb) {
        if (textureClass == 0u) return textureLod(texturesSrgb0, at, lod);
        if (textureClass == 1u) return textureLod(texturesSrgb1, at, lod);
        if (textureClass == 2u) return textureLod(texturesSrgb2, at, lod);
        return textureLod(texturesSrgb3, at, lod);
    }
    if (textureClass == 0u) return textureLod(textures0, at, lod);
    if (textureClass == 1u) return textureLod(textures1, at, lod);
    if (textureClass == 2u) return textureLod(textures2, at, lod);
    return textureLod(textures3, at, lod);
}

#endif
