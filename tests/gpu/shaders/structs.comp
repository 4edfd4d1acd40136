#version 460
// Writes the words of the second STRUCT of two, field by field, as STRUCT_FIELDS lists them.
#include "shared/bvh.h"
#include "shared/frame.h"
#include "shared/geometry.h"
#include "shared/gpu_light.h"
#include "shared/probe.h"
#include "shared/resampling.h"
#include "shared/shadow_map.h"
#include "shared/views.h"
#include "tests/gpu/shaders/struct_fields.h"

layout(local_size_x = 1) in;
#ifdef AS_UNIFORM
layout(scalar) uniform Source {
    STRUCT source[2];
};
#else
layout(scalar) readonly buffer Source {
    STRUCT source[];
};
#endif
layout(scalar) writeonly buffer Words {
    uint words[];
};

uint count = 1u;

void put(uint x) { words[count++] = x; }
void put(float x) { put(floatBitsToUint(x)); }
void put(vec2 v) { put(v.x); put(v.y); }
void put(vec3 v) { put(v.xy); put(v.z); }
void put(vec4 v) { put(v.xyz); put(v.w); }
void put(uvec2 v) { put(v.x); put(v.y); }
void put(uvec3 v) { put(v.xy); put(v.z); }
void put(mat4 m) { put(m[0]); put(m[1]); put(m[2]); put(m[3]); }
#define PUT_REF(field) put(ref.field);
void put(GpuTextureRef ref) { FIELDS_GpuTextureRef(PUT_REF) }
#define PUT_GRID(field) put(grid.field);
void put(GridConstants grid) { FIELDS_GridConstants(PUT_GRID) }

void put(uvec4 v) { put(v.xyz); put(v.w); }
#define PUT_SAMPLING(field) put(sampling.field);
void put(SamplingConstants sampling) { FIELDS_SamplingConstants(PUT_SAMPLING) }
#define PUT_DENOISING(field) put(denoising.field);
void put(DenoisingConstants denoising) { FIELDS_DenoisingConstants(PUT_DENOISING) }

#define PUT(field) put(source[1].field);

void main() {
    STRUCT_FIELDS(PUT)
    words[0] = count - 1u;
}
