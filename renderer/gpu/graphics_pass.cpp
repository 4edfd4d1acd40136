// Graphics passes with dynamic rendering; see pass.h.
#include "pass_internal.h"

namespace kilolux::gpu {

GraphicsPass::GraphicsPass(PassResources& resources, std::string name, std::vector<PassUse> uses,
                           GraphicsState state)
    : PassBase(resources, std::move(name), std::move(uses)), state_(std::move(state)),
      vertex_(compileOrFail("passes/" + state_.vertex + ".vert")),
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
