#version 460
// The running mean of the frames, what a still picture converges to, and the variance of their luminance (Welford,
// 1962). Methods that leave pixels without a sample in a frame count per pixel.
#include "shared/features.h"
#include "lib/dispatch.glsl"
#include "lib/filtered_light.glsl"

layout(constant_id = CHOICE_COUNT_SAMPLES) const bool kCountSamples = false;

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push {
    uint framesBefore;
};
uniform sampler2D rawColor;
uniform sampler2D litDiffuse;
uniform sampler2D gDepth;
layout(rgba32f) uniform image2D meanColor; // alpha: frames counted; 1 for methods that sample every pixel
layout(rg32f) uniform image2D meanMoments; // luminance's mean and variance

void addSampled(ivec2 at, vec3 color) {
    vec4 mean = framesBefore > 0u ? imageLoad(meanColor, at) : vec4(0.0);
    vec2 moments = framesBefore > 0u ? imageLoad(meanMoments, at).xy : vec2(0.0);
    bool sampled = texelFetch(gDepth, at, 0).x >= DEPTH_SKY || texelFetch(litDiffuse, at, 0).a > 0.0;
    if (sampled && isFiniteLight(color)) {
        float count = mean.a + 1.0, y = luminance(color), off = y - moments.x;
        mean = vec4(mean.rgb + (color - mean.rgb) / count, count);
        moments.x += off / count;
        moments.y += (off * (y - moments.x) - moments.y) / count;
    }
    imageStore(meanColor, at, mean);
    imageStore(meanMoments, at, vec4(moments, 0.0, 0.0));
}

void main() {
    uvec2 pixel = streamedPixel();
    if (!isInPicture(pixel)) return;
    ivec2 at = ivec2(pixel);
    vec3 color = texelFetch(rawColor, at, 0).rgb;
    if (kCountSamples) {
        addSampled(at, color);
        return;
    }
    if (framesBefore > 0u) {
        vec3 before = imageLoad(meanColor, at).rgb;
        color = before + (color - before) / float(framesBefore + 1u);
    }
    imageStore(meanColor, at, vec4(color, 1.0));
}
