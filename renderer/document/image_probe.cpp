#include "renderer/document/image_probe.h"

#include <cstring>
#include <fmt/format.h>
#include <string_view>

namespace kilolux {

namespace {

constexpr std::int64_t kMaxTileSizePx = 4096;

bool startsWith(std::span<const std::uint8_t> file, std::string_view magic) {
    return file.size() >= magic.size() && std::memcmp(file.data(), magic.data(), magic.size()) == 0;
}

std::uint64_t bigEndian16(std::span<const std::uint8_t> file, std::size_t at) {
    return static_cast<std::uint64_t>(file[at]) << 8 | file[at + 1];
}

std::int32_t littleEndian32(std::span<const std::uint8_t> file, std::size_t at) {
    std::int32_t value = 0;
    std::memcpy(&value, file.data() + at, sizeof(value));
    return value;
}

// The coefficients of a progressive JPEG (ITU-T T.81, annex B: segments up to the frame header); 0 for
// sequential ones.
std::uint64_t jpegBufferedBytes(std::span<const std::uint8_t> file) {
    for (std::size_t at = 2; at + 9 < file.size();) {
        const std::uint8_t marker = file[at + 1];
        if (file[at] != 0xFF || marker == 0xFF) {
            ++at;
            continue;
        }
        const bool isFrame =
            marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
        const bool isSequential = marker <= 0xC1;
        if (isFrame)
            return isSequential ? 0
                                : bigEndian16(file, at + 5) * bigEndian16(file, at + 7) * file[at + 9] * 2;
        at += 2 + bigEndian16(file, at + 2);
    }
    return 0;
}

// The pixels of an interlaced PNG; 0 for others.
std::uint64_t pngBufferedBytes(std::span<const std::uint8_t> file) {
    if (file.size() <= 28 || file[28] == 0) return 0;
    const std::uint64_t width = bigEndian16(file, 16) << 16 | bigEndian16(file, 18);
    const std::uint64_t height = bigEndian16(file, 20) << 16 | bigEndian16(file, 22);
    return width * height * 8;
}

// Tiles and data window of every OpenEXR header (OpenEXR file layout: name, type, size, value until an empty
// name).
std::optional<std::string> exrComplaint(std::span<const std::uint8_t> file, int maxSizePx) {
    const auto text = [&](std::size_t& at) {
        std::string value;
        for (; at < file.size() && file[at] != 0; ++at)
            value += static_cast<char>(file[at]);
        ++at;
        return value;
    };
    bool wasEmpty = false;
    for (std::size_t at = 8; at < file.size();) {
        const std::string name = text(at);
        if (name.empty()) {
            if (wasEmpty)
                break; // the end of several headers; a single one's end is followed by binary offsets
            wasEmpty = true;
            continue;
        }
        wasEmpty = false;
        const std::string type = text(at);
        if (at + 4 > file.size()) break;
        const std::int32_t size = littleEndian32(file, at);
        at += 4;
        if (size < 0 || static_cast<std::size_t>(size) > file.size() - at) break;
        if (type == "tiledesc" && size >= 8) {
            const std::int64_t width = static_cast<std::uint32_t>(littleEndian32(file, at));
            const std::int64_t height = static_cast<std::uint32_t>(littleEndian32(file, at + 4));
            if (width > kMaxTileSizePx || height > kMaxTileSizePx) {
                return fmt::format("expected tiles of at most {} pixels a side, found {} x {}",
                                   kMaxTileSizePx, width, height);
            }
        }
        if (name == "dataWindow" && type == "box2i" && size >= 16) {
            const std::int64_t width =
                std::int64_t{littleEndian32(file, at + 8)} - littleEndian32(file, at) + 1;
            const std::int64_t height =
                std::int64_t{littleEndian32(file, at + 12)} - littleEndian32(file, at + 4) + 1;
            if (width < 1 || height < 1 || width > maxSizePx || height > maxSizePx) {
                return fmt::format("expected 1 to {} pixels a side, found {} x {}", maxSizePx, width, height);
            }
        }
        at += static_cast<std::size_t>(size);
    }
    return std::nullopt;
}

} // namespace

std::optional<std::string> complaintAboutClaims(std::span<const std::uint8_t> file, int maxSizePx,
                                                std::uint64_t maxBytes) {
    if (startsWith(file, "\x76\x2f\x31\x01")) return exrComplaint(file, maxSizePx);
    std::uint64_t buffered = 0;
    if (startsWith(file, "\xFF\xD8")) buffered = jpegBufferedBytes(file);
    if (startsWith(file, "\x89PNG")) buffered = pngBufferedBytes(file);
    if (buffered <= maxBytes) return std::nullopt;
    return fmt::format("expected an interlaced or progressive image of at most {} MiB, found {} MiB",
                       maxBytes >> 20, buffered >> 20);
}

} // namespace kilolux
