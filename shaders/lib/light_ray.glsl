// Rays from a receiver to points of a light: which point, and whether it is seen.
#ifndef KILOLUX_LIB_LIGHT_RAY_GLSL
#define KILOLUX_LIB_LIGHT_RAY_GLSL
#include "receiver.glsl"
#include "trace.glsl"
#include "../math/hash.glsl"
#include "../shared/sampling.h"

// The point at `uv`; drawn again by `seed` until one is above the receiver's horizon and emits towards it. False when
// none is found.
bool usablePoint(Receiver receiver, LightHot light, vec2 uv, uint seed, out LightSample s) {
    // A pixel that took its neighbour's choice may be left out by the light or have all of it below its horizon.
    if (!lightIncludes(light, receiver.point.channels)) return false;
    LightExtent extent = lightExtent(light, receiver.point.positionWs);
    float highest = dot(receiver.point.normalWs, extent.toCenter) + extentAlong(extent, receiver.point.normalWs);
    bool above = highest > 0.0 || (kDome && lightType(light) == LIGHT_DOME);
    int draws = above ? mostDraws(light) : 0;
    for (int draw = 0; draw < draws; ++draw) {
        s = lightSample(light, receiver.point.positionWs, uv);
        if (s.valid && dot(receiver.point.normalWs, s.dirWs) > 0.0) return true;
        // From behind or inside all points are invalid; of a tube seen along its axis only some are.
        if (!s.valid && lightType(light) != LIGHT_TUBE) return false;
        uv = whiteNoise2(seed, uint(draw));
    }
    return false;
}

// The sample with the source grown or shrunk about its centre, as shadow rays see it.
LightSample scaledSource(LightSample s, LightHot light, Receiver receiver, float penumbraScale) {
    bool directional = lightType(light) == LIGHT_DIRECTIONAL;
    vec3 middle = directional ? -light.dirWs : light.positionWs - receiver.point.positionWs;
    vec3 to = mix(middle, directional ? s.dirWs : s.positionWs - receiver.point.positionWs, penumbraScale);
    float lengthM = length(to);
    s.dirWs = to / max(lengthM, 1.0e-20);
    s.positionWs = receiver.point.positionWs + to;
    if (!directional) s.distanceM = lengthM;
    return s;
}

// The BRDF at a point of a light, over the point's density: diffuse without albedo, specular for F0 and for F90.
vec3 termsAtPoint(Receiver receiver, LightSample s) {
    BrdfTimesCosine brdf = brdfTimesCosine(receiver.point.normalWs, receiver.point.viewDirWs, receiver.point.noV, s.dirWs,
                                           receiver.point.alpha);
    return s.geometry * vec3(brdf.diffuse, brdf.specular);
}

// Of the meshes that cast the light's shadow.
uint shadowChannelsOf(LightHot light) {
    return lightHasShaping(light) ? lightShaping(light).shadowChannels : CHANNELS_ALL;
}

// RAY_VISIBLE or RAY_HIDDEN of a point on the light of a slot; `traced`: there was a ray to trace.
uint tracePoint(Receiver receiver, uint slot, LightSample s, out bool traced) {
    LightCold cold = loadLightCold(slot);
    if (cold.penumbraScale != 1.0) s = scaledSource(s, loadLightHot(slot), receiver, cold.penumbraScale);
    traced = false;
    if (dot(receiver.surface.geoNormalWs, s.dirWs) <= 0.0) return RAY_HIDDEN;
    Ray ray = shadowRay(receiver, s, cold.rayEndBiasM);
    if (kTraceChannels) ray.channels = shadowChannelsOf(loadOwnLightHot(slot));
    if (ray.tMaxM <= 0.0) return RAY_VISIBLE;
    traced = true;
    return occluded(ray) ? RAY_HIDDEN : RAY_VISIBLE;
}

#endif
