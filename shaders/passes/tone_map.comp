#version 460
// Exposed linear light to display values, sRGB-encoded by the writer.
#include "shared/features.h"
#include "lib/dispatch.glsl"
#include "math/tone_map.glsl"

layout(constant_id = CHOICE_TONE_MAP) const int kToneMap = TONE_MAP_NEUTRAL;

layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D picture;
layout(rgba8) writeonly uniform image2D displayOut;

void main() {
    uvec2 pixel = dispatchedPixel();
    if (!isInPicture(pixel)) return;
    vec3 color = max(texelFetch(picture, ivec2(pixel), 0).rgb, vec3(0.0));
    if (kToneMap == TONE_MAP_NEUTRAL) color = toneMapNeutral(color);
    imageStore(displayOut, ivec2(pixel), vec4(srgbFromLinear(clamp(color, 0.0, 1.0)), 1.0));
}
