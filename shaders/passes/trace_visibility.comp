#version 460
// The visibility buffer by nearest hit: equal to raster_visibility within edge ties. Back faces of single-sided
// materials are passed through, as glTF culls them.
#include "lib/dispatch.glsl"
#include "lib/geometry.glsl"
#include "lib/trace.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(rg32ui) writeonly uniform uimage2D visibilityOut;

// Layers of culled back faces that a ray may pass; more are taken as seen.
const int kMaxBackFaces = 64;

void main() {
    uvec2 pixel = dispatchedPixel();
    if (!isInPicture(pixel)) return;
    CameraRay camera = cameraRay(pixel);
    float perUnitDepth = length(camera.dir);
    Ray ray = makeRay(camera.originWs, camera.dir / perUnitDepth, KX_INFINITY);
    ray.tMinM = frame.zNearM * perUnitDepth;
    Hit hit = nearest(ray);
    for (int i = 0; i < kMaxBackFaces && hit.instance != HIT_NONE; ++i) {
        uint flags = instances[hit.instance].flags;
        if ((flags & INSTANCE_DOUBLE_SIDED) != 0u || !hit.backFace) break;
        ray.tMinM = hit.tM + max(1.0e-6 * hit.tM, 1.0e-7);
        hit = nearest(ray);
    }
    imageStore(visibilityOut, ivec2(pixel), uvec4(hit.instance, hit.primitive, 0u, 0u));
}
