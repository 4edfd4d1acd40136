// Device memory in blocks: one list of 4 MiB blocks per memory type and resource kind, first fit, with
// dedicated allocations from 1 MiB on (16 MiB blocks left 41 of 125 MiB unused in the gallery at 640 x 360: a
// frame's targets are 1 to 4 MiB each). Every allocation names its cause; current and peak bytes are kept per
// cause, and what blocks hold beyond that counts as "unused in blocks".
#pragma once

#include "vk.h"

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace kilolux::gpu {

enum class MemoryUse {
    DeviceOnly,   // fastest for the device; mapped only if that memory happens to be host visible
    HostWrite,    // mapped, written by the CPU, read by the device
    HostReadback, // mapped, written by the device, read by the CPU (cached where possible)
};

enum class ResourceKind { Linear, Tiled }; // buffers against optimally tiled images (bufferImageGranularity)

struct Allocation {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;
    VkDeviceSize size = 0;
    std::byte* mapped = nullptr; // null when not host visible
    bool coherent = true;
    std::int32_t block = -1; // -1: dedicated
    std::uint32_t pool = 0;
    std::uint32_t cause = 0;
};

struct MemoryCauseBytes {
    std::string cause;
    VkDeviceSize current = 0;
    VkDeviceSize peak = 0;
};

struct MemoryOptions {
    bool forceStaging = false;       // never map DeviceOnly memory, so that uploads take the staging path
    bool treatAsNonCoherent = false; // flush and invalidate always
};

class MemoryAllocator {
  public:
    static constexpr VkDeviceSize kBlockBytes = VkDeviceSize{4} << 20;
    static constexpr VkDeviceSize kDedicatedBytes = VkDeviceSize{1} << 20;

    MemoryAllocator(VkPhysicalDevice physicalDevice, VkDevice device, MemoryOptions options);
    ~MemoryAllocator();
    MemoryAllocator(const MemoryAllocator&) = delete;
    MemoryAllocator& operator=(const MemoryAllocator&) = delete;

    Allocation allocate(const VkMemoryRequirements& requirements, MemoryUse use, ResourceKind kind,
                        bool deviceAddress, std::string_view cause);
    void free(const Allocation& allocation);

    // Makes CPU writes visible to the device / device writes visible to the CPU, where memory asks for it.
    void flush(const Allocation& allocation) const;
    void invalidate(const Allocation& allocation) const;

    std::vector<MemoryCauseBytes> causes() const; // in order of first use, "unused in blocks" last
    VkDeviceSize peakBytes() const;               // of what was taken from the device

  private:
    struct Range {
        VkDeviceSize offset, size;
    };
    struct Block {
        VkDeviceMemory memory = VK_NULL_HANDLE;
        std::byte* mapped = nullptr;
        std::vector<Range> freeRanges; // sorted by offset, never adjacent
    };
    struct Pool {
        std::uint32_t memoryType = 0;
        ResourceKind kind = ResourceKind::Linear;
        bool deviceAddress = false;
        std::vector<Block> blocks;
    };

    std::uint32_t chooseType(std::uint32_t allowedBits, MemoryUse use) const;
    bool isMappable(std::uint32_t memoryType, MemoryUse use) const;
    VkDeviceMemory allocateRaw(VkDeviceSize bytes, std::uint32_t memoryType, bool deviceAddress);
    std::uint32_t poolFor(std::uint32_t memoryType, ResourceKind kind, bool deviceAddress);
    bool takeFromBlock(Block& block, VkDeviceSize size, VkDeviceSize alignment, VkDeviceSize& offset);
    std::uint32_t causeIndex(std::string_view cause);
    VkMappedMemoryRange mappedRange(const Allocation& allocation) const;

    VkDevice device_;
    MemoryOptions options_;
    VkPhysicalDeviceMemoryProperties properties_{};
    VkDeviceSize atomSize_ = 1;
    mutable std::mutex mutex_;
    std::vector<Pool> pools_;
    std::vector<MemoryCauseBytes> causes_;
    std::map<VkDeviceMemory, VkDeviceSize> rawSizes_;
    VkDeviceSize rawBytes_ = 0, rawPeak_ = 0, usedBytes_ = 0, slackPeak_ = 0;
};

} // namespace kilolux::gpu
