#version 460
// From the triangle that each pixel sees to its G-buffer.
#include "shared/features.h"
#include "lib/dispatch.glsl"
#include "lib/surface.glsl"

layout(constant_id = FEATURE_BACKGROUND) const bool kBackground = true;
layout(constant_id = FEATURE_MOVING_INSTANCES) const bool kMovingInstances = true;

layout(local_size_x = 8, local_size_y = 8) in;
uniform usampler2D visibility;
layout(r32f) writeonly uniform image2D gDepthOut;
layout(rgba32ui) writeonly uniform uimage2D gSurfaceOut;
layout(r32ui) writeonly uniform uimage2D gMaterialOut;
layout(rgba16f) writeonly uniform image2D gEmissiveOut;

layout(rgba16f) writeonly uniform image2D motionOut;
layout(scalar) readonly buffer PreviousInstances {
    InstanceRows previousInstances[];
};

// Where the surface point was in the previous frame: uv offset, linear depth. Both uvs come from one expression, and
// both places of a moving instance from another, so that what stands still under a still camera gets exactly 0.
vec3 motionOf(uint instanceId, vec3 positionWs, vec3 positionLs) {
    vec3 beforeWs = positionWs;
    if (kMovingInstances && (instances[instanceId].flags & INSTANCE_MOVING) != 0u) {
        InstanceRows rows = previousInstances[instanceId];
        vec4 p = vec4(positionLs, 1.0);
        beforeWs = vec3(dot(rows.row0, p), dot(rows.row1, p), dot(rows.row2, p));
        positionWs = transformPoint(instances[instanceId], positionLs);
    }
    vec4 now = frame.steadyClipFromWorld * vec4(positionWs, 1.0);
    vec4 before = frame.previousClipFromWorld * vec4(beforeWs, 1.0);
    float depthM = dot(frame.previousDepthRow, vec4(beforeWs, 1.0));
    if (depthM <= 0.0) return vec3(4.0, 4.0, depthM); // behind the previous camera: far outside its picture
    return vec3(clamp(0.5 * (before.xy / before.w - now.xy / now.w), -4.0, 4.0), depthM);
}

const float kHalfMax = 65504.0;

// The same of what lies behind the scene: endlessly far away.
vec3 motionOfBackground(vec3 dir) {
    vec4 now = frame.steadyClipFromWorld * vec4(dir, 0.0), before = frame.previousClipFromWorld * vec4(dir, 0.0);
    if (now.w <= 0.0) return vec3(0.0); // orthographic: one direction everywhere
    if (before.w <= 0.0) return vec3(4.0, 4.0, kHalfMax);
    return vec3(clamp(0.5 * (before.xy / before.w - now.xy / now.w), -4.0, 4.0), kHalfMax);
}

void main() {
    uvec2 pixel = streamedPixel();
    if (!isInPicture(pixel)) return;
    ivec2 at = ivec2(pixel);
    uvec2 seen = texelFetch(visibility, at, 0).xy;
    float depthM = DEPTH_SKY;
    uint material = 0u;
    uvec4 surface = noSurface();
    vec3 emissive = vec3(0.0), moved = vec3(0.0);
    if (seen.x != 0xffffffffu) {
        CameraRay camera = cameraRay(pixel);
        SurfaceHit hit = evaluateSurface(seen.x, seen.y, camera.originWs, camera.dir, -normalize(camera.dir),
                                         frame.pixelAngleRad);
        depthM = max(dot(hit.positionWs - camera.originWs, camera.dir) / dot(camera.dir, camera.dir), frame.zNearM);
        surface = packSurface(depthM, hit.surface);
        material = packMaterial(hit.surface, instances[seen.x].flags >> INSTANCE_CHANNELS_SHIFT);
        moved = motionOf(seen.x, hit.positionWs, hit.positionLs);
        emissive = min(hit.emissiveNit * frame.exposure, vec3(kHalfMax));
    }
    if (kBackground && seen.x == 0xffffffffu) moved = motionOfBackground(cameraRay(pixel).dir);
    imageStore(gDepthOut, at, vec4(depthM));
    imageStore(gSurfaceOut, at, surface);
    imageStore(gMaterialOut, at, uvec4(material));
    imageStore(gEmissiveOut, at, vec4(emissive, 1.0));
    // Methods without history have no such image: a dummy of one texel stands in.
    if (all(lessThan(at, imageSize(motionOut))))
        imageStore(motionOut, at, vec4(clamp(moved, vec3(-kHalfMax), vec3(kHalfMax)), 0.0));
}
