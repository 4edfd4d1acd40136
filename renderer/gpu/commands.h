// Records work in order: passes with labels and timers, barriers derived from the declared uses of resources,
// copies. One Commands is one submission; it waits for the device in submitAndWait().
#pragma once

#include "resource.h"

#include <atomic>
#include <functional>
#include <map>

namespace kilolux::gpu {

// Milliseconds of every pass of every submission, by name, in order of first appearance.
class PassTimes {
  public:
    struct Entry {
        std::string name;
        std::vector<double> ms;
    };
    void add(std::string_view name, double ms);
    double newestMs(std::string_view name) const; // 0: never seen
    void keepNewest(std::size_t count);           // of every pass
    const std::vector<Entry>& entries() const { return entries_; }
    void clear() { entries_.clear(); }

  private:
    std::vector<Entry> entries_;
};

// How a pass touches a resource. Stage, access and layout follow from it.
enum class Usage {
    ComputeSampled,
    ComputeStorageRead,
    ComputeStorageWrite,
    ComputeStorageReadWrite,
    ComputeUniform,
    ComputeAccelerationStructure,
    GraphicsSampled,
    GraphicsStorageRead,
    GraphicsUniform,
    ColorAttachment,
    DepthAttachment,
    IndexRead,
    IndirectRead,
    TransferRead,
    TransferWrite,
    AccelerationBuildRead,
    AccelerationBuildWrite,
};

// What a pass had written right after it ran, tightly packed; see Commands::captureAfter.
struct Captured {
    std::string name;                      // GLSL name in the pass
    VkFormat format = VK_FORMAT_UNDEFINED; // UNDEFINED for buffers
    std::uint32_t width = 0, height = 0;   // texels of an image's level
    std::vector<std::byte> bytes;
};

// A submission that was given up between two of its slices; what had been recorded until then has run.
class Interrupted : public std::exception {
  public:
    const char* what() const noexcept override { return "interrupted"; }
};

class Commands {
  public:
    explicit Commands(Device& device, PassTimes* times = nullptr);
    ~Commands();
    Commands(const Commands&) = delete;
    Commands& operator=(const Commands&) = delete;

    Device& device() { return device_; }
    VkCommandBuffer handle();

    // Between these, everything belongs to the named pass.
    void beginPass(std::string_view name);
    void endPass();

    // Declares the next use of a resource; the barrier is recorded by flushBarriers().
    void use(const Buffer& buffer, Usage usage);
    void use(const Image& image, Usage usage); // every mip
    void use(const Image& image, std::uint32_t mip, Usage usage);
    void flushBarriers();

    void copyBuffer(const Buffer& from, VkDeviceSize fromOffset, const Buffer& to, VkDeviceSize toOffset,
                    VkDeviceSize bytes);
    void copyBufferToImage(const Buffer& from, VkDeviceSize offset, const Image& to, std::uint32_t mip,
                           std::uint32_t layer);
    void copyImageToBuffer(const Image& from, std::uint32_t mip, std::uint32_t layer, const Buffer& to,
                           VkDeviceSize offset);
    void clearColor(const Image& image, const VkClearColorValue& value); // every mip and layer
    void fillBuffer(const Buffer& buffer, std::uint32_t value);

    // Submits and waits whenever passes of together about `sliceMs` have been recorded, by what PassTimes
    // knows of them, and throws Interrupted there once `interrupt` is set. One pass is never divided.
    void submitInSlices(double sliceMs, const std::atomic<bool>* interrupt);
    // Called with the name of every pass that begins.
    void onPass(std::function<void(const std::string&)> tell) { tellPass_ = std::move(tell); }

    VkDescriptorSet allocateSet(VkDescriptorSetLayout layout);

    // Keeps what the named pass writes (its last recording), as the pass's own declaration says: for tests
    // and for looking into a frame. Read with captured() after submitAndWait().
    void captureAfter(std::string_view passName) { capturePass_ = passName; }
    bool captures(std::string_view passName) const {
        return !capturePass_.empty() && capturePass_ == passName;
    }
    void capture(std::string_view name, const Image& image, std::uint32_t mip);
    void capture(std::string_view name, const Buffer& buffer);
    std::vector<Captured> captured() const;

    void submitAndWait();

    // For the test that shows that the validation layer sees a missing barrier.
    static bool dropBarriersForTest;

  private:
    struct Timer {
        std::string name;
        std::uint32_t firstQuery = 0;
        double startMs = 0.0;
    };

    void openBuffer();
    void closeBuffer();
    void need(AccessState& state, Usage usage, const Image* image, std::uint32_t mip);
    void submitOpen();
    void collectTimers();

    Device& device_;
    PassTimes* times_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer open_ = VK_NULL_HANDLE;
    std::vector<VkCommandBuffer> recorded_;
    std::vector<VkImageMemoryBarrier2> imageBarriers_;
    VkMemoryBarrier2 memoryBarrier_{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    std::vector<VkDescriptorPool> descriptorPools_;
    std::uint32_t setsInPool_ = 0;
    VkQueryPool queries_ = VK_NULL_HANDLE;
    std::uint32_t queryCount_ = 0;
    std::vector<Timer> timers_;
    bool inPass_ = false;
    std::string passName_;
    double sliceMs_ = 0.0;  // 0: one submission
    double openedMs_ = 0.0; // expected of the passes since the last one
    const std::atomic<bool>* interrupt_ = nullptr;
    std::function<void(const std::string&)> tellPass_;
    struct PendingCapture {
        Captured result;
        Buffer staging;
    };
    std::string capturePass_;
    void keepCapture(PendingCapture capture);
    std::vector<PendingCapture> captures_;
    std::vector<PendingCapture> replacedCaptures_; // by a later recording of the pass; still written to
};

} // namespace kilolux::gpu
