#include "renderer/targets.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace kilolux {

Targets::Targets(gpu::Device& device, std::uint32_t widthPx, std::uint32_t heightPx,
                 const TargetNeeds& needs) {
    constexpr VkImageUsageFlags storage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    constexpr VkImageUsageFlags attachment = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    const auto make = [&](const char* name, VkFormat format, VkImageUsageFlags more = 0) {
        return gpu::Image(
            device,
            {.name = name, .format = format, .width = widthPx, .height = heightPx, .usage = storage | more});
    };
    visibility = make("visibility", VK_FORMAT_R32G32_UINT, needs.raster ? attachment : 0);
    if (needs.raster) {
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
    if (needs.history) {
        motion = make("motion", VK_FORMAT_R16G16B16A16_SFLOAT);
        previousDepth = make("previousDepth", VK_FORMAT_R32_SFLOAT);
        previousNormals = make("previousNormals", VK_FORMAT_R32G32_UINT);
    }
    const auto makeLayers = [&](const char* name, VkFormat format, std::uint32_t layers,
                                std::uint32_t divisor) {
        return gpu::Image(device, {.name = name,
                                   .format = format,
                                   .width = (widthPx + divisor - 1) / divisor,
                                   .height = (heightPx + divisor - 1) / divisor,
                                   .layers = layers,
                                   .arrayed = true,
                                   .usage = storage});
    };
    if (needs.rays > 0) {
        samples = makeLayers("samples", VK_FORMAT_R32G32B32A32_UINT, needs.rays, 1);
        rayResults = makeLayers("rayResults", VK_FORMAT_R32_UINT, needs.rays, 1);
    }
    if (needs.halfChoices > 0)
        samplesHalf = makeLayers("samplesHalf", VK_FORMAT_R32G32B32A32_UINT, needs.halfChoices, 2);
    sceneColor = make("sceneColor", VK_FORMAT_R32G32B32A32_SFLOAT, attachment);
    meanColor = make("meanColor", VK_FORMAT_R32G32B32A32_SFLOAT);
    if (needs.debugView) viewValues = make("viewValues", VK_FORMAT_R32G32B32A32_SFLOAT);
    display = make("display", VK_FORMAT_R8G8B8A8_UNORM);
}

void Targets::turnHistory() {
    if (!motion) return;
    std::swap(gDepth, previousDepth);
    std::swap(gNormals, previousNormals);
}

std::vector<const gpu::Image*> Targets::all() const {
    std::vector<const gpu::Image*> result;
    for (const gpu::Image* image :
         {&visibility,  &rasterDepth,   &gDepth,          &gNormals,    &gMaterial,  &gEmissive,  &pyramid,
          &motion,      &previousDepth, &previousNormals, &samplesHalf, &samples,    &rayResults, &litDiffuse,
          &litSpecular, &lightCounts,   &sceneColor,      &meanColor,   &viewValues, &display}) {
        if (*image) result.push_back(image);
    }
    return result;
}

} // namespace kilolux
