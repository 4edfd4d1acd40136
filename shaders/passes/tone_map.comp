#version 460
// Exposed linear light to display values, sRGB-encoded by the writer.
#include "shared/features.h"
#include "lib/dispatch.glsl"
#include "math/tone_map.glsl"

layout(constant_id = CHOICE_TONE_MAP) const int kToneMap = TONE_MAP_NEUTRAL;

layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D picture;
layout(rgba8) writeonly uniform image2D displayOut;

// Linear between the four nearest rendered pixels; the pixel itself at full resolution.
vec3 shownColor(uvec2 pixel) {
    if (frame.size == frame.outputSize) return texelFetch(picture, ivec2(pixel), 0).rgb;
    vec2 at = renderedFromOutput(pixel) - 0.5;
    ivec2 corner = ivec2(floor(at)), last = ivec2(frame.size) - 1;
    vec2 part = at - vec2(corner);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        vec2 weight = mix(1.0 - part, part, vec2(offset));
        sum += weight.x * weight.y * texelFetch(picture, clamp(corner + offset, ivec2(0), last), 0).rgb;
    }
    return sum;
}

void main() {
    uvec2 pixel = streamedOutputPixel();
    if (!isInOutput(pixel)) return;
    vec3 color = max(shownColor(pixel), vec3(0.0));
    if (kToneMap == TONE_MAP_NEUTRAL) color = toneMapNeutral(color);
    imageStore(displayOut, ivec2(pixel), vec4(srgbFromLinear(clamp(color, 0.0, 1.0)), 1.0));
}
