#version 460
// The grid cell of every pixel, as passes that read the grid find it.
#include "lib/light_grid.glsl"

layout(local_size_x = 64) in;

uniform sampler2D gDepth;
layout(scalar) writeonly buffer PixelCells {
    uint pixelCells[];
};

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= frame.size.x * frame.size.y) return;
    uvec2 pixel = uvec2(index % frame.size.x, index / frame.size.x);
    pixelCells[index] = gridCellOfPixel(pixel, texelFetch(gDepth, ivec2(pixel), 0).x);
}
