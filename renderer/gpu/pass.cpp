// Passes, see pass.h.
#include "pass.h"

#include <algorithm>
#include <fmt/format.h>

namespace kilolux::gpu {

namespace {

VkShaderModule makeModule(Device& device, const ShaderCode& code) {
    VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = code.spirv.size() * 4;
    info.pCode = code.spirv.data();
    VkShaderModule module;
    KX_VK(vkCreateShaderModule(device.handle(), &info, nullptr, &module));
    return module;
}

// Specialization data that lives as long as the pipeline creation needs it.
struct Specialization {
    explicit Specialization(const SpecValues& values) {
        for (const auto& [id, value] : values) {
            entries.push_back({id, std::uint32_t(data.size() * 4), 4});
            data.push_back(value);
        }
        info = {std::uint32_t(entries.size()), entries.data(), data.size() * 4, data.data()};
    }
    std::vector<VkSpecializationMapEntry> entries;
    std::vector<std::uint32_t> data;
    VkSpecializationInfo info{};
};

VkPipelineShaderStageCreateInfo stageInfo(VkShaderStageFlagBits stage, VkShaderModule module,
                                          const Specialization& specialization) {
    VkPipelineShaderStageCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    info.stage = stage;
    info.module = module;
    info.pName = "main";
    info.pSpecializationInfo = &specialization.info;
    return info;
}

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

ShaderCode compileOrFail(const std::string& file, const std::vector<std::string>& defines = {}) {
    Result<ShaderCode> code = compileShader(file, defines);
    if (!code) failContract(code.error());
    return std::move(code.value());
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
        const Usage usage = usageOf(slot, graphics);
        DescriptorWrite& data = storage[i];
        VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
        write.dstSet = set;
        write.dstBinding = slot.binding;
        write.descriptorCount = 1;
        write.descriptorType = slot.type;
        bool matches = false;
        if (const Image* image = bound->image(); image && isImage(slot.type)) {
            matches = true;
            const bool sampled = slot.type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
            if (bound->mipLevel() >= 0) {
                commands.use(*image, std::uint32_t(bound->mipLevel()), usage);
                data.image.imageView = image->mipView(std::uint32_t(bound->mipLevel()));
            } else {
                commands.use(*image, usage);
                data.image.imageView = bound->isSecond() ? image->secondView()
                                       : sampled         ? image->view()
                                                         : image->mipView(0);
            }
            data.image.sampler = sampled ? resources_.sampler(bound->sampler()) : VK_NULL_HANDLE;
            data.image.imageLayout =
                sampled ? VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL : VK_IMAGE_LAYOUT_GENERAL;
            write.pImageInfo = &data.image;
        } else if (const Buffer* buffer = bound->buffer(); buffer && !isImage(slot.type)) {
            commands.use(*buffer, usage);
            data.buffer = {buffer->handle(), 0, VK_WHOLE_SIZE};
            data.texels = buffer->texelView();
            matches = !isTexelBuffer(slot.type) || data.texels;
            write.pBufferInfo = &data.buffer;
            write.pTexelBufferView = &data.texels;
        } else if (const AccelerationStructure* structure = bound->accelerationStructure()) {
            matches = slot.type == VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR;
            data.structure = structure->handle();
            data.structures.accelerationStructureCount = 1;
            data.structures.pAccelerationStructures = &data.structure;
            write.pNext = &data.structures;
        }
        if (!matches) {
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

// --- ComputePass -----------------------------------------------------------------------------------------

ComputePass::ComputePass(PassResources& resources, std::string name, std::vector<PassUse> uses,
                         std::string file, std::vector<std::string> defines)
    : PassBase(resources, std::move(name), std::move(uses)), file_(std::move(file)),
      defines_(std::move(defines)) {
    if (file_.empty()) file_ = "passes/" + name_ + ".comp";
    code_ = compileOrFail(file_, defines_);
    build({&code_});
    module_ = makeModule(device_, code_);
}

ComputePass::ComputePass(PassResources& resources, ShaderCode code, std::vector<PassUse> uses)
    : PassBase(resources, code.name, std::move(uses)), code_(std::move(code)) {
    build({&code_});
    module_ = makeModule(device_, code_);
}

ComputePass::~ComputePass() {
    destroyPipelines();
    vkDestroyShaderModule(device_.handle(), module_, nullptr);
}

void ComputePass::destroyPipelines() {
    for (auto& [key, pipeline] : pipelines_)
        vkDestroyPipeline(device_.handle(), pipeline.get(), nullptr);
    pipelines_.clear();
}

GroupCount ComputePass::cover(std::uint32_t width, std::uint32_t height, std::uint32_t depth) const {
    const auto groups = [](std::uint32_t threads, std::uint32_t size) { return (threads + size - 1) / size; };
    return {groups(width, code_.localSize[0]), groups(height, code_.localSize[1]),
            groups(depth, code_.localSize[2])};
}

VkPipeline ComputePass::create(const SpecValues& features) const {
    const Specialization specialization(features);
    VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.stage = stageInfo(VK_SHADER_STAGE_COMPUTE_BIT, module_, specialization);
    info.layout = layout_;
    VkPipeline pipeline;
    KX_VK(vkCreateComputePipelines(device_.handle(), device_.pipelineCache(), 1, &info, nullptr, &pipeline));
    device_.setName(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<std::uint64_t>(pipeline), name_.c_str());
    return pipeline;
}

void ComputePass::warm(const SpecValues& features) {
    const SpecValues key = masked(features);
    if (!pipelines_.contains(key)) {
        pipelines_[key] = std::async(std::launch::async, [this, key] { return create(key); }).share();
    }
}

VkPipeline ComputePass::pipeline(const SpecValues& features) {
    warm(features);
    const auto& exact = pipelines_.at(masked(features));
    const bool ready = exact.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    if (ready || wait_ == PipelineWait::Exact) return exact.get();
    warm({});
    return pipelines_.at({}).get();
}

void ComputePass::recordBytes(Commands& commands, const SpecValues& features, const Bindings& bindings,
                              std::span<const std::byte> constants, GroupCount groups) {
    commands.beginPass(name_);
    const VkDescriptorSet set = prepare(commands, bindings);
    commands.flushBarriers();
    vkCmdBindPipeline(commands.handle(), VK_PIPELINE_BIND_POINT_COMPUTE, pipeline(features));
    push(commands, set, VK_PIPELINE_BIND_POINT_COMPUTE, constants);
    vkCmdDispatch(commands.handle(), groups.x, groups.y, groups.z);
    commands.endPass();
    captureWrites(commands, bindings);
}

std::string ComputePass::reload() {
    Result<ShaderCode> code = compileShader(file_, defines_);
    if (!code) return code.error();
    const ShaderCode old = std::exchange(code_, std::move(code.value()));
    const std::vector<ShaderBinding> oldBindings = bindings_;
    try {
        build({&code_});
    } catch (const std::logic_error& difference) {
        code_ = old;
        build({&code_});
        return difference.what();
    }
    const bool sameInterface = code_.pushBytes == old.pushBytes && oldBindings.size() == bindings_.size();
    if (!sameInterface) {
        code_ = old;
        build({&code_});
        return fmt::format("{}: the interface changed; restart to load it", file_);
    }
    vkDeviceWaitIdle(device_.handle());
    destroyPipelines();
    vkDestroyShaderModule(device_.handle(), module_, nullptr);
    module_ = makeModule(device_, code_);
    return {};
}

// --- GraphicsPass ----------------------------------------------------------------------------------------

GraphicsPass::GraphicsPass(PassResources& resources, std::string name, std::vector<PassUse> uses,
                           GraphicsState state)
    : PassBase(resources, std::move(name), std::move(uses)), state_(std::move(state)),
      vertex_(compileOrFail("passes/" + name_ + ".vert")),
      fragment_(compileOrFail("passes/" + name_ + ".frag")) {
    build({&vertex_, &fragment_});
    vertexModule_ = makeModule(device_, vertex_);
    fragmentModule_ = makeModule(device_, fragment_);
}

GraphicsPass::~GraphicsPass() {
    for (const auto& [key, pipeline] : pipelines_)
        vkDestroyPipeline(device_.handle(), pipeline, nullptr);
    vkDestroyShaderModule(device_.handle(), vertexModule_, nullptr);
    vkDestroyShaderModule(device_.handle(), fragmentModule_, nullptr);
}

namespace {

VkPipelineColorBlendAttachmentState blendState(ColorTarget::Blend blend) {
    VkPipelineColorBlendAttachmentState state{};
    state.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT |
                           VK_COLOR_COMPONENT_A_BIT;
    if (blend == ColorTarget::Blend::None) return state;
    state.blendEnable = VK_TRUE;
    state.colorBlendOp = state.alphaBlendOp = VK_BLEND_OP_ADD;
    state.srcColorBlendFactor =
        blend == ColorTarget::Blend::Multiply ? VK_BLEND_FACTOR_DST_COLOR : VK_BLEND_FACTOR_ONE;
    state.dstColorBlendFactor = blend == ColorTarget::Blend::Multiply ? VK_BLEND_FACTOR_ZERO
                                : blend == ColorTarget::Blend::Add    ? VK_BLEND_FACTOR_ONE
                                                                      : VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    state.srcAlphaBlendFactor = VK_BLEND_FACTOR_ZERO;
    state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    return state;
}

} // namespace

VkPipeline GraphicsPass::create(const SpecValues& features) const {
    const Specialization specialization(features);
    const VkPipelineShaderStageCreateInfo stages[] = {
        stageInfo(VK_SHADER_STAGE_VERTEX_BIT, vertexModule_, specialization),
        stageInfo(VK_SHADER_STAGE_FRAGMENT_BIT, fragmentModule_, specialization)};
    VkPipelineVertexInputStateCreateInfo input{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    VkPipelineInputAssemblyStateCreateInfo assembly{
        VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
    viewport.viewportCount = viewport.scissorCount = 1;
    VkPipelineRasterizationStateCreateInfo raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
    raster.lineWidth = 1.0f;
    VkPipelineMultisampleStateCreateInfo samples{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    VkPipelineDepthStencilStateCreateInfo depth{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    depth.depthTestEnable = state_.depth != VK_FORMAT_UNDEFINED;
    depth.depthWriteEnable = state_.depthWrite;
    depth.depthCompareOp = VK_COMPARE_OP_GREATER_OR_EQUAL;
    std::vector<VkPipelineColorBlendAttachmentState> attachments;
    std::vector<VkFormat> formats;
    for (const ColorTarget& color : state_.colors) {
        attachments.push_back(blendState(color.blend));
        formats.push_back(color.format);
    }
    VkPipelineColorBlendStateCreateInfo blend{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
    blend.attachmentCount = std::uint32_t(attachments.size());
    blend.pAttachments = attachments.data();
    const VkDynamicState dynamicStates[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR,
                                            VK_DYNAMIC_STATE_CULL_MODE, VK_DYNAMIC_STATE_FRONT_FACE};
    VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
    dynamic.dynamicStateCount = 4;
    dynamic.pDynamicStates = dynamicStates;
    VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
    rendering.colorAttachmentCount = std::uint32_t(formats.size());
    rendering.pColorAttachmentFormats = formats.data();
    rendering.depthAttachmentFormat = state_.depth;
    VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
    info.pNext = &rendering;
    info.stageCount = 2;
    info.pStages = stages;
    info.pVertexInputState = &input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = layout_;
    VkPipeline pipeline;
    KX_VK(vkCreateGraphicsPipelines(device_.handle(), device_.pipelineCache(), 1, &info, nullptr, &pipeline));
    return pipeline;
}

VkPipeline GraphicsPass::pipeline(const SpecValues& features) {
    VkPipeline& pipeline = pipelines_[masked(features)];
    if (!pipeline) pipeline = create(masked(features));
    return pipeline;
}

void GraphicsPass::record(Commands& commands, const SpecValues& features, const Bindings& bindings,
                          std::span<const std::byte> constants, std::uint32_t width, std::uint32_t height,
                          const std::vector<Attachment>& colors, const Attachment& depth,
                          const std::function<void(VkCommandBuffer)>& draw) {
    commands.beginPass(name_);
    const VkDescriptorSet set = prepare(commands, bindings);
    const auto attachmentInfo = [&](const Attachment& attachment, Usage usage, VkImageLayout layout) {
        commands.use(*attachment.image, 0, usage);
        VkRenderingAttachmentInfo info{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
        info.imageView = attachment.image->mipView(0);
        info.imageLayout = layout;
        info.loadOp = attachment.load ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_CLEAR;
        info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        info.clearValue = attachment.clear;
        return info;
    };
    std::vector<VkRenderingAttachmentInfo> colorInfos;
    for (const Attachment& color : colors) {
        colorInfos.push_back(
            attachmentInfo(color, Usage::ColorAttachment, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL));
    }
    VkRenderingAttachmentInfo depthInfo{};
    if (depth.image) {
        depthInfo =
            attachmentInfo(depth, Usage::DepthAttachment, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
    }
    commands.flushBarriers();
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea.extent = {width, height};
    info.layerCount = 1;
    info.colorAttachmentCount = std::uint32_t(colorInfos.size());
    info.pColorAttachments = colorInfos.data();
    info.pDepthAttachment = depth.image ? &depthInfo : nullptr;
    const VkCommandBuffer buffer = commands.handle();
    vkCmdBeginRendering(buffer, &info);
    vkCmdBindPipeline(buffer, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline(features));
    push(commands, set, VK_PIPELINE_BIND_POINT_GRAPHICS, constants);
    const VkViewport viewport{0.0f, 0.0f, float(width), float(height), 0.0f, 1.0f};
    const VkRect2D scissor{{0, 0}, {width, height}};
    vkCmdSetViewport(buffer, 0, 1, &viewport);
    vkCmdSetScissor(buffer, 0, 1, &scissor);
    vkCmdSetCullMode(buffer, VK_CULL_MODE_NONE);
    vkCmdSetFrontFace(buffer, VK_FRONT_FACE_COUNTER_CLOCKWISE);
    draw(buffer);
    vkCmdEndRendering(buffer);
    commands.endPass();
    if (!commands.captures(name_)) return;
    for (std::size_t i = 0; i < colors.size(); ++i)
        commands.capture(state_.colors[i].name, *colors[i].image, 0);
}

} // namespace kilolux::gpu
