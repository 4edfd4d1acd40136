// Shadow maps of lights, for the baseline 'shadow-maps': what is drawn from a light's middle, and where it
// stands in the one image of all maps. Around a local light stand up to six square faces; a narrow spot has
// one, a directional light one for the whole scene.
#ifndef KILOLUX_SHARED_SHADOW_MAP_H
#define KILOLUX_SHARED_SHADOW_MAP_H
#include "base.h"
#include "channels.h"

KX_SHARED_BEGIN

// Of the light's shape as shadows see it: a rectangle or a disk along sourceXWs and sourceYWs, what is round,
// or a capsule along sourceXWs.
KX_CONST uint SHADOW_SOURCE_RECT = 0u;
KX_CONST uint SHADOW_SOURCE_DISK = 1u;
KX_CONST uint SHADOW_SOURCE_SPHERE = 2u;
KX_CONST uint SHADOW_SOURCE_TUBE = 3u;
// Face 2 * i looks along the i-th of forward, x and y, the next one against it; its picture's right and up
// are the axes that follow in that ring.
KX_CONST uint SHADOW_FACES = 6u;
KX_CONST uint SHADOW_FORWARD_FACE = 1u; // a mask of the one face of spots and directional lights

struct ShadowMap {
    vec3 centerWs;  // m, relative to the anchor; directional: the middle of the near side of what is drawn
    float nearM;    // depth is nearM / distance along a face; directional: 1 - distance / this
    vec3 forwardWs; // unit, as are the next two
    float tanHalf;  // of a face's half angle; directional: half the width of what is drawn, m
    vec3 axisXWs;
    uint faceMask; // a bit per face; 0: the light has no map
    vec3 axisYWs;
    uint firstTile; // of its faces, which follow one another, in tiles of tilePx counted by rows
    vec3 sourceXWs; // half extent, m; directional: tangent of the angular radius
    uint tilePx;
    vec3 sourceYWs;
    float sourceRadiusM;
    uint source;         // SHADOW_SOURCE_*
    uint directional;    // 0 or 1
    uint shadowChannels; // CHANNELS_LIMITED + those of the meshes that cast its shadow, or CHANNELS_ALL
    float endBiasM;      // what is this near to the source casts no shadow
};

// What draws one face.
struct ShadowFacePush {
    mat4 clipFromWorld; // of anchor-relative positions
    uint map;           // slot of the light
};

KX_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(kilolux::shared::ShadowMap) == 112);
static_assert(sizeof(kilolux::shared::ShadowFacePush) == 68);
#endif
#endif
