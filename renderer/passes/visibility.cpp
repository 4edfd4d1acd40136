// Which triangle each pixel sees: by raster with culling, or by nearest hit. Equal but for edge ties.
#include "renderer/passes/passes.h"

namespace kilolux {

using gpu::Access;

RasterVisibilityPass::RasterVisibilityPass(gpu::PassResources& resources)
    : pass_(resources, "raster_visibility", joined({{{"Frame"}}, geometryUses(), GpuRayWorld::alphaUses()}),
            {.vertex = "draw_instance",
             .colors = {{"visibility", VK_FORMAT_R32G32_UINT}},
             .depth = VK_FORMAT_D32_SFLOAT}) {}

void RasterVisibilityPass::record(FrameContext& frame) {
    const GpuScene& scene = frame.scene;
    frame.commands.use(scene.indexBuffer(), gpu::Usage::IndexRead);
    VkClearValue none{};
    none.color.uint32[0] = none.color.uint32[1] = 0xffffffffu;
    pass_.record(
        frame.commands, frame.features,
        joined({{{"Frame", frame.frameBuffer}}, scene.geometryBindings(), scene.rayWorld().alphaBindings()}),
        {}, frame.constants.size.x, frame.constants.size.y, {{&frame.targets.visibility, none}},
        {&frame.targets.rasterDepth},
        [&](VkCommandBuffer commands) { drawVisible(commands, frame, scene.opaqueDraws()); });
}

TraceVisibilityPass::TraceVisibilityPass(gpu::PassResources& resources, TraceBackEnd tracer)
    : pass_(resources, "trace_visibility",
            joined({{{"Frame"}, {"visibilityOut", Access::Write}}, geometryUses(), traceUses(tracer)}), {},
            tracerDefines(tracer)) {}

void TraceVisibilityPass::record(FrameContext& frame, const gpu::Bindings& world) {
    pass_.record(frame.commands, frame.features,
                 joined({{{"Frame", frame.frameBuffer}, {"visibilityOut", frame.targets.visibility}},
                         frame.scene.geometryBindings(),
                         world}),
                 frame.tiles());
}

} // namespace kilolux
