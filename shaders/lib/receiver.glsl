// The surface of a pixel as the lighting passes see it.
#ifndef KILOLUX_LIB_RECEIVER_GLSL
#define KILOLUX_LIB_RECEIVER_GLSL
#include "frame.glsl"
#include "gbuffer.glsl"
#include "light_access.glsl"
#include "ray.glsl"

uniform usampler2D gSurface;
uniform usampler2D gMaterial;

struct Receiver {
    ShadingPoint point;
    Surface surface;
    float depthM;
    float errorM; // how far the position may be off its surface
    bool exists;
};

Receiver loadReceiver(uvec2 pixel) {
    ivec2 at = ivec2(pixel);
    Receiver receiver;
    uvec4 texel = texelFetch(gSurface, at, 0);
    receiver.depthM = surfaceDepthM(texel);
    receiver.exists = receiver.depthM < DEPTH_SKY;
    uint material = texelFetch(gMaterial, at, 0).x;
    receiver.surface = unpackSurface(texel, material);
    CameraRay camera = cameraRay(pixel);
    vec3 positionWs = camera.originWs + camera.dir * receiver.depthM;
    float distanceM = receiver.depthM * length(camera.dir);
    receiver.errorM = frame.rasterized != 0u ? rasterPositionErrorM(positionWs, distanceM, frame.pixelAngleRad)
                                             : positionErrorM(positionWs) + 7.5e-7 * distanceM;
    receiver.point = makeShadingPoint(positionWs, receiver.surface.normalWs, -normalize(camera.dir),
                                      receiver.surface.roughness);
    if (kLightChannels) receiver.point.channels = materialChannels(material);
    return receiver;
}

// Tries to find a point above the receiver's horizon. Those that never do count as hidden, which loses 0.9^64 =
// 0.1 % of a light of which a tenth is above; 8 tries lost 43 % of it, and 0.4 % of one that is half above.
const int kMaxDraws = 64;
const int kMaxDomeDraws = 256; // whose light may come nearly all from a sun below the horizon

int mostDraws(LightHot light) {
    return kDome && lightType(light) == LIGHT_DOME ? kMaxDomeDraws : kMaxDraws;
}

// The ray from a receiver to a sampled point of a light, for which occluded() is asked; tMaxM <= 0 where nothing
// can be between.
Ray shadowRay(Receiver receiver, LightSample s, float rayEndBiasM) {
    vec3 origin = offsetRayOrigin(receiver.point.positionWs, receiver.surface.geoNormalWs, s.dirWs, receiver.errorM);
    // The light's own point must not be met either: end short by the rounding of the distance.
    float endM = s.distanceM >= KX_INFINITY ? KX_INFINITY
                                            : s.distanceM * (1.0 - 4.0e-7) - rayEndBiasM - receiver.errorM;
    return makeRay(origin, s.dirWs, endM);
}

#endif
