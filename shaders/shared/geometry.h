// Meshes, instances and materials as the G-buffer passes read them.
#ifndef KILOLUX_SHARED_GEOMETRY_H
#define KILOLUX_SHARED_GEOMETRY_H
#include "base.h"

KX_SHARED_BEGIN

// A vertex is two RGBA32_UINT texels:
//   position (3 floats), normal (packOct16)
//   tangent (packOct16, lowest bit set where the handedness is -1), uv0 (2 floats), colour (unorm 4x8)
KX_CONST uint VERTEX_TEXELS = 2u;

KX_CONST uint INSTANCE_MIRRORED = 1u; // negative determinant: triangles wind the other way in world space
KX_CONST uint INSTANCE_DOUBLE_SIDED = 2u;
KX_CONST uint INSTANCE_ALPHA_TESTED = 4u;
KX_CONST uint INSTANCE_HAS_TANGENTS = 8u;

KX_CONST uint INSTANCE_MOVING = 16u;         // its transform of the previous frame is in PreviousInstances
KX_CONST uint INSTANCE_CHANNELS_SHIFT = 24u; // lighting channels of its mesh, 8 bits

KX_CONST uint NO_OFFSET = 0xffffffffu;

struct GpuInstance {
    vec4 row0; // world (anchor-relative) from local, rows of the 3 x 4 matrix
    vec4 row1;
    vec4 row2;
    uint firstVertex;
    uint firstIndex;
    uint firstUv1; // into the second uv set, or NO_OFFSET
    uint material;
    uint flags; // INSTANCE_*
    uint triangleCount;
};

struct InstanceRows {
    vec4 row0; // as in GpuInstance
    vec4 row1;
    vec4 row2;
};

// A material's use of a texture. The image lies in one of four layered arrays, resized to their size.
KX_CONST uint TEXTURE_NONE = 0xffffffffu;
KX_CONST uint TEXTURE_CLASS_SHIFT = 16u; // place = class << 16 | layer
KX_CONST uint TEXTURE_CLASSES = 4u;
KX_CONST uint TEXTURE_WRAP_REPEAT = 0u;
KX_CONST uint TEXTURE_WRAP_CLAMP = 1u;
KX_CONST uint TEXTURE_WRAP_MIRROR = 2u;
KX_CONST uint TEXTURE_WRAP_T_SHIFT = 2u;
KX_CONST uint TEXTURE_UV1 = 16u;
KX_CONST uint TEXTURE_NEAREST = 32u;

struct GpuTextureRef {
    uint place;  // TEXTURE_NONE or class and layer
    uint flags;  // TEXTURE_*
    vec3 uvRow0; // u' = dot(uvRow0, (u, v, 1))
    vec3 uvRow1;
};

struct GpuMaterial {
    vec4 baseColor; // linear
    vec3 emissive;  // nit
    float metallic;
    float roughness;
    float normalScale;
    float opacity; // what transmission stops; read where MATERIAL_TRANSMISSIVE
    uint flags;    // MATERIAL_*
    GpuTextureRef baseColorTexture;
    GpuTextureRef metallicRoughnessTexture;
    GpuTextureRef normalTexture;
    GpuTextureRef emissiveTexture;
};

KX_CONST uint MATERIAL_TRANSMISSIVE = 1u; // tints what is behind by its base colour; BLEND mixes by opacity

KX_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(kilolux::shared::GpuInstance) == 72);
static_assert(sizeof(kilolux::shared::GpuTextureRef) == 32);
static_assert(sizeof(kilolux::shared::GpuMaterial) == 48 + 4 * 32);
#endif
#endif
