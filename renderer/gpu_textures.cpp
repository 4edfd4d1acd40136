// Texture arrays, see gpu_textures.h.
#include "renderer/gpu_textures.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <thread>

namespace kilolux {

namespace {

using namespace shared;

constexpr std::array<int, TEXTURE_CLASSES> kSizes{256, 512, 1024, 2048}; // as in shaders/lib/material.glsl

std::uint32_t classFor(const Image& image) {
    const int size = std::max(image.width, image.height);
    for (std::uint32_t i = 0; i + 1 < TEXTURE_CLASSES; ++i) {
        if (size <= kSizes[i]) return i;
    }
    return TEXTURE_CLASSES - 1;
}

// How an image is read, over all materials.
struct ImageUse {
    bool used = false;
    bool srgb = false;    // holds colour
    bool nearest = false; // read without filtering
    bool wraps = false;   // repeats in some direction
};

std::vector<ImageUse> imageUses(const Scene& scene) {
    std::vector<ImageUse> uses(scene.images.size());
    for (const Material& material : scene.materials) {
        for (const TextureRef* ref :
             {&material.baseColor, &material.metallicRoughness, &material.normal, &material.emissive}) {
            if (ref->image < 0) continue;
            ImageUse& use = uses[std::size_t(ref->image)];
            use.used = true;
            use.srgb |= ref == &material.baseColor || ref == &material.emissive;
            use.nearest |= ref->nearestFilter;
            use.wraps |= ref->wrapS == WrapMode::Repeat || ref->wrapT == WrapMode::Repeat;
        }
    }
    return uses;
}

// sRGB decoding of bytes, so that averages are of light.
const std::array<float, 256>& linearOfByte() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> values{};
        for (int i = 0; i < 256; ++i) {
            const double x = i / 255.0;
            values[std::size_t(i)] = float(x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4));
        }
        return values;
    }();
    return table;
}

std::uint8_t toByte(float value, bool srgb) {
    const double x = std::clamp(double(value), 0.0, 1.0);
    const double encoded = !srgb ? x : x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
    return std::uint8_t(encoded * 255.0 + 0.5);
}

struct Pixels {
    int size = 0;
    std::vector<glm::vec4> texels; // linear light for sRGB images
};

glm::vec4 texelAt(const Image& image, int x, int y, bool srgb) {
    const std::size_t at = (std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * 4;
    if (!image.rgbaF32.empty()) {
        return {image.rgbaF32[at], image.rgbaF32[at + 1], image.rgbaF32[at + 2], image.rgbaF32[at + 3]};
    }
    const std::uint8_t* p = &image.rgba8[at];
    const auto& linear = linearOfByte();
    if (srgb) return {linear[p[0]], linear[p[1]], linear[p[2]], p[3] / 255.0f};
    return {p[0] / 255.0f, p[1] / 255.0f, p[2] / 255.0f, p[3] / 255.0f};
}

// Resized to size x size: exact copies where the size fits, a bilinear tent (wider when shrinking) elsewhere,
// or the nearest texel for images that are looked up without filtering.
int foldTexel(int texel, int size, bool wraps) {
    return wraps ? ((texel % size) + size) % size : std::clamp(texel, 0, size - 1);
}

Pixels resize(const Image& image, int size, const ImageUse& use) {
    Pixels result{size, std::vector<glm::vec4>(std::size_t(size) * std::size_t(size))};
    const double scaleX = double(image.width) / size, scaleY = double(image.height) / size;
    const double radiusX = std::max(1.0, scaleX), radiusY = std::max(1.0, scaleY);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            glm::vec4& out = result.texels[std::size_t(y) * std::size_t(size) + std::size_t(x)];
            const double cx = (x + 0.5) * scaleX - 0.5, cy = (y + 0.5) * scaleY - 0.5;
            if (use.nearest || (image.width == size && image.height == size)) {
                out = texelAt(image, std::clamp(int(std::lround(cx)), 0, image.width - 1),
                              std::clamp(int(std::lround(cy)), 0, image.height - 1), use.srgb);
                continue;
            }
            glm::dvec4 sum(0.0);
            double weights = 0.0;
            for (int sy = int(std::ceil(cy - radiusY)); sy <= int(std::floor(cy + radiusY)); ++sy) {
                for (int sx = int(std::ceil(cx - radiusX)); sx <= int(std::floor(cx + radiusX)); ++sx) {
                    const double w = std::max(0.0, 1.0 - std::abs(sx - cx) / radiusX) *
                                     std::max(0.0, 1.0 - std::abs(sy - cy) / radiusY);
                    sum += w * glm::dvec4(texelAt(image, foldTexel(sx, image.width, use.wraps),
                                                  foldTexel(sy, image.height, use.wraps), use.srgb));
                    weights += w;
                }
            }
            out = glm::vec4(sum / std::max(weights, 1e-12));
        }
    }
    return result;
}

Pixels halve(const Pixels& source) {
    Pixels result{std::max(1, source.size / 2), {}};
    result.texels.resize(std::size_t(result.size) * std::size_t(result.size));
    const auto size = std::size_t(source.size);
    for (std::size_t y = 0; y < std::size_t(result.size); ++y) {
        for (std::size_t x = 0; x < std::size_t(result.size); ++x) {
            const std::size_t at = 2 * y * size + 2 * x;
            result.texels[y * std::size_t(result.size) + x] =
                0.25f * (source.texels[at] + source.texels[at + 1] + source.texels[at + size] +
                         source.texels[at + size + 1]);
        }
    }
    return result;
}

std::vector<std::uint8_t> toBytes(const Pixels& pixels, bool srgb) {
    std::vector<std::uint8_t> bytes(pixels.texels.size() * 4);
    for (std::size_t i = 0; i < pixels.texels.size(); ++i) {
        for (int c = 0; c < 4; ++c)
            bytes[i * 4 + std::size_t(c)] = toByte(pixels.texels[i][c], srgb && c < 3);
    }
    return bytes;
}

std::vector<std::vector<std::uint8_t>> makeMips(const Image& image, int size, const ImageUse& use) {
    std::vector<std::vector<std::uint8_t>> mips;
    Pixels level = resize(image, size, use);
    for (;;) {
        mips.push_back(toBytes(level, use.srgb));
        if (level.size == 1) return mips;
        level = halve(level);
    }
}

} // namespace

Result<TextureArrays> makeTextureArrays(gpu::Device& device, const Scene& scene) {
    const std::vector<ImageUse> uses = imageUses(scene);
    TextureArrays arrays;
    arrays.placeOfImage.assign(scene.images.size(), TEXTURE_NONE);
    std::array<std::uint32_t, TEXTURE_CLASSES> layers{};
    std::vector<std::size_t> order;
    for (std::size_t index = 0; index < uses.size(); ++index) {
        if (!uses[index].used) continue;
        order.push_back(index);
        const std::uint32_t textureClass = classFor(*scene.images[index]);
        arrays.placeOfImage[index] = textureClass << TEXTURE_CLASS_SHIFT | layers[textureClass]++;
    }
    for (std::uint32_t i = 0; i < TEXTURE_CLASSES; ++i) {
        if (layers[i] == 0) continue;
        if (layers[i] > device.limits().maxImageArrayLayers) {
            return Error{fmt::format("{}: {} textures of up to {} px, the device holds {}",
                                     scene.sourcePath.string(), layers[i], kSizes[i],
                                     device.limits().maxImageArrayLayers)};
        }
        const auto size = std::uint32_t(kSizes[i]);
        arrays.images[i] = gpu::Image(device, {.name = fmt::format("textures{}", i),
                                               .format = VK_FORMAT_R8G8B8A8_UNORM,
                                               .width = size,
                                               .height = size,
                                               .mips = std::uint32_t(std::log2(size)) + 1,
                                               .layers = layers[i],
                                               .arrayed = true,
                                               .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
                                               .secondFormat = VK_FORMAT_R8G8B8A8_SRGB,
                                               .cause = "textures"});
    }
    // Resizing is the slow part: two at a time, uploads in between on this thread.
    const std::size_t threads = std::max(1u, std::thread::hardware_concurrency());
    for (std::size_t first = 0; first < order.size(); first += threads) {
        const std::size_t count = std::min(threads, order.size() - first);
        std::vector<std::vector<std::vector<std::uint8_t>>> mips(count);
        std::vector<std::jthread> workers;
        for (std::size_t i = 0; i < count; ++i) {
            workers.emplace_back([&, i] {
                const std::size_t index = order[first + i];
                const Image& image = *scene.images[index];
                mips[i] = makeMips(image, kSizes[classFor(image)], uses[index]);
            });
        }
        workers.clear();
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t place = arrays.placeOfImage[order[first + i]];
            gpu::Image& array = arrays.images[place >> TEXTURE_CLASS_SHIFT];
            for (std::uint32_t mip = 0; mip < mips[i].size(); ++mip) {
                array.upload(std::as_bytes(std::span(mips[i][mip])), mip, place & 0xffffu);
            }
        }
    }
    return arrays;
}

GpuTextureRef makeTextureRef(const TextureRef& ref, const std::vector<std::uint32_t>& placeOfImage) {
    GpuTextureRef gpu{};
    gpu.place = ref.image < 0 ? TEXTURE_NONE : placeOfImage[std::size_t(ref.image)];
    const auto wrap = [](WrapMode mode) {
        return mode == WrapMode::Repeat        ? TEXTURE_WRAP_REPEAT
               : mode == WrapMode::ClampToEdge ? TEXTURE_WRAP_CLAMP
                                               : TEXTURE_WRAP_MIRROR;
    };
    gpu.flags = wrap(ref.wrapS) | wrap(ref.wrapT) << TEXTURE_WRAP_T_SHIFT |
                (ref.texCoord == 1 ? TEXTURE_UV1 : 0u) | (ref.nearestFilter ? TEXTURE_NEAREST : 0u);
    // KHR_texture_transform: translation * rotation * scale.
    const double c = std::cos(ref.rotationRad), s = std::sin(ref.rotationRad);
    gpu.uvRow0 = glm::vec3(c * ref.scale.x, s * ref.scale.y, ref.offset.x);
    gpu.uvRow1 = glm::vec3(-s * ref.scale.x, c * ref.scale.y, ref.offset.y);
    return gpu;
}

} // namespace kilolux
