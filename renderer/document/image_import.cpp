// Reads images from memory in bands of rows, so that a picture too large for its budget is halved while it is
// read and never held whole. The kind of file is told by its first bytes, not by its name.
#include "renderer/document/image_import.h"

#include "renderer/document/image_probe.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <memory>
#include <numeric>
#include <optional>

namespace kilolux {

namespace {

constexpr int kChannels = 4;
constexpr float kLargestHalf = 65504.0f;
constexpr const char* kMemoryName = "image.memory"; // what the readers think the file is called
constexpr int kMaxFileChannels = 64;
constexpr std::uint64_t kMaxTileRows = 4096;
constexpr std::uint64_t kMaxBandBytes = 32ull << 20;

struct Format {
    const char* reader; // OpenImageIO's name
    bool isHdr;
};

bool startsWith(std::span<const std::uint8_t> file, std::string_view magic) {
    return file.size() >= magic.size() && std::memcmp(file.data(), magic.data(), magic.size()) == 0;
}

std::optional<Format> recognize(std::span<const std::uint8_t> file) {
    if (startsWith(file, "\x89PNG\r\n\x1a\n")) return Format{"png", false};
    if (startsWith(file, "\xFF\xD8\xFF")) return Format{"jpeg", false};
    if (startsWith(file, "\x76\x2f\x31\x01")) return Format{"openexr", true};
    if (startsWith(file, "#?RADIANCE") || startsWith(file, "#?RGBE")) return Format{"hdr", true};
    return std::nullopt;
}

// One row of `channels` interleaved values to RGBA: grey is spread, missing alpha is opaque.
template<typename T>
void spreadToRgba(const T* source, int width, int channels, T opaque, T* target) {
    for (int x = 0; x < width; ++x, source += channels, target += kChannels) {
        const bool isGrey = channels < 3;
        target[0] = source[0];
        target[1] = isGrey ? source[0] : source[1];
        target[2] = isGrey ? source[0] : source[2];
        target[3] = channels == 2 ? source[1] : channels > 3 ? source[3] : opaque;
    }
}

float finite(float value) {
    if (std::isnan(value)) return 0.0f;
    return std::clamp(value, -kLargestHalf, kLargestHalf);
}
std::uint8_t finite(std::uint8_t value) {
    return value;
}

float mean(float sum, int count) {
    return sum / static_cast<float>(count);
}
std::uint8_t mean(int sum, int count) {
    return static_cast<std::uint8_t>((sum + count / 2) / count);
}

// Box-filters `rows` rows of `width` RGBA pixels into one row of ceil(width / factor).
template<typename T, typename Sum>
void shrinkRows(const T* source, int width, int rows, int factor, T* target) {
    if (factor == 1) {
        for (int i = 0; i < width * kChannels; ++i)
            target[i] = finite(source[i]);
        return;
    }
    const int targetWidth = (width + factor - 1) / factor;
    for (int x = 0; x < targetWidth; ++x) {
        const int x0 = x * factor, x1 = std::min(width, x0 + factor);
        for (int c = 0; c < kChannels; ++c) {
            Sum sum{};
            for (int row = 0; row < rows; ++row) {
                const T* line = source + static_cast<std::size_t>(row) * width * kChannels;
                for (int i = x0; i < x1; ++i)
                    sum += finite(line[i * kChannels + c]);
            }
            target[x * kChannels + c] = mean(sum, rows * (x1 - x0));
        }
    }
}

std::uint64_t defaultLimit(std::span<const std::uint8_t> file) {
    return (64ull << 20) + 8 * file.size();
}

struct Reader {
    std::string name;
    std::unique_ptr<OIIO::Filesystem::IOMemReader> memory; // outlives `input`
    std::unique_ptr<OIIO::ImageInput> input;
    OIIO::ImageSpec spec;
    bool isHdr = false;
    int channels = 0; // read from the file, at most 4
    int factor = 1;   // by which the picture is reduced
};

Error complain(const std::string& name, const std::string& text) {
    std::string line = name + ": " + text;
    std::replace_if(
        line.begin(), line.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; }, ' ');
    if (line.size() > 500) line.resize(500);
    return Error{std::move(line)};
}

std::string readerError(OIIO::ImageInput* input) {
    std::string error = input ? input->geterror() : OIIO::geterror();
    // The libraries' own preambles name a file that does not exist.
    for (const std::string_view preamble : {"OpenEXR exception: ", "Failed OpenEXR read: "}) {
        if (error.starts_with(preamble)) error.erase(0, preamble.size());
    }
    if (const auto at = error.find(kMemoryName); at != error.npos) {
        if (const auto end = error.find(". ", at); end != error.npos) error.erase(0, end + 2);
    }
    while (!error.empty() && (error.back() == '\n' || error.back() == '.'))
        error.pop_back();
    // They also quote names from the file, in whatever encoding.
    std::replace_if(
        error.begin(), error.end(), [](unsigned char c) { return c >= 0x80; }, '?');
    return error.empty() ? "the file ends early or is damaged" : error;
}

std::optional<Error> checkSpec(const Reader& reader, const ImageImportOptions& options) {
    const OIIO::ImageSpec& spec = reader.spec;
    if (spec.deep || spec.depth > 1)
        return complain(reader.name, "expected a flat picture, found deep or volume data");
    if (spec.width < 1 || spec.height < 1 || spec.width > options.maxSizePx ||
        spec.height > options.maxSizePx) {
        return complain(reader.name, fmt::format("expected 1 to {} pixels a side, found {} x {}",
                                                 options.maxSizePx, spec.width, spec.height));
    }
    if (spec.nchannels < 1 || spec.nchannels > kMaxFileChannels) {
        return complain(reader.name,
                        fmt::format("expected 1 to {} channels, found {}", kMaxFileChannels, spec.nchannels));
    }
    const bool goodTiles = (spec.tile_width == 0) == (spec.tile_height == 0) && spec.tile_depth <= 1;
    const std::uint64_t rows = std::max(spec.tile_height, 1);
    const std::uint64_t columns = std::max(spec.width, spec.tile_width);
    if (!goodTiles || rows > kMaxTileRows || rows * columns * spec.pixel_bytes(true) > kMaxBandBytes) {
        return complain(reader.name,
                        fmt::format("expected rows of tiles of at most {} MiB, found tiles of {} x {}",
                                    kMaxBandBytes >> 20, spec.tile_width, spec.tile_height));
    }
    return std::nullopt;
}

// Opens the file and checks its header; nothing of the picture is decoded yet.
std::optional<Error> openReader(std::span<const std::uint8_t> file, const ImageImportOptions& options,
                                Reader& reader) {
    const auto format = recognize(file);
    if (!format) return complain(reader.name, "expected a PNG, JPEG, OpenEXR or Radiance HDR image");
    reader.isHdr = format->isHdr;
    const auto complaint = complaintAboutClaims(file, options.maxSizePx, defaultLimit(file));
    if (complaint) return complain(reader.name, *complaint);
    reader.memory =
        std::make_unique<OIIO::Filesystem::IOMemReader>(const_cast<std::uint8_t*>(file.data()), file.size());
    reader.input = OIIO::ImageInput::create(format->reader, false, nullptr, reader.memory.get());
    if (!reader.input) return complain(reader.name, "expected a readable image: " + readerError(nullptr));
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    void* proxy = reader.memory.get();
    config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    if (!reader.input->open(kMemoryName, reader.spec, config)) {
        return complain(reader.name, "expected a readable image: " + readerError(reader.input.get()));
    }
    reader.channels = std::min(reader.spec.nchannels, kChannels);
    return checkSpec(reader, options);
}

// Tiled files are read by whole rows of tiles (read_scanlines divides by zero on them), others by bands of
// rows.
template<typename T>
bool readBand(Reader& reader, int y, int rows, T* target) {
    const OIIO::ImageSpec& spec = reader.spec;
    const int y0 = spec.y + y;
    const auto type = OIIO::BaseTypeFromC<T>::value;
    if (spec.tile_width == 0) {
        return reader.input->read_scanlines(0, 0, y0, y0 + rows, spec.z, 0, reader.channels, type, target);
    }
    return reader.input->read_tiles(0, 0, spec.x, spec.x + spec.width, y0, y0 + rows, spec.z, spec.z + 1, 0,
                                    reader.channels, type, target);
}

template<typename T, typename Sum>
bool readPicture(Reader& reader, T opaque, std::vector<T>& pixels) {
    const OIIO::ImageSpec& spec = reader.spec;
    const int factor = reader.factor;
    const int width = (spec.width + factor - 1) / factor, height = (spec.height + factor - 1) / factor;
    const std::size_t rowBytes = static_cast<std::size_t>(spec.width) * reader.channels * sizeof(T);
    int bandRows = std::max(1, static_cast<int>((std::size_t{1} << 20) / rowBytes));
    if (spec.tile_height > 0) bandRows = spec.tile_height;
    // Whole tiles and whole groups of rows that become one.
    bandRows = std::lcm(std::min(bandRows, std::max(spec.height, spec.tile_height)), factor);
    pixels.assign(static_cast<std::size_t>(width) * height * kChannels, T{});
    const int heldRows = std::min(bandRows, spec.height);
    std::vector<T> band(static_cast<std::size_t>(heldRows) * spec.width * reader.channels);
    std::vector<T> rgba(static_cast<std::size_t>(heldRows) * spec.width * kChannels);
    for (int y = 0; y < spec.height; y += bandRows) {
        const int rows = std::min(bandRows, spec.height - y);
        if (!readBand(reader, y, rows, band.data())) return false;
        spreadToRgba(band.data(), spec.width * rows, reader.channels, opaque, rgba.data());
        for (int row = 0; row < rows; row += factor) {
            T* target = pixels.data() + static_cast<std::size_t>((y + row) / factor) * width * kChannels;
            shrinkRows<T, Sum>(rgba.data() + static_cast<std::size_t>(row) * spec.width * kChannels,
                               spec.width, std::min(factor, rows - row), factor, target);
        }
    }
    return true;
}

std::uint64_t decodedBytes(const Reader& reader, int factor) {
    const std::uint64_t width = (reader.spec.width + factor - 1) / factor;
    const std::uint64_t height = (reader.spec.height + factor - 1) / factor;
    return width * height * kChannels * (reader.isHdr ? sizeof(float) : sizeof(std::uint8_t));
}

} // namespace

Result<std::uint64_t> decodedImageBytes(std::span<const std::uint8_t> file, const std::string& name,
                                        const ImageImportOptions& options) {
    Reader reader;
    reader.name = name;
    try {
        if (auto error = openReader(file, options, reader)) return *error;
        return decodedBytes(reader, 1);
    } catch (const std::exception& e) {
        return complain(name, fmt::format("expected a readable image: {}", e.what()));
    }
}

Result<Image> importImage(std::span<const std::uint8_t> file, const std::string& name,
                          const ImageImportOptions& options) {
    Reader reader;
    reader.name = name;
    try {
        if (auto error = openReader(file, options, reader)) return *error;
        const std::uint64_t limit =
            options.maxDecodedBytes > 0 ? options.maxDecodedBytes : defaultLimit(file);
        while (decodedBytes(reader, reader.factor) > limit && reader.factor < options.maxSizePx)
            reader.factor *= 2;
        Image image;
        image.name = name;
        image.width = (reader.spec.width + reader.factor - 1) / reader.factor;
        image.height = (reader.spec.height + reader.factor - 1) / reader.factor;
        const bool good = reader.isHdr
                              ? readPicture<float, float>(reader, 1.0f, image.rgbaF32)
                              : readPicture<std::uint8_t, int>(reader, std::uint8_t{255}, image.rgba8);
        if (!good) return complain(name, "expected undamaged pixels: " + readerError(reader.input.get()));
        return image;
    } catch (const std::exception& e) {
        return complain(name, fmt::format("expected a readable image: {}", e.what()));
    }
}

Result<Image> importImage(const std::filesystem::path& path, const ImageImportOptions& options) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error))
        return complain(path.string(), "expected a file, not found");
    std::ifstream stream(path, std::ios::binary);
    std::vector<std::uint8_t> bytes(std::filesystem::file_size(path, error));
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (error || !stream) return complain(path.string(), "expected a readable file");
    return importImage(bytes, path.string(), options);
}

} // namespace kilolux
