// Vulkan headers and the one way to check a call: a failing call throws DeviceError with file, line, call and
// result name, in every build. The command line turns it into exit code 3.
#pragma once

#include <stdexcept>
#include <string>
#include <vulkan/vulkan.h>

namespace kilolux::gpu {

class DeviceError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

const char* resultName(VkResult result);
[[noreturn]] void failVulkan(const char* file, int line, const char* call, VkResult result);

// Prefers the name in `what` over an assert: wrong names in a pass are programmer errors that must stop
// every build.
[[noreturn]] void failContract(const std::string& what);

} // namespace kilolux::gpu

#define KX_VK(call)                                                                                          \
    do {                                                                                                     \
        const VkResult kxResult = (call);                                                                    \
        if (kxResult < VK_SUCCESS) ::kilolux::gpu::failVulkan(__FILE__, __LINE__, #call, kxResult);          \
    } while (false)
