// The masks of spatio-temporal blue noise that content/make/noise writes and shaders/lib/noise.glsl reads.
//
// File, little-endian: the 8 bytes "KXNOI01\n"; uint32 width, height, layers, channels (64, 64, 32, 4:
// shaders/ shared/noise.h); then a uint16 for each layer, row, column and channel, the last fastest.
// Channels: number for the visible list, number for the hidden list, the two coordinates of a point. A value
// v stands for [v, v + 1) / 65536.
#pragma once

#include "renderer/document/result.h"
#include "shaders/shared/noise.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace kilolux {

struct NoiseMask {
    static constexpr int kWidth = static_cast<int>(shared::NOISE_TILE_PX);
    static constexpr int kHeight = kWidth;
    static constexpr int kLayers = static_cast<int>(shared::NOISE_LAYERS);

    using Texel = std::array<std::uint16_t, 4>;
    std::vector<Texel> texels; // [layer][y][x]: upload as an array image of RGBA16_UINT, name `noiseMask`

    const Texel& at(int x, int y, int layer) const {
        return texels[(static_cast<std::size_t>(layer) * kHeight + y) * kWidth + x];
    }
};

// Fails with the file's name, the byte and what was expected there.
Result<NoiseMask> loadNoiseMask(const std::filesystem::path& path);
Result<std::filesystem::path> saveNoiseMask(const NoiseMask& mask, const std::filesystem::path& path);

} // namespace kilolux
