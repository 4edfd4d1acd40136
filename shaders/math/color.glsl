// Colour helpers in linear Rec. 709.
#ifndef KILOLUX_MATH_COLOR_GLSL
#define KILOLUX_MATH_COLOR_GLSL
#include "prelude.glsl"

KX_INLINE float luminance(vec3 rec709) {
    return dot(rec709, vec3(0.2126, 0.7152, 0.0722));
}

#endif
