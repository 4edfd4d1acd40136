// The list of a frame's rays in the order in which they are traced and shaded; see shared/sampling.h.
#pragma once

#include "renderer/gpu/resource.h"
#include "shaders/shared/sampling.h"

namespace kilolux {

struct RayList {
    // Room for a picture of at most width x height pixels. One layer of rays is listed at a time.
    RayList(gpu::Device& device, std::uint32_t widthPx, std::uint32_t heightPx, std::uint32_t layers)
        : heads(device, {"rayListHeads", layers * sizeof(shared::RayListHead),
                         VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT,
                         gpu::MemoryUse::DeviceOnly, "ray list"}),
          entries(device, {"rayList", VkDeviceSize(widthPx) * heightPx * sizeof(std::uint32_t),
                           VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                           gpu::MemoryUse::DeviceOnly, "ray list", VK_FORMAT_R32_UINT}) {}

    gpu::Buffer heads; // RayListHead by layer, 0 before a frame
    gpu::Buffer entries;
};

} // namespace kilolux
