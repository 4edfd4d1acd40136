// Recording, copies, timers and captures, see commands.h; barriers are in barriers.cpp.
#include "commands.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>

namespace kilolux::gpu {

namespace {

constexpr std::uint32_t kMaxQueries = 2048;
constexpr std::uint32_t kSetsPerPool = 128;

double nowMs() {
    using namespace std::chrono;
    return duration<double, std::milli>(steady_clock::now().time_since_epoch()).count();
}

} // namespace

void PassTimes::add(std::string_view name, double ms) {
    for (Entry& entry : entries_) {
        if (entry.name == name) {
            entry.ms.push_back(ms);
            return;
        }
    }
    entries_.push_back({std::string(name), {ms}});
}

double PassTimes::newestMs(std::string_view name) const {
    for (const Entry& entry : entries_)
        if (entry.name == name) return entry.ms.back();
    return 0.0;
}

void PassTimes::keepNewest(std::size_t count) {
    for (Entry& entry : entries_)
        if (entry.ms.size() > count) entry.ms.erase(entry.ms.begin(), entry.ms.end() - std::ptrdiff_t(count));
}

Commands::Commands(Device& device, PassTimes* times) : device_(device), times_(times) {
    VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    poolInfo.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    poolInfo.queueFamilyIndex = device.queueFamily();
    KX_VK(vkCreateCommandPool(device.handle(), &poolInfo, nullptr, &pool_));
    if (times && device.hasReliableTimestamps()) {
        VkQueryPoolCreateInfo queryInfo{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
        queryInfo.queryType = VK_QUERY_TYPE_TIMESTAMP;
        queryInfo.queryCount = kMaxQueries;
        KX_VK(vkCreateQueryPool(device.handle(), &queryInfo, nullptr, &queries_));
        vkResetQueryPool(device.handle(), queries_, 0, kMaxQueries);
    }
}

Commands::~Commands() {
    for (VkDescriptorPool pool : descriptorPools_)
        vkDestroyDescriptorPool(device_.handle(), pool, nullptr);
    if (queries_) vkDestroyQueryPool(device_.handle(), queries_, nullptr);
    vkDestroyCommandPool(device_.handle(), pool_, nullptr);
}

VkCommandBuffer Commands::handle() {
    if (!open_) openBuffer();
    return open_;
}

void Commands::openBuffer() {
    VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    info.commandPool = pool_;
    info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    info.commandBufferCount = 1;
    KX_VK(vkAllocateCommandBuffers(device_.handle(), &info, &open_));
    VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    KX_VK(vkBeginCommandBuffer(open_, &begin));
}

void Commands::closeBuffer() {
    if (!open_) return;
    KX_VK(vkEndCommandBuffer(open_));
    recorded_.push_back(open_);
    open_ = VK_NULL_HANDLE;
}

void Commands::beginPass(std::string_view name) {
    if (inPass_) failContract(fmt::format("pass '{}' begins inside another", name));
    inPass_ = true;
    passName_ = name;
    if (tellPass_) tellPass_(passName_);
    if (times_ && !queries_) submitOpen(); // wall timing: nothing before may run inside this pass
    if (device_.options().commandBufferPerPass) closeBuffer();
    const std::string label(name);
    if (device_.cmdBeginLabel) {
        VkDebugUtilsLabelEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT};
        info.pLabelName = label.c_str();
        device_.cmdBeginLabel(handle(), &info);
    }
    if (!times_) return;
    timers_.push_back({label, queryCount_, nowMs()});
    if (!queries_) return;
    if (queryCount_ + 2 > kMaxQueries) failContract("more passes than timers in one submission");
    vkCmdWriteTimestamp2(handle(), VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_, queryCount_++);
}

void Commands::endPass() {
    inPass_ = false;
    if (times_ && queries_) {
        vkCmdWriteTimestamp2(handle(), VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_, queryCount_++);
    }
    if (device_.cmdEndLabel) device_.cmdEndLabel(handle());
    if (times_ && !queries_) {
        submitOpen();
        times_->add(timers_.back().name, nowMs() - timers_.back().startMs);
        timers_.clear();
    }
    if (sliceMs_ <= 0.0) return;
    // A pass that has never run may have to be compiled: it is a slice of its own.
    const double knownMs = times_ ? times_->newestMs(passName_) : 0.0;
    openedMs_ += knownMs > 0.0 ? knownMs : sliceMs_;
    if (openedMs_ < sliceMs_) return;
    submitOpen();
    openedMs_ = 0.0;
    if (interrupt_ && *interrupt_) throw Interrupted();
}

void Commands::copyBuffer(const Buffer& from, VkDeviceSize fromOffset, const Buffer& to,
                          VkDeviceSize toOffset, VkDeviceSize bytes) {
    use(from, Usage::TransferRead);
    use(to, Usage::TransferWrite);
    flushBarriers();
    const VkBufferCopy region{fromOffset, toOffset, bytes};
    vkCmdCopyBuffer(handle(), from.handle(), to.handle(), 1, &region);
}

namespace {
VkBufferImageCopy wholeMip(const Image& image, std::uint32_t mip, std::uint32_t layer, VkDeviceSize offset) {
    VkBufferImageCopy region{};
    region.bufferOffset = offset;
    region.imageSubresource = {image.aspect(), mip, layer, 1};
    const ImageDesc& desc = image.desc();
    region.imageExtent = {std::max(1u, desc.width >> mip), std::max(1u, desc.height >> mip),
                          std::max(1u, desc.depth >> mip)};
    return region;
}
} // namespace

void Commands::copyBufferToImage(const Buffer& from, VkDeviceSize offset, const Image& to, std::uint32_t mip,
                                 std::uint32_t layer) {
    use(from, Usage::TransferRead);
    use(to, mip, Usage::TransferWrite);
    flushBarriers();
    const VkBufferImageCopy region = wholeMip(to, mip, layer, offset);
    vkCmdCopyBufferToImage(handle(), from.handle(), to.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
                           &region);
}

void Commands::copyImageToBuffer(const Image& from, std::uint32_t mip, std::uint32_t layer, const Buffer& to,
                                 VkDeviceSize offset) {
    use(from, mip, Usage::TransferRead);
    use(to, Usage::TransferWrite);
    flushBarriers();
    const VkBufferImageCopy region = wholeMip(from, mip, layer, offset);
    vkCmdCopyImageToBuffer(handle(), from.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to.handle(), 1,
                           &region);
}

void Commands::clearColor(const Image& image, const VkClearColorValue& value) {
    use(image, Usage::TransferWrite);
    flushBarriers();
    const VkImageSubresourceRange range{image.aspect(), 0, image.desc().mips, 0, image.desc().layers};
    vkCmdClearColorImage(handle(), image.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &value, 1, &range);
}

void Commands::fillBuffer(const Buffer& buffer, std::uint32_t value) {
    use(buffer, Usage::TransferWrite);
    flushBarriers();
    vkCmdFillBuffer(handle(), buffer.handle(), 0, VK_WHOLE_SIZE, value);
}

VkDescriptorSet Commands::allocateSet(VkDescriptorSetLayout layout) {
    if (descriptorPools_.empty() || setsInPool_ == kSetsPerPool) {
        std::vector<VkDescriptorPoolSize> sizes;
        for (const VkDescriptorType type :
             {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE,
              VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER,
              VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
              VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_SAMPLER}) {
            sizes.push_back({type, kSetsPerPool * 12});
        }
        if (device_.hasRayQuery())
            sizes.push_back({VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR, kSetsPerPool});
        VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
        info.maxSets = kSetsPerPool;
        info.poolSizeCount = std::uint32_t(sizes.size());
        info.pPoolSizes = sizes.data();
        VkDescriptorPool pool;
        KX_VK(vkCreateDescriptorPool(device_.handle(), &info, nullptr, &pool));
        descriptorPools_.push_back(pool);
        setsInPool_ = 0;
    }
    VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    info.descriptorPool = descriptorPools_.back();
    info.descriptorSetCount = 1;
    info.pSetLayouts = &layout;
    VkDescriptorSet set;
    KX_VK(vkAllocateDescriptorSets(device_.handle(), &info, &set));
    ++setsInPool_;
    return set;
}

void Commands::capture(std::string_view name, const Image& image, std::uint32_t mip) {
    const ImageDesc& desc = image.desc();
    PendingCapture pending;
    pending.result = {std::string(name),
                      desc.format,
                      std::max(1u, desc.width >> mip),
                      std::max(1u, desc.height >> mip),
                      {}};
    const VkDeviceSize bytes =
        VkDeviceSize(pending.result.width) * pending.result.height * texelBytes(desc.format);
    pending.staging = Buffer(
        device_, {"capture", bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryUse::HostReadback, "readback"});
    copyImageToBuffer(image, mip, 0, pending.staging, 0);
    keepCapture(std::move(pending));
}

void Commands::capture(std::string_view name, const Buffer& buffer) {
    PendingCapture pending;
    pending.result.name = name;
    pending.staging = Buffer(device_, {"capture", buffer.bytes(), VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                       MemoryUse::HostReadback, "readback"});
    copyBuffer(buffer, 0, pending.staging, 0, buffer.bytes());
    keepCapture(std::move(pending));
}

void Commands::keepCapture(PendingCapture capture) {
    for (PendingCapture& other : captures_) {
        if (other.result.name != capture.result.name) continue;
        std::swap(other, capture);
        replacedCaptures_.push_back(std::move(capture));
        return;
    }
    captures_.push_back(std::move(capture));
}

std::vector<Captured> Commands::captured() const {
    std::vector<Captured> results;
    for (const PendingCapture& pending : captures_) {
        results.push_back(pending.result);
        results.back().bytes = pending.staging.download();
    }
    return results;
}

void Commands::submitOpen() {
    closeBuffer();
    if (!recorded_.empty()) device_.submitAndWait(recorded_);
    recorded_.clear();
}

void Commands::collectTimers() {
    if (timers_.empty()) return;
    std::vector<std::uint64_t> ticks(queryCount_);
    KX_VK(vkGetQueryPoolResults(device_.handle(), queries_, 0, queryCount_, ticks.size() * sizeof(ticks[0]),
                                ticks.data(), sizeof(ticks[0]),
                                VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT));
    const double msPerTick = double(device_.limits().timestampPeriod) * 1e-6;
    for (const Timer& timer : timers_) {
        times_->add(timer.name, double(ticks[timer.firstQuery + 1] - ticks[timer.firstQuery]) * msPerTick);
    }
    timers_.clear();
}

void Commands::submitInSlices(double sliceMs, const std::atomic<bool>* interrupt) {
    sliceMs_ = sliceMs;
    interrupt_ = interrupt;
}

void Commands::submitAndWait() {
    submitOpen();
    if (queries_) collectTimers();
}

} // namespace kilolux::gpu
