#version 460
// Light of a pixel's visible samples: their contributions summed per light, times the light's analytic irradiance
// (the MegaLights talk, SIGGRAPH 2025, "Shading"; Heitz, Hill and McGuire 2018 for the split). Output is exposed;
// diffuse light is without the diffuse albedo, specular light without the pre-integrated environment BRDF, so that
// the denoiser blurs no material.
#include "shared/features.h"
#include "lib/ray_list.glsl"
#include "lib/receiver.glsl"
#include "lib/environment_brdf.glsl"
#include "lib/sample.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform usampler2DArray samples;
uniform usampler2DArray rayResults;
layout(rgba32f) writeonly uniform image2D litDiffuseOut;
layout(rgba32f) writeonly uniform image2D litSpecularOut;

void main() {
    uvec2 pixel = pixelOfRay(0u); // the list is that of the only ray
    if (!isInPicture(pixel)) return;
    SamplingConstants how = frame.sampling;
    vec3 diffuse = vec3(0.0), specular = vec3(0.0);
    vec2 state = vec2(0.0, HISTORY_FREE_FRAMES);
    Receiver receiver = loadReceiver(pixel);
    if (receiver.exists) {
        LtcLobe lobe;
        vec3 f0 = specularF0(receiver.surface);
        bool lobeMade = false;
        // A light that several rays chose is evaluated once, at the first of them.
        for (uint i = 0u; i < how.rays; ++i) {
            uvec4 texel = texelFetch(samples, ivec3(pixel, i), 0);
            StoredSample s = unpackSample(texel);
            if (i == 0u) state = sampledState(texel);
            if (!(s.contribution > 0.0)) continue;
            float visible = 0.0;
            bool first = true;
            for (uint j = 0u; j < how.rays; ++j) {
                StoredSample other = unpackSample(texelFetch(samples, ivec3(pixel, j), 0));
                if (!(other.contribution > 0.0) || other.slot != s.slot) continue;
                first = first && j >= i;
                uint result = texelFetch(rayResults, ivec3(pixel, j), 0).x & RAY_STATE_MASK;
                visible += result == RAY_VISIBLE ? other.contribution : 0.0;
            }
            if (!first || visible <= 0.0) continue;
            if (!lobeMade) lobe = makeLtcLobe(receiver.point);
            lobeMade = true;
            LightIrradiance lit = lightIrradiance(loadOwnLightHot(s.slot), receiver.point, lobe);
            float exposed = frame.exposure * visible;
            diffuse += lit.emission * (exposed * lit.diffuse * KX_INV_PI);
            specular += lit.specularEmission * exposed * (f0 * lit.specular.x + vec3(lit.specular.y));
        }
        if (lobeMade) specular /= environmentBrdf(lobe.albedo, f0);
    }
    imageStore(litDiffuseOut, ivec2(pixel), vec4(diffuse, state.x));
    imageStore(litSpecularOut, ivec2(pixel), vec4(specular, state.y));
}
