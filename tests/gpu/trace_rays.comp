#version 460
// Traces a list of rays both ways and reports everything: the tracer as tests see it.
#include "lib/trace.glsl"

layout(local_size_x = 64) in;

struct TracedRay {
    float tM;
    uint instance;
    uint primitive;
    vec2 barycentrics;
    uint flags; // 1 occluded, 2 back face
};

uniform samplerBuffer testRays; // origin, 0; direction, length
layout(scalar) writeonly buffer TracedRays { TracedRay tracedRays[]; };
layout(push_constant) uniform Push { uint rayCount; } push;

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= push.rayCount) return;
    vec4 from = texelFetch(testRays, int(index * 2u));
    vec4 to = texelFetch(testRays, int(index * 2u + 1u));
    Ray ray = makeRay(from.xyz, to.xyz, to.w);
    Hit hit = nearest(ray);
    tracedRays[index] = TracedRay(hit.tM, hit.instance, hit.primitive, hit.barycentrics,
                                  (occluded(ray) ? 1u : 0u) | (hit.backFace ? 2u : 0u));
}
