// Pictures to files: PNG for what the display shows, EXR and HDR for linear light. A file appears whole under
// its name or not at all. Every error is one line that names the file.
#pragma once

#include "renderer/document/result.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace kilolux {

// Row-major, top row first, interleaved channels.
struct FloatImage {
    int width = 0; // pixels
    int height = 0;
    int channels = 0;
    std::vector<float> pixels; // width * height * channels
};

enum class PictureFormat { Png, Exr, Hdr };
enum class ExrDepth { Half, Float };

// From the extension, upper and lower case alike.
Result<PictureFormat> pictureFormat(const std::filesystem::path& file);

// Whether `file` could be written: its folder exists, accepts a new file, and `file` is not a folder. Leaves
// nothing behind. For asking before long work.
std::optional<Error> checkWritable(const std::filesystem::path& file);

// 8-bit sRGB, 3 bytes a pixel.
std::optional<Error> writePng(const std::filesystem::path& file, int widthPx, int heightPx,
                              std::span<const std::uint8_t> srgb8);

// Linear values. Half floats clamp to +-65504, the largest half. Channels: 1 Y, 2 RG, 3 RGB, 4 RGBA; more are
// named c0, c1, ...
std::optional<Error> writeExr(const std::filesystem::path& file, const FloatImage& image, ExrDepth depth);

// Radiance RGBE: 3 channels, negative values become 0.
std::optional<Error> writeHdr(const std::filesystem::path& file, const FloatImage& image);

// A text file (statistics, lists) with the same promise.
std::optional<Error> writeText(const std::filesystem::path& file, std::string_view text);

} // namespace kilolux
