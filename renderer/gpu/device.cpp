// Device set-up, see device.h.
#include "device.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <utility>

namespace kilolux::gpu {

namespace {

VKAPI_ATTR VkBool32 VKAPI_CALL onValidationMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                                   VkDebugUtilsMessageTypeFlagsEXT,
                                                   const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                   void* user) {
    const std::string_view message = data->pMessage ? data->pMessage : "?";
    // What GPU-assisted validation says of its own set-up is no finding.
    const bool setup = message.find("GPU-Assisted Validation Setup") != std::string_view::npos ||
                       message.find("vkCreateDevice: Internal Warning") != std::string_view::npos;
    if (!setup) static_cast<Device*>(user)->addValidationMessage(std::string(message));
    return VK_FALSE;
}

bool hasExtension(const std::vector<VkExtensionProperties>& list, const char* name) {
    return std::any_of(list.begin(), list.end(),
                       [name](const auto& entry) { return std::strcmp(entry.extensionName, name) == 0; });
}

std::vector<VkExtensionProperties> deviceExtensions(VkPhysicalDevice device) {
    std::uint32_t count = 0;
    vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> list(count);
    vkEnumerateDeviceExtensionProperties(device, nullptr, &count, list.data());
    return list;
}

// Higher is preferred; negative cannot be used at all.
int scoreDevice(const VkPhysicalDeviceProperties& properties) {
    if (properties.apiVersion < VK_API_VERSION_1_3) return -1;
    switch (properties.deviceType) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return 4;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return 3;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return 2;
    default:
        return 1;
    }
}

} // namespace

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

void Device::createInstance() {
    const bool validate = options_.validation != Validation::Off;
    const bool gpuAssisted = options_.validation == Validation::GpuAssisted;
    std::vector<const char*> layers, extensions = options_.instanceExtensions;
    std::uint32_t count = 0;
    vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> available(count);
    vkEnumerateInstanceExtensionProperties(nullptr, &count, available.data());
    hasDebugUtils_ = hasExtension(available, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    if (hasDebugUtils_) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    if (validate) layers.push_back("VK_LAYER_KHRONOS_validation");

    // Hazards across submits are a switch of the layer, not of the extension; it reads this variable.
    if (validate && !gpuAssisted) {
        setenv("VK_LAYER_ENABLES", "VALIDATION_CHECK_ENABLE_SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT", 0);
    }
    const VkValidationFeatureEnableEXT enables[] = {
        gpuAssisted ? VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_EXT
                    : VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT,
        VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_RESERVE_BINDING_SLOT_EXT};
    VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
    features.enabledValidationFeatureCount = gpuAssisted ? 2 : 1;
    features.pEnabledValidationFeatures = enables;

    VkDebugUtilsMessengerCreateInfoEXT messenger{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    messenger.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType =
        VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    messenger.pfnUserCallback = onValidationMessage;
    messenger.pUserData = this;

    VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.pApplicationName = "Kilolux";
    application.apiVersion = VK_API_VERSION_1_3;
    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    info.pNext = validate ? &features : nullptr;
    info.pApplicationInfo = &application;
    info.enabledLayerCount = std::uint32_t(layers.size());
    info.ppEnabledLayerNames = layers.data();
    info.enabledExtensionCount = std::uint32_t(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    KX_VK(vkCreateInstance(&info, nullptr, &instance_));
    if (validate && hasDebugUtils_) {
        auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
        KX_VK(create(instance_, &messenger, nullptr, &messenger_));
    }
}

void Device::choosePhysicalDevice() {
    std::uint32_t count = 0;
    KX_VK(vkEnumeratePhysicalDevices(instance_, &count, nullptr));
    std::vector<VkPhysicalDevice> devices(count);
    KX_VK(vkEnumeratePhysicalDevices(instance_, &count, devices.data()));
    int bestScore = -1;
    std::string seen;
    for (VkPhysicalDevice candidate : devices) {
        VkPhysicalDeviceProperties properties;
        vkGetPhysicalDeviceProperties(candidate, &properties);
        seen += fmt::format("{}'{}'", seen.empty() ? "" : ", ", properties.deviceName);
        const bool wanted =
            options_.nameContains.empty() ||
            std::string_view(properties.deviceName).find(options_.nameContains) != std::string_view::npos;
        const int score = scoreDevice(properties);
        if (wanted && score > bestScore) {
            bestScore = score;
            physicalDevice_ = candidate;
            properties_ = properties;
        }
    }
    if (bestScore < 0) {
        throw DeviceError(fmt::format("no Vulkan 1.3 device{}; found: {}",
                                      options_.nameContains.empty()
                                          ? std::string{}
                                          : fmt::format(" whose name has '{}'", options_.nameContains),
                                      seen.empty() ? "none" : seen));
    }
    VkPhysicalDeviceSubgroupProperties subgroup{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES};
    VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    VkPhysicalDeviceSubgroupSizeControlProperties sizes{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_PROPERTIES};
    subgroup.pNext = &sizes;
    driver.pNext = &subgroup;
    VkPhysicalDeviceProperties2 properties2{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    properties2.pNext = &driver;
    vkGetPhysicalDeviceProperties2(physicalDevice_, &properties2);
    driver_ = fmt::format("{} {}", driver.driverName, driver.driverInfo);
    subgroupSize_ = subgroup.subgroupSize;
    canRequireSubgroupSize_ = (sizes.requiredSubgroupSizeStages & VK_SHADER_STAGE_COMPUTE_BIT) &&
                              sizes.minSubgroupSize <= subgroupSize_ &&
                              subgroupSize_ <= sizes.maxSubgroupSize;
    // lavapipe before Mesa 23 writes timestamps when the command is read, not when the work before it ends.
    const bool oldLavapipe = driver.driverID == VK_DRIVER_ID_MESA_LLVMPIPE &&
                             std::string_view(driver.driverInfo).find("Mesa 22.") != std::string_view::npos;
    hasReliableTimestamps_ = properties_.limits.timestampComputeAndGraphics && !oldLavapipe;
}

void Device::createDevice() {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physicalDevice_, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physicalDevice_, &count, families.data());
    const VkQueueFlags wanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    const auto family = std::find_if(families.begin(), families.end(), [&](const auto& candidate) {
        return (candidate.queueFlags & wanted) == wanted;
    });
    if (family == families.end()) throw DeviceError("the device has no queue for graphics and compute");
    queueFamily_ = std::uint32_t(family - families.begin());

    const std::vector<VkExtensionProperties> available = deviceExtensions(physicalDevice_);
    std::vector<const char*> extensions = options_.deviceExtensions;
    hasRayQuery_ = options_.allowRayQuery && hasExtension(available, VK_KHR_RAY_QUERY_EXTENSION_NAME) &&
                   hasExtension(available, VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME) &&
                   hasExtension(available, VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME);
    if (hasRayQuery_) {
        extensions.insert(extensions.end(),
                          {VK_KHR_RAY_QUERY_EXTENSION_NAME, VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                           VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME});
    }

    VkPhysicalDeviceRayQueryFeaturesKHR rayQuery{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR};
    rayQuery.rayQuery = VK_TRUE;
    VkPhysicalDeviceAccelerationStructureFeaturesKHR acceleration{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR};
    acceleration.pNext = &rayQuery;
    acceleration.accelerationStructure = VK_TRUE;

    VkPhysicalDeviceVulkan13Features supported13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    VkPhysicalDeviceVulkan12Features supported12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    supported12.pNext = &supported13;
    VkPhysicalDeviceFeatures2 supported{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    supported.pNext = &supported12;
    vkGetPhysicalDeviceFeatures2(physicalDevice_, &supported);
    // Storage images of two channels (rg32ui, rg32f) are among the extended formats.
    if (!supported.features.shaderStorageImageExtendedFormats) {
        throw DeviceError("the device lacks shaderStorageImageExtendedFormats");
    }
    canRequireSubgroupSize_ = canRequireSubgroupSize_ && supported13.subgroupSizeControl;
    if (!supported12.scalarBlockLayout) throw DeviceError("the device lacks scalarBlockLayout");

    VkPhysicalDeviceVulkan13Features features13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    features13.pNext = hasRayQuery_ ? &acceleration : nullptr;
    features13.synchronization2 = VK_TRUE;
    features13.dynamicRendering = VK_TRUE;
    features13.maintenance4 = VK_TRUE;
    features13.subgroupSizeControl = canRequireSubgroupSize_ ? VK_TRUE : VK_FALSE;
    VkPhysicalDeviceVulkan12Features features12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    features12.pNext = &features13;
    features12.scalarBlockLayout = VK_TRUE;
    features12.hostQueryReset = VK_TRUE;
    features12.timelineSemaphore = VK_TRUE;
    features12.bufferDeviceAddress = hasRayQuery_ ? VK_TRUE : VK_FALSE;
    VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    features.pNext = &features12;
    features.features.independentBlend = VK_TRUE;
    hasGeometryShader_ = supported.features.geometryShader;
    features.features.geometryShader = supported.features.geometryShader;
    features.features.shaderStorageImageExtendedFormats =
        supported.features.shaderStorageImageExtendedFormats;
    features.features.samplerAnisotropy = supported.features.samplerAnisotropy;
    // GPU-assisted validation writes from every stage.
    features.features.fragmentStoresAndAtomics = supported.features.fragmentStoresAndAtomics;
    features.features.vertexPipelineStoresAndAtomics = supported.features.vertexPipelineStoresAndAtomics;

    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queueInfo{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queueInfo.queueFamilyIndex = queueFamily_;
    queueInfo.queueCount = 1;
    queueInfo.pQueuePriorities = &priority;
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    info.pNext = &features;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queueInfo;
    info.enabledExtensionCount = std::uint32_t(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    KX_VK(vkCreateDevice(physicalDevice_, &info, nullptr, &device_));
    vkGetDeviceQueue(device_, queueFamily_, 0, &queue_);
}

void Device::loadEntryPoints() {
    const auto load = [this](auto& pointer, const char* name) {
        pointer =
            reinterpret_cast<std::remove_reference_t<decltype(pointer)>>(vkGetDeviceProcAddr(device_, name));
    };
    if (hasDebugUtils_) {
        load(setObjectName_, "vkSetDebugUtilsObjectNameEXT");
        load(cmdBeginLabel, "vkCmdBeginDebugUtilsLabelEXT");
        load(cmdEndLabel, "vkCmdEndDebugUtilsLabelEXT");
    }
    if (hasRayQuery_) {
        load(createAccelerationStructure, "vkCreateAccelerationStructureKHR");
        load(destroyAccelerationStructure, "vkDestroyAccelerationStructureKHR");
        load(getAccelerationStructureBuildSizes, "vkGetAccelerationStructureBuildSizesKHR");
        load(cmdBuildAccelerationStructures, "vkCmdBuildAccelerationStructuresKHR");
        load(getAccelerationStructureDeviceAddress, "vkGetAccelerationStructureDeviceAddressKHR");
    }
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
