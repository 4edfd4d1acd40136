// Opens image files (PNG, JPEG, OpenEXR, Radiance HDR) through OpenImageIO as 8-bit or float RGBA.
#pragma once

#include "renderer/document/result.h"
#include "renderer/document/scene.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace kilolux {

struct ImageImportOptions {
    int maxSizePx = 16384; // larger images are refused
    // Decoded bytes allowed; a larger picture is halved until it fits. 0 derives 64 MiB + 8 times the file's
    // bytes.
    std::uint64_t maxDecodedBytes = 0;
};

// The picture with the file's own encoding of values (no colour conversion, alpha not multiplied in): rgba8
// for PNG and JPEG, rgbaF32 for OpenEXR and HDR, where NaN becomes 0 and infinities the largest half
// float. One channel is grey, two are grey and alpha. An error is one line that starts with the image's name.
Result<Image> importImage(const std::filesystem::path& path, const ImageImportOptions& options = {});
Result<Image> importImage(std::span<const std::uint8_t> file, const std::string& name,
                          const ImageImportOptions& options = {});

// What importImage would hold without halving, from the file's header alone.
Result<std::uint64_t> decodedImageBytes(std::span<const std::uint8_t> file, const std::string& name,
                                        const ImageImportOptions& options = {});

} // namespace kilolux
