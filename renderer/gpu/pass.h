// A pass: one compute shader or one vertex+fragment pair with what it reads and writes, declared once by the
// GLSL names and checked against the SPIR-V when it is created. Barriers, label, timer and descriptor writes
// follow from the declaration. Features are specialization constants; a pass builds one pipeline per set of
// the features that its shader declares.
#pragma once

#include "commands.h"
#include "shader.h"

#include <functional>
#include <future>
#include <initializer_list>
#include <map>
#include <optional>
#include <span>
#include <variant>

namespace kilolux::gpu {

// A value per specialization constant id: features below kFirstChoiceId (on by default, off changes no
// picture), choices from there on (they do).
using SpecValues = std::map<std::uint32_t, std::uint32_t>;
constexpr std::uint32_t kFirstChoiceId = 32;
// A shader that declares this constant runs workgroups of one whole subgroup; the value is its size.
constexpr std::uint32_t kLanesChoiceId = 40;

enum class Access { Read, Write, ReadWrite };
enum class Presence {
    Required,
    Optional
}; // Optional: a dummy of the same kind stands in where it is not bound

struct PassUse {
    std::string_view name; // the GLSL variable, or the block for buffers
    Access access = Access::Read;
    Presence presence = Presence::Required;
};

// A resource bound under its GLSL name for one recording.
class Binding {
  public:
    Binding(std::string_view name, const Buffer& buffer) : name_(name), resource_(&buffer) {}
    Binding(std::string_view name, const Image& image, SamplerKind sampler = SamplerKind::NearestClamp)
        : name_(name), resource_(&image), sampler_(sampler) {}
    Binding(std::string_view name, const AccelerationStructure& structure)
        : name_(name), resource_(&structure) {}
    // One mip level only, for storage images and pyramid steps.
    static Binding mip(std::string_view name, const Image& image, std::uint32_t level) {
        Binding binding(name, image);
        binding.mip_ = int(level);
        return binding;
    }
    // The image's view in ImageDesc::secondFormat.
    static Binding second(std::string_view name, const Image& image, SamplerKind sampler) {
        Binding binding(name, image, sampler);
        binding.second_ = true;
        return binding;
    }

    std::string_view name() const { return name_; }
    const Buffer* buffer() const { return get<Buffer>(); }
    const Image* image() const { return get<Image>(); }
    const AccelerationStructure* accelerationStructure() const { return get<AccelerationStructure>(); }
    int mipLevel() const { return mip_; } // -1: all
    bool isSecond() const { return second_; }
    SamplerKind sampler() const { return sampler_; }

  private:
    template<typename T>
    const T* get() const {
        const auto* pointer = std::get_if<const T*>(&resource_);
        return pointer ? *pointer : nullptr;
    }
    std::string_view name_;
    std::variant<const Buffer*, const Image*, const AccelerationStructure*> resource_;
    SamplerKind sampler_ = SamplerKind::NearestClamp;
    int mip_ = -1;
    bool second_ = false;
};
using Bindings = std::vector<Binding>;

// Objects shared by all passes of a device: samplers and dummies.
class PassResources {
  public:
    explicit PassResources(Device& device);
    ~PassResources();
    Device& device() { return device_; }
    // Called with a pass's name when its shaders have been compiled; whoever waits may throw Interrupted.
    void onCompiled(std::function<void(const std::string&)> tell) { tell_ = std::move(tell); }
    void tellCompiled(const std::string& pass) const {
        if (tell_) tell_(pass);
    }
    VkSampler sampler(SamplerKind kind);
    Binding dummy(const ShaderBinding& binding);

  private:
    Device& device_;
    std::function<void(const std::string&)> tell_;
    std::map<SamplerKind, VkSampler> samplers_;
    std::map<std::string, std::unique_ptr<Image>> images_;
    std::map<std::string, std::unique_ptr<Buffer>> buffers_;
    std::unique_ptr<AccelerationStructure> emptyScene_;
};

// What compute and graphics passes share: layout, descriptor writes, barriers.
class PassBase {
  public:
    PassBase(const PassBase&) = delete;
    PassBase& operator=(const PassBase&) = delete;
    const std::string& name() const { return name_; }
    const std::vector<SpecConstant>& constants() const { return constants_; }

  protected:
    PassBase(PassResources& resources, std::string name, std::vector<PassUse> uses);
    virtual ~PassBase();

    // Checks the declaration against the stages and makes the layouts; a difference is a contract failure
    // that names the pass and the resource.
    void build(const std::vector<ShaderCode*>& stages);
    VkDescriptorSet prepare(Commands& commands, const Bindings& bindings);
    void captureWrites(Commands& commands,
                       const Bindings& bindings) const; // where Commands asks for this pass
    void push(Commands& commands, VkDescriptorSet set, VkPipelineBindPoint bindPoint,
              std::span<const std::byte> constants);
    SpecValues masked(const SpecValues& values) const; // only what the shaders declare

    PassResources& resources_;
    Device& device_;
    std::string name_;
    std::vector<PassUse> uses_;
    std::vector<ShaderBinding> bindings_;
    std::vector<SpecConstant> constants_;
    std::uint32_t pushBytes_ = 0;
    VkShaderStageFlags stages_ = 0;
    VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;

  private:
    void checkDeclaration() const;
    const Binding* find(const Bindings& bindings, std::string_view name) const;
};

struct GroupCount {
    std::uint32_t x = 1, y = 1, z = 1;
};

struct IndirectGroups {
    const Buffer* buffer = nullptr;
    VkDeviceSize offset = 0;
};

enum class PipelineWait { Exact, AllFeaturesMeanwhile };

class ComputePass : public PassBase {
  public:
    // shaders/passes/<name>.comp unless `file` says otherwise.
    ComputePass(PassResources& resources, std::string name, std::vector<PassUse> uses, std::string file = {},
                std::vector<std::string> defines = {});
    ComputePass(PassResources& resources, ShaderCode code, std::vector<PassUse> uses); // from text, for tests
    ~ComputePass() override;

    template<typename Push>
    void record(Commands& commands, const SpecValues& features, const Bindings& bindings,
                const Push& constants, GroupCount groups) {
        recordBytes(commands, features, bindings, std::as_bytes(std::span(&constants, 1)), groups);
    }
    void record(Commands& commands, const SpecValues& features, const Bindings& bindings, GroupCount groups) {
        recordBytes(commands, features, bindings, {}, groups);
    }
    // Three words at `offset` of `arguments` say how many groups there are.
    template<typename Push>
    void recordIndirect(Commands& commands, const SpecValues& features, const Bindings& bindings,
                        const Push& constants, const Buffer& arguments, VkDeviceSize offset) {
        recordBytes(commands, features, bindings, std::as_bytes(std::span(&constants, 1)),
                    IndirectGroups{&arguments, offset});
    }
    void recordIndirect(Commands& commands, const SpecValues& features, const Bindings& bindings,
                        const Buffer& arguments, VkDeviceSize offset) {
        recordBytes(commands, features, bindings, {}, IndirectGroups{&arguments, offset});
    }
    // Groups that cover width x height (x depth) threads.
    GroupCount cover(std::uint32_t width, std::uint32_t height, std::uint32_t depth = 1) const;
    GroupCount localSize() const { return {code_.localSize[0], code_.localSize[1], code_.localSize[2]}; }

    // Begins to build the pipeline of a feature set in the background.
    void warm(const SpecValues& features);
    // With AllFeaturesMeanwhile, record() uses the pipeline with no constants set (all features on, the same
    // picture) until the exact one is built; Exact waits, so that runs repeat byte for byte in time as well.
    void setWait(PipelineWait wait) { wait_ = wait; }
    // Compiles the file again; on failure the old pipelines stay and the compiler's words come back.
    std::string reload();

  private:
    void recordBytes(Commands& commands, const SpecValues& features, const Bindings& bindings,
                     std::span<const std::byte> constants,
                     const std::variant<GroupCount, IndirectGroups>& groups);
    VkPipeline pipeline(const SpecValues& features);
    VkPipeline create(const SpecValues& features) const;
    void destroyPipelines();

    std::string file_;
    std::vector<std::string> defines_;
    ShaderCode code_;
    VkShaderModule module_ = VK_NULL_HANDLE;
    PipelineWait wait_ = PipelineWait::Exact;
    std::map<SpecValues, std::shared_future<VkPipeline>> pipelines_;
};

struct ColorTarget {
    std::string_view name;
    VkFormat format;
    enum class Blend { None, Multiply, Add, Over } blend = Blend::None;
};

struct GraphicsState {
    std::string vertex;              // shaders/passes/<vertex>.vert
    std::vector<ColorTarget> colors; // in the order of the fragment shader's locations
    VkFormat depth = VK_FORMAT_UNDEFINED;
    bool depthWrite = true; // reversed depth: greater or equal passes
};

class GraphicsPass : public PassBase {
  public:
    // shaders/passes/<name>.frag with the state's vertex shader.
    GraphicsPass(PassResources& resources, std::string name, std::vector<PassUse> uses, GraphicsState state);
    ~GraphicsPass() override;

    struct Attachment {
        const Image* image = nullptr;
        VkClearValue clear{};
        bool load = false; // keep what the image holds
    };
    // Opens the pass on the sub-rectangle width x height; draw() is called with pipeline and set bound. Cull
    // mode and front face are dynamic and start at none and counter-clockwise.
    void record(Commands& commands, const SpecValues& features, const Bindings& bindings,
                std::span<const std::byte> constants, std::uint32_t width, std::uint32_t height,
                const std::vector<Attachment>& colors, const Attachment& depth,
                const std::function<void(VkCommandBuffer)>& draw);
    // Other push constants for the draws that follow, within draw().
    template<typename Push>
    void pushAgain(VkCommandBuffer commands, const Push& constants) const {
        vkCmdPushConstants(commands, layout_, stages_, 0, sizeof(Push), &constants);
    }

  private:
    VkPipeline pipeline(const SpecValues& features);
    VkPipeline create(const SpecValues& features) const;

    GraphicsState state_;
    ShaderCode vertex_, fragment_;
    VkShaderModule vertexModule_ = VK_NULL_HANDLE, fragmentModule_ = VK_NULL_HANDLE;
    std::map<SpecValues, VkPipeline> pipelines_;
};

} // namespace kilolux::gpu
