// Block allocator, see memory.h.
#include "memory.h"

#include <algorithm>
#include <fmt/format.h>

namespace kilolux::gpu {

namespace {
VkDeviceSize alignUp(VkDeviceSize value, VkDeviceSize alignment) {
    return (value + alignment - 1) / alignment * alignment;
}
} // namespace

MemoryAllocator::MemoryAllocator(VkPhysicalDevice physicalDevice, VkDevice device, MemoryOptions options)
    : device_(device), options_(options) {
    vkGetPhysicalDeviceMemoryProperties(physicalDevice, &properties_);
    VkPhysicalDeviceProperties deviceProperties;
    vkGetPhysicalDeviceProperties(physicalDevice, &deviceProperties);
    atomSize_ = std::max<VkDeviceSize>(1, deviceProperties.limits.nonCoherentAtomSize);
}

MemoryAllocator::~MemoryAllocator() {
    for (const auto& [memory, size] : rawSizes_)
        vkFreeMemory(device_, memory, nullptr);
}

std::uint32_t MemoryAllocator::chooseType(std::uint32_t allowedBits, MemoryUse use) const {
    VkMemoryPropertyFlags required = 0, preferred = 0;
    switch (use) {
    case MemoryUse::DeviceOnly:
        preferred = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
        break;
    case MemoryUse::HostWrite:
        required = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT;
        preferred = VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
        break;
    case MemoryUse::HostReadback:
        required = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT;
        preferred = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
        break;
    }
    std::int32_t best = -1;
    for (std::uint32_t i = 0; i < properties_.memoryTypeCount; ++i) {
        const VkMemoryPropertyFlags flags = properties_.memoryTypes[i].propertyFlags;
        if (!(allowedBits >> i & 1u) || (flags & required) != required) continue;
        if ((flags & preferred) == preferred) return i;
        if (best < 0) best = static_cast<std::int32_t>(i);
    }
    if (best < 0) throw DeviceError("no device memory type fits a resource");
    return static_cast<std::uint32_t>(best);
}

bool MemoryAllocator::isMappable(std::uint32_t memoryType, MemoryUse use) const {
    const bool visible =
        properties_.memoryTypes[memoryType].propertyFlags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT;
    return visible && !(use == MemoryUse::DeviceOnly && options_.forceStaging);
}

VkDeviceMemory MemoryAllocator::allocateRaw(VkDeviceSize bytes, std::uint32_t memoryType,
                                            bool deviceAddress) {
    VkMemoryAllocateFlagsInfo flags{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO};
    flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
    VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    info.pNext = deviceAddress ? &flags : nullptr;
    info.allocationSize = bytes;
    info.memoryTypeIndex = memoryType;
    VkDeviceMemory memory;
    const VkResult result = vkAllocateMemory(device_, &info, nullptr, &memory);
    if (result != VK_SUCCESS) {
        throw DeviceError(fmt::format("device memory: {} for {:.1f} MiB, with {:.1f} MiB in use",
                                      resultName(result), double(bytes) / (1 << 20),
                                      double(rawBytes_) / (1 << 20)));
    }
    rawSizes_[memory] = bytes;
    rawBytes_ += bytes;
    rawPeak_ = std::max(rawPeak_, rawBytes_);
    return memory;
}

std::uint32_t MemoryAllocator::poolFor(std::uint32_t memoryType, ResourceKind kind, bool deviceAddress) {
    for (std::uint32_t i = 0; i < pools_.size(); ++i) {
        const Pool& pool = pools_[i];
        if (pool.memoryType == memoryType && pool.kind == kind && pool.deviceAddress == deviceAddress)
            return i;
    }
    pools_.push_back({memoryType, kind, deviceAddress, {}});
    return static_cast<std::uint32_t>(pools_.size() - 1);
}

bool MemoryAllocator::takeFromBlock(Block& block, VkDeviceSize size, VkDeviceSize alignment,
                                    VkDeviceSize& offset) {
    for (std::size_t i = 0; i < block.freeRanges.size(); ++i) {
        const Range range = block.freeRanges[i];
        const VkDeviceSize start = alignUp(range.offset, alignment);
        if (start + size > range.offset + range.size) continue;
        block.freeRanges.erase(block.freeRanges.begin() + std::ptrdiff_t(i));
        if (const VkDeviceSize tail = range.offset + range.size - (start + size); tail > 0) {
            block.freeRanges.insert(block.freeRanges.begin() + std::ptrdiff_t(i), {start + size, tail});
        }
        if (start > range.offset) {
            block.freeRanges.insert(block.freeRanges.begin() + std::ptrdiff_t(i),
                                    {range.offset, start - range.offset});
        }
        offset = start;
        return true;
    }
    return false;
}

std::uint32_t MemoryAllocator::causeIndex(std::string_view cause) {
    for (std::uint32_t i = 0; i < causes_.size(); ++i) {
        if (causes_[i].cause == cause) return i;
    }
    causes_.push_back({std::string(cause), 0, 0});
    return static_cast<std::uint32_t>(causes_.size() - 1);
}

Allocation MemoryAllocator::allocate(const VkMemoryRequirements& requirements, MemoryUse use,
                                     ResourceKind kind, bool deviceAddress, std::string_view cause) {
    const std::lock_guard lock(mutex_);
    const std::uint32_t type = chooseType(requirements.memoryTypeBits, use);
    const bool mappable = isMappable(type, use);
    Allocation result;
    // Non-coherent ranges are flushed in whole atoms, so neighbours must not share one.
    const VkDeviceSize alignment = std::max(requirements.alignment, mappable ? atomSize_ : VkDeviceSize{1});
    result.size = alignUp(requirements.size, mappable ? atomSize_ : VkDeviceSize{1});
    result.coherent = !options_.treatAsNonCoherent &&
                      (properties_.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    result.cause = causeIndex(cause);
    const auto map = [&](VkDeviceMemory memory) {
        void* mapped = nullptr;
        if (mappable) KX_VK(vkMapMemory(device_, memory, 0, VK_WHOLE_SIZE, 0, &mapped));
        return static_cast<std::byte*>(mapped);
    };
    if (result.size >= kDedicatedBytes) {
        result.memory = allocateRaw(result.size, type, deviceAddress);
        result.mapped = map(result.memory);
    } else {
        result.pool = poolFor(type, kind, deviceAddress);
        std::vector<Block>& blocks = pools_[result.pool].blocks;
        for (std::size_t i = 0; i < blocks.size() && result.block < 0; ++i) {
            if (takeFromBlock(blocks[i], result.size, alignment, result.offset)) result.block = int(i);
        }
        if (result.block < 0) {
            Block block;
            block.memory = allocateRaw(kBlockBytes, type, deviceAddress);
            block.mapped = map(block.memory);
            block.freeRanges = {{0, kBlockBytes}};
            takeFromBlock(block, result.size, alignment, result.offset);
            blocks.push_back(std::move(block));
            result.block = static_cast<std::int32_t>(blocks.size() - 1);
        }
        const Block& block = blocks[std::size_t(result.block)];
        result.memory = block.memory;
        result.mapped = block.mapped && mappable ? block.mapped + result.offset : nullptr;
    }
    MemoryCauseBytes& bytes = causes_[result.cause];
    bytes.current += result.size;
    bytes.peak = std::max(bytes.peak, bytes.current);
    usedBytes_ += result.size;
    slackPeak_ = std::max(slackPeak_, rawBytes_ - usedBytes_);
    return result;
}

void MemoryAllocator::free(const Allocation& allocation) {
    if (!allocation.memory) return;
    const std::lock_guard lock(mutex_);
    causes_[allocation.cause].current -= allocation.size;
    usedBytes_ -= allocation.size;
    if (allocation.block < 0) {
        rawBytes_ -= rawSizes_.at(allocation.memory);
        rawSizes_.erase(allocation.memory);
        vkFreeMemory(device_, allocation.memory, nullptr);
        return;
    }
    std::vector<Range>& ranges = pools_[allocation.pool].blocks[std::size_t(allocation.block)].freeRanges;
    auto next =
        std::lower_bound(ranges.begin(), ranges.end(), allocation.offset,
                         [](const Range& range, VkDeviceSize offset) { return range.offset < offset; });
    next = ranges.insert(next, {allocation.offset, allocation.size});
    if (auto after = next + 1; after != ranges.end() && next->offset + next->size == after->offset) {
        next->size += after->size;
        ranges.erase(after);
    }
    if (next != ranges.begin()) {
        auto before = next - 1;
        if (before->offset + before->size == next->offset) {
            before->size += next->size;
            ranges.erase(next);
        }
    }
}

VkMappedMemoryRange MemoryAllocator::mappedRange(const Allocation& allocation) const {
    VkMappedMemoryRange range{VK_STRUCTURE_TYPE_MAPPED_MEMORY_RANGE};
    range.memory = allocation.memory;
    range.offset = allocation.offset / atomSize_ * atomSize_;
    range.size = allocation.block < 0 ? VK_WHOLE_SIZE : alignUp(allocation.size, atomSize_);
    return range;
}

void MemoryAllocator::flush(const Allocation& allocation) const {
    if (allocation.coherent || !allocation.mapped) return;
    const VkMappedMemoryRange range = mappedRange(allocation);
    KX_VK(vkFlushMappedMemoryRanges(device_, 1, &range));
}

void MemoryAllocator::invalidate(const Allocation& allocation) const {
    if (allocation.coherent || !allocation.mapped) return;
    const VkMappedMemoryRange range = mappedRange(allocation);
    KX_VK(vkInvalidateMappedMemoryRanges(device_, 1, &range));
}

std::vector<MemoryCauseBytes> MemoryAllocator::causes() const {
    const std::lock_guard lock(mutex_);
    std::vector<MemoryCauseBytes> result = causes_;
    result.push_back({"unused in blocks", rawBytes_ - usedBytes_, slackPeak_});
    return result;
}

VkDeviceSize MemoryAllocator::peakBytes() const {
    const std::lock_guard lock(mutex_);
    return rawPeak_;
}

} // namespace kilolux::gpu
