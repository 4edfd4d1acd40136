#version 460
// From the triangle that each pixel sees to its G-buffer.
#include "shared/features.h"
#include "lib/dispatch.glsl"
#include "lib/surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform usampler2D visibility;
layout(r32f) writeonly uniform image2D gDepthOut;
layout(rg32ui) writeonly uniform uimage2D gNormalsOut;
layout(rg32ui) writeonly uniform uimage2D gMaterialOut;
layout(rgba16f) writeonly uniform image2D gEmissiveOut;

const float kHalfMax = 65504.0;

void main() {
    uvec2 pixel = dispatchedPixel();
    if (!isInPicture(pixel)) return;
    ivec2 at = ivec2(pixel);
    uvec2 seen = texelFetch(visibility, at, 0).xy;
    float depthM = DEPTH_SKY;
    uvec2 normals = uvec2(0u), material = uvec2(0u);
    vec3 emissive = vec3(0.0);
    if (seen.x != 0xffffffffu) {
        CameraRay camera = cameraRay(pixel);
        SurfaceHit hit = evaluateSurface(seen.x, seen.y, camera.originWs, camera.dir, -normalize(camera.dir),
                                         frame.pixelAngleRad);
        depthM = max(dot(hit.positionWs - camera.originWs, camera.dir) / dot(camera.dir, camera.dir), frame.zNearM);
        normals = packNormals(hit.surface);
        material = packMaterial(hit.surface);
        emissive = min(hit.emissiveNit * frame.exposure, vec3(kHalfMax));
    }
    imageStore(gDepthOut, at, vec4(depthM));
    imageStore(gNormalsOut, at, uvec4(normals, 0u, 0u));
    imageStore(gMaterialOut, at, uvec4(material, 0u, 0u));
    imageStore(gEmissiveOut, at, vec4(emissive, 1.0));
}
