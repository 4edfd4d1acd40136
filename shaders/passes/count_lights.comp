#version 460
// How many lights may shine on each pixel, and how many of its samples were seen: for statistics and views only, as
// the stochastic method itself never looks at all lights.
#include "shared/features.h"
#include "lib/dispatch.glsl"
#include "lib/count.glsl"
#include "lib/light_grid.glsl"
#include "lib/receiver.glsl"
#include "lib/sample.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform usampler2DArray rayResults;
layout(scalar) readonly buffer GridCells {
    GridCell gridCells[];
};
uniform usamplerBuffer gridIndices;
layout(r32ui) writeonly uniform uimage2D lightCountsOut;

void main() {
    uvec2 pixel = dispatchedPixel();
    if (!isInPicture(pixel)) return;
    Receiver receiver = loadReceiver(pixel);
    uint inRange = 0u, seen = 0u;
    if (receiver.exists) {
        bool gridded = frame.grid.enabled != 0u;
        GridCell cell = GridCell(0u, frame.lightCount, 0u);
        if (gridded) cell = gridCells[gridCellOfPixel(pixel, receiver.depthM)];
        for (uint i = 0u; i < cell.count; ++i) {
            uint slot = gridded ? texelFetch(gridIndices, int(cell.first + i)).x : i;
            inRange += lightReaches(loadLightHot(slot), receiver.point) ? 1u : 0u;
        }
        for (uint i = 0u; i < frame.sampling.rays; ++i)
            seen += (texelFetch(rayResults, ivec3(pixel, i), 0).x & RAY_STATE_MASK) == RAY_VISIBLE ? 1u : 0u;
        countAll(COUNTER_LIGHTS_IN_RANGE, inRange);
        countAll(COUNTER_LIGHTS_TESTED, cell.count);
        countAll(COUNTER_COUNTED_PIXELS, 1u);
    }
    imageStore(lightCountsOut, ivec2(pixel), uvec4(min(inRange, 0xffffu) | min(seen, 0xffffu) << 16u));
}
