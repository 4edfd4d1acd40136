// The sorted forward pass over transparent surfaces. They are not lit: a limit that the README names.
#include "renderer/passes/passes.h"

#include <algorithm>

namespace kilolux {

namespace {
gpu::GraphicsPass makePass(gpu::PassResources& resources, const char* name, gpu::ColorTarget::Blend blend) {
    return gpu::GraphicsPass(
        resources, name, joined({{{"Frame"}, {"gDepth"}}, surfaceUses()}),
        {.vertex = "draw_instance", .colors = {{"sceneColor", VK_FORMAT_R32G32B32A32_SFLOAT, blend}}});
}
} // namespace

TransparentPass::TransparentPass(gpu::PassResources& resources)
    : tint_(makePass(resources, "forward_tint", gpu::ColorTarget::Blend::Multiply)),
      emission_(makePass(resources, "forward_emission", gpu::ColorTarget::Blend::Add)) {}

void TransparentPass::draw(FrameContext& frame, gpu::GraphicsPass& pass, const std::vector<DrawItem>& items,
                           const gpu::Image& color) {
    frame.commands.use(frame.scene.indexBuffer(), gpu::Usage::IndexRead);
    pass.record(frame.commands, frame.features,
                joined({{{"Frame", frame.frameBuffer}, {"gDepth", frame.targets.gDepth}},
                        frame.scene.surfaceBindings()}),
                {}, frame.constants.size.x, frame.constants.size.y, {{.image = &color, .load = true}}, {},
                [&](VkCommandBuffer commands) { drawVisible(commands, frame, items); });
}

void TransparentPass::record(FrameContext& frame, const gpu::Image& color) {
    std::vector<DrawItem> items = frame.scene.transparentDraws();
    if (items.empty()) return;
    const glm::dvec3 camera = glm::dvec3(frame.constants.originBase) + frame.scene.anchor();
    const auto distance = [&](const DrawItem& item) {
        const glm::dvec3 offset = 0.5 * (item.boundsMin + item.boundsMax) - camera;
        return glm::dot(offset, offset);
    };
    std::stable_sort(items.begin(), items.end(),
                     [&](const DrawItem& a, const DrawItem& b) { return distance(a) > distance(b); });
    // Tints commute, so they go in runs; only an emitter must come after those behind it.
    std::vector<DrawItem> run;
    for (const DrawItem& item : items) {
        run.push_back(item);
        if (!item.emits) continue;
        draw(frame, tint_, run, color);
        draw(frame, emission_, {item}, color);
        run.clear();
    }
    if (!run.empty()) draw(frame, tint_, run, color);
}

} // namespace kilolux
