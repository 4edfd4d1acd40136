// The one list of features: a shader states those it models as specialization constants,
//   layout(constant_id = FEATURE_x) const bool featureX = true;
// and a pipeline is built per set of the features that its shader states. Off means that the scene or the
// settings do not need it; the picture is the same.
#ifndef KILOLUX_SHARED_FEATURES_H
#define KILOLUX_SHARED_FEATURES_H
#include "base.h"

KX_SHARED_BEGIN

const int FEATURE_ALPHA_MASK = 0; // some instance is alpha-tested

KX_SHARED_END

#endif
