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
    gSurface = make("gSurface", VK_FORMAT_R32G32B32A32_UINT);
    gMaterial = make("gMaterial", VK_FORMAT_R32_UINT);
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
        previousSurface = make("previousSurface", VK_FORMAT_R32G32B32A32_UINT);
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
        if (!needs.reservoirs) samples = makeLayers("samples", VK_FORMAT_R32G32B32A32_UINT, needs.rays, 1);
        rayResults = makeLayers("rayResults", VK_FORMAT_R32_UINT, needs.rays, 1);
    }
    if (needs.reservoirs) {
        newReservoirs = make("newReservoirs", VK_FORMAT_R32G32B32A32_UINT);
        reservoirs = make("reservoirs", VK_FORMAT_R32G32B32A32_UINT);
        previousReservoirs = make("previousReservoirs", VK_FORMAT_R32G32B32A32_UINT);
    }
    if (needs.halfChoices > 0)
        samplesHalf = makeLayers("samplesHalf", VK_FORMAT_R32G32B32A32_UINT, needs.halfChoices, 2);
    sceneColor = make("sceneColor", VK_FORMAT_R32G32B32A32_SFLOAT, attachment);
    makeFiltered(make, needs);
    addForView(device, needs);
    display = make("display", VK_FORMAT_R8G8B8A8_UNORM);
}

void Targets::addForView(gpu::Device& device, const TargetNeeds& needs) {
    const auto make = [&](const char* name, VkFormat format) {
        return gpu::Image(device, {.name = name,
                                   .format = format,
                                   .width = sceneColor.desc().width,
                                   .height = sceneColor.desc().height,
                                   .usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT});
    };
    if (needs.debugView && !viewValues) viewValues = make("viewValues", VK_FORMAT_R32G32B32A32_SFLOAT);
    if (needs.denoiseTrace && !denoiseTrace)
        denoiseTrace = make("denoiseTrace", VK_FORMAT_R16G16B16A16_SFLOAT);
}

void Targets::makeFiltered(const Make& make, const TargetNeeds& needs) {
    constexpr VkFormat half = VK_FORMAT_R16G16B16A16_SFLOAT, full = VK_FORMAT_R32G32B32A32_SFLOAT;
    if (needs.denoised) {
        historyDiffuse = make("historyDiffuse", half, 0);
        historySpecular = make("historySpecular", half, 0);
        historyMoments = make("historyMoments", half, 0);
        previousDiffuse = make("previousDiffuse", half, 0);
        previousSpecular = make("previousSpecular", half, 0);
        previousMoments = make("previousMoments", half, 0);
        denoisedDiffuse = make("denoisedDiffuse", half, 0);
        denoisedSpecular = make("denoisedSpecular", half, 0);
    }
    if (needs.antiAliased) {
        antiAliased = make("antiAliased", half, 0);
        previousAntiAliased = make("previousAntiAliased", half, 0);
        pixelMoments = make("pixelMoments", half, 0);
        previousPixelMoments = make("previousPixelMoments", half, 0);
    }
    if (needs.rawColor) rawColor = make("rawColor", full, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
    if (needs.mean) meanColor = make("meanColor", full, 0);
    if (needs.counted) meanMoments = make("meanMoments", VK_FORMAT_R32G32_SFLOAT, 0);
    if (needs.settled) viewportColor = make("viewportColor", half, 0);
}

void Targets::turnHistory() {
    if (!motion) return;
    std::swap(gSurface, previousSurface);
    std::swap(reservoirs, previousReservoirs);
}

void Targets::turnFilteredHistory() {
    std::swap(historyDiffuse, previousDiffuse);
    std::swap(historySpecular, previousSpecular);
    std::swap(historyMoments, previousMoments);
    std::swap(antiAliased, previousAntiAliased);
    std::swap(pixelMoments, previousPixelMoments);
}

std::vector<NamedTarget> Targets::all() const {
    std::vector<NamedTarget> result;
#define KX_TARGET(name)                                                                                      \
    if (name) result.push_back({#name, &(name)})
    KX_TARGET(visibility);
    KX_TARGET(rasterDepth);
    KX_TARGET(gDepth);
    KX_TARGET(gSurface);
    KX_TARGET(gMaterial);
    KX_TARGET(gEmissive);
    KX_TARGET(pyramid);
    KX_TARGET(motion);
    KX_TARGET(previousSurface);
    KX_TARGET(samplesHalf);
    KX_TARGET(samples);
    KX_TARGET(rayResults);
    KX_TARGET(newReservoirs);
    KX_TARGET(reservoirs);
    KX_TARGET(previousReservoirs);
    KX_TARGET(litDiffuse);
    KX_TARGET(litSpecular);
    KX_TARGET(historyDiffuse);
    KX_TARGET(historySpecular);
    KX_TARGET(historyMoments);
    KX_TARGET(previousDiffuse);
    KX_TARGET(previousSpecular);
    KX_TARGET(previousMoments);
    KX_TARGET(denoiseTrace);
    KX_TARGET(denoisedDiffuse);
    KX_TARGET(denoisedSpecular);
    KX_TARGET(lightCounts);
    KX_TARGET(sceneColor);
    KX_TARGET(rawColor);
    KX_TARGET(meanColor);
    KX_TARGET(meanMoments);
    KX_TARGET(antiAliased);
    KX_TARGET(previousAntiAliased);
    KX_TARGET(pixelMoments);
    KX_TARGET(previousPixelMoments);
    KX_TARGET(viewportColor);
    KX_TARGET(viewValues);
    KX_TARGET(display);
#undef KX_TARGET
    return result;
}

} // namespace kilolux
