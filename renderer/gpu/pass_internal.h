// What the two kinds of pass share when they make pipelines; included by pass*.cpp only.
#pragma once

#include "pass.h"

namespace kilolux::gpu {

inline VkShaderModule makeModule(Device& device, const ShaderCode& code) {
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

inline VkPipelineShaderStageCreateInfo stageInfo(VkShaderStageFlagBits stage, VkShaderModule module,
                                                 const Specialization& specialization) {
    VkPipelineShaderStageCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    info.stage = stage;
    info.module = module;
    info.pName = "main";
    info.pSpecializationInfo = &specialization.info;
    return info;
}

inline ShaderCode compileOrFail(const std::string& file, const std::vector<std::string>& defines = {}) {
    Result<ShaderCode> code = compileShader(file, defines);
    if (!code) failContract(code.error());
    return std::move(code.value());
}

} // namespace kilolux::gpu
