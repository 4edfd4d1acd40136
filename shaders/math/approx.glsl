// Cheap elementary functions with stated errors, for loops where the built-in ones dominate the cost.
#ifndef KILOLUX_MATH_APPROX_GLSL
#define KILOLUX_MATH_APPROX_GLSL
#include "prelude.glsl"

// The angle in [0, pi] of a vector (cosine, sine) of any positive length, sine >= 0. Absolute error 2e-8 plus
// rounding, relative error the same towards 0 (Abramowitz and Stegun, 4.4.49). A zero vector gives 0.
KX_INLINE float angleFromCosSin(float cosine, float sine) {
    float larger = max(abs(cosine), sine);
    float smaller = min(abs(cosine), sine);
    float t = smaller / max(larger, 1.0e-37);
    float t2 = t * t;
    float series = 0.0028662257 * t2 - 0.0161657367;
    series = series * t2 + 0.0429096138;
    series = series * t2 - 0.0752896400;
    series = series * t2 + 0.1065626393;
    series = series * t2 - 0.1420889944;
    series = series * t2 + 0.1999355085;
    series = series * t2 - 0.3333314528;
    float angle = t + t * t2 * series;
    angle = sine > abs(cosine) ? KX_HALF_PI - angle : angle;
    return cosine < 0.0 ? KX_PI - angle : angle;
}

#endif
