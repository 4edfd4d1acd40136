#version 460
// Takes one of a pixel's own and its neighbours' reservoirs, traces a shadow ray to its point and shades by the BRDF
// there (Bitterli et al. 2020, algorithms 4 to 6). The weight is by multiple importance sampling (section 4.3): each
// pixel that was asked counts by what the point would give it, and, unbiased, is asked whether it sees the point.
// Without reuse it only traces and shades.
#include "shared/features.h"
#include "lib/count.glsl"
#include "lib/dispatch.glsl"
#include "lib/light_reservoir.glsl"
#include "lib/environment_brdf.glsl"
#include "shared/denoising.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant, scalar) uniform Push {
    ResamplingConstants how;
};
uniform usampler2D newReservoirs;
layout(rgba32ui) writeonly uniform uimage2D reservoirsOut;
layout(r32ui) writeonly uniform uimage2DArray rayResultsOut;
layout(rgba32f) writeonly uniform image2D litDiffuseOut;
layout(rgba32f) writeonly uniform image2D litSpecularOut;

const float kSameDepth = 0.1;     // of the depth

// The j-th of the pixels whose reservoirs are asked; the 0-th is the pixel itself. False for another surface.
bool askedPixel(uvec2 pixel, Receiver receiver, uint seed, uint j, out uvec2 asked) {
    asked = pixel;
    if (j == 0u) return true;
    vec2 number = whiteNoise2(seed, j);
    float radius = how.radiusPx * sqrt(number.x), angle = number.y * KX_TWO_PI;
    ivec2 at = ivec2(floor(vec2(pixel) + 0.5 + radius * vec2(cos(angle), sin(angle))));
    if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, ivec2(frame.size)))) return false;
    asked = uvec2(at);
    uvec4 surface = texelFetch(gSurface, at, 0);
    return abs(surfaceDepthM(surface) - receiver.depthM) <= kSameDepth * receiver.depthM &&
           dot(surfaceNormalWs(surface), receiver.surface.normalWs) >= kLikeNormal;
}

void main() {
    uvec2 pixel = dispatchedPixel();
    if (!isInPicture(pixel)) return;
    ivec2 at = ivec2(pixel);
    Receiver here = loadReceiver(pixel);
    LightReservoir chosen = emptyLightReservoir();
    vec3 diffuse = vec3(0.0), specular = vec3(0.0);
    uint result = RAY_NONE;
    if (here.exists) {
        uint seed = hashCombine(pixelSeed(pixel, frame.frame, frame.seed), 0x9e0bu);
        uint asked = how.reuse != 0u ? how.neighbours + 1u : 1u;
        uint weights = how.reuse != 0u ? how.weights : REUSE_BY_COUNTS;
        float sum = 0.0, target = 0.0;
        float drawnBy = 0.0, drawnByAll = 0.0; // densities of the point: of who drew it, and of all, times counts
        uint from = 0u;
        vec3 emission = vec3(0.0), terms = vec3(0.0);
        uint rays = 0u;
        // First all reservoirs are offered, then the winner is held up to those who offered: the pixel itself, whose
        // answer is the shadow ray, and the others where the weight asks for them.
        for (uint i = 0u; i < 2u * asked; ++i) {
            bool offering = i < asked;
            uint j = offering ? i : i - asked;
            if (!offering && (target <= 0.0 || (j > 0u && weights == REUSE_BY_COUNTS))) break;
            uvec2 place;
            if (!askedPixel(pixel, here, seed, j, place)) continue;
            LightReservoir offered = unpackLightReservoir(texelFetch(newReservoirs, ivec2(place), 0));
            Receiver there = here;
            if (!offering && j > 0u) there = loadReceiver(place);
            PointLight lit = pointLight(there, offering ? offered.slot : chosen.slot, offering ? offered.uv : chosen.uv);
            if (offering) {
                chosen.count += offered.count;
                float weight = lit.target * offered.contribution * offered.count;
                if (!takesOffer(sum, weight, whiteNoise1(seed, 64u + j))) continue;
                chosen.slot = offered.slot;
                chosen.uv = offered.uv;
                from = j;
                target = lit.target;
                emission = lit.emission;
                terms = lit.terms;
            } else if (lit.target > 0.0) {
                bool traced = false;
                uint seen = RAY_VISIBLE;
                if (j == 0u || weights == REUSE_BY_RAYS) seen = tracePoint(there, chosen.slot, lit.point, traced);
                rays += traced ? 1u : 0u;
                float density = seen == RAY_VISIBLE || weights != REUSE_BY_RAYS ? lit.target : 0.0;
                drawnByAll += density * offered.count;
                if (j == from) drawnBy = density;
                if (j == 0u) result = seen;
            }
        }
        float share = 1.0 / max(chosen.count, 1.0);
        if (weights != REUSE_BY_COUNTS) share = drawnByAll > 0.0 ? drawnBy / drawnByAll : 0.0;
        chosen.contribution = target > 0.0 ? sum / target * share : 0.0;
        if (result == RAY_VISIBLE) {
            vec3 f0 = specularF0(here.surface), light = emission * (frame.exposure * chosen.contribution);
            diffuse = light * terms.x;
            specular = light * (f0 * terms.y + vec3(terms.z));
            specular /= environmentBrdf(here.point.noV, here.surface.roughness, f0);
        } else if (weights == REUSE_BY_RAYS) {
            chosen.contribution = 0.0; // what a pixel hands on is what it sees
        }
        countAll(COUNTER_RAYS, rays);
        countAll(COUNTER_SAMPLES, target > 0.0 ? 1u : 0u);
        countAll(COUNTER_USEFUL_RAYS, result == RAY_VISIBLE ? 1u : 0u);
    }
    imageStore(reservoirsOut, at, packLightReservoir(chosen));
    imageStore(rayResultsOut, ivec3(at, 0), uvec4(result));
    imageStore(litDiffuseOut, at, vec4(diffuse, 1.0));
    imageStore(litSpecularOut, at, vec4(specular, HISTORY_FREE_FRAMES));
}
