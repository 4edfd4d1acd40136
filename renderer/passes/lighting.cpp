// Direct light of all lights, and the picture before transparent surfaces.
#include "renderer/passes/passes.h"

namespace kilolux {

using gpu::Access;

LightAllPass::LightAllPass(gpu::PassResources& resources, TraceBackEnd tracer)
    : pass_(resources, "light_all",
            joined({{{"Frame"},
                     {"gSurface"},
                     {"gMaterial"},
                     {"litDiffuseOut", Access::Write},
                     {"litSpecularOut", Access::Write},
                     {"lightCountsOut", Access::Write},
                     {"GridCells"},
                     {"GridIndices"},
                     {"Counters", Access::ReadWrite},
                     {"ShadowMaps", Access::Read, gpu::Presence::Optional},
                     {"shadowDepths", Access::Read, gpu::Presence::Optional}},
                    lightUses(),
                    traceUses(tracer)}),
            {}, tracerDefines(tracer)) {}

void LightAllPass::record(FrameContext& frame, const gpu::Bindings& world, const Counts& counts) {
    const Targets& targets = frame.targets;
    gpu::Bindings maps;
    if (frame.shadowMaps)
        maps = {{"ShadowMaps", frame.shadowMaps->maps()}, {"shadowDepths", frame.shadowMaps->depths()}};
    pass_.record(frame.commands, frame.features,
                 joined({{{"Frame", frame.frameBuffer},
                          {"gSurface", targets.gSurface},
                          {"gMaterial", targets.gMaterial},
                          {"litDiffuseOut", targets.litDiffuse},
                          {"litSpecularOut", targets.litSpecular},
                          {"lightCountsOut", targets.lightCounts},
                          {"GridCells", frame.grid.cells()},
                          {"GridIndices", frame.grid.indices()},
                          {"Counters", frame.counters}},
                         maps,
                         frame.scene.lightBindings(),
                         world}),
                 counts, frame.tiles());
}

CompositePass::CompositePass(gpu::PassResources& resources)
    : pass_(resources, "composite",
            {{"Frame"},
             {"gSurface"},
             {"gMaterial"},
             {"gEmissive"},
             {"litDiffuse"},
             {"litSpecular"},
             {"rawDiffuse", Access::Read, gpu::Presence::Optional},
             {"rawSpecular", Access::Read, gpu::Presence::Optional},
             {"ltcScales"},
             {"domeRadiances", Access::Read, gpu::Presence::Optional},
             {"sceneColorOut", Access::Write},
             {"rawColorOut", Access::Write, gpu::Presence::Optional}}) {}

void CompositePass::record(FrameContext& frame) {
    const Targets& targets = frame.targets;
    const bool denoised = bool(targets.denoisedDiffuse);
    gpu::Bindings both;
    if (targets.rawColor) {
        both = {{"rawDiffuse", targets.litDiffuse},
                {"rawSpecular", targets.litSpecular},
                {"rawColorOut", targets.rawColor}};
    }
    pass_.record(frame.commands, frame.features,
                 joined({both,
                         frame.scene.backgroundBindings(),
                         {{"Frame", frame.frameBuffer},
                          {"gSurface", targets.gSurface},
                          {"gMaterial", targets.gMaterial},
                          {"gEmissive", targets.gEmissive},
                          {"litDiffuse", denoised ? targets.denoisedDiffuse : targets.litDiffuse},
                          {"litSpecular", denoised ? targets.denoisedSpecular : targets.litSpecular},
                          frame.scene.environmentBrdf(),
                          {"sceneColorOut", targets.sceneColor}}}),
                 frame.tiles());
}

} // namespace kilolux
