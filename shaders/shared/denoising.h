// The numbers that steer the denoiser, the anti-aliasing and the passage to the converged picture; settings
// of the same names, see renderer/settings_table.cpp for ranges and defaults.
#ifndef KILOLUX_SHARED_DENOISING_H
#define KILOLUX_SHARED_DENOISING_H
#include "base.h"

KX_SHARED_BEGIN

KX_CONST float HISTORY_FREE_FRAMES = 255.0f; // of a pixel whose light was not edited: no limit of its own

struct DenoisingConstants {
    float diffuseFrames; // that a history holds at most
    float specularFrames;
    float leastFrames; // what remains of that limit where the history is far off
    float clipWidth;   // standard deviations of the neighbourhood
    float clipExtent;  // of display white
    float momentFrames;
    float depthTolerance;  // share of the depth
    float normalTolerance; // cosine
    float spatialRadiusPx;
    float spatialThreshold; // relative standard error from which on the spatial filter works
    float spatialTaps;
    float spatialTapsNew;
    float spatialNewFrames;
    float spatialDeviations; // standard errors
    float spatialPlanePx;
    float spatialNormal; // per 1 - cosine
    float antiAliasFrames;
    float antiAliasClip;     // standard deviations of the neighbourhood
    float antiAliasSureClip; // times that
    float antiAliasExtent;   // of display white
    float antiAliasLeastFrames;
    float antiAliasMovingFrames;
    float antiAliasMomentFrames;
    float settleError; // relative standard error of the mean at which it has taken over
    float settleBegin; // times that
    float settleFirstFrames;
    float settleFullFrames; // more than the first
    float settleFaultBegin; // standard errors of the mean
    float settleFaultSure;  // more than that
};

KX_SHARED_END

#endif
