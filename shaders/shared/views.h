// The debug views; renderer/views.cpp gives each its name and help.
#ifndef KILOLUX_SHARED_VIEWS_H
#define KILOLUX_SHARED_VIEWS_H
#include "base.h"

KX_SHARED_BEGIN

const int VIEW_FINAL = 0;
const int VIEW_DIFFUSE = 1;
const int VIEW_SPECULAR = 2;
const int VIEW_NORMAL = 3;
const int VIEW_GEOMETRIC_NORMAL = 4;
const int VIEW_BASE_COLOR = 5;
const int VIEW_ROUGHNESS = 6;
const int VIEW_METALLIC = 7;
const int VIEW_EMISSIVE = 8;
const int VIEW_DEPTH = 9;
const int VIEW_DEPTH_RANGE = 10;
const int VIEW_INSTANCE = 11;
const int VIEW_PRIMITIVE = 12;
const int VIEW_LIGHTS_IN_RANGE = 13;
const int VIEW_LIGHTS_SEEN = 14;
const int VIEW_SEEN_SHARE = 15;
const int VIEW_CHOSEN_LIGHT = 16;
const int VIEW_VISIBILITY = 17;
const int VIEW_HIDDEN_SHARE = 18;
const int VIEW_SAMPLE_WEIGHT = 19;
const int VIEW_LIST_LENGTH = 20;
const int VIEW_LIST_AGE = 21;
const int VIEW_REPROJECTION = 22;
const int VIEW_HISTORY_LENGTH = 23; // these to VIEW_DENOISED_SPECULAR are the denoiser's
const int VIEW_DEVIATION = 24;
const int VIEW_REJECTED_HISTORY = 25;
const int VIEW_DENOISED_DIFFUSE = 26;
const int VIEW_DENOISED_SPECULAR = 27;
const int VIEW_LUMINANCE = 28;
const int VIEW_ILLUMINANCE = 29;
const int VIEW_STOPS = 30;
const int VIEW_CLIPPING = 31;
const int VIEW_COUNT = 32;

// What a view is drawn by beside the frame; from its legend (renderer/legend.h).
struct ViewConstants {
    float low; // value at the low end of the scale; of logarithmic ones the log10, of depth the metres in its
               // middle
    float high;
    uint denoised; // the denoiser's light is bound
};

KX_SHARED_END
#endif
