// Images of any of the project's formats to floats, for files, tests and probes.
#pragma once

#include "renderer/gpu/commands.h"
#include "renderer/output/picture_file.h"

namespace kilolux {

// The top mip. Integers become their value as a float (exact up to 2^24), normalized formats 0..1.
FloatImage toFloatImage(const gpu::Image& image);
FloatImage toFloatImage(const gpu::Captured& image);

} // namespace kilolux
