// What turns noisy light into a picture: the denoiser, temporal anti-aliasing, and the passage to the mean.
#include "renderer/passes/passes.h"

namespace kilolux {

using gpu::Access;
using gpu::Presence;

DenoiseTemporalPass::DenoiseTemporalPass(gpu::PassResources& resources)
    : pass_(resources, "denoise_temporal",
            {{"Frame"},
             {"gSurface"},
             {"motion"},
             {"litDiffuse"},
             {"litSpecular"},
             {"previousSurface"},
             {"previousDiffuse"},
             {"previousSpecular"},
             {"previousMoments"},
             {"historyDiffuseOut", Access::Write},
             {"historySpecularOut", Access::Write},
             {"historyMomentsOut", Access::Write},
             {"denoiseTraceOut", Access::Write, Presence::Optional}}) {}

void DenoiseTemporalPass::record(FrameContext& frame) {
    const Targets& targets = frame.targets;
    gpu::Bindings bindings{{"Frame", frame.frameBuffer},
                           {"gSurface", targets.gSurface},
                           {"motion", targets.motion},
                           {"litDiffuse", targets.litDiffuse},
                           {"litSpecular", targets.litSpecular},
                           {"previousSurface", targets.previousSurface},
                           {"previousDiffuse", targets.previousDiffuse},
                           {"previousSpecular", targets.previousSpecular},
                           {"previousMoments", targets.previousMoments},
                           {"historyDiffuseOut", targets.historyDiffuse},
                           {"historySpecularOut", targets.historySpecular},
                           {"historyMomentsOut", targets.historyMoments}};
    if (targets.denoiseTrace) bindings.push_back({"denoiseTraceOut", targets.denoiseTrace});
    pass_.record(frame.commands, frame.features, bindings, frame.tiles());
}

DenoiseSpatialPass::DenoiseSpatialPass(gpu::PassResources& resources)
    : pass_(resources, "denoise_spatial",
            {{"Frame"},
             {"gSurface"},
             {"historyDiffuse"},
             {"historySpecular"},
             {"historyMoments"},
             {"denoisedDiffuseOut", Access::Write},
             {"denoisedSpecularOut", Access::Write}}) {}

void DenoiseSpatialPass::record(FrameContext& frame) {
    const Targets& targets = frame.targets;
    pass_.record(frame.commands, frame.features,
                 {{"Frame", frame.frameBuffer},
                  {"gSurface", targets.gSurface},
                  {"historyDiffuse", targets.historyDiffuse},
                  {"historySpecular", targets.historySpecular},
                  {"historyMoments", targets.historyMoments},
                  {"denoisedDiffuseOut", targets.denoisedDiffuse},
                  {"denoisedSpecularOut", targets.denoisedSpecular}},
                 frame.tiles());
}

AntiAliasPass::AntiAliasPass(gpu::PassResources& resources)
    : pass_(resources, "anti_alias",
            {{"Frame"},
             {"gDepth"},
             {"gSurface"},
             {"previousSurface"},
             {"motion"},
             {"sceneColor"},
             {"litSpecular"},
             {"historyDiffuse", Access::Read, Presence::Optional},
             {"historySpecular", Access::Read, Presence::Optional},
             {"previousAntiAliased"},
             {"previousPixelMoments"},
             {"antiAliasedOut", Access::Write},
             {"pixelMomentsOut", Access::Write}}) {}

void AntiAliasPass::record(FrameContext& frame) {
    const Targets& targets = frame.targets;
    gpu::Bindings bindings{
        {"Frame", frame.frameBuffer},
        {"gDepth", targets.gDepth},
        {"gSurface", targets.gSurface},
        {"previousSurface", targets.previousSurface},
        {"motion", targets.motion},
        {"sceneColor", targets.sceneColor},
        {"litSpecular", targets.litSpecular},
        {"previousAntiAliased", targets.previousAntiAliased, gpu::SamplerKind::LinearClamp},
        {"previousPixelMoments", targets.previousPixelMoments},
        {"antiAliasedOut", targets.antiAliased},
        {"pixelMomentsOut", targets.pixelMoments}};
    if (targets.historyDiffuse) {
        bindings.push_back({"historyDiffuse", targets.historyDiffuse});
        bindings.push_back({"historySpecular", targets.historySpecular});
    }
    pass_.record(frame.commands, frame.features, bindings, frame.tiles());
}

AccumulatePass::AccumulatePass(gpu::PassResources& resources)
    : pass_(resources, "accumulate",
            {{"Frame"},
             {"rawColor"},
             {"litDiffuse"},
             {"gDepth"},
             {"meanColor", Access::ReadWrite},
             {"meanMoments", Access::ReadWrite, Presence::Optional}}) {}

void AccumulatePass::record(FrameContext& frame, std::uint32_t framesBefore) {
    const Targets& targets = frame.targets;
    gpu::Bindings bindings{{"Frame", frame.frameBuffer},
                           {"rawColor", targets.rawColor ? targets.rawColor : targets.sceneColor},
                           {"litDiffuse", targets.litDiffuse},
                           {"gDepth", targets.gDepth},
                           {"meanColor", targets.meanColor}};
    if (targets.meanMoments) bindings.push_back({"meanMoments", targets.meanMoments});
    pass_.record(frame.commands, frame.features, bindings, framesBefore, frame.tiles());
}

SettlePass::SettlePass(gpu::PassResources& resources)
    : pass_(resources, "settle",
            {{"Frame"},
             {"filteredColor"},
             {"meanColor"},
             {"meanMoments"},
             {"pixelMoments", Access::Read, Presence::Optional},
             {"viewportColorOut", Access::Write}}) {}

void SettlePass::record(FrameContext& frame) {
    const Targets& targets = frame.targets;
    gpu::Bindings bindings{{"Frame", frame.frameBuffer},
                           {"filteredColor", targets.antiAliased ? targets.antiAliased : targets.sceneColor},
                           {"meanColor", targets.meanColor},
                           {"meanMoments", targets.meanMoments},
                           {"viewportColorOut", targets.viewportColor}};
    if (targets.pixelMoments) bindings.push_back({"pixelMoments", targets.pixelMoments});
    pass_.record(frame.commands, frame.features, bindings, frame.tiles());
}

} // namespace kilolux
