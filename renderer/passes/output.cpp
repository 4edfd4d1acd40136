// Running mean, display transform and debug views.
#include "renderer/passes/passes.h"

namespace kilolux {

using gpu::Access;

AccumulatePass::AccumulatePass(gpu::PassResources& resources)
    : pass_(resources, "accumulate", {{"Frame"}, {"sceneColor"}, {"meanColor", Access::ReadWrite}}) {}

void AccumulatePass::record(FrameContext& frame, std::uint32_t framesBefore) {
    pass_.record(frame.commands, frame.features,
                 {{"Frame", frame.frameBuffer},
                  {"sceneColor", frame.targets.sceneColor},
                  {"meanColor", frame.targets.meanColor}},
                 framesBefore, frame.tiles());
}

ToneMapPass::ToneMapPass(gpu::PassResources& resources)
    : pass_(resources, "tone_map", {{"Frame"}, {"meanColor"}, {"displayOut", Access::Write}}) {}

void ToneMapPass::record(FrameContext& frame) {
    pass_.record(frame.commands, frame.features,
                 {{"Frame", frame.frameBuffer},
                  {"meanColor", frame.targets.meanColor},
                  {"displayOut", frame.targets.display}},
                 frame.tiles());
}

DebugViewPass::DebugViewPass(gpu::PassResources& resources)
    : pass_(resources, "debug_view",
            {{"Frame"},
             {"visibility"},
             {"gDepth"},
             {"gNormals"},
             {"gMaterial"},
             {"gEmissive"},
             {"litDiffuse"},
             {"litSpecular"},
             {"lightCounts"},
             {"pyramid"},
             {"ltcScales"},
             {"samples", Access::Read, gpu::Presence::Optional},
             {"rayResults", Access::Read, gpu::Presence::Optional},
             {"visibleLists", Access::Read, gpu::Presence::Optional},
             {"displayOut", Access::Write},
             {"viewValuesOut", Access::Write}}) {}

void DebugViewPass::record(FrameContext& frame, float depthScaleM) {
    const Targets& targets = frame.targets;
    gpu::Bindings sampling;
    if (frame.lists) {
        sampling = {{"samples", targets.samples},
                    {"rayResults", targets.rayResults},
                    {"visibleLists", frame.lists->current()}};
    }
    pass_.record(frame.commands, frame.features,
                 joined({sampling,
                         {{"Frame", frame.frameBuffer},
                          {"visibility", targets.visibility},
                          {"gDepth", targets.gDepth},
                          {"gNormals", targets.gNormals},
                          {"gMaterial", targets.gMaterial},
                          {"gEmissive", targets.gEmissive},
                          {"litDiffuse", targets.litDiffuse},
                          {"litSpecular", targets.litSpecular},
                          {"lightCounts", targets.lightCounts},
                          {"pyramid", targets.pyramid},
                          frame.scene.environmentBrdf(),
                          {"displayOut", targets.display},
                          {"viewValuesOut", targets.viewValues}}}),
                 depthScaleM, frame.tiles());
}

} // namespace kilolux
