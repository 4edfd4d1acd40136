// Buffers of the device's own memory that are made and filled at once.
#pragma once

#include "resource.h"

#include <vector>

namespace kilolux::gpu {

// `data` as a shader reads it from a samplerBuffer whose texels have `format`. `cause` as in the statistics
// of memory. Waits for the device, as Buffer::upload() does.
template<typename T>
Buffer texelBuffer(Device& device, const char* name, const std::vector<T>& data, VkFormat format,
                   std::string_view cause, VkBufferUsageFlags moreUsage = 0) {
    const VkBufferUsageFlags usage = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | moreUsage;
    Buffer buffer(device, {name, data.size() * sizeof(T), usage, MemoryUse::DeviceOnly, cause, format});
    buffer.upload(data);
    return buffer;
}

// `data` as a storage buffer of the same layout; otherwise like texelBuffer().
template<typename T>
Buffer storageBuffer(Device& device, const char* name, const std::vector<T>& data, std::string_view cause) {
    Buffer buffer(device, {name, data.size() * sizeof(T), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                           MemoryUse::DeviceOnly, cause});
    buffer.upload(data);
    return buffer;
}

} // namespace kilolux::gpu
