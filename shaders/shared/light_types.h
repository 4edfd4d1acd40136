// The one list of the types of light that a document can hold, as X(UPPER, Name, place), places without gaps.
// Their codes are LIGHT_UPPER (gpu_light.h); features, the shaders' constants and what statistics call them
// follow from the list.
#ifndef KILOLUX_SHARED_LIGHT_TYPES_H
#define KILOLUX_SHARED_LIGHT_TYPES_H

#define KX_LIGHT_TYPES(X)                                                                                    \
    X(DIRECTIONAL, Directional, 0)                                                                           \
    X(SPHERE, Sphere, 1)                                                                                     \
    X(SPOT, Spot, 2)                                                                                         \
    X(TUBE, Tube, 3)                                                                                         \
    X(RECT, Rect, 4)                                                                                         \
    X(DISK, Disk, 5)

#endif
