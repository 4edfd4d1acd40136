// Which barriers the declared uses of resources need, see Commands::use(): none where what a use reads has
// been made visible to it, otherwise one merged memory barrier and one barrier for each image that changes
// its layout.
#include "commands.h"

namespace kilolux::gpu {

namespace {

struct UsageInfo {
    VkPipelineStageFlags2 stage;
    VkAccessFlags2 read;
    VkAccessFlags2 write;
    VkImageLayout layout;
};

constexpr VkPipelineStageFlags2 kGraphicsShaders =
    VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;

UsageInfo usageInfo(Usage usage) {
    constexpr auto compute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    constexpr auto build = VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR;
    constexpr auto storageRead = VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
    constexpr auto storageWrite = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    constexpr auto general = VK_IMAGE_LAYOUT_GENERAL;
    switch (usage) {
    case Usage::ComputeSampled:
        return {compute, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, 0, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    case Usage::ComputeStorageRead:
        return {compute, storageRead, 0, general};
    case Usage::ComputeStorageWrite:
        return {compute, 0, storageWrite, general};
    case Usage::ComputeStorageReadWrite:
        return {compute, storageRead, storageWrite, general};
    case Usage::ComputeUniform:
        return {compute, VK_ACCESS_2_UNIFORM_READ_BIT, 0, general};
    case Usage::ComputeAccelerationStructure:
        return {compute, VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR, 0, general};
    case Usage::GraphicsSampled:
        return {kGraphicsShaders, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, 0,
                VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    case Usage::GraphicsStorageRead:
        return {kGraphicsShaders, storageRead, 0, general};
    case Usage::GraphicsUniform:
        return {kGraphicsShaders, VK_ACCESS_2_UNIFORM_READ_BIT, 0, general};
    case Usage::ColorAttachment:
        return {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT,
                VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    case Usage::DepthAttachment:
        return {VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
                VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
                VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    case Usage::IndexRead:
        return {VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT, VK_ACCESS_2_INDEX_READ_BIT, 0, general};
    case Usage::IndirectRead:
        return {VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, 0, general};
    case Usage::TransferRead:
        return {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT, 0,
                VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
    case Usage::TransferWrite:
        return {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, 0, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL};
    case Usage::AccelerationBuildRead:
        return {build, VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR, 0,
                general};
    case Usage::AccelerationBuildWrite:
        return {build, VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR,
                VK_ACCESS_2_ACCELERATION_STRUCTURE_WRITE_BIT_KHR, general};
    }
    failContract("unknown Usage");
}

} // namespace

bool Commands::dropBarriersForTest = false;

void Commands::need(AccessState& state, Usage usage, const Image* image, std::uint32_t mip) {
    const UsageInfo info = usageInfo(usage);
    const bool relayout = image && state.layout != info.layout;
    const bool writes = info.write != 0 || relayout;
    VkPipelineStageFlags2 sourceStage = 0;
    VkAccessFlags2 sourceAccess = 0;
    if (writes) {
        sourceStage = state.writeStage | state.readStages;
        sourceAccess = state.writeAccess;
    } else if (state.writeStage &&
               ((info.stage & ~state.visibleStages) || (info.read & ~state.visibleAccess))) {
        sourceStage = state.writeStage;
        sourceAccess = state.writeAccess;
    }
    if (relayout) {
        VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
        barrier.srcStageMask = sourceStage;
        barrier.srcAccessMask = sourceAccess;
        barrier.dstStageMask = info.stage;
        barrier.dstAccessMask = info.read | info.write;
        barrier.oldLayout = state.layout;
        barrier.newLayout = info.layout;
        barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.image = image->handle();
        barrier.subresourceRange = {image->aspect(), mip, 1, 0, image->desc().layers};
        imageBarriers_.push_back(barrier);
    } else if (sourceStage) {
        memoryBarrier_.srcStageMask |= sourceStage;
        memoryBarrier_.srcAccessMask |= sourceAccess;
        memoryBarrier_.dstStageMask |= info.stage;
        memoryBarrier_.dstAccessMask |= info.read | info.write;
    }
    if (writes) {
        state.writeStage = info.stage;
        state.writeAccess = info.write;
        state.readStages = info.write ? 0 : info.stage;
        state.visibleStages = info.write ? 0 : info.stage;
        state.visibleAccess = info.write ? 0 : info.read;
    } else {
        state.readStages |= info.stage;
        state.visibleStages |= info.stage;
        state.visibleAccess |= info.read;
    }
    if (image) state.layout = info.layout;
}

void Commands::use(const Buffer& buffer, Usage usage) {
    need(buffer.state(), usage, nullptr, 0);
}

void Commands::use(const Image& image, std::uint32_t mip, Usage usage) {
    need(image.state(mip), usage, &image, mip);
}

void Commands::use(const Image& image, Usage usage) {
    for (std::uint32_t mip = 0; mip < image.desc().mips; ++mip)
        use(image, mip, usage);
}

void Commands::flushBarriers() {
    const bool memory = memoryBarrier_.srcStageMask != 0;
    if ((memory || !imageBarriers_.empty()) && !(dropBarriersForTest && imageBarriers_.empty())) {
        VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
        info.memoryBarrierCount = memory ? 1 : 0;
        info.pMemoryBarriers = &memoryBarrier_;
        info.imageMemoryBarrierCount = std::uint32_t(imageBarriers_.size());
        info.pImageMemoryBarriers = imageBarriers_.data();
        vkCmdPipelineBarrier2(handle(), &info);
    }
    imageBarriers_.clear();
    memoryBarrier_ = {VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
}

} // namespace kilolux::gpu
