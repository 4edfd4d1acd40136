#version 460
// The viewport's picture: denoised and anti-aliased at first, giving way to the mean of the raw frames as that
// converges, by the mean's own relative standard error. The error is taken over a neighbourhood: a pixel's own
// is as noisy as the pixel, and would choose the mean where it happens to be wrong.
#include "lib/dispatch.glsl"
#include "lib/filtered_light.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D filteredColor;
uniform sampler2D meanColor;
uniform sampler2D meanMoments;
layout(rgba16f) writeonly uniform image2D viewportColorOut;

const float kFewFrames = 8.0;  // in which a variance says nothing yet
const float kDarkest = 0.01;   // of display white: errors of darker pixels are not seen
const float kBegin = 4.0;      // times settleError: where the mean begins to show

void main() {
    uvec2 pixel = dispatchedPixel();
    if (!isInPicture(pixel)) return;
    ivec2 at = ivec2(pixel);
    float variance = 0.0, light = 0.0, taps = 0.0;
    for (int y = -4; y <= 4; y += 2) {
        for (int x = -4; x <= 4; x += 2) {
            ivec2 other = clamp(at + ivec2(x, y), ivec2(0), ivec2(frame.size) - 1);
            vec2 moments = texelFetch(meanMoments, other, 0).xy;
            light += moments.x;
            variance += moments.y;
            taps += 1.0;
        }
    }
    vec4 mean = texelFetch(meanColor, at, 0);
    float error = sqrt(variance / (taps * max(mean.a, 1.0))) / (light / taps + kDarkest);
    float least = frame.denoising.settleError;
    float share = mean.a < kFewFrames ? 0.0 : 1.0 - saturate((error - least) / ((kBegin - 1.0) * least));
    vec3 color = mix(texelFetch(filteredColor, at, 0).rgb, mean.rgb, share);
    imageStore(viewportColorOut, at, vec4(storableLight(color), share));
}
