// Orthonormal bases.
#ifndef KILOLUX_MATH_BASIS_GLSL
#define KILOLUX_MATH_BASIS_GLSL
#include "prelude.glsl"

// Columns: two tangents and the unit normal, right-handed (Duff et al., "Building an Orthonormal Basis,
// Revisited", JCGT 2017, listing 3). Jumps only where normal.z changes sign.
KX_INLINE mat3 basisFromNormal(vec3 normal) {
    float side = normal.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (side + normal.z);
    float b = normal.x * normal.y * a;
    vec3 tangent = vec3(1.0 + side * normal.x * normal.x * a, side * b, -side * normal.x);
    vec3 bitangent = vec3(b, side + normal.y * normal.y * a, -normal.y);
    return mat3(tangent, bitangent, normal);
}

// Columns: the part of `tangent` square to the unit normal, the bitangent, the normal; right-handed. A
// tangent along the normal gives basisFromNormal.
KX_INLINE mat3 basisFromNormalTangent(vec3 normal, vec3 tangent) {
    vec3 flat_ = tangent - normal * dot(normal, tangent);
    float length2 = dot(flat_, flat_);
    if (length2 < 1.0e-10) return basisFromNormal(normal);
    vec3 x = flat_ * inversesqrt(length2);
    return mat3(x, cross(normal, x), normal);
}

#endif
