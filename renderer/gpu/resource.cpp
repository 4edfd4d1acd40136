// Resource handles, see resource.h.
#include "resource.h"

#include "commands.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace kilolux::gpu {

// --- Buffer ----------------------------------------------------------------------------------------------

Buffer::Buffer(Device& device, BufferDesc desc) : device_(&device), desc_(std::move(desc)) {
    const VkDeviceSize askedBytes = desc_.bytes;
    desc_.bytes = std::max<VkDeviceSize>(desc_.bytes, 16);
    if (desc_.texelFormat != VK_FORMAT_UNDEFINED) {
        const VkDeviceSize texels = askedBytes / texelBytes(desc_.texelFormat);
        if (texels > device.limits().maxTexelBufferElements) {
            throw DeviceError(fmt::format("'{}' takes {} texels, and device '{}' allows {} in a buffer",
                                          desc_.name, texels, device.name(),
                                          device.limits().maxTexelBufferElements));
        }
    }
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = desc_.bytes;
    info.usage = desc_.usage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    KX_VK(vkCreateBuffer(device.handle(), &info, nullptr, &buffer_));
    VkMemoryRequirements requirements;
    vkGetBufferMemoryRequirements(device.handle(), buffer_, &requirements);
    const bool addressed = desc_.usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    allocation_ =
        device.memory().allocate(requirements, desc_.memory, ResourceKind::Linear, addressed, desc_.cause);
    KX_VK(vkBindBufferMemory(device.handle(), buffer_, allocation_.memory, allocation_.offset));
    device.setName(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<std::uint64_t>(buffer_), desc_.name.c_str());
    if (desc_.texelFormat != VK_FORMAT_UNDEFINED) {
        VkBufferViewCreateInfo view{VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO};
        view.buffer = buffer_;
        view.format = desc_.texelFormat;
        // What pads a small buffer is none of its texels: shaders ask for their number.
        view.range = askedBytes > 0 ? askedBytes : VK_WHOLE_SIZE;
        KX_VK(vkCreateBufferView(device.handle(), &view, nullptr, &texelView_));
    }
}

Buffer::~Buffer() {
    release();
}

void Buffer::release() {
    if (!buffer_) return;
    vkDestroyBufferView(device_->handle(), texelView_, nullptr);
    vkDestroyBuffer(device_->handle(), buffer_, nullptr);
    device_->memory().free(allocation_);
    buffer_ = VK_NULL_HANDLE;
}

Buffer::Buffer(Buffer&& other) noexcept {
    *this = std::move(other);
}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    if (this == &other) return *this;
    release();
    device_ = other.device_;
    desc_ = std::move(other.desc_);
    buffer_ = std::exchange(other.buffer_, VK_NULL_HANDLE);
    texelView_ = std::exchange(other.texelView_, VK_NULL_HANDLE);
    allocation_ = other.allocation_;
    state_ = other.state_;
    return *this;
}

VkDeviceAddress Buffer::address() const {
    VkBufferDeviceAddressInfo info{VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO};
    info.buffer = buffer_;
    return vkGetBufferDeviceAddress(device_->handle(), &info);
}

void Buffer::upload(std::span<const std::byte> data, VkDeviceSize offset) {
    if (data.empty()) return;
    if (offset + data.size() > desc_.bytes) failContract("upload past the end of buffer " + desc_.name);
    if (allocation_.mapped) {
        std::memcpy(allocation_.mapped + offset, data.data(), data.size());
        device_->memory().flush(allocation_);
        return;
    }
    // Pieces, so that a large upload does not need a staging buffer of its own size.
    constexpr std::size_t kPiece = std::size_t{8} << 20;
    for (std::size_t done = 0; done < data.size(); done += kPiece) {
        const std::span<const std::byte> piece = data.subspan(done, std::min(kPiece, data.size() - done));
        Buffer staging(*device_, {"staging", piece.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                  MemoryUse::HostWrite, "staging"});
        staging.upload(piece);
        Commands commands(*device_);
        commands.copyBuffer(staging, 0, *this, offset + done, piece.size());
        commands.submitAndWait();
    }
}

std::vector<std::byte> Buffer::download() const {
    std::vector<std::byte> result(desc_.bytes);
    if (allocation_.mapped) {
        device_->memory().invalidate(allocation_);
        std::memcpy(result.data(), allocation_.mapped, result.size());
        return result;
    }
    Buffer staging(*device_, {"readback", desc_.bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                              MemoryUse::HostReadback, "readback"});
    Commands commands(*device_);
    commands.copyBuffer(*this, 0, staging, 0, desc_.bytes);
    commands.submitAndWait();
    return staging.download();
}

// --- Image -----------------------------------------------------------------------------------------------

std::uint32_t texelBytes(VkFormat format) {
    switch (format) {
    case VK_FORMAT_R8_UNORM:
    case VK_FORMAT_R8_UINT:
        return 1;
    case VK_FORMAT_R8G8_UNORM:
    case VK_FORMAT_R8G8_SNORM:
    case VK_FORMAT_R16_UINT:
    case VK_FORMAT_R16_UNORM:
    case VK_FORMAT_R16_SFLOAT:
        return 2;
    case VK_FORMAT_R8G8B8A8_UNORM:
    case VK_FORMAT_R8G8B8A8_SRGB:
    case VK_FORMAT_R8G8B8A8_UINT:
    case VK_FORMAT_R16G16_SNORM:
    case VK_FORMAT_R16G16_SFLOAT:
    case VK_FORMAT_R16G16_UNORM:
    case VK_FORMAT_R16G16_UINT:
    case VK_FORMAT_R32_UINT:
    case VK_FORMAT_R32_SFLOAT:
    case VK_FORMAT_B10G11R11_UFLOAT_PACK32:
    case VK_FORMAT_A2B10G10R10_UNORM_PACK32:
    case VK_FORMAT_D32_SFLOAT:
        return 4;
    case VK_FORMAT_R16G16B16A16_SFLOAT:
    case VK_FORMAT_R16G16B16A16_UNORM:
    case VK_FORMAT_R32G32_SFLOAT:
    case VK_FORMAT_R32G32_UINT:
        return 8;
    case VK_FORMAT_R32G32B32A32_SFLOAT:
    case VK_FORMAT_R32G32B32A32_UINT:
        return 16;
    default:
        return 0;
    }
}

Image::Image(Device& device, ImageDesc desc) : device_(&device), desc_(std::move(desc)) {
    desc_.usage |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.flags = desc_.secondFormat != VK_FORMAT_UNDEFINED ? VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT : 0;
    info.imageType = desc_.depth > 1 ? VK_IMAGE_TYPE_3D : VK_IMAGE_TYPE_2D;
    info.format = desc_.format;
    info.extent = {desc_.width, desc_.height, desc_.depth};
    info.mipLevels = desc_.mips;
    info.arrayLayers = desc_.layers;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = desc_.usage;
    KX_VK(vkCreateImage(device.handle(), &info, nullptr, &image_));
    VkMemoryRequirements requirements;
    vkGetImageMemoryRequirements(device.handle(), image_, &requirements);
    allocation_ = device.memory().allocate(requirements, MemoryUse::DeviceOnly, ResourceKind::Tiled, false,
                                           desc_.cause);
    KX_VK(vkBindImageMemory(device.handle(), image_, allocation_.memory, allocation_.offset));
    device.setName(VK_OBJECT_TYPE_IMAGE, reinterpret_cast<std::uint64_t>(image_), desc_.name.c_str());
    states_.resize(desc_.mips);
    view_ = makeView(desc_.format, 0, desc_.mips, 0);
    if (desc_.secondFormat != VK_FORMAT_UNDEFINED) {
        secondView_ = makeView(desc_.secondFormat, 0, desc_.mips, VK_IMAGE_USAGE_SAMPLED_BIT);
    }
    for (std::uint32_t mip = 0; mip < desc_.mips; ++mip) {
        mipViews_.push_back(desc_.mips == 1 ? view_ : makeView(desc_.format, mip, 1, 0));
    }
}

VkImageView Image::makeView(VkFormat format, std::uint32_t firstMip, std::uint32_t mipCount,
                            VkImageUsageFlags usage) const {
    VkImageViewUsageCreateInfo usageInfo{VK_STRUCTURE_TYPE_IMAGE_VIEW_USAGE_CREATE_INFO};
    usageInfo.usage = usage;
    VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    info.pNext = usage ? &usageInfo : nullptr;
    info.image = image_;
    const bool arrayed = desc_.layers > 1 || desc_.arrayed;
    info.viewType = desc_.depth > 1 ? VK_IMAGE_VIEW_TYPE_3D
                    : arrayed       ? VK_IMAGE_VIEW_TYPE_2D_ARRAY
                                    : VK_IMAGE_VIEW_TYPE_2D;
    info.format = format;
    info.subresourceRange = {aspect(), firstMip, mipCount, 0, desc_.layers};
    VkImageView view;
    KX_VK(vkCreateImageView(device_->handle(), &info, nullptr, &view));
    return view;
}

VkImageAspectFlags Image::aspect() const {
    return desc_.format == VK_FORMAT_D32_SFLOAT ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

Image::~Image() {
    release();
}

void Image::release() {
    if (!image_) return;
    if (desc_.mips > 1) {
        for (VkImageView mipView : mipViews_)
            vkDestroyImageView(device_->handle(), mipView, nullptr);
    }
    vkDestroyImageView(device_->handle(), view_, nullptr);
    vkDestroyImageView(device_->handle(), secondView_, nullptr);
    vkDestroyImage(device_->handle(), image_, nullptr);
    device_->memory().free(allocation_);
    image_ = VK_NULL_HANDLE;
}

Image::Image(Image&& other) noexcept {
    *this = std::move(other);
}

Image& Image::operator=(Image&& other) noexcept {
    if (this == &other) return *this;
    release();
    device_ = other.device_;
    desc_ = std::move(other.desc_);
    image_ = std::exchange(other.image_, VK_NULL_HANDLE);
    view_ = std::exchange(other.view_, VK_NULL_HANDLE);
    secondView_ = std::exchange(other.secondView_, VK_NULL_HANDLE);
    mipViews_ = std::move(other.mipViews_);
    allocation_ = other.allocation_;
    states_ = std::move(other.states_);
    return *this;
}

void Image::upload(std::span<const std::byte> texels, std::uint32_t mip, std::uint32_t layer) {
    Buffer staging(*device_, {"staging", texels.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                              MemoryUse::HostWrite, "staging"});
    staging.upload(texels);
    Commands commands(*device_);
    commands.copyBufferToImage(staging, 0, *this, mip, layer);
    commands.submitAndWait();
}

std::vector<std::byte> Image::download(std::uint32_t mip, std::uint32_t layer) const {
    const std::size_t texels = std::size_t(std::max(1u, desc_.width >> mip)) *
                               std::max(1u, desc_.height >> mip) * std::max(1u, desc_.depth >> mip);
    Buffer staging(*device_, {"readback", texels * texelBytes(desc_.format), VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                              MemoryUse::HostReadback, "readback"});
    Commands commands(*device_);
    commands.copyImageToBuffer(*this, mip, layer, staging, 0);
    commands.submitAndWait();
    std::vector<std::byte> result = staging.download();
    result.resize(texels * texelBytes(desc_.format));
    return result;
}

// --- AccelerationStructure -------------------------------------------------------------------------------

AccelerationStructure::AccelerationStructure(Device& device, std::string name,
                                             VkAccelerationStructureTypeKHR type, VkDeviceSize bytes)
    : device_(&device), buffer_(device, {std::move(name), bytes,
                                         VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR |
                                             VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                                         MemoryUse::DeviceOnly, "acceleration structures"}) {
    VkAccelerationStructureCreateInfoKHR info{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR};
    info.buffer = buffer_.handle();
    info.size = bytes;
    info.type = type;
    KX_VK(device.createAccelerationStructure(device.handle(), &info, nullptr, &handle_));
}

AccelerationStructure::~AccelerationStructure() {
    if (handle_) device_->destroyAccelerationStructure(device_->handle(), handle_, nullptr);
}

AccelerationStructure::AccelerationStructure(AccelerationStructure&& other) noexcept {
    *this = std::move(other);
}

AccelerationStructure& AccelerationStructure::operator=(AccelerationStructure&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(buffer_, other.buffer_);
    std::swap(handle_, other.handle_);
    return *this;
}

VkDeviceAddress AccelerationStructure::address() const {
    VkAccelerationStructureDeviceAddressInfoKHR info{
        VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR};
    info.accelerationStructure = handle_;
    return device_->getAccelerationStructureDeviceAddress(device_->handle(), &info);
}

} // namespace kilolux::gpu
