// Writes by OpenImageIO into a hidden file beside the target, then renames it into place.
#include "renderer/output/picture_file.h"

#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <unistd.h>

namespace kilolux {
namespace {

namespace fs = std::filesystem;

constexpr float kLargestHalf = 65504.0f;

Error cannotWrite(const fs::path& file, std::string_view reason) {
    return {fmt::format("cannot write '{}': {}", file.string(), reason)};
}

// Of this process, so that two of them writing one file do not mix; hidden, and on the same file system.
fs::path temporaryName(const fs::path& file) {
    return file.parent_path() / fmt::format(".{}.{}.tmp", file.filename().string(), getpid());
}

// `write` fills the file it is given and returns what went wrong, empty for nothing.
std::optional<Error> writeAtomically(const fs::path& file,
                                     const std::function<std::string(const fs::path&)>& write) {
    if (std::optional<Error> error = checkWritable(file)) return error;
    const fs::path temporary = temporaryName(file);
    std::error_code ignored;
    const std::string problem = write(temporary);
    if (!problem.empty()) {
        fs::remove(temporary, ignored);
        return cannotWrite(file, problem);
    }
    std::error_code failure;
    fs::rename(temporary, file, failure);
    if (!failure) return std::nullopt;
    fs::remove(temporary, ignored);
    return cannotWrite(file, failure.message());
}

std::vector<std::string> channelNames(int channels) {
    switch (channels) {
    case 1:
        return {"Y"};
    case 2:
        return {"R", "G"};
    case 3:
        return {"R", "G", "B"};
    case 4:
        return {"R", "G", "B", "A"};
    default:
        break;
    }
    std::vector<std::string> names;
    for (int c = 0; c < channels; ++c)
        names.push_back(fmt::format("c{}", c));
    return names;
}

// OpenImageIO's messages end in line breaks and may hold several; one line is what a terminal and a log want.
std::string oneLine(std::string text) {
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())))
        text.pop_back();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text.empty() ? "unknown error of the image library" : text;
}

std::string writeWithOiio(const fs::path& file, const char* format, const OIIO::ImageSpec& spec,
                          const OIIO::TypeDesc& pixelType, const void* pixels) {
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
    if (!output) return oneLine(OIIO::geterror());
    if (!output->open(file.string(), spec)) return oneLine(output->geterror());
    const bool written = output->write_image(pixelType, pixels);
    const bool closed = output->close(); // a full disk shows up here for small pictures
    return written && closed ? "" : oneLine(output->geterror());
}

std::optional<Error> checkSize(const fs::path& file, const FloatImage& image) {
    const bool positive = image.width > 0 && image.height > 0 && image.channels > 0;
    const std::size_t expected = positive ? std::size_t(image.width) * image.height * image.channels : 0;
    if (positive && image.pixels.size() == expected) return std::nullopt;
    return cannotWrite(file, fmt::format("{} values for {} x {} pixels of {} channels", image.pixels.size(),
                                         image.width, image.height, image.channels));
}

} // namespace

Result<PictureFormat> pictureFormat(const fs::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    if (extension == ".png") return PictureFormat::Png;
    if (extension == ".exr") return PictureFormat::Exr;
    if (extension == ".hdr") return PictureFormat::Hdr;
    return Error{fmt::format("'{}': the extension must be .png, .exr or .hdr", file.string())};
}

std::optional<Error> checkWritable(const fs::path& file) {
    std::error_code failure;
    if (file.filename().empty() || fs::is_directory(file, failure))
        return cannotWrite(file, "it is a folder");
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    if (!fs::exists(folder, failure))
        return cannotWrite(file, fmt::format("the folder '{}' does not exist", folder.string()));
    const fs::path temporary = temporaryName(file);
    errno = 0;
    if (!std::ofstream(temporary)) return cannotWrite(file, std::strerror(errno ? errno : EIO));
    fs::remove(temporary, failure);
    return std::nullopt;
}

std::optional<Error> writePng(const fs::path& file, int widthPx, int heightPx,
                              std::span<const std::uint8_t> srgb8) {
    if (widthPx <= 0 || heightPx <= 0 || srgb8.size() != std::size_t(widthPx) * heightPx * 3)
        return cannotWrite(file, fmt::format("{} bytes for {} x {} pixels", srgb8.size(), widthPx, heightPx));
    OIIO::ImageSpec spec(widthPx, heightPx, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    return writeAtomically(file, [&](const fs::path& temporary) {
        return writeWithOiio(temporary, "png", spec, OIIO::TypeDesc::UINT8, srgb8.data());
    });
}

std::optional<Error> writeExr(const fs::path& file, const FloatImage& image, ExrDepth depth) {
    if (std::optional<Error> error = checkSize(file, image)) return error;
    const bool half = depth == ExrDepth::Half;
    OIIO::ImageSpec spec(image.width, image.height, image.channels,
                         half ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT);
    spec.channelnames = channelNames(image.channels);
    spec.attribute("oiio:ColorSpace", "Linear");
    spec.attribute("compression", "zip");
    std::vector<float> clamped;
    if (half) {
        clamped = image.pixels;
        for (float& value : clamped)
            value = std::clamp(value, -kLargestHalf, kLargestHalf);
    }
    return writeAtomically(file, [&](const fs::path& temporary) {
        return writeWithOiio(temporary, "openexr", spec, OIIO::TypeDesc::FLOAT,
                             half ? clamped.data() : image.pixels.data());
    });
}

std::optional<Error> writeHdr(const fs::path& file, const FloatImage& image) {
    if (std::optional<Error> error = checkSize(file, image)) return error;
    if (image.channels != 3) return cannotWrite(file, "HDR holds exactly 3 channels");
    std::vector<float> positive = image.pixels;
    for (float& value : positive)
        value = std::max(value, 0.0f);
    const OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::FLOAT);
    return writeAtomically(file, [&](const fs::path& temporary) {
        return writeWithOiio(temporary, "hdr", spec, OIIO::TypeDesc::FLOAT, positive.data());
    });
}

std::optional<Error> writeText(const fs::path& file, std::string_view text) {
    return writeAtomically(file, [&](const fs::path& temporary) -> std::string {
        std::ofstream stream(temporary, std::ios::binary);
        stream.write(text.data(), static_cast<std::streamsize>(text.size()));
        stream.close();
        return stream ? "" : std::strerror(errno ? errno : EIO);
    });
}

} // namespace kilolux
