// Images that a window shows, see swapchain.h.
#include "swapchain.h"

#include <algorithm>
#include <fmt/format.h>

namespace kilolux::gpu {

Swapchain::Swapchain(Device& device, VkSurfaceKHR surface) : device_(device), surface_(surface) {
    VkBool32 presents = VK_FALSE;
    KX_VK(vkGetPhysicalDeviceSurfaceSupportKHR(device.physical(), device.queueFamily(), surface, &presents));
    if (!presents) throw DeviceError(fmt::format("device '{}' cannot present to this window", device.name()));
    std::uint32_t count = 0;
    KX_VK(vkGetPhysicalDeviceSurfaceFormatsKHR(device.physical(), surface, &count, nullptr));
    std::vector<VkSurfaceFormatKHR> formats(count);
    KX_VK(vkGetPhysicalDeviceSurfaceFormatsKHR(device.physical(), surface, &count, formats.data()));
    // Values are sRGB-encoded already, as are ImGui's colours.
    const auto wanted = std::find_if(formats.begin(), formats.end(), [](const VkSurfaceFormatKHR& f) {
        return f.format == VK_FORMAT_B8G8R8A8_UNORM || f.format == VK_FORMAT_R8G8B8A8_UNORM;
    });
    if (wanted == formats.end()) throw DeviceError("the window has no 8-bit format");
    format_ = *wanted;
    KX_VK(vkGetPhysicalDeviceSurfacePresentModesKHR(device.physical(), surface, &count, nullptr));
    std::vector<VkPresentModeKHR> modes(count);
    KX_VK(vkGetPhysicalDeviceSurfacePresentModesKHR(device.physical(), surface, &count, modes.data()));
    if (std::find(modes.begin(), modes.end(), VK_PRESENT_MODE_MAILBOX_KHR) != modes.end())
        presentMode_ = VK_PRESENT_MODE_MAILBOX_KHR;
}

Swapchain::~Swapchain() {
    vkDeviceWaitIdle(device_.handle());
    dropImages();
    if (swapchain_) vkDestroySwapchainKHR(device_.handle(), swapchain_, nullptr);
}

void Swapchain::dropImages() {
    for (const Image& image : images_) {
        vkDestroyFramebuffer(device_.handle(), image.framebuffer, nullptr);
        vkDestroyImageView(device_.handle(), image.view, nullptr);
        vkDestroySemaphore(device_.handle(), image.drawn, nullptr);
    }
    images_.clear();
}

Swapchain::Image Swapchain::makeImage(VkImage handle, VkRenderPass renderPass) const {
    Image image{handle};
    VkImageViewCreateInfo viewInfo{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    viewInfo.image = handle;
    viewInfo.viewType = VK_IMAGE_VIEW_TYPE_2D;
    viewInfo.format = format_.format;
    viewInfo.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    KX_VK(vkCreateImageView(device_.handle(), &viewInfo, nullptr, &image.view));
    VkFramebufferCreateInfo framebufferInfo{VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO};
    framebufferInfo.renderPass = renderPass;
    framebufferInfo.attachmentCount = 1;
    framebufferInfo.pAttachments = &image.view;
    framebufferInfo.width = extentPx_.width;
    framebufferInfo.height = extentPx_.height;
    framebufferInfo.layers = 1;
    KX_VK(vkCreateFramebuffer(device_.handle(), &framebufferInfo, nullptr, &image.framebuffer));
    const VkSemaphoreCreateInfo semaphoreInfo{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    KX_VK(vkCreateSemaphore(device_.handle(), &semaphoreInfo, nullptr, &image.drawn));
    return image;
}

void Swapchain::make(VkExtent2D windowPx, VkRenderPass renderPass) {
    vkDeviceWaitIdle(device_.handle());
    dropImages();
    VkSurfaceCapabilitiesKHR can{};
    KX_VK(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device_.physical(), surface_, &can));
    extentPx_ = can.currentExtent.width == UINT32_MAX ? windowPx : can.currentExtent;
    VkSwapchainCreateInfoKHR info{VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR};
    info.surface = surface_;
    info.minImageCount = std::max(kLeastImages, can.minImageCount);
    info.imageFormat = format_.format;
    info.imageColorSpace = format_.colorSpace;
    info.imageExtent = extentPx_;
    info.imageArrayLayers = 1;
    info.imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    info.preTransform = can.currentTransform;
    info.compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
    info.presentMode = presentMode_;
    info.clipped = VK_TRUE;
    info.oldSwapchain = swapchain_;
    VkSwapchainKHR made = VK_NULL_HANDLE;
    KX_VK(vkCreateSwapchainKHR(device_.handle(), &info, nullptr, &made));
    if (swapchain_) vkDestroySwapchainKHR(device_.handle(), swapchain_, nullptr);
    swapchain_ = made;
    std::uint32_t count = 0;
    KX_VK(vkGetSwapchainImagesKHR(device_.handle(), swapchain_, &count, nullptr));
    std::vector<VkImage> handles(count);
    KX_VK(vkGetSwapchainImagesKHR(device_.handle(), swapchain_, &count, handles.data()));
    for (VkImage handle : handles)
        images_.push_back(makeImage(handle, renderPass));
    stale_ = false;
}

const Swapchain::Image* Swapchain::acquire(VkExtent2D windowPx, VkRenderPass renderPass,
                                           VkSemaphore acquired) {
    if (stale_ || extentPx_.width != windowPx.width || extentPx_.height != windowPx.height)
        make(windowPx, renderPass);
    const VkResult got =
        vkAcquireNextImageKHR(device_.handle(), swapchain_, UINT64_MAX, acquired, VK_NULL_HANDLE, &index_);
    if (got == VK_ERROR_OUT_OF_DATE_KHR) {
        make(windowPx, renderPass); // the next frame draws into it
        return nullptr;
    }
    if (got != VK_SUBOPTIMAL_KHR) KX_VK(got);
    return &images_[index_];
}

void Swapchain::present() {
    VkPresentInfoKHR info{VK_STRUCTURE_TYPE_PRESENT_INFO_KHR};
    info.waitSemaphoreCount = 1;
    info.pWaitSemaphores = &images_[index_].drawn;
    info.swapchainCount = 1;
    info.pSwapchains = &swapchain_;
    info.pImageIndices = &index_;
    const VkResult shown = vkQueuePresentKHR(device_.queue(), &info);
    stale_ = shown == VK_ERROR_OUT_OF_DATE_KHR || shown == VK_SUBOPTIMAL_KHR;
    if (!stale_) KX_VK(shown);
}

} // namespace kilolux::gpu
