// The table of linearly transformed cosines that content/make/ltc_fit writes and that shaders look up.
//
// File: the 8 bytes "KXLTC01\n", then little-endian uint32 width (nodes along noV), uint32 height (nodes
// along roughness), then width x height x 8 floats, roughness by roughness; of each node's 8 the first 4 are
// ltcLookup0's, the others ltcLookup1's (shaders/math/ltc.glsl). Node coordinates: ltcInputsFromNode.
#pragma once

#include "renderer/document/result.h"

#include <filesystem>
#include <glm/glm.hpp>
#include <vector>

namespace kilolux {

enum class LtcLayer { Parameters, Scales };

struct LtcTable {
    int width = 0;
    int height = 0;
    std::vector<glm::vec4>
        parameters; // row-major, `width` a row: upload as RGBA32F with linear, clamped filtering
    std::vector<glm::vec4> scales;

    // Bilinear as a sampler does it, with clamped uv, but in double.
    glm::dvec4 sample(glm::dvec2 uv, LtcLayer layer) const;
};

// Fails with the file's name where it cannot be read or is not such a table.
Result<LtcTable> loadLtcTable(const std::filesystem::path& path);
Result<std::filesystem::path> saveLtcTable(const LtcTable& table, const std::filesystem::path& path);

// The table that kilolux::f32 and kilolux::f64 look up, for the whole process; set it before they run.
void useLtcTable(LtcTable table);
const LtcTable& boundLtcTable(); // asserts that there is one

} // namespace kilolux
