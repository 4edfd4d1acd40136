// Upload of pictures of lights, see gpu_pictures.h.
#include "renderer/gpu_pictures.h"

#include "renderer/gpu/filled_buffer.h"

namespace kilolux {

void GpuPictures::update(gpu::Device& device,
                         const std::vector<std::shared_ptr<const SourcePicture>>& layers) {
    if (layers == layers_) return;
    layers_ = layers;
    image_ = gpu::Image();
    warps_ = gpu::Buffer();
    if (layers.empty()) return;
    const auto sizePx = std::uint32_t(layers[0]->levels[0].sizePx);
    image_ = gpu::Image(device, {.name = "lightPictures",
                                 .format = VK_FORMAT_R16G16B16A16_SFLOAT,
                                 .width = sizePx,
                                 .height = sizePx,
                                 .mips = std::uint32_t(layers[0]->levels.size()),
                                 .layers = std::uint32_t(layers.size()),
                                 .arrayed = true,
                                 .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
                                 .cause = "lights"});
    std::vector<float> warps;
    for (std::uint32_t layer = 0; layer < layers.size(); ++layer) {
        const SourcePicture& picture = *layers[layer];
        for (std::uint32_t level = 0; level < picture.levels.size(); ++level)
            image_.upload(std::as_bytes(std::span(picture.levels[level].texels)), level, layer);
        warps.insert(warps.end(), picture.warp.begin(), picture.warp.end());
    }
    warps_ = gpu::storageBuffer(device, "lightWarps", warps, "lights");
}

gpu::Bindings GpuPictures::bindings() const {
    if (!image_) return {};
    return {{"lightPictures", image_, gpu::SamplerKind::LinearClamp}, {"LightWarps", warps_}};
}

} // namespace kilolux
