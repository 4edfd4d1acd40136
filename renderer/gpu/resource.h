// Buffers, images, samplers and acceleration structures: owning handles that know their last use, so that
// passes can derive their barriers. Not thread-safe; one recorder uses a resource at a time.
#pragma once

#include "device.h"

#include <cstring>
#include <span>

namespace kilolux::gpu {

// The last uses of a resource (or of one mip level), as far as a later barrier needs them.
struct AccessState {
    VkPipelineStageFlags2 writeStage = 0;
    VkAccessFlags2 writeAccess = 0;
    VkPipelineStageFlags2 readStages = 0;    // since the last write
    VkPipelineStageFlags2 visibleStages = 0; // that the last write has been made visible to
    VkAccessFlags2 visibleAccess = 0;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
};

struct BufferDesc {
    std::string name;
    VkDeviceSize bytes = 0;
    VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT; // transfer bits are always added
    MemoryUse memory = MemoryUse::DeviceOnly;
    std::string_view cause = "other";
    VkFormat texelFormat = VK_FORMAT_UNDEFINED; // makes a view for samplerBuffer / imageBuffer
};

class Buffer {
  public:
    Buffer() = default;
    Buffer(Device& device, BufferDesc desc); // zero bytes become 16, so that empty lists can be bound
    ~Buffer();
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&& other) noexcept;

    explicit operator bool() const { return buffer_ != VK_NULL_HANDLE; }
    VkBuffer handle() const { return buffer_; }
    VkDeviceSize bytes() const { return desc_.bytes; }
    const BufferDesc& desc() const { return desc_; }
    VkBufferView texelView() const { return texelView_; }
    VkDeviceAddress address() const;
    std::byte* mapped() const { return allocation_.mapped; }
    const Allocation& allocation() const { return allocation_; }
    Device* device() const { return device_; }
    AccessState& state() const { return state_; }

    // Writes through the mapping or a staging buffer; waits for the device in the latter case.
    void upload(std::span<const std::byte> data, VkDeviceSize offset = 0);
    template<typename T>
    void upload(const std::vector<T>& data) {
        upload(std::as_bytes(std::span(data)));
    }
    // Reads back through the mapping or a staging buffer. All earlier submits must have been waited for.
    std::vector<std::byte> download() const;
    template<typename T>
    std::vector<T> downloadAs() const {
        const std::vector<std::byte> bytes = download();
        std::vector<T> result(bytes.size() / sizeof(T));
        std::memcpy(result.data(), bytes.data(), result.size() * sizeof(T));
        return result;
    }

  private:
    void release();

    Device* device_ = nullptr;
    BufferDesc desc_;
    VkBuffer buffer_ = VK_NULL_HANDLE;
    VkBufferView texelView_ = VK_NULL_HANDLE;
    Allocation allocation_;
    mutable AccessState state_;
};

struct ImageDesc {
    std::string name;
    VkFormat format = VK_FORMAT_UNDEFINED;
    std::uint32_t width = 1, height = 1, depth = 1;
    std::uint32_t mips = 1, layers = 1;
    bool arrayed = false; // view as an array even with one layer
    VkImageUsageFlags usage =
        VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT; // transfer always added
    VkFormat secondFormat = VK_FORMAT_UNDEFINED; // a second sampled view, e.g. sRGB beside UNORM
    std::string_view cause = "targets";
};

class Image {
  public:
    Image() = default;
    Image(Device& device, ImageDesc desc);
    ~Image();
    Image(Image&& other) noexcept;
    Image& operator=(Image&& other) noexcept;

    explicit operator bool() const { return image_ != VK_NULL_HANDLE; }
    VkImage handle() const { return image_; }
    const ImageDesc& desc() const { return desc_; }
    VkImageView view() const { return view_; }             // all mips, for sampling
    VkImageView secondView() const { return secondView_; } // in ImageDesc::secondFormat
    VkImageView mipView(std::uint32_t mip) const { return mipViews_[mip]; }
    VkImageAspectFlags aspect() const;
    AccessState& state(std::uint32_t mip) const { return states_[mip]; }
    Device* device() const { return device_; }

    // Fills one mip of one layer from tightly packed texels; waits for the device.
    void upload(std::span<const std::byte> texels, std::uint32_t mip = 0, std::uint32_t layer = 0);
    // Copies one mip of one layer back, tightly packed. All earlier submits must have been waited for.
    std::vector<std::byte> download(std::uint32_t mip = 0, std::uint32_t layer = 0) const;

  private:
    VkImageView makeView(VkFormat format, std::uint32_t firstMip, std::uint32_t mipCount,
                         VkImageUsageFlags usage) const;
    void release();

    Device* device_ = nullptr;
    ImageDesc desc_;
    VkImage image_ = VK_NULL_HANDLE;
    VkImageView view_ = VK_NULL_HANDLE, secondView_ = VK_NULL_HANDLE;
    std::vector<VkImageView> mipViews_;
    Allocation allocation_;
    mutable std::vector<AccessState> states_;
};

// Bytes of a texel; 0 for formats that the project does not use.
std::uint32_t texelBytes(VkFormat format);

// An owning VkAccelerationStructureKHR with its buffer.
class AccelerationStructure {
  public:
    AccelerationStructure() = default;
    AccelerationStructure(Device& device, std::string name, VkAccelerationStructureTypeKHR type,
                          VkDeviceSize bytes);
    ~AccelerationStructure();
    AccelerationStructure(AccelerationStructure&& other) noexcept;
    AccelerationStructure& operator=(AccelerationStructure&& other) noexcept;

    explicit operator bool() const { return handle_ != VK_NULL_HANDLE; }
    VkAccelerationStructureKHR handle() const { return handle_; }
    VkDeviceAddress address() const;

  private:
    Device* device_ = nullptr;
    Buffer buffer_;
    VkAccelerationStructureKHR handle_ = VK_NULL_HANDLE;
};

enum class SamplerKind { NearestClamp, LinearClamp, LinearRepeat };

} // namespace kilolux::gpu
