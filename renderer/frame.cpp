// The frame from top to bottom.
#include "renderer/frame.h"

#include "shaders/shared/features.h"

#include <algorithm>

namespace kilolux {

FramePasses::FramePasses(gpu::PassResources& resources, const FramePlan& plan)
    : resolveGBuffer(resources), depthPyramid(resources), lightGrid(resources), composite(resources),
      toneMap(resources) {
    if (plan.producer == GBufferProducer::Raster) {
        rasterVisibility = std::make_unique<RasterVisibilityPass>(resources);
    } else {
        traceVisibility = std::make_unique<TraceVisibilityPass>(resources, plan.tracer);
    }
    if (plan.stochastic()) {
        sampleLights = std::make_unique<SampleLightsPass>(resources, plan.choices);
        if (plan.halfSampling) upsampleSamples = std::make_unique<UpsampleSamplesPass>(resources);
        if (plan.compactRays) compactRays = std::make_unique<CompactRaysPass>(resources);
        traceSamples = std::make_unique<TraceSamplesPass>(resources, plan.tracer);
        visibleList = std::make_unique<VisibleListPass>(resources);
        shadeSamples = std::make_unique<ShadeSamplesPass>(resources);
        countLights = std::make_unique<CountLightsPass>(resources);
    } else if (plan.resamples()) {
        resampleLights = std::make_unique<ResampleLightsPass>(resources, plan.tracer);
        reuseReservoirs = std::make_unique<ReuseReservoirsPass>(resources, plan.tracer);
        countLights = std::make_unique<CountLightsPass>(resources);
    } else {
        if (plan.mapsShadows()) shadowMaps = std::make_unique<ShadowMapsPass>(resources);
        lightAll = std::make_unique<LightAllPass>(resources, plan.tracer);
    }
    if (plan.denoise) {
        denoiseTemporal = std::make_unique<DenoiseTemporalPass>(resources);
        denoiseSpatial = std::make_unique<DenoiseSpatialPass>(resources);
    }
    if (plan.antiAlias) antiAlias = std::make_unique<AntiAliasPass>(resources);
    if (plan.mean) accumulate = std::make_unique<AccumulatePass>(resources);
    if (plan.settle) settle = std::make_unique<SettlePass>(resources);
    if (plan.transparent) transparent = std::make_unique<TransparentPass>(resources);
    if (plan.view != 0) debugView = std::make_unique<DebugViewPass>(resources);
}

void planFilters(FramePlan& plan, const Settings& settings) {
    const PictureChoice picture = settings.picture;
    if (!plan.filtersLight()) return;
    const bool filtered = picture == PictureChoice::Viewport || picture == PictureChoice::Denoised;
    plan.denoise = settings.denoise && (filtered || isDenoiserView(plan.view));
    plan.antiAlias = settings.antiAlias && filtered;
    plan.mean = picture == PictureChoice::Viewport || picture == PictureChoice::Mean;
    plan.settle = picture == PictureChoice::Viewport;
}

shared::DenoisingConstants denoisingConstants(const Settings& s) {
    shared::DenoisingConstants c{};
    c.diffuseFrames = float(s.diffuseFrames);
    c.specularFrames = float(s.specularFrames);
    c.leastFrames = float(s.leastFrames);
    c.clipWidth = float(s.clipWidth);
    c.clipExtent = float(s.clipExtent);
    c.momentFrames = float(s.momentFrames);
    c.depthTolerance = float(s.depthTolerance);
    c.normalTolerance = float(s.normalTolerance);
    c.spatialRadiusPx = float(s.spatialRadius);
    c.spatialThreshold = float(s.spatialThreshold);
    c.spatialTaps = float(s.spatialTaps);
    c.spatialTapsNew = float(s.spatialTapsNew);
    c.spatialNewFrames = float(s.spatialNewFrames);
    c.spatialDeviations = float(s.spatialDeviations);
    c.spatialPlanePx = float(s.spatialPlane);
    c.spatialNormal = float(s.spatialNormal);
    c.antiAliasFrames = float(s.antiAliasFrames);
    c.antiAliasClip = float(s.antiAliasClip);
    c.antiAliasSureClip = float(s.antiAliasSureClip);
    c.antiAliasExtent = float(s.antiAliasExtent);
    c.antiAliasLeastFrames = float(s.antiAliasLeastFrames);
    c.antiAliasMovingFrames = float(s.antiAliasMovingFrames);
    c.antiAliasMomentFrames = float(s.antiAliasMomentFrames);
    c.settleError = float(s.settleError);
    c.settleBegin = float(s.settleBegin);
    // What rises from one to the other needs a way between them.
    c.settleFirstFrames = float(s.settleFirstFrames);
    c.settleFullFrames = float(std::max(s.settleFullFrames, s.settleFirstFrames + 1));
    c.settleFaultBegin = float(s.settleFaultBegin);
    c.settleFaultSure = float(std::max(s.settleFaultSure, s.settleFaultBegin + 0.01));
    return c;
}

shared::ResamplingConstants resamplingConstants(Method method, const Settings& s) {
    const bool resamples = method == Method::Resampling || method == Method::Restir;
    shared::ResamplingConstants c{};
    c.candidates = resamples ? std::uint32_t(s.resampleCandidates) : 1u;
    c.reuse = method == Method::Restir;
    c.mostHistory = float(s.reuseFrames) * float(c.candidates);
    c.neighbours = std::uint32_t(s.reuseNeighbours);
    c.radiusPx = float(s.reuseRadius);
    c.weights = std::uint32_t(s.reuseWeights);
    return c;
}

int drawnFrom(Method method, const Settings& s) {
    switch (method) {
    case Method::Power:
        return shared::DRAW_FROM_POWER;
    case Method::Brdf:
        return shared::DRAW_FROM_BRDF;
    case Method::Hierarchy:
        return shared::DRAW_FROM_TREE;
    case Method::Resampling:
    case Method::Restir:
        if (s.resampleFrom == ResampleFrom::Power) return shared::DRAW_FROM_POWER;
        return s.resampleFrom == ResampleFrom::Hierarchy ? shared::DRAW_FROM_TREE : shared::DRAW_FROM_CELL;
    default:
        return shared::DRAW_FROM_CELL;
    }
}

const gpu::Image& shownPicture(const Targets& targets, const FramePlan& plan) {
    if (plan.settle) return targets.viewportColor;
    if (plan.mean) return targets.meanColor;
    return plan.antiAlias ? targets.antiAliased : targets.sceneColor;
}

void recordFrame(FrameContext& frame, FramePasses& passes, const FramePlan& plan, const gpu::Bindings& world,
                 std::uint32_t framesBefore, const shared::ViewConstants& viewScale) {
    const Targets& targets = frame.targets;
    if (passes.rasterVisibility) passes.rasterVisibility->record(frame);
    if (passes.traceVisibility) passes.traceVisibility->record(frame, world);
    passes.resolveGBuffer.record(frame);
    passes.depthPyramid.record(frame);
    passes.lightGrid.record(frame);
    if (passes.shadowMaps) passes.shadowMaps->record(frame);
    if (passes.lightAll) passes.lightAll->record(frame, world, plan.lightAll);
    if (plan.stochastic()) {
        passes.sampleLights->record(frame);
        if (passes.upsampleSamples) passes.upsampleSamples->record(frame);
        for (std::uint32_t layer = 0; layer < frame.constants.sampling.rays; ++layer) {
            if (passes.compactRays) passes.compactRays->record(frame, layer);
            passes.traceSamples->record(frame, world, layer);
        }
        if (plan.writeLists) passes.visibleList->record(frame);
        passes.shadeSamples->record(frame);
        if (frame.replacedDiffuse) {
            frame.commands.copyBufferToImage(*frame.replacedDiffuse, 0, targets.litDiffuse, 0, 0);
            frame.commands.copyBufferToImage(*frame.replacedSpecular, 0, targets.litSpecular, 0, 0);
        }
    }
    if (plan.resamples()) {
        passes.resampleLights->record(frame, world, plan.resampling);
        passes.reuseReservoirs->record(frame, world, plan.resampling);
    }
    if (passes.countLights && plan.countLights) passes.countLights->record(frame);
    if (plan.denoise) {
        passes.denoiseTemporal->record(frame);
        passes.denoiseSpatial->record(frame);
    }
    passes.composite.record(frame);
    if (passes.transparent) {
        passes.transparent->record(frame, targets.sceneColor);
        if (plan.keepsRaw()) passes.transparent->record(frame, targets.rawColor);
    }
    if (passes.antiAlias) passes.antiAlias->record(frame);
    if (passes.accumulate) passes.accumulate->record(frame, framesBefore);
    if (passes.settle) passes.settle->record(frame);
    passes.toneMap.record(frame, shownPicture(targets, plan));
    if (plan.view != shared::VIEW_FINAL)
        passes.debugView->record(frame, viewScale, shownPicture(targets, plan));
}

} // namespace kilolux
