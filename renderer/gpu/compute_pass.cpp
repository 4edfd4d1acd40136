// Compute passes: pipelines per feature set, built in the background, and reloading; see pass.h.
#include "pass_internal.h"

#include <fmt/format.h>
#include <utility>

namespace kilolux::gpu {

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
    VkPipelineShaderStageRequiredSubgroupSizeCreateInfo lanes{
        VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_REQUIRED_SUBGROUP_SIZE_CREATE_INFO};
    if (const auto found = features.find(kLanesChoiceId);
        found != features.end() && device_.canRequireSubgroupSize()) {
        lanes.requiredSubgroupSize = found->second;
        info.stage.pNext = &lanes;
        // Such passes take a workgroup for one subgroup, and so do without barriers.
        info.stage.flags |= VK_PIPELINE_SHADER_STAGE_CREATE_REQUIRE_FULL_SUBGROUPS_BIT;
    }
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
    SpecValues standIn = masked(features);
    standIn.erase(standIn.begin(), standIn.lower_bound(kFirstChoiceId));
    warm(standIn);
    return pipelines_.at(standIn).get();
}

void ComputePass::recordBytes(Commands& commands, const SpecValues& features, const Bindings& bindings,
                              std::span<const std::byte> constants,
                              const std::variant<GroupCount, IndirectGroups>& groups) {
    const auto* indirect = std::get_if<IndirectGroups>(&groups);
    commands.beginPass(name_);
    const VkDescriptorSet set = prepare(commands, bindings);
    if (indirect) commands.use(*indirect->buffer, Usage::IndirectRead);
    commands.flushBarriers();
    vkCmdBindPipeline(commands.handle(), VK_PIPELINE_BIND_POINT_COMPUTE, pipeline(features));
    push(commands, set, VK_PIPELINE_BIND_POINT_COMPUTE, constants);
    if (indirect) {
        vkCmdDispatchIndirect(commands.handle(), indirect->buffer->handle(), indirect->offset);
    } else {
        const auto& [x, y, z] = std::get<GroupCount>(groups);
        vkCmdDispatch(commands.handle(), x, y, z);
    }
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

} // namespace kilolux::gpu
