// Device and drawing of the window, see imgui_host.h.
#include "ui/imgui_host.h"

#include "renderer/gpu/resource.h"
#include "renderer/gpu/swapchain.h"
#include "ui/render_thread.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>
#include <backends/imgui_impl_vulkan.h>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <imgui.h>
#include <vector>

extern "C" VkResult glfwCreateWindowSurface(VkInstance instance, GLFWwindow* window,
                                            const VkAllocationCallbacks* allocator, VkSurfaceKHR* surface);

namespace kilolux {

namespace {

gpu::DeviceOptions presentingDevice() {
    gpu::DeviceOptions options;
    const char* validation = std::getenv("KILOLUX_VALIDATION");
    if (validation && *validation && *validation != '0') options.validation = gpu::Validation::On;
    if (const char* name = std::getenv("KILOLUX_DEVICE"); name && *name) options.nameContains = name;
    options.allowRayQuery = false;
    std::uint32_t count = 0;
    const char** needed = glfwGetRequiredInstanceExtensions(&count);
    for (std::uint32_t i = 0; i < count; ++i)
        options.instanceExtensions.push_back(needed[i]);
    options.deviceExtensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    return options;
}

void imageBarrier(VkCommandBuffer commands, VkImage image, VkImageLayout from, VkImageLayout to) {
    VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    // One queue and a handful of commands a frame: exact stages would gain nothing.
    barrier.srcStageMask = barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.imageMemoryBarrierCount = 1;
    info.pImageMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &info);
}

} // namespace

struct ImGuiHost::Impl {
    Impl() : device(presentingDevice()) {}
    ~Impl();

    gpu::Device device;
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    std::unique_ptr<gpu::Swapchain> swapchain;
    VkRenderPass renderPass = VK_NULL_HANDLE;
    VkDescriptorPool descriptors = VK_NULL_HANDLE;
    VkCommandPool pool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkFence fence = VK_NULL_HANDLE;
    VkSemaphore acquired = VK_NULL_HANDLE;
    bool imguiReady = false;

    gpu::Image picture;
    gpu::Buffer staging;
    glm::ivec2 picturePx{0};
    bool uploadPending = false;

    void prepare(GLFWwindow* window);
    void makeRenderPass();
    void makeObjects();
    void startImGui();
    void record(const gpu::Swapchain::Image& target, const ViewportRect& rect);
    void blitPicture(const gpu::Swapchain::Image& target, const ViewportRect& rect);
    std::optional<Error> present(glm::ivec2 windowPx, const ViewportRect& rect);
};

ImGuiHost::Impl::~Impl() {
    vkDeviceWaitIdle(device.handle());
    if (imguiReady) ImGui_ImplVulkan_Shutdown();
    swapchain.reset();
    if (renderPass) vkDestroyRenderPass(device.handle(), renderPass, nullptr);
    if (descriptors) vkDestroyDescriptorPool(device.handle(), descriptors, nullptr);
    if (pool) vkDestroyCommandPool(device.handle(), pool, nullptr);
    if (fence) vkDestroyFence(device.handle(), fence, nullptr);
    if (acquired) vkDestroySemaphore(device.handle(), acquired, nullptr);
    if (surface) vkDestroySurfaceKHR(device.instance(), surface, nullptr);
}

void ImGuiHost::Impl::prepare(GLFWwindow* window) {
    KX_VK(glfwCreateWindowSurface(device.instance(), window, nullptr, &surface));
    swapchain = std::make_unique<gpu::Swapchain>(device, surface);
    makeRenderPass();
    makeObjects();
    startImGui();
}

void ImGuiHost::Impl::makeRenderPass() {
    VkAttachmentDescription color{};
    color.format = swapchain->format();
    color.samples = VK_SAMPLE_COUNT_1_BIT;
    color.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD; // the picture lies below
    color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    color.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    color.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    color.initialLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    color.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &reference;
    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 1;
    info.pAttachments = &color;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    KX_VK(vkCreateRenderPass(device.handle(), &info, nullptr, &renderPass));
}

void ImGuiHost::Impl::makeObjects() {
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 4};
    VkDescriptorPoolCreateInfo descriptorInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    descriptorInfo.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
    descriptorInfo.maxSets = 4;
    descriptorInfo.poolSizeCount = 1;
    descriptorInfo.pPoolSizes = &size;
    KX_VK(vkCreateDescriptorPool(device.handle(), &descriptorInfo, nullptr, &descriptors));
    VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    poolInfo.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    poolInfo.queueFamilyIndex = device.queueFamily();
    KX_VK(vkCreateCommandPool(device.handle(), &poolInfo, nullptr, &pool));
    VkCommandBufferAllocateInfo bufferInfo{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    bufferInfo.commandPool = pool;
    bufferInfo.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    bufferInfo.commandBufferCount = 1;
    KX_VK(vkAllocateCommandBuffers(device.handle(), &bufferInfo, &commands));
    VkFenceCreateInfo fenceInfo{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    fenceInfo.flags = VK_FENCE_CREATE_SIGNALED_BIT;
    KX_VK(vkCreateFence(device.handle(), &fenceInfo, nullptr, &fence));
    const VkSemaphoreCreateInfo semaphoreInfo{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    KX_VK(vkCreateSemaphore(device.handle(), &semaphoreInfo, nullptr, &acquired));
}

void ImGuiHost::Impl::startImGui() {
    ImGui_ImplVulkan_InitInfo info{};
    info.Instance = device.instance();
    info.PhysicalDevice = device.physical();
    info.Device = device.handle();
    info.QueueFamily = device.queueFamily();
    info.Queue = device.queue();
    info.PipelineCache = device.pipelineCache();
    info.DescriptorPool = descriptors;
    info.MinImageCount = gpu::Swapchain::kLeastImages;
    // Vertex buffers of so many frames; one frame is in flight.
    info.ImageCount = gpu::Swapchain::kLeastImages;
    info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
    ImGui_ImplVulkan_Init(&info, renderPass);
    imguiReady = true;
}

void ImGuiHost::Impl::blitPicture(const gpu::Swapchain::Image& target, const ViewportRect& rect) {
    if (uploadPending) {
        imageBarrier(commands, picture.handle(), VK_IMAGE_LAYOUT_UNDEFINED,
                     VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        VkBufferImageCopy region{};
        region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        region.imageExtent = {std::uint32_t(picturePx.x), std::uint32_t(picturePx.y), 1};
        vkCmdCopyBufferToImage(commands, staging.handle(), picture.handle(),
                               VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
        imageBarrier(commands, picture.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                     VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        uploadPending = false;
    }
    // A picture of another shape, while its successor is on the way, keeps the viewport's height.
    const double shownWidth = rect.height * picturePx.x / picturePx.y;
    const double cut = std::max(0.5 * (1.0 - rect.width / shownWidth), 0.0); // share left out at each side
    const glm::ivec2 corner(int(rect.x + std::max(0.5 * (rect.width - shownWidth), 0.0)), int(rect.y));
    const glm::ivec2 wanted(int(std::lround(std::min(rect.width, shownWidth))), int(rect.height));
    const VkExtent2D extentPx = swapchain->extentPx();
    const glm::ivec2 end = glm::min(corner + wanted, glm::ivec2(extentPx.width, extentPx.height));
    if (end.x <= corner.x || end.y <= corner.y) return;
    VkImageBlit region{};
    region.srcSubresource = region.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.srcOffsets[0] = {int(std::lround(cut * picturePx.x)), 0, 0};
    region.srcOffsets[1] = {picturePx.x - region.srcOffsets[0].x, picturePx.y, 1};
    region.dstOffsets[0] = {corner.x, corner.y, 0};
    region.dstOffsets[1] = {end.x, end.y, 1};
    const bool sameSize = end - corner == picturePx;
    vkCmdBlitImage(commands, picture.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target.image,
                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region,
                   sameSize ? VK_FILTER_NEAREST : VK_FILTER_LINEAR);
}

void ImGuiHost::Impl::record(const gpu::Swapchain::Image& target, const ViewportRect& rect) {
    KX_VK(vkResetCommandBuffer(commands, 0));
    VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    KX_VK(vkBeginCommandBuffer(commands, &begin));
    imageBarrier(commands, target.image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    if (picture) blitPicture(target, rect);
    imageBarrier(commands, target.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                 VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    VkRenderPassBeginInfo pass{VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO};
    pass.renderPass = renderPass;
    pass.framebuffer = target.framebuffer;
    pass.renderArea.extent = swapchain->extentPx();
    vkCmdBeginRenderPass(commands, &pass, VK_SUBPASS_CONTENTS_INLINE);
    ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), commands);
    vkCmdEndRenderPass(commands);
    KX_VK(vkEndCommandBuffer(commands));
}

std::optional<Error> ImGuiHost::Impl::present(glm::ivec2 windowPx, const ViewportRect& rect) {
    if (windowPx.x <= 0 || windowPx.y <= 0) return std::nullopt;
    KX_VK(vkWaitForFences(device.handle(), 1, &fence, VK_TRUE, UINT64_MAX));
    const gpu::Swapchain::Image* target =
        swapchain->acquire({std::uint32_t(windowPx.x), std::uint32_t(windowPx.y)}, renderPass, acquired);
    if (!target) return std::nullopt;
    record(*target, rect);
    KX_VK(vkResetFences(device.handle(), 1, &fence));
    const VkPipelineStageFlags stage = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
    VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    submit.waitSemaphoreCount = 1;
    submit.pWaitSemaphores = &acquired;
    submit.pWaitDstStageMask = &stage;
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands;
    submit.signalSemaphoreCount = 1;
    submit.pSignalSemaphores = &target->drawn;
    KX_VK(vkQueueSubmit(device.queue(), 1, &submit, fence));
    swapchain->present();
    const std::vector<std::string> messages = device.takeValidationMessages();
    if (!messages.empty()) return Error{fmt::format("Vulkan validation: {}", messages.front())};
    return std::nullopt;
}

// --- ImGuiHost -------------------------------------------------------------------------------------------

ImGuiHost::ImGuiHost(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ImGuiHost::~ImGuiHost() = default;

Result<std::unique_ptr<ImGuiHost>> ImGuiHost::create(GLFWwindow* window) {
    try {
        auto impl = std::make_unique<Impl>();
        impl->prepare(window);
        return std::unique_ptr<ImGuiHost>(new ImGuiHost(std::move(impl)));
    } catch (const gpu::DeviceError& error) {
        return Error{error.what()};
    }
}

bool ImGuiHost::isSoftware() const {
    return impl_->device.isCpu();
}

std::optional<Error> ImGuiHost::uploadFonts() {
    try {
        Impl& impl = *impl_;
        KX_VK(vkWaitForFences(impl.device.handle(), 1, &impl.fence, VK_TRUE, UINT64_MAX));
        KX_VK(vkResetCommandBuffer(impl.commands, 0));
        VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
        KX_VK(vkBeginCommandBuffer(impl.commands, &begin));
        ImGui_ImplVulkan_CreateFontsTexture(impl.commands);
        KX_VK(vkEndCommandBuffer(impl.commands));
        impl.device.submitAndWait({impl.commands});
        ImGui_ImplVulkan_DestroyFontUploadObjects();
        return std::nullopt;
    } catch (const gpu::DeviceError& error) {
        return Error{error.what()};
    }
}

void ImGuiHost::setPicture(const ShownFrame* frame) {
    Impl& impl = *impl_;
    KX_VK(vkWaitForFences(impl.device.handle(), 1, &impl.fence, VK_TRUE, UINT64_MAX));
    if (!frame) {
        impl.picture = {};
        impl.uploadPending = false;
        return;
    }
    const glm::ivec2 size(frame->width, frame->height);
    if (!impl.picture || size != impl.picturePx) {
        impl.picture =
            gpu::Image(impl.device, {"shown picture", VK_FORMAT_R8G8B8A8_UNORM, std::uint32_t(size.x),
                                     std::uint32_t(size.y), 1, 1, 1, false, VK_IMAGE_USAGE_SAMPLED_BIT});
        impl.staging =
            gpu::Buffer(impl.device, {"shown picture", frame->rgba8.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                      gpu::MemoryUse::HostWrite, "staging"});
        impl.picturePx = size;
    }
    impl.staging.upload(std::span(frame->rgba8));
    impl.uploadPending = true;
}

std::optional<Error> ImGuiHost::present(glm::ivec2 windowPx, const ViewportRect& rect) {
    try {
        return impl_->present(windowPx, rect);
    } catch (const gpu::DeviceError& error) {
        return Error{error.what()};
    }
}

} // namespace kilolux
