// What the probe of a pixel writes: the surface, how its lights were chosen among, and every light.
#ifndef KILOLUX_SHARED_PROBE_H
#define KILOLUX_SHARED_PROBE_H
#include "base.h"

KX_SHARED_BEGIN

KX_CONST uint PROBE_RAYS = 16u;  // to each light in range
KX_CONST uint PROBE_LANES = 64u; // of its only workgroup

struct ProbeRequest {
    uvec2 renderedPx; // pixel of the rendered part
    uvec2 shownPx;    // of the picture
    uint stochastic;  // 0: another method, which chooses no lights
    uint lights;      // 0: the surface and the picture only
};

struct ProbeSurface {
    uvec2 pixel;     // that chose the lights: at half resolution another one of the 2 x 2 pixels
    uint exists;     // 0: no surface
    uint hasTurn;    // 0: below one ray per pixel, in frames that sample other pixels
    vec3 positionWs; // metres, anchor-relative
    float depthM;
    vec3 normalWs;
    vec3 geoNormalWs;
    vec3 viewDirWs;
    vec3 baseColor;
    float roughness;
    float metallic;
    uint instance;
    uint primitive;
    vec3 pictureNit;    // of the picture as the frame shows it, linear
    vec3 viewValue;     // raw value of the view; the picture's where it is not a view
    vec3 irradianceLux; // of all lights with their shadows, as the frame found it
    // How lights were chosen among:
    uint candidates; // lights that were weighed
    uint cellLights; // on the grid cell's list
    uint stride;     // every so many of them is a candidate
    uint listLights; // on the visible list
    uvec2 listTile;  // whose list that is, of the previous frame's tiles
    uint missed;     // reprojection failed
    vec4 sums;       // of weights: visible, hidden, directional, dome
    vec3 budgeted;   // what the last three count for
};

KX_CONST uint PROBE_REACHES = 1u;    // on, within range, cone and side
KX_CONST uint PROBE_IN_CELL = 2u;    // on the grid cell's list
KX_CONST uint PROBE_LISTED = 4u;     // on the visible list
KX_CONST uint PROBE_FRESH = 8u;      // just edited
KX_CONST uint PROBE_CANDIDATE = 16u; // weighed in this frame

struct ProbeLight {
    uint flags;         // PROBE_*
    uint list;          // LIST_* as a candidate
    uint entry;         // of the visible list, packed; 0 where it is not on it
    uint cells;         // of its unit square that were seen, a bit each
    float weight;       // perceptual, before the dim lights' threshold and the stride
    float offered;      // weight as a candidate
    float probability;  // that a sample of this frame goes to it
    uint chosen;        // samples of this frame that did
    uint chosenVisible; // and of those, rays that met it
    uint rays;          // of the probe's own rays: those that had a point above the horizon
    uint raysVisible;
    vec3 irradianceLux; // unshadowed, analytic
    vec3 reflectedNit;  // towards the camera, unshadowed, analytic
};

KX_SHARED_END
#endif
