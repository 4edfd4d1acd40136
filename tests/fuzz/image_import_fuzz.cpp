// libFuzzer target: any bytes as an image. A picture that is opened is complete and finite.
#include "renderer/document/image_import.h"

#include <cmath>

namespace {

void check(bool good) {
    if (!good) __builtin_trap();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    kilolux::ImageImportOptions options;
    options.maxDecodedBytes = 4u << 20; // larger pictures take the halving path and the run stays quick
    options.maxSizePx = 4096;
    const auto image = kilolux::importImage(std::span(data, size), "input", options);
    if (!image) {
        check(!image.error().empty() && image.error().find('\n') == std::string::npos);
        return 0;
    }
    const kilolux::Image& opened = image.value();
    const std::size_t values = static_cast<std::size_t>(opened.width) * opened.height * 4;
    check(opened.width > 0 && opened.height > 0);
    check(opened.rgba8.size() + opened.rgbaF32.size() == values);
    for (const float value : opened.rgbaF32)
        check(std::isfinite(value));
    return 0;
}
