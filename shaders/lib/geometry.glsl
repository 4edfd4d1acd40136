// Vertices, instances and materials with their bindings, and the surface of a triangle at a point.
#ifndef KILOLUX_LIB_GEOMETRY_GLSL
#define KILOLUX_LIB_GEOMETRY_GLSL
#include "../math/pack.glsl"
#include "../shared/geometry.h"

uniform usamplerBuffer vertices; // RGBA32_UINT
uniform usamplerBuffer indices;  // R32_UINT
layout(scalar) readonly buffer Instances {
    GpuInstance instances[];
};

vec3 transformPoint(GpuInstance instance, vec3 p) {
    vec4 v = vec4(p, 1.0);
    return vec3(dot(instance.row0, v), dot(instance.row1, v), dot(instance.row2, v));
}

vec3 vertexPosition(uint vertex) {
    return uintBitsToFloat(texelFetch(vertices, int(vertex * VERTEX_TEXELS)).xyz);
}

uvec3 triangleVertices(GpuInstance instance, uint primitive) {
    int first = int(instance.firstIndex + 3u * primitive);
    return instance.firstVertex + uvec3(texelFetch(indices, first).x, texelFetch(indices, first + 1).x,
                                        texelFetch(indices, first + 2).x);
}

struct TrianglePositions {
    vec3 a, b, c; // metres, anchor-relative world
};

TrianglePositions trianglePositions(GpuInstance instance, uvec3 v) {
    return TrianglePositions(transformPoint(instance, vertexPosition(v.x)), transformPoint(instance, vertexPosition(v.y)),
                             transformPoint(instance, vertexPosition(v.z)));
}

// Weights of b and c where the ray crosses the triangle's plane, by signed volumes (Möller-Trumbore's form);
// (1/3, 1/3) for a triangle seen edge on.
vec2 planeBarycentrics(TrianglePositions t, vec3 origin, vec3 dir) {
    vec3 ab = t.b - t.a, ac = t.c - t.a, ao = origin - t.a;
    vec3 p = cross(dir, ac);
    float volume = dot(ab, p);
    if (abs(volume) < 1.0e-37) return vec2(1.0 / 3.0);
    vec2 weights = vec2(dot(ao, p), dot(dir, cross(ao, ab))) / volume;
    // Raster may give pixels whose centre is a rounding error outside; attributes stay on the triangle.
    weights = clamp(weights, 0.0, 1.0);
    return weights / max(1.0, weights.x + weights.y);
}

#endif
