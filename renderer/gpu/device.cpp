// The device at work: its pipeline cache, submissions and messages, see device.h; it is set up in
// device_setup.cpp.
#include "device.h"

#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <utility>

namespace kilolux::gpu {

std::filesystem::path cacheDirectory() {
    std::filesystem::path base;
    if (const char* xdg = std::getenv("XDG_CACHE_HOME"); xdg && *xdg) {
        base = xdg;
    } else if (const char* home = std::getenv("HOME"); home && *home) {
        base = std::filesystem::path(home) / ".cache";
    } else {
        return {};
    }
    std::error_code error;
    std::filesystem::create_directories(base / "kilolux", error);
    return error ? std::filesystem::path{} : base / "kilolux";
}

Device::Device(const DeviceOptions& options) : options_(options) {
    createInstance();
    choosePhysicalDevice();
    createDevice();
    loadEntryPoints();
    createPipelineCache();
    memory_ = std::make_unique<MemoryAllocator>(physicalDevice_, device_, options_.memory);
}

Device::~Device() {
    if (device_) {
        vkDeviceWaitIdle(device_);
        savePipelineCache();
        vkDestroyPipelineCache(device_, pipelineCache_, nullptr);
        memory_.reset();
        vkDestroyDevice(device_, nullptr);
    }
    if (messenger_) {
        auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
        destroy(instance_, messenger_, nullptr);
    }
    if (instance_) vkDestroyInstance(instance_, nullptr);
}

std::filesystem::path Device::pipelineCachePath() const {
    const std::filesystem::path directory = cacheDirectory();
    if (directory.empty() || !options_.diskCache) return {};
    std::string uuid;
    for (const std::uint8_t byte : properties_.pipelineCacheUUID)
        uuid += fmt::format("{:02x}", byte);
    return directory / fmt::format("pipelines-{}.bin", uuid);
}

void Device::createPipelineCache() {
    std::vector<char> data;
    if (const std::filesystem::path path = pipelineCachePath(); !path.empty()) {
        std::ifstream file(path, std::ios::binary);
        data.assign(std::istreambuf_iterator<char>(file), {});
    }
    VkPipelineCacheCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
    info.initialDataSize = data.size();
    info.pInitialData = data.data();
    KX_VK(vkCreatePipelineCache(device_, &info, nullptr, &pipelineCache_));
}

void Device::savePipelineCache() const {
    const std::filesystem::path path = pipelineCachePath();
    std::size_t size = 0;
    if (path.empty() || vkGetPipelineCacheData(device_, pipelineCache_, &size, nullptr) != VK_SUCCESS) return;
    std::vector<char> data(size);
    if (vkGetPipelineCacheData(device_, pipelineCache_, &size, data.data()) != VK_SUCCESS) return;
    // Written beside and renamed, so that a second process never reads half a file.
    std::filesystem::path partial = path;
    partial += fmt::format(".{}", std::uintptr_t(this));
    std::ofstream(partial, std::ios::binary).write(data.data(), std::streamsize(size));
    std::error_code error;
    std::filesystem::rename(partial, path, error);
}

void Device::submitAndWait(const std::vector<VkCommandBuffer>& work) {
    std::vector<VkCommandBufferSubmitInfo> infos(work.size());
    for (std::size_t i = 0; i < work.size(); ++i) {
        infos[i] = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
        infos[i].commandBuffer = work[i];
    }
    VkSubmitInfo2 submit{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
    submit.commandBufferInfoCount = std::uint32_t(infos.size());
    submit.pCommandBufferInfos = infos.data();
    VkFenceCreateInfo fenceInfo{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    VkFence fence;
    KX_VK(vkCreateFence(device_, &fenceInfo, nullptr, &fence));
    {
        const std::lock_guard lock(queueMutex_);
        KX_VK(vkQueueSubmit2(queue_, 1, &submit, fence));
    }
    KX_VK(vkWaitForFences(device_, 1, &fence, VK_TRUE, UINT64_MAX));
    vkDestroyFence(device_, fence, nullptr);
}

std::vector<std::string> Device::takeValidationMessages() {
    const std::lock_guard lock(messageMutex_);
    return std::exchange(messages_, {});
}

void Device::addValidationMessage(std::string message) {
    const std::lock_guard lock(messageMutex_);
    messages_.push_back(std::move(message));
}

void Device::setName(VkObjectType type, std::uint64_t object, const char* name) const {
    if (!setObjectName_) return;
    VkDebugUtilsObjectNameInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT};
    info.objectType = type;
    info.objectHandle = object;
    info.pObjectName = name;
    setObjectName_(device_, &info);
}

const char* resultName(VkResult result) {
    switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
        return "VK_ERROR_OUT_OF_HOST_MEMORY";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
        return "VK_ERROR_OUT_OF_DEVICE_MEMORY";
    case VK_ERROR_INITIALIZATION_FAILED:
        return "VK_ERROR_INITIALIZATION_FAILED";
    case VK_ERROR_DEVICE_LOST:
        return "VK_ERROR_DEVICE_LOST";
    case VK_ERROR_MEMORY_MAP_FAILED:
        return "VK_ERROR_MEMORY_MAP_FAILED";
    case VK_ERROR_LAYER_NOT_PRESENT:
        return "VK_ERROR_LAYER_NOT_PRESENT (is the validation layer installed?)";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
        return "VK_ERROR_EXTENSION_NOT_PRESENT";
    case VK_ERROR_FEATURE_NOT_PRESENT:
        return "VK_ERROR_FEATURE_NOT_PRESENT";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
        return "VK_ERROR_INCOMPATIBLE_DRIVER (no Vulkan driver installed?)";
    case VK_ERROR_TOO_MANY_OBJECTS:
        return "VK_ERROR_TOO_MANY_OBJECTS";
    case VK_ERROR_FORMAT_NOT_SUPPORTED:
        return "VK_ERROR_FORMAT_NOT_SUPPORTED";
    case VK_ERROR_FRAGMENTED_POOL:
        return "VK_ERROR_FRAGMENTED_POOL";
    case VK_ERROR_OUT_OF_POOL_MEMORY:
        return "VK_ERROR_OUT_OF_POOL_MEMORY";
    default:
        return "an unnamed VkResult";
    }
}

void failVulkan(const char* file, int line, const char* call, VkResult result) {
    throw DeviceError(fmt::format("{}:{}: {} failed with {} ({})", file, line, call, resultName(result),
                                  static_cast<int>(result)));
}

void failContract(const std::string& what) {
    throw std::logic_error(what);
}

} // namespace kilolux::gpu
