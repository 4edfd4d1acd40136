// What every pass of a frame knows: camera, size, noise. One uniform block, `Frame`.
#ifndef KILOLUX_SHARED_FRAME_H
#define KILOLUX_SHARED_FRAME_H
#include "base.h"
#include "denoising.h"
#include "light_grid.h"
#include "sampling.h"

KX_SHARED_BEGIN

struct FrameConstants {
    mat4 clipFromWorld; // of anchor-relative positions, jitter contained; reversed depth, infinite far plane
    // The camera ray of pixel coordinates (px, py), pixel centres at halves, jitter contained:
    //   origin = originBase + px * originStepX + py * originStepY
    //   direction = dirBase + px * dirStepX + py * dirStepY, with 1 along the camera's axis: so that
    //   position = origin + direction * linear depth
    vec3 originBase; // metres, anchor-relative
    vec3 originStepX;
    vec3 originStepY;
    vec3 dirBase;
    vec3 dirStepX;
    vec3 dirStepY;
    uvec2 size;       // pixels of the sub-rectangle that this frame renders
    uvec2 outputSize; // pixels of the picture that is shown
    uvec2 tiles;      // of 8 x 8 pixels that cover it
    uint tileChunks;  // runs of workgroups that the device executes side by side (lib/tile_order.glsl)
    uint frame;       // since the start, for noise
    uint seed;
    uint lightCount;     // slots
    float exposure;      // display value = exposure * luminance [nit]
    float pixelAngleRad; // 2 tan(fovY / 2) / height; orthographic: 0
    float zNearM;
    uint rasterized;     // 1 when the visibility came from raster, whose depth snaps corners to 1/256 px
    vec3 backgroundNit;  // of a texel of the dome's picture of 1
    vec2 backgroundTurn; // cosine and sine of its turn about +Y
    vec3 fillNit;        // plain ambient light
    GridConstants grid;
    // Motion and history. Both matrices are without jitter and relative to this frame's anchor.
    mat4 steadyClipFromWorld;
    mat4 previousClipFromWorld;
    vec4 depthRow;         // linear depth = dot(row, vec4(position, 1))
    vec4 previousDepthRow; // linear depth in the previous frame = dot(row, vec4(position, 1))
    uvec2 previousSize;    // pixels of the previous frame's sub-rectangle
    uvec2 previousTiles;
    float exposureRatio; // exposure over the one that history was written with
    uint historyValid;   // 0: the first frame, or the first after a cut
    SamplingConstants sampling;
    DenoisingConstants denoising;
};

KX_CONST float DEPTH_SKY = 3.0e38f; // linear depth of pixels without a surface

// What a frame counted; one buffer of integers, zeroed before the frame.
KX_CONST uint COUNTER_RAYS = 0u;
KX_CONST uint COUNTER_LIGHTS_IN_RANGE = 1u;
KX_CONST uint COUNTER_SURFACE_PIXELS = 2u;
KX_CONST uint COUNTER_LIGHTS_TESTED = 3u;  // candidates of the pixels' cells
KX_CONST uint COUNTER_USEFUL_RAYS = 4u;    // rays that met their light
KX_CONST uint COUNTER_CANDIDATES = 5u;     // lights that pixels evaluated
KX_CONST uint COUNTER_LIST_ENTRIES = 6u;   // of all visible lists
KX_CONST uint COUNTER_LIST_OVERFLOW = 7u;  // lights that a list had no room for
KX_CONST uint COUNTER_SAMPLES = 8u;        // samples with a light
KX_CONST uint COUNTER_COUNTED_PIXELS = 9u; // pixels that the first two of lights and tests were counted for
KX_CONST uint COUNTER_MISSED = 10u;        // pixels whose reprojection failed
KX_CONST uint COUNTER_DROPPED = 11u;       // shares of the pixels' unshadowed light, in steps, dropped as dim
KX_CONST uint COUNTER_COUNT = 12u;
KX_CONST uint DROPPED_STEPS = 256u; // of the whole light of a pixel, so that 16 million pixels fit

KX_SHARED_END
#endif
