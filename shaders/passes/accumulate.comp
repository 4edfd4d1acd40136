#version 460
// The running mean of all frames: what a still picture converges to.
#include "lib/dispatch.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push {
    uint framesBefore;
};
uniform sampler2D sceneColor;
layout(rgba32f) uniform image2D meanColor;

void main() {
    uvec2 pixel = dispatchedPixel();
    if (!isInPicture(pixel)) return;
    ivec2 at = ivec2(pixel);
    vec3 color = texelFetch(sceneColor, at, 0).rgb;
    if (framesBefore > 0u) {
        vec3 before = imageLoad(meanColor, at).rgb;
        color = before + (color - before) / float(framesBefore + 1u);
    }
    imageStore(meanColor, at, vec4(color, 1.0));
}
