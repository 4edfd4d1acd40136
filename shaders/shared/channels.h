// Lighting channels: a light reaches the meshes that share a bit with it. What a light, or a shadow ray, asks
// for is 0 where it asks for nothing.
#ifndef KILOLUX_SHARED_CHANNELS_H
#define KILOLUX_SHARED_CHANNELS_H
#include "base.h"

KX_SHARED_BEGIN

KX_CONST uint CHANNELS_ALL = 0u;       // of lights and rays: whatever channels the mesh has
KX_CONST uint CHANNELS_LIMITED = 256u; // added to the bits asked for
KX_CONST uint CHANNELS_MASK = 255u;    // of meshes

KX_SHARED_END
#endif
