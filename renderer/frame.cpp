// The frame from top to bottom.
#include "renderer/frame.h"

namespace kilolux {

FramePasses::FramePasses(gpu::PassResources& resources, const FramePlan& plan)
    : resolveGBuffer(resources), depthPyramid(resources), lightGrid(resources),
      lightAll(resources, plan.tracer), composite(resources), accumulate(resources), toneMap(resources) {
    if (plan.producer == GBufferProducer::Raster) {
        rasterVisibility = std::make_unique<RasterVisibilityPass>(resources);
    } else {
        traceVisibility = std::make_unique<TraceVisibilityPass>(resources, plan.tracer);
    }
    if (plan.transparent) transparent = std::make_unique<TransparentPass>(resources);
    if (plan.view != 0) debugView = std::make_unique<DebugViewPass>(resources);
}

void recordFrame(FrameContext& frame, FramePasses& passes, const FramePlan& plan, const gpu::Bindings& world,
                 std::uint32_t framesBefore, float depthScaleM) {
    if (passes.rasterVisibility) passes.rasterVisibility->record(frame);
    if (passes.traceVisibility) passes.traceVisibility->record(frame, world);
    passes.resolveGBuffer.record(frame);
    passes.depthPyramid.record(frame);
    passes.lightGrid.record(frame);
    passes.lightAll.record(frame, world, plan.raysPerLight);
    passes.composite.record(frame);
    if (passes.transparent) passes.transparent->record(frame);
    passes.accumulate.record(frame, framesBefore);
    passes.toneMap.record(frame);
    if (passes.debugView) passes.debugView->record(frame, depthScaleM);
}

} // namespace kilolux
