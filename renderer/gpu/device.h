// The Vulkan device: instance, validation, one queue, memory and caches. Any Vulkan 1.3 device with one queue
// for graphics and compute will do; nothing optional is required, ray queries are used where they exist.
#pragma once

#include "memory.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace kilolux::gpu {

enum class Validation {
    Off,
    On,          // core and synchronization, the latter across submits too
    GpuAssisted, // core and GPU-assisted (the layer does not combine it with synchronization)
};

struct DeviceOptions {
    Validation validation = Validation::Off;
    MemoryOptions memory;
    bool commandBufferPerPass = false; // lets queue-submit validation see hazards between passes
    bool allowRayQuery = true;
    std::string nameContains; // picks the first device whose name has this; empty prefers real GPUs
    bool diskCache = true;
    // Beyond what lighting needs: the window's own device presents.
    std::vector<const char*> instanceExtensions, deviceExtensions;
};

class Device {
  public:
    explicit Device(const DeviceOptions& options = {});
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    VkDevice handle() const { return device_; }
    VkPhysicalDevice physical() const { return physicalDevice_; }
    VkInstance instance() const { return instance_; }
    VkQueue queue() const { return queue_; }
    std::uint32_t queueFamily() const { return queueFamily_; }
    MemoryAllocator& memory() { return *memory_; }
    VkPipelineCache pipelineCache() const { return pipelineCache_; }
    const DeviceOptions& options() const { return options_; }
    const VkPhysicalDeviceLimits& limits() const { return properties_.limits; }

    std::string name() const { return properties_.deviceName; }
    std::string driver() const { return driver_; }
    bool isCpu() const { return properties_.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU; }
    bool hasRayQuery() const { return hasRayQuery_; }
    bool hasGeometryShader() const { return hasGeometryShader_; } // lets fragments read gl_PrimitiveID
    bool hasReliableTimestamps() const { return hasReliableTimestamps_; }
    std::uint32_t subgroupSize() const { return subgroupSize_; }
    bool canRequireSubgroupSize() const { return canRequireSubgroupSize_; } // of compute pipelines

    // Submits and waits; thread-safe. `work` is an array of recorded command buffers in order.
    void submitAndWait(const std::vector<VkCommandBuffer>& work);

    // Warnings and errors of the validation layer since the last call, as one text each.
    std::vector<std::string> takeValidationMessages();
    void addValidationMessage(std::string message);

    // For labels in captures and validation messages; no-ops without the debug extension.
    void setName(VkObjectType type, std::uint64_t object, const char* name) const;
    PFN_vkCmdBeginDebugUtilsLabelEXT cmdBeginLabel = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT cmdEndLabel = nullptr;

    // Ray query entry points; null where hasRayQuery() is false.
    PFN_vkCreateAccelerationStructureKHR createAccelerationStructure = nullptr;
    PFN_vkDestroyAccelerationStructureKHR destroyAccelerationStructure = nullptr;
    PFN_vkGetAccelerationStructureBuildSizesKHR getAccelerationStructureBuildSizes = nullptr;
    PFN_vkCmdBuildAccelerationStructuresKHR cmdBuildAccelerationStructures = nullptr;
    PFN_vkGetAccelerationStructureDeviceAddressKHR getAccelerationStructureDeviceAddress = nullptr;

  private:
    void createInstance();
    void choosePhysicalDevice();
    void createDevice();
    void loadEntryPoints();
    void createPipelineCache();
    void savePipelineCache() const;
    std::filesystem::path pipelineCachePath() const;

    DeviceOptions options_;
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkPhysicalDevice physicalDevice_ = VK_NULL_HANDLE;
    VkPhysicalDeviceProperties properties_{};
    std::string driver_;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    std::uint32_t queueFamily_ = 0;
    VkPipelineCache pipelineCache_ = VK_NULL_HANDLE;
    std::unique_ptr<MemoryAllocator> memory_;
    bool hasDebugUtils_ = false;
    bool hasRayQuery_ = false;
    bool hasGeometryShader_ = false;
    bool hasReliableTimestamps_ = false;
    std::uint32_t subgroupSize_ = 0;
    bool canRequireSubgroupSize_ = false;
    PFN_vkSetDebugUtilsObjectNameEXT setObjectName_ = nullptr;
    std::mutex queueMutex_;
    std::mutex messageMutex_;
    std::vector<std::string> messages_;
};

// $XDG_CACHE_HOME/kilolux or ~/.cache/kilolux; created on demand, empty when neither can be had.
std::filesystem::path cacheDirectory();

} // namespace kilolux::gpu
