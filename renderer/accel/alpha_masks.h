// What the alpha test of shaders/lib/alpha.glsl reads: the alpha channels of the images that tested materials
// use, one record per tested primitive, and the corner attributes of its triangles.
#pragma once

#include "renderer/accel/instances.h"
#include "shaders/shared/bvh.h"

#include <vector>

namespace kilolux {

struct AlphaMasks {
    std::vector<std::uint8_t> texels; // alpha as unorm8, row-major, one image after the other
    std::vector<shared::AlphaRecord> records;
    std::vector<shared::AlphaTriangle> triangles;
    std::vector<std::uint32_t> recordOfInstance; // ALPHA_RECORD_NONE where nothing is tested
};

AlphaMasks buildAlphaMasks(const Scene& scene, const std::vector<Instance>& instances);

} // namespace kilolux
