// Display transform and debug views.
#include "renderer/passes/passes.h"

namespace kilolux {

using gpu::Access;

ToneMapPass::ToneMapPass(gpu::PassResources& resources)
    : pass_(resources, "tone_map", {{"Frame"}, {"picture"}, {"displayOut", Access::Write}}) {}

void ToneMapPass::record(FrameContext& frame, const gpu::Image& picture) {
    pass_.record(frame.commands, frame.features,
                 {{"Frame", frame.frameBuffer}, {"picture", picture}, {"displayOut", frame.targets.display}},
                 frame.outputTiles());
}

DebugViewPass::DebugViewPass(gpu::PassResources& resources)
    : pass_(resources, "debug_view",
            {{"Frame"},
             {"visibility"},
             {"gSurface"},
             {"gMaterial"},
             {"gEmissive"},
             {"litDiffuse"},
             {"litSpecular"},
             {"lightCounts"},
             {"pyramid"},
             {"historyDiffuse", Access::Read, gpu::Presence::Optional},
             {"historyMoments", Access::Read, gpu::Presence::Optional},
             {"denoiseTrace", Access::Read, gpu::Presence::Optional},
             {"denoisedDiffuse", Access::Read, gpu::Presence::Optional},
             {"denoisedSpecular", Access::Read, gpu::Presence::Optional},
             {"ltcScales"},
             {"samples", Access::Read, gpu::Presence::Optional},
             {"rayResults", Access::Read, gpu::Presence::Optional},
             {"visibleLists", Access::Read, gpu::Presence::Optional},
             {"picture"},
             {"displayOut", Access::Write},
             {"viewValuesOut", Access::Write}}) {}

void DebugViewPass::record(FrameContext& frame, shared::ViewConstants scale, const gpu::Image& picture) {
    const Targets& targets = frame.targets;
    gpu::Bindings sampling;
    if (frame.lists) {
        sampling = {{"samples", targets.samples},
                    {"rayResults", targets.rayResults},
                    {"visibleLists", frame.lists->current()}};
    }
    gpu::Bindings filters;
    scale.denoised = bool(targets.denoisedDiffuse);
    if (targets.denoisedDiffuse) {
        filters = {{"historyDiffuse", targets.historyDiffuse},
                   {"historyMoments", targets.historyMoments},
                   {"denoisedDiffuse", targets.denoisedDiffuse},
                   {"denoisedSpecular", targets.denoisedSpecular}};
    }
    if (targets.denoiseTrace) filters.push_back({"denoiseTrace", targets.denoiseTrace});
    pass_.record(frame.commands, frame.features,
                 joined({sampling,
                         filters,
                         {{"Frame", frame.frameBuffer},
                          {"visibility", targets.visibility},
                          {"gSurface", targets.gSurface},
                          {"gMaterial", targets.gMaterial},
                          {"gEmissive", targets.gEmissive},
                          {"litDiffuse", targets.litDiffuse},
                          {"litSpecular", targets.litSpecular},
                          {"lightCounts", targets.lightCounts},
                          {"pyramid", targets.pyramid},
                          frame.scene.environmentBrdf(),
                          {"picture", picture},
                          {"displayOut", targets.display},
                          {"viewValuesOut", targets.viewValues}}}),
                 scale, frame.outputTiles());
}

} // namespace kilolux
