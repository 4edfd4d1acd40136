// What a transparent surface does to the light behind it, for the two forward passes.
#ifndef KILOLUX_LIB_TRANSPARENT_GLSL
#define KILOLUX_LIB_TRANSPARENT_GLSL
#include "frame.glsl"
#include "surface.glsl"

uniform sampler2D gDepth;

// True where an opaque surface is in front. Coplanar surfaces are seen.
bool isHidden(vec3 positionWs, CameraRay camera) {
    float depthM = dot(positionWs - camera.originWs, camera.dir) / dot(camera.dir, camera.dir);
    return depthM > texelFetch(gDepth, ivec2(gl_FragCoord.xy), 0).x * 1.00001;
}

SurfaceHit transparentSurface(uint instanceId) {
    CameraRay camera = cameraRay(gl_FragCoord.xy);
    SurfaceHit hit = evaluateSurface(instanceId, uint(gl_PrimitiveID), camera.originWs, camera.dir,
                                     -normalize(camera.dir), frame.pixelAngleRad);
    if (isHidden(hit.positionWs, camera)) discard;
    return hit;
}

// Transmission tints by its base colour; BLEND covers with a share that reflects nothing here.
vec3 transmittance(SurfaceHit hit, GpuMaterial material) {
    if ((material.flags & MATERIAL_TRANSMISSIVE) != 0u) {
        return hit.surface.baseColor * (1.0 - material.opacity);
    }
    return mix(vec3(1.0), hit.surface.baseColor, clamp(hit.alpha, 0.0, 1.0));
}

#endif
