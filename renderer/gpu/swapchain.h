// The images that a window shows, made anew whenever its size changes. Knows the window's surface only.
#pragma once

#include "device.h"

namespace kilolux::gpu {

class Swapchain {
  public:
    struct Image {
        VkImage image = VK_NULL_HANDLE;
        VkImageView view = VK_NULL_HANDLE;
        VkFramebuffer framebuffer = VK_NULL_HANDLE;
        VkSemaphore drawn = VK_NULL_HANDLE; // to be signalled by what draws into it
    };
    static constexpr std::uint32_t kLeastImages = 2;

    // Chooses format and mode; makes no image yet. `surface` must outlive it. Throws DeviceError where the
    // device cannot present to it or it has no 8-bit format.
    Swapchain(Device& device, VkSurfaceKHR surface);
    ~Swapchain(); // waits for the device
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;

    VkFormat format() const { return format_.format; } // holds sRGB-encoded values
    VkExtent2D extentPx() const { return extentPx_; }  // of the images; 0 before the first

    // The next image, of the window's size, with a framebuffer of `renderPass`; `acquired` is signalled once
    // it may be drawn into. Null where the window has just changed: the next call will have one. What was
    // drawn before must have been waited for.
    const Image* acquire(VkExtent2D windowPx, VkRenderPass renderPass, VkSemaphore acquired);

    // Shows the image of the last acquire() as soon as its `drawn` is signalled.
    void present();

  private:
    void make(VkExtent2D windowPx, VkRenderPass renderPass);
    Image makeImage(VkImage handle, VkRenderPass renderPass) const;
    void dropImages();

    Device& device_;
    VkSurfaceKHR surface_;
    VkSurfaceFormatKHR format_{};
    VkPresentModeKHR presentMode_ = VK_PRESENT_MODE_FIFO_KHR;
    VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
    VkExtent2D extentPx_{};
    bool stale_ = true; // to be made anew by the next acquire()
    std::vector<Image> images_;
    std::uint32_t index_ = 0; // of the acquired one
};

} // namespace kilolux::gpu
