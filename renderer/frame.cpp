// The frame from top to bottom.
#include "renderer/frame.h"

namespace kilolux {

FramePasses::FramePasses(gpu::PassResources& resources, const FramePlan& plan)
    : resolveGBuffer(resources), depthPyramid(resources), lightGrid(resources), composite(resources),
      accumulate(resources), toneMap(resources) {
    if (plan.producer == GBufferProducer::Raster) {
        rasterVisibility = std::make_unique<RasterVisibilityPass>(resources);
    } else {
        traceVisibility = std::make_unique<TraceVisibilityPass>(resources, plan.tracer);
    }
    if (plan.stochastic()) {
        sampleLights = std::make_unique<SampleLightsPass>(resources, plan.choices);
        if (plan.halfSampling) upsampleSamples = std::make_unique<UpsampleSamplesPass>(resources);
        traceSamples = std::make_unique<TraceSamplesPass>(resources, plan.tracer);
        visibleList = std::make_unique<VisibleListPass>(resources);
        shadeSamples = std::make_unique<ShadeSamplesPass>(resources);
        countLights = std::make_unique<CountLightsPass>(resources);
    } else {
        lightAll = std::make_unique<LightAllPass>(resources, plan.tracer);
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
    if (passes.lightAll) passes.lightAll->record(frame, world, plan.raysPerLight);
    if (plan.stochastic()) {
        passes.sampleLights->record(frame);
        if (passes.upsampleSamples) passes.upsampleSamples->record(frame);
        passes.traceSamples->record(frame, world);
        if (plan.writeLists) passes.visibleList->record(frame);
        passes.shadeSamples->record(frame);
        if (plan.countLights) passes.countLights->record(frame);
    }
    passes.composite.record(frame);
    if (passes.transparent) passes.transparent->record(frame);
    passes.accumulate.record(frame, framesBefore);
    passes.toneMap.record(frame);
    if (passes.debugView) passes.debugView->record(frame, depthScaleM);
}

} // namespace kilolux
