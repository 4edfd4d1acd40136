#include "renderer/targets.h"

#include <algorithm>
#include <cmath>

namespace kilolux {

Targets::Targets(gpu::Device& device, std::uint32_t widthPx, std::uint32_t heightPx, bool raster,
                 bool debugView) {
    const auto make = [&](const char* name, VkFormat format, VkImageUsageFlags more = 0) {
        return gpu::Image(device, {.name = name,
                                   .format = format,
                                   .width = widthPx,
                                   .height = heightPx,
                                   .usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | more});
    };
    constexpr VkImageUsageFlags attachment = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    visibility = make("visibility", VK_FORMAT_R32G32_UINT, raster ? attachment : 0);
    if (raster) {
        rasterDepth = gpu::Image(device, {.name = "rasterDepth",
                                          .format = VK_FORMAT_D32_SFLOAT,
                                          .width = widthPx,
                                          .height = heightPx,
                                          .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT});
    }
    gDepth = make("gDepth", VK_FORMAT_R32_SFLOAT);
    gNormals = make("gNormals", VK_FORMAT_R32G32_UINT);
    gMaterial = make("gMaterial", VK_FORMAT_R32G32_UINT);
    gEmissive = make("gEmissive", VK_FORMAT_R16G16B16A16_SFLOAT);
    const std::uint32_t halfWidth = std::max(1u, widthPx / 2), halfHeight = std::max(1u, heightPx / 2);
    pyramid = gpu::Image(device, {.name = "pyramid",
                                  .format = VK_FORMAT_R32G32_SFLOAT,
                                  .width = halfWidth,
                                  .height = halfHeight,
                                  .mips = 1 + std::uint32_t(std::log2(std::max(halfWidth, halfHeight)))});
    litDiffuse = make("litDiffuse", VK_FORMAT_R32G32B32A32_SFLOAT);
    litSpecular = make("litSpecular", VK_FORMAT_R32G32B32A32_SFLOAT);
    lightCounts = make("lightCounts", VK_FORMAT_R32_UINT);
    sceneColor = make("sceneColor", VK_FORMAT_R32G32B32A32_SFLOAT, attachment);
    meanColor = make("meanColor", VK_FORMAT_R32G32B32A32_SFLOAT);
    if (debugView) viewValues = make("viewValues", VK_FORMAT_R32G32B32A32_SFLOAT);
    display = make("display", VK_FORMAT_R8G8B8A8_UNORM);
}

std::vector<const gpu::Image*> Targets::all() const {
    std::vector<const gpu::Image*> result{&visibility,  &gDepth,     &gNormals,   &gMaterial,
                                          &gEmissive,   &pyramid,    &litDiffuse, &litSpecular,
                                          &lightCounts, &sceneColor, &meanColor,  &display};
    if (viewValues) result.push_back(&viewValues);
    if (rasterDepth) result.insert(result.begin() + 1, &rasterDepth);
    return result;
}

} // namespace kilolux
