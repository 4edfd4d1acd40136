#include "renderer/visible_lists.h"

#include <algorithm>
#include <cmath>

namespace kilolux {

using namespace shared;

VisibleLists::VisibleLists(gpu::Device& device, std::uint32_t widthPx, std::uint32_t heightPx) {
    const VkDeviceSize tiles = VkDeviceSize((widthPx + LIST_TILE_PX - 1) / LIST_TILE_PX) *
                               ((heightPx + LIST_TILE_PX - 1) / LIST_TILE_PX);
    for (gpu::Buffer& list : lists_) {
        list = gpu::Buffer(device,
                           {"visibleLists", tiles * LIST_TEXELS * sizeof(glm::uvec2),
                            VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                            gpu::MemoryUse::DeviceOnly, "visible lists", VK_FORMAT_R32G32_UINT});
        // Lists that are frozen from the start are read before any frame has written them.
        list.upload(std::vector<glm::uvec2>(tiles * LIST_TEXELS));
    }
}

void VisibleLists::replacePrevious(const std::vector<glm::uvec2>& texels) {
    lists_[1 - current_].upload(texels);
}

std::vector<glm::uvec2> VisibleLists::readPrevious() const {
    return previous().downloadAs<glm::uvec2>();
}

SamplingConstants samplingConstants(const Settings& s) {
    // Thresholds are stated as display luminances; the selection compares weights.
    const auto weight = [](double luminance) { return float(std::log1p(luminance) / std::log(2.0)); };
    SamplingConstants c{};
    c.rays = std::uint32_t(std::max(1.0, std::round(s.raysPerPixel)));
    c.choices = s.sampling == Sampling::Full ? c.rays : 4 * c.rays;
    c.pixelsPerRay = s.raysPerPixel <= 0.25 ? 4 : (s.raysPerPixel <= 0.5 ? 2 : 1);
    c.guiding = s.guiding;
    c.areaMasks = s.areaMasks;
    c.maskHiddenShare = float(s.maskHiddenShare);
    c.maskSizeTiles = float(s.maskSize);
    c.maskSamples = float(s.maskSamples);
    c.hiddenShare = float(s.hiddenShare);
    c.missHiddenShare = float(s.missHiddenShare);
    c.hiddenSeenShare = float(s.hiddenSeenShare);
    c.hiddenRelaxedBelow = weight(s.hiddenRelaxedBelow);
    c.directionalShare = float(s.directionalShare);
    c.directionalFreeBelow = weight(s.directionalFreeBelow);
    c.domeShare = float(s.domeBudget);
    c.cellCandidates = std::uint32_t(s.cellCandidates);
    c.missCandidates = std::uint32_t(s.missCandidates);
    c.dimThreshold = weight(s.dimThreshold);
    c.dimMode = std::uint32_t(s.dimLights);
    c.listLength = std::uint32_t(s.listLength);
    c.listMemory = std::uint32_t(s.listMemory);
    c.editHistory = float(s.editHistory);
    c.upsampleDepth = float(s.upsampleDepth);
    c.upsampleNormal = float(s.upsampleNormal);
    c.upsampleLeast = float(s.upsampleLeast);
    c.upsampleReachPx = float(s.upsampleReach);
    return c;
}

} // namespace kilolux
