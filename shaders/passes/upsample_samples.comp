#version 460
// Brings the samples of half-resolution pixels to full resolution: each pixel takes those of one of its four
// nearest neighbours, by bilinear chance weighted by depth and normal (the MegaLights talk, SIGGRAPH 2025,
// "Downsampled Sampling"). Every pixel still traces rays and shades by its own surface; only the choice of the
// light is borrowed.
#include "shared/features.h"
#include "lib/dispatch.glsl"
#include "lib/gbuffer.glsl"
#include "lib/sample.glsl"
#include "lib/sampled_pixel.glsl"

layout(constant_id = CHOICE_HALF_SAMPLING) const int kHalfSampling = HALF_CHECKERBOARD;

layout(local_size_x = 8, local_size_y = 8) in;
uniform usampler2D gSurface;
uniform usampler2DArray samplesHalf;
layout(rgba32ui) writeonly uniform uimage2DArray samplesOut;

// How well the surface at a half-resolution pixel's own place stands for the one at `pixel`: 0 where it does not.
float likeness(uvec2 other, float depthM, vec3 normalWs) {
    uvec4 surface = texelFetch(gSurface, ivec2(other), 0);
    float otherM = surfaceDepthM(surface);
    if (otherM >= DEPTH_SKY) return 0.0;
    vec3 otherWs = surfaceNormalWs(surface);
    float apart = abs(otherM - depthM) / depthM;
    float byDepth = exp2(-apart * frame.sampling.upsampleDepth);
    float byNormal = pow(max(dot(normalWs, otherWs), 0.0), frame.sampling.upsampleNormal);
    float w = byDepth * byNormal;
    return w > frame.sampling.upsampleLeast ? w : 0.0;
}

void main() {
    uvec2 pixel = dispatchedPixel();
    if (!isInPicture(pixel)) return;
    SamplingConstants how = frame.sampling;
    uvec4 surface = texelFetch(gSurface, ivec2(pixel), 0);
    float depthM = surfaceDepthM(surface);
    bool sampled = depthM < DEPTH_SKY && isSampledPixel(pixel, how.pixelsPerRay, how.noiseFrame);
    uvec2 halfSize = (frame.size + 1u) / 2u;
    ivec2 corner = ivec2(pixel >> 1u) - 1 + ivec2(pixel & 1u);
    uint seed = pixelSeed(pixel, how.noiseFrame, frame.seed);
    uvec2 taken = min(pixel >> 1u, halfSize - 1u);
    uint flags = SAMPLE_RECONSTRUCTED;
    if (sampled) {
        vec3 normalWs = surfaceNormalWs(surface);
        float sum = 0.0, number = whiteNoise1(seed, 64u);
        for (int i = 0; i < 4; ++i) {
            ivec2 at = corner + ivec2(i & 1, i >> 1);
            if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, ivec2(halfSize)))) continue;
            uvec2 other = halfResolutionPixel(uvec2(at), kHalfSampling, how.noiseFrame);
            vec2 apart = abs(vec2(other) - vec2(pixel));
            vec2 reach = max(2.0 - apart, vec2(how.upsampleReachPx));
            float w = reach.x * reach.y * likeness(other, depthM, normalWs);
            if (w <= 0.0) continue;
            sum += w;
            if (number * sum < w) {
                taken = uvec2(at);
                number = min(number * sum / w, 0.99999994);
            } else {
                number = min((number * sum - w) / (sum - w), 0.99999994);
            }
        }
        flags = sum > 0.0 ? 0u : SAMPLE_RECONSTRUCTED;
    }
    // The samples of a half-resolution pixel are dealt to its four pixels in a random order: each by itself is
    // unbiased only if it is any of them with the same chance.
    uint turn = hashCombine(pixelSeed(taken, how.noiseFrame, frame.seed), 65u) & 3u;
    uint mine = ((pixel.x & 1u) + 2u * (pixel.y & 1u)) ^ turn;
    for (uint i = 0u; i < how.rays; ++i) {
        uvec4 texel = uvec4(0u);
        if (sampled) {
            texel = texelFetch(samplesHalf, ivec3(taken, mine * how.rays + i), 0);
            texel.x |= flags;
        }
        imageStore(samplesOut, ivec3(pixel, i), texel);
    }
}
