// Material images in four layered arrays by size, resized to powers of two, with mip levels: one set of
// bindings for any number of textures, without descriptor indexing.
#pragma once

#include "renderer/document/result.h"
#include "renderer/document/scene.h"
#include "renderer/gpu/resource.h"
#include "shaders/shared/geometry.h"

#include <array>
#include <vector>

namespace kilolux {

struct TextureArrays {
    std::array<gpu::Image, shared::TEXTURE_CLASSES> images; // empty where no image falls into the class
    std::vector<std::uint32_t> placeOfImage;                // per Scene::images: GpuTextureRef::place
};

// Only images that some material uses. Errors: more layers of one size than the device has.
Result<TextureArrays> makeTextureArrays(gpu::Device& device, const Scene& scene);

// What a material says of a texture, for the device; `placeOfImage` of makeTextureArrays().
shared::GpuTextureRef makeTextureRef(const TextureRef& ref, const std::vector<std::uint32_t>& placeOfImage);

} // namespace kilolux
