#version 460
// The viewport's picture: denoised and anti-aliased at first, giving way to the mean of the raw frames as that
// converges, by the mean's own relative standard error. The error is taken over a neighbourhood: a pixel's own
// is as noisy as the pixel, and would choose the mean where it happens to be wrong. Where filtering takes no noise
// away (rims of lamps, which jitter meets now and then) the mean is the better average of the same frames at once.
#include "lib/dispatch.glsl"
#include "lib/filtered_light.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D filteredColor;
uniform sampler2D meanColor;
uniform sampler2D meanMoments;
uniform sampler2D pixelMoments; // deviation of the filtered frames; absent without anti-aliasing
layout(rgba16f) writeonly uniform image2D viewportColorOut;

const float kDarkest = 0.01;   // of display white: errors of darker pixels are not seen

void main() {
    uvec2 pixel = streamedPixel();
    if (!isInPicture(pixel)) return;
    ivec2 at = ivec2(pixel);
    DenoisingConstants how = frame.denoising;
    vec4 mean = texelFetch(meanColor, at, 0);
    vec3 filtered = texelFetch(filteredColor, at, 0).rgb;
    // In the first frames a variance says little, and grain that changes disturbs more than a filter's faults.
    if (mean.a <= how.settleFirstFrames || how.settleError <= 0.0) {
        imageStore(viewportColorOut, at, vec4(storableLight(filtered), 0.0));
        return;
    }
    float variance = 0.0, filteredVariance = 0.0, light = 0.0, off = 0.0, taps = 0.0, here = luminance(filtered);
    bool knowsFiltered = textureSize(pixelMoments, 0) == textureSize(meanColor, 0);
    for (int y = -3; y <= 3; y += 3) {
        for (int x = -3; x <= 3; x += 3) {
            ivec2 other = clamp(at + ivec2(x, y), ivec2(0), ivec2(frame.size) - 1);
            vec2 moments = texelFetch(meanMoments, other, 0).xy;
            light += moments.x;
            variance += moments.y;
            off += moments.x - luminance(texelFetch(filteredColor, other, 0).rgb);
            if (knowsFiltered) filteredVariance += square(texelFetch(pixelMoments, other, 0).y);
            taps += 1.0;
        }
    }
    float error = sqrt(variance / (taps * max(mean.a, 1.0))) / (light / taps + kDarkest);
    float least = how.settleError;
    float settled = 1.0 - saturate((error - least) / ((how.settleBegin - 1.0) * least));
    float useless = smoothstep(0.5, 1.0, sqrt(filteredVariance / max(variance, 1.0e-12)));
    // A difference that the mean's noise does not explain is the filters' fault: small highlights and shadows.
    vec2 own = texelFetch(meanMoments, at, 0).xy;
    float deviation = sqrt(max(own.y, variance / taps) / max(mean.a, 1.0)) + kDarkest * 0.1;
    float faulty = smoothstep(how.settleFaultBegin, how.settleFaultSure, abs(own.x - here) / deviation);
    // The taps together know sooner: what a filter takes from a region, however dark, their sum tells from noise.
    float deviationOfSum = sqrt(variance / max(mean.a, 1.0)) + kDarkest * 0.01 * taps;
    faulty = max(faulty, smoothstep(how.settleFaultBegin, how.settleFaultSure, abs(off) / deviationOfSum));
    float trust = smoothstep(how.settleFirstFrames, how.settleFullFrames, mean.a);
    float share = max(max(settled, useless), faulty) * trust;
    vec3 color = mix(filtered, mean.rgb, share);
    imageStore(viewportColorOut, at, vec4(storableLight(color), share));
}
