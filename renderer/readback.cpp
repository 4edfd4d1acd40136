#include "renderer/readback.h"

#include <fmt/format.h>
#include <glm/gtc/packing.hpp>

namespace kilolux {

namespace {

enum class Channel { Float32, Float16, Uint32, Unorm8 };

struct Layout {
    Channel channel;
    int channels;
};

Layout layoutOf(VkFormat format, std::string_view name) {
    switch (format) {
    case VK_FORMAT_R32_SFLOAT:
    case VK_FORMAT_D32_SFLOAT:
        return {Channel::Float32, 1};
    case VK_FORMAT_R32G32_SFLOAT:
        return {Channel::Float32, 2};
    case VK_FORMAT_R32G32B32A32_SFLOAT:
        return {Channel::Float32, 4};
    case VK_FORMAT_R16G16B16A16_SFLOAT:
        return {Channel::Float16, 4};
    case VK_FORMAT_R32_UINT:
        return {Channel::Uint32, 1};
    case VK_FORMAT_R32G32_UINT:
        return {Channel::Uint32, 2};
    case VK_FORMAT_R32G32B32A32_UINT:
        return {Channel::Uint32, 4};
    case VK_FORMAT_R8G8B8A8_UNORM:
        return {Channel::Unorm8, 4};
    default:
        gpu::failContract(fmt::format("image '{}' has no float form", name));
    }
}

template<typename T>
T valueAt(const std::vector<std::byte>& bytes, std::size_t i) {
    T value;
    std::memcpy(&value, bytes.data() + i * sizeof(T), sizeof(T));
    return value;
}

} // namespace

FloatImage toFloatImage(const gpu::Image& image) {
    const gpu::ImageDesc& desc = image.desc();
    return toFloatImage(gpu::Captured{desc.name, desc.format, desc.width, desc.height, image.download()});
}

FloatImage toFloatImage(const gpu::Captured& image) {
    const Layout layout = layoutOf(image.format, image.name);
    const std::vector<std::byte>& bytes = image.bytes;
    FloatImage result{int(image.width), int(image.height), layout.channels, {}};
    result.pixels.resize(std::size_t(result.width) * std::size_t(result.height) *
                         std::size_t(layout.channels));
    for (std::size_t i = 0; i < result.pixels.size(); ++i) {
        switch (layout.channel) {
        case Channel::Float32:
            result.pixels[i] = valueAt<float>(bytes, i);
            break;
        case Channel::Float16:
            result.pixels[i] = glm::unpackHalf1x16(valueAt<std::uint16_t>(bytes, i));
            break;
        case Channel::Uint32:
            result.pixels[i] = float(valueAt<std::uint32_t>(bytes, i));
            break;
        case Channel::Unorm8:
            result.pixels[i] = float(std::uint8_t(bytes[i])) / 255.0f;
            break;
        }
    }
    return result;
}

} // namespace kilolux
