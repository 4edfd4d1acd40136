// The one list of features: a shader states those it models as specialization constants,
//   layout(constant_id = FEATURE_x) const bool featureX = true;
// and a pipeline is built per set of the features that its shader states. Off means that the scene or the
// settings do not need it; the picture is the same.
#ifndef KILOLUX_SHARED_FEATURES_H
#define KILOLUX_SHARED_FEATURES_H
#include "base.h"
#include "light_types.h"

KX_SHARED_BEGIN

const int FEATURE_ALPHA_MASK = 0;       // some instance is alpha-tested
const int FEATURE_TEXTURES = 1;         // some material has a texture
const int FEATURE_MOVING_INSTANCES = 2; // some instance may move
const int FEATURE_BARN_DOORS = 3;       // some rectangle light has flaps
const int FEATURE_IES_PROFILES = 4;     // some light has a photometric profile
const int FEATURE_LIGHT_FUNCTIONS = 5;  // some light has a light function
const int FEATURE_LIGHT_CHANNELS = 6;   // some light leaves out some mesh
const int FEATURE_CHANNEL_SHADOWS = 7;  // and shines through it
const int FEATURE_DOME = 8;             // there is light from all around
const int FEATURE_BACKGROUND = 9;       // and it is seen behind the scene
const int FEATURE_FILL = 10;            // there is plain ambient light
const int FEATURE_TEXTURED_LIGHTS = 11; // some rectangle light has a picture
const int FEATURE_LIGHT_TYPES = 12;     // from here on, by its place in the list: some light is of the type
#define KX_LIGHT_FEATURE(UPPER, Name, place) const int FEATURE_##UPPER##_LIGHTS = FEATURE_LIGHT_TYPES + place;
KX_LIGHT_TYPES(KX_LIGHT_FEATURE) // FEATURE_SPHERE_LIGHTS, ...
#undef KX_LIGHT_FEATURE
#define KX_LIGHT_ONE(UPPER, Name, place) +1
const int FEATURE_COUNT = FEATURE_LIGHT_TYPES KX_LIGHT_TYPES(KX_LIGHT_ONE);
#undef KX_LIGHT_ONE

// Choices of the frame that are specialization constants too, beyond the features.
const int CHOICE_LIGHTS_IN_UNIFORM = 32; // at most 1,024 slots, which a uniform block holds
const int CHOICE_ESTIMATOR = 33;         // ESTIMATOR_*
const int CHOICE_VIEW = 34;              // VIEW_* of shared/views.h
const int CHOICE_TONE_MAP = 35;          // TONE_MAP_*
const int CHOICE_WHITE_NOISE = 36;       // white noise instead of blue (lib/noise.glsl)
const int CHOICE_HALF_SAMPLING = 37;     // HALF_*
const int CHOICE_DEMODULATED = 38;       // specular light is without the environment BRDF
const int CHOICE_COUNT_SAMPLES = 39;     // pixels may be without a sample in a frame
const int CHOICE_SPARSE_NEIGHBOURS = 41; // 5 of the 5 x 5 pixels, as on a die: fetches are dear
const int CHOICE_LANES = 40;             // of a subgroup, for passes whose workgroup is one; see gpu/pass.h
const int CHOICE_COMPACT_RAYS = 42;      // trace_samples and shade_samples walk the list of compact_rays
const int CHOICE_PIXEL_ROWS =
    43; // passes over images go row by row instead of tile by tile (lib/dispatch.glsl)
const int CHOICE_DRAW_FROM = 44; // DRAW_FROM_*
const int CHOICE_DIM_DROP = 45;  // dim lights are dropped, and what is lost is counted

// Where resample_lights draws its candidates from.
const int DRAW_FROM_CELL = 0;  // the lights of the pixel's cell, evenly
const int DRAW_FROM_POWER = 1; // all lights, by power
const int DRAW_FROM_TREE = 2;  // all lights, by a tree of them
const int DRAW_FROM_BRDF = 3;  // what a direction drawn by the BRDF meets

const int HALF_OFF = 0;
const int HALF_CHECKERBOARD = 1;
const int HALF_ROOKS = 2;

const int ESTIMATOR_SPLIT = 0; // analytic irradiance times mean visibility
const int ESTIMATOR_TRUE = 1;  // the BRDF at the sampled point
const int ESTIMATOR_MAPS = 2;  // as split, but visibility by shadow maps

const int TONE_MAP_NEUTRAL = 0;
const int TONE_MAP_NONE = 1;

KX_SHARED_END

#endif
