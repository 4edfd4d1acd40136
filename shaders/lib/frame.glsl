// The frame's constants and camera rays.
#ifndef KILOLUX_LIB_FRAME_GLSL
#define KILOLUX_LIB_FRAME_GLSL
#include "../math/prelude.glsl"
#include "../shared/frame.h"

layout(scalar) uniform Frame {
    FrameConstants frame;
};

struct CameraRay {
    vec3 originWs;
    vec3 dir; // not unit: 1 along the camera's axis
};

CameraRay cameraRay(vec2 px) {
    return CameraRay(frame.originBase + px.x * frame.originStepX + px.y * frame.originStepY,
                     frame.dirBase + px.x * frame.dirStepX + px.y * frame.dirStepY);
}

CameraRay cameraRay(uvec2 pixel) {
    return cameraRay(vec2(pixel) + 0.5);
}

#endif
