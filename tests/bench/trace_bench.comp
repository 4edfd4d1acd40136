#version 460
// Traces a list of rays: one word per ray, 1 where something is in the way. For tests/bench/trace_bench.cpp.
#include "lib/tile_order.glsl"
#include "lib/trace.glsl"

layout(local_size_x = 64) in;

uniform samplerBuffer benchRays; // origin, 0; direction, length
layout(scalar) writeonly buffer BenchResults { uint benchResults[]; };
layout(push_constant) uniform Push { uint rayCount; uint chunks; } push;

void main() {
    uint tile = interleavedTile(gl_WorkGroupID.x, uvec2(gl_NumWorkGroups.x, 1u), push.chunks).x;
    uint index = tile * 64u + gl_LocalInvocationID.x;
    if (index >= push.rayCount) return;
    vec4 from = texelFetch(benchRays, int(index * 2u));
    vec4 to = texelFetch(benchRays, int(index * 2u + 1u));
    Ray ray = makeRay(from.xyz, to.xyz, to.w);
    benchResults[index] = occluded(ray) ? 1u : 0u;
}
