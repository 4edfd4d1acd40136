#version 460
// The random numbers of 80 x 72 pixels by lib/noise.glsl, 5 floats each.
#include "lib/noise.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push {
    uint frameIndex;
    uint seed;
};
layout(scalar) writeonly buffer Numbers {
    float numbers[];
};

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    PixelNoise noise = pixelNoise(pixel, frameIndex, seed);
    uint at = 5u * (pixel.y * gl_NumWorkGroups.x * 8u + pixel.x);
    for (int i = 0; i < 3; ++i)
        numbers[at + i] = noise.numbers[i];
    numbers[at + 3] = noise.point.x;
    numbers[at + 4] = noise.point.y;
}
