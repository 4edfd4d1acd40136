// Shared objects of passes, declarations checked, descriptors and barriers; see pass.h.
#include "pass.h"

#include <algorithm>
#include <fmt/format.h>

namespace kilolux::gpu {

namespace {

VkShaderStageFlags stageFlag(ShaderStage stage) {
    switch (stage) {
    case ShaderStage::Compute:
        return VK_SHADER_STAGE_COMPUTE_BIT;
    case ShaderStage::Vertex:
        return VK_SHADER_STAGE_VERTEX_BIT;
    case ShaderStage::Fragment:
        return VK_SHADER_STAGE_FRAGMENT_BIT;
    }
    failContract("unknown ShaderStage");
}

} // namespace

// --- PassResources ---------------------------------------------------------------------------------------

PassResources::PassResources(Device& device) : device_(device) {}

PassResources::~PassResources() {
    for (const auto& [kind, sampler] : samplers_)
        vkDestroySampler(device_.handle(), sampler, nullptr);
}

VkSampler PassResources::sampler(SamplerKind kind) {
    VkSampler& sampler = samplers_[kind];
    if (sampler) return sampler;
    const bool linear = kind != SamplerKind::NearestClamp;
    const bool repeat = kind == SamplerKind::LinearRepeat;
    VkSamplerCreateInfo info{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
    info.magFilter = info.minFilter = linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
    info.mipmapMode = linear ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
    info.addressModeU = info.addressModeV = info.addressModeW =
        repeat ? VK_SAMPLER_ADDRESS_MODE_REPEAT : VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    info.maxLod = VK_LOD_CLAMP_NONE;
    KX_VK(vkCreateSampler(device_.handle(), &info, nullptr, &sampler));
    return sampler;
}

Binding PassResources::dummy(const ShaderBinding& binding) {
    const bool texels = binding.type == VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER ||
                        binding.type == VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER;
    const VkFormat format = binding.format != VK_FORMAT_UNDEFINED ? binding.format
                            : binding.integer                     ? VK_FORMAT_R32_UINT
                                                                  : VK_FORMAT_R8G8B8A8_UNORM;
    const std::string key =
        fmt::format("dummy {} {} {} {}", int(binding.type), int(format), binding.dimension, binding.arrayed);
    if (binding.type == VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR) {
        failContract(fmt::format("'{}': an acceleration structure has no dummy", binding.name));
    }
    if (texels || binding.type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER ||
        binding.type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER) {
        std::unique_ptr<Buffer>& buffer = buffers_[key];
        if (!buffer) {
            BufferDesc desc{key, 65536,
                            VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |
                                VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT};
            if (texels) desc.texelFormat = format;
            if (binding.type == VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER) {
                desc.usage |= VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT;
            }
            buffer = std::make_unique<Buffer>(device_, desc);
        }
        return Binding(binding.name, *buffer);
    }
    std::unique_ptr<Image>& image = images_[key];
    if (!image) {
        ImageDesc desc{key, format};
        desc.usage = binding.type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE ? VK_IMAGE_USAGE_STORAGE_BIT
                                                                      : VK_IMAGE_USAGE_SAMPLED_BIT;
        desc.arrayed = binding.arrayed;
        if (binding.dimension == 2u) desc.depth = 2;
        image = std::make_unique<Image>(device_, desc);
    }
    return Binding(binding.name, *image);
}

// --- PassBase --------------------------------------------------------------------------------------------

PassBase::PassBase(PassResources& resources, std::string name, std::vector<PassUse> uses)
    : resources_(resources), device_(resources.device()), name_(std::move(name)), uses_(std::move(uses)) {}

PassBase::~PassBase() {
    vkDestroyPipelineLayout(device_.handle(), layout_, nullptr);
    vkDestroyDescriptorSetLayout(device_.handle(), setLayout_, nullptr);
}

void PassBase::build(const std::vector<ShaderCode*>& stages) {
    resources_.tellCompiled(name_);
    assignBindings(stages);
    bindings_.clear();
    constants_.clear();
    for (const ShaderCode* stage : stages) {
        stages_ |= stageFlag(stage->stage);
        pushBytes_ = std::max(pushBytes_, stage->pushBytes);
        constants_.insert(constants_.end(), stage->constants.begin(), stage->constants.end());
        for (const ShaderBinding& binding : stage->bindings) {
            const auto known = std::find_if(bindings_.begin(), bindings_.end(),
                                            [&](const auto& other) { return other.name == binding.name; });
            if (known == bindings_.end()) {
                bindings_.push_back(binding);
            } else {
                known->reads |= binding.reads;
                known->writes |= binding.writes;
            }
        }
    }
    checkDeclaration();
    if (layout_) return; // a reload keeps its layouts: the declaration did not change
    std::vector<VkDescriptorSetLayoutBinding> layoutBindings;
    for (const ShaderBinding& binding : bindings_) {
        layoutBindings.push_back({binding.binding, binding.type, 1, stages_, nullptr});
    }
    VkDescriptorSetLayoutCreateInfo setInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    setInfo.bindingCount = std::uint32_t(layoutBindings.size());
    setInfo.pBindings = layoutBindings.data();
    KX_VK(vkCreateDescriptorSetLayout(device_.handle(), &setInfo, nullptr, &setLayout_));
    const VkPushConstantRange range{stages_, 0, pushBytes_};
    VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    info.setLayoutCount = 1;
    info.pSetLayouts = &setLayout_;
    info.pushConstantRangeCount = pushBytes_ ? 1 : 0;
    info.pPushConstantRanges = &range;
    KX_VK(vkCreatePipelineLayout(device_.handle(), &info, nullptr, &layout_));
}

void PassBase::checkDeclaration() const {
    for (const ShaderBinding& binding : bindings_) {
        const auto use = std::find_if(uses_.begin(), uses_.end(), [&](const PassUse& candidate) {
            return candidate.name == binding.name;
        });
        if (use == uses_.end()) {
            failContract(
                fmt::format("pass '{}': the shader uses '{}', which is not declared", name_, binding.name));
        }
        const bool declaredRead = use->access != Access::Write;
        const bool declaredWrite = use->access != Access::Read;
        if (declaredRead != binding.reads || declaredWrite != binding.writes) {
            failContract(fmt::format("pass '{}': '{}' is declared as {}{} but the shader has it as {}{}",
                                     name_, binding.name, declaredRead ? "read " : "",
                                     declaredWrite ? "write" : "", binding.reads ? "read " : "",
                                     binding.writes ? "write" : ""));
        }
    }
    for (const PassUse& use : uses_) {
        const bool found = std::any_of(bindings_.begin(), bindings_.end(),
                                       [&](const auto& binding) { return binding.name == use.name; });
        if (!found)
            failContract(fmt::format("pass '{}': '{}' is declared but the shader lacks it", name_, use.name));
    }
}

const Binding* PassBase::find(const Bindings& bindings, std::string_view name) const {
    const auto found = std::find_if(bindings.begin(), bindings.end(),
                                    [&](const Binding& candidate) { return candidate.name() == name; });
    return found == bindings.end() ? nullptr : &*found;
}

namespace {

Usage usageOf(const ShaderBinding& binding, bool graphics) {
    switch (binding.type) {
    case VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER:
        return graphics ? Usage::GraphicsSampled : Usage::ComputeSampled;
    case VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER:
        return graphics ? Usage::GraphicsUniform : Usage::ComputeUniform;
    case VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR:
        return Usage::ComputeAccelerationStructure;
    default:
        break;
    }
    if (graphics) return Usage::GraphicsStorageRead;
    if (!binding.writes) return Usage::ComputeStorageRead;
    return binding.reads ? Usage::ComputeStorageReadWrite : Usage::ComputeStorageWrite;
}

// One descriptor write with the storage its pointers need.
struct DescriptorWrite {
    VkDescriptorImageInfo image{};
    VkDescriptorBufferInfo buffer{};
    VkBufferView texels = VK_NULL_HANDLE;
    VkAccelerationStructureKHR structure = VK_NULL_HANDLE;
    VkWriteDescriptorSetAccelerationStructureKHR structures{
        VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR};
};

bool isTexelBuffer(VkDescriptorType type) {
    return type == VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER || type == VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER;
}

bool isImage(VkDescriptorType type) {
    return type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER || type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
}

// Points `write` to what is bound, kept in `data`, and declares its use. False: it is of another kind than
// the slot.
bool describe(const ShaderBinding& slot, const Binding& bound, Commands& commands, Usage usage,
              PassResources& resources, DescriptorWrite& data, VkWriteDescriptorSet& write) {
    if (const Image* image = bound.image(); image && isImage(slot.type)) {
        const bool sampled = slot.type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
        if (bound.mipLevel() >= 0) {
            commands.use(*image, std::uint32_t(bound.mipLevel()), usage);
            data.image.imageView = image->mipView(std::uint32_t(bound.mipLevel()));
        } else {
            commands.use(*image, usage);
            data.image.imageView = bound.isSecond() ? image->secondView()
                                   : sampled        ? image->view()
                                                    : image->mipView(0);
        }
        data.image.sampler = sampled ? resources.sampler(bound.sampler()) : VK_NULL_HANDLE;
        data.image.imageLayout = sampled ? VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL : VK_IMAGE_LAYOUT_GENERAL;
        write.pImageInfo = &data.image;
        return true;
    }
    if (const Buffer* buffer = bound.buffer(); buffer && !isImage(slot.type)) {
        commands.use(*buffer, usage);
        data.buffer = {buffer->handle(), 0, VK_WHOLE_SIZE};
        data.texels = buffer->texelView();
        write.pBufferInfo = &data.buffer;
        write.pTexelBufferView = &data.texels;
        return !isTexelBuffer(slot.type) || data.texels;
    }
    if (const AccelerationStructure* structure = bound.accelerationStructure()) {
        data.structure = structure->handle();
        data.structures.accelerationStructureCount = 1;
        data.structures.pAccelerationStructures = &data.structure;
        write.pNext = &data.structures;
        return slot.type == VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR;
    }
    return false;
}

} // namespace

VkDescriptorSet PassBase::prepare(Commands& commands, const Bindings& bindings) {
    const bool graphics = !(stages_ & VK_SHADER_STAGE_COMPUTE_BIT);
    const VkDescriptorSet set = commands.allocateSet(setLayout_);
    std::vector<DescriptorWrite> storage(bindings_.size());
    std::vector<VkWriteDescriptorSet> writes;
    for (std::size_t i = 0; i < bindings_.size(); ++i) {
        const ShaderBinding& slot = bindings_[i];
        const Binding* bound = find(bindings, slot.name);
        std::optional<Binding> dummy;
        if (!bound) {
            const auto use =
                std::find_if(uses_.begin(), uses_.end(), [&](const auto& u) { return u.name == slot.name; });
            if (use->presence == Presence::Required) {
                failContract(fmt::format("pass '{}': nothing is bound to '{}'", name_, slot.name));
            }
            dummy = resources_.dummy(slot);
            bound = &*dummy;
        }
        VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
        write.dstSet = set;
        write.dstBinding = slot.binding;
        write.descriptorCount = 1;
        write.descriptorType = slot.type;
        if (!describe(slot, *bound, commands, usageOf(slot, graphics), resources_, storage[i], write)) {
            failContract(
                fmt::format("pass '{}': what is bound to '{}' is of another kind", name_, slot.name));
        }
        writes.push_back(write);
    }
    for (const Binding& binding : bindings) {
        const bool known = std::any_of(bindings_.begin(), bindings_.end(),
                                       [&](const auto& slot) { return slot.name == binding.name(); });
        if (!known) failContract(fmt::format("pass '{}' has no '{}' to bind", name_, binding.name()));
    }
    vkUpdateDescriptorSets(device_.handle(), std::uint32_t(writes.size()), writes.data(), 0, nullptr);
    return set;
}

void PassBase::captureWrites(Commands& commands, const Bindings& bindings) const {
    if (!commands.captures(name_)) return;
    for (const ShaderBinding& slot : bindings_) {
        const Binding* bound = slot.writes ? find(bindings, slot.name) : nullptr;
        if (!bound) continue;
        if (bound->image())
            commands.capture(slot.name, *bound->image(), std::uint32_t(std::max(0, bound->mipLevel())));
        if (bound->buffer()) commands.capture(slot.name, *bound->buffer());
    }
}

void PassBase::push(Commands& commands, VkDescriptorSet set, VkPipelineBindPoint bindPoint,
                    std::span<const std::byte> constants) {
    if (constants.size() != pushBytes_) {
        failContract(fmt::format("pass '{}': push constants of {} bytes where the shader has {}", name_,
                                 constants.size(), pushBytes_));
    }
    vkCmdBindDescriptorSets(commands.handle(), bindPoint, layout_, 0, 1, &set, 0, nullptr);
    if (!constants.empty()) {
        vkCmdPushConstants(commands.handle(), layout_, stages_, 0, std::uint32_t(constants.size()),
                           constants.data());
    }
}

SpecValues PassBase::masked(const SpecValues& values) const {
    SpecValues result;
    for (const SpecConstant& constant : constants_) {
        if (const auto found = values.find(constant.id); found != values.end()) result.insert(*found);
    }
    return result;
}

} // namespace kilolux::gpu
