// False colour of light: stops from middle grey, and decades of nit and lux, with the steps at which isolines run.
#ifndef KILOLUX_MATH_FALSE_COLOR_GLSL
#define KILOLUX_MATH_FALSE_COLOR_GLSL
#include "color_map.glsl"

const float KX_MIDDLE_GREY = 0.18;       // of the display, before tone mapping
const float KX_DARKEST_STOPS = -20.0;    // black has no logarithm
const float KX_ISOLINES_A_DECADE = 2.0;  // at 1, 3.16, 10, ...
const float KX_CLIPPED_LEVEL = 254.5;    // of 255: the display cannot show more
const float KX_CRUSHED_LEVEL = 0.5;

KX_INLINE float stopsFromGrey(float exposedLuminance) {
    return max(log2(max(exposedLuminance, 1.0e-30) / KX_MIDDLE_GREY), KX_DARKEST_STOPS);
}

KX_INLINE float decadesOf(float value) {
    return log2(max(value, 1.0e-30)) * 0.30102999566;
}

// Where on a scale a value stands: 0 at its low end, 1 at its high one.
KX_INLINE float scalePosition(float value, float low, float high) {
    return (value - low) / max(high - low, 1.0e-20);
}

// The band between two isolines that a value lies in.
KX_INLINE float stopBand(float stops) {
    return floor(stops);
}
KX_INLINE float decadeBand(float decades) {
    return floor(decades * KX_ISOLINES_A_DECADE);
}

#endif
