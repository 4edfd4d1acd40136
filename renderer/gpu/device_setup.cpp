// Set-up of a device: instance with validation, choice among the devices there are, queue, features and entry
// points; see device.h.
#include "device.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>

namespace kilolux::gpu {

namespace {

// Passes whose workgroup is one subgroup give each lane at least one pixel of an 8 x 8 tile.
constexpr std::uint32_t kMostLanes = 64;

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

// The first queue family for graphics and compute.
std::uint32_t chooseQueueFamily(VkPhysicalDevice device) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    const VkQueueFlags wanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    const auto family = std::find_if(families.begin(), families.end(), [&](const auto& candidate) {
        return (candidate.queueFlags & wanted) == wanted;
    });
    if (family == families.end()) throw DeviceError("the device has no queue for graphics and compute");
    return std::uint32_t(family - families.begin());
}

// Features as the chain that Vulkan reads them from; `first` leads it.
struct FeatureChain {
    VkPhysicalDeviceFeatures2 first{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    VkPhysicalDeviceVulkan12Features of12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    VkPhysicalDeviceVulkan13Features of13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    VkPhysicalDeviceAccelerationStructureFeaturesKHR acceleration{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR};
    VkPhysicalDeviceRayQueryFeaturesKHR rayQuery{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR};

    FeatureChain() {
        first.pNext = &of12;
        of12.pNext = &of13;
    }
    FeatureChain(const FeatureChain&) = delete;
    FeatureChain& operator=(const FeatureChain&) = delete;
};

// What the device can of what could be asked for. Errors: it lacks what the project needs.
void readSupport(VkPhysicalDevice device, FeatureChain& supported) {
    vkGetPhysicalDeviceFeatures2(device, &supported.first);
    // Storage images of two channels (rg32ui, rg32f) are among the extended formats.
    if (!supported.first.features.shaderStorageImageExtendedFormats) {
        throw DeviceError("the device lacks shaderStorageImageExtendedFormats");
    }
    if (!supported.of12.scalarBlockLayout) throw DeviceError("the device lacks scalarBlockLayout");
}

void enableFeatures(const FeatureChain& supported, bool rayQuery, bool subgroupSizes, FeatureChain& enabled) {
    enabled.of13.synchronization2 = VK_TRUE;
    enabled.of13.dynamicRendering = VK_TRUE;
    enabled.of13.maintenance4 = VK_TRUE;
    enabled.of13.subgroupSizeControl = subgroupSizes ? VK_TRUE : VK_FALSE;
    enabled.of13.computeFullSubgroups = subgroupSizes ? VK_TRUE : VK_FALSE;
    enabled.of12.scalarBlockLayout = VK_TRUE;
    enabled.of12.hostQueryReset = VK_TRUE;
    enabled.of12.timelineSemaphore = VK_TRUE;
    enabled.of12.bufferDeviceAddress = rayQuery ? VK_TRUE : VK_FALSE;
    const VkPhysicalDeviceFeatures& can = supported.first.features;
    VkPhysicalDeviceFeatures& features = enabled.first.features;
    features.independentBlend = VK_TRUE;
    features.geometryShader = can.geometryShader;
    features.shaderStorageImageExtendedFormats = can.shaderStorageImageExtendedFormats;
    features.samplerAnisotropy = can.samplerAnisotropy;
    // GPU-assisted validation writes from every stage.
    features.fragmentStoresAndAtomics = can.fragmentStoresAndAtomics;
    features.vertexPipelineStoresAndAtomics = can.vertexPipelineStoresAndAtomics;
    if (!rayQuery) return;
    enabled.of13.pNext = &enabled.acceleration;
    enabled.acceleration.pNext = &enabled.rayQuery;
    enabled.acceleration.accelerationStructure = VK_TRUE;
    enabled.rayQuery.rayQuery = VK_TRUE;
}

} // namespace

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
    subgroupSize_ = std::min(subgroup.subgroupSize, kMostLanes);
    canRequireSubgroupSize_ = (sizes.requiredSubgroupSizeStages & VK_SHADER_STAGE_COMPUTE_BIT) &&
                              sizes.minSubgroupSize <= subgroupSize_ &&
                              subgroupSize_ <= sizes.maxSubgroupSize;
    // lavapipe before Mesa 23 writes timestamps when the command is read, not when the work before it ends.
    const bool oldLavapipe = driver.driverID == VK_DRIVER_ID_MESA_LLVMPIPE &&
                             std::string_view(driver.driverInfo).find("Mesa 22.") != std::string_view::npos;
    hasReliableTimestamps_ = properties_.limits.timestampComputeAndGraphics && !oldLavapipe;
}

void Device::createDevice() {
    queueFamily_ = chooseQueueFamily(physicalDevice_);
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
    FeatureChain supported, enabled;
    readSupport(physicalDevice_, supported);
    canRequireSubgroupSize_ =
        canRequireSubgroupSize_ && supported.of13.subgroupSizeControl && supported.of13.computeFullSubgroups;
    hasGeometryShader_ = supported.first.features.geometryShader;
    enableFeatures(supported, hasRayQuery_, canRequireSubgroupSize_, enabled);

    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queueInfo{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queueInfo.queueFamilyIndex = queueFamily_;
    queueInfo.queueCount = 1;
    queueInfo.pQueuePriorities = &priority;
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    info.pNext = &enabled.first;
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

} // namespace kilolux::gpu
