// What shaders/math and shaders/lights need to compile as GLSL, as C++ in float and as C++ in double. In C++
// the includer (renderer/lights_cpp) has opened a namespace that brings GLM's types and functions under
// GLSL's names. The subset: functions and structs only, no swizzles (write vec3(v4.x, ...) or vec3(v4)), no
// implicit conversions, literals without suffix, OUT(T) and INOUT(T) for reference parameters.
#ifndef KILOLUX_MATH_PRELUDE_GLSL
#define KILOLUX_MATH_PRELUDE_GLSL

#define KX_INLINE
#ifdef __cplusplus
#define OUT(T) T&
#define INOUT(T) T&
#else
#define OUT(T) out T
#define INOUT(T) inout T
#endif

const float KX_PI = 3.14159265358979323846;
const float KX_TWO_PI = 6.28318530717958647692;
const float KX_HALF_PI = 1.57079632679489661923;
const float KX_INV_PI = 0.31830988618379067154;
const float KX_INFINITY = 3.0e38; // stands for "no end" in distances and radii; finite, so that 0 * it is 0

KX_INLINE float saturate(float x) {
    return clamp(x, 0.0, 1.0);
}

KX_INLINE float square(float x) {
    return x * x;
}

#endif
