// The pass of the probe.
#include "renderer/passes/passes.h"

namespace kilolux {

using gpu::Access;
using gpu::Presence;

static std::vector<std::string> defines(TraceBackEnd tracer, std::uint32_t choices) {
    std::vector<std::string> result = tracerDefines(tracer);
    result.push_back(sampleRoom(choices));
    return result;
}

ProbePass::ProbePass(gpu::PassResources& resources, TraceBackEnd tracer, std::uint32_t choices)
    : pass_(resources, "probe",
            joined({receiverUses(),
                    {{"visibility"},
                     {"picture"},
                     {"viewValues"},
                     {"litDiffuse"},
                     {"GridCells"},
                     {"gridIndices"},
                     {"DirectionalSlots"},
                     // Only of the stochastic method.
                     {"motion", Access::Read, Presence::Optional},
                     {"previousSurface", Access::Read, Presence::Optional},
                     {"visibleLists", Access::Read, Presence::Optional},
                     {"noiseMask", Access::Read, Presence::Optional},
                     {"samples", Access::Read, Presence::Optional},
                     {"rayResults", Access::Read, Presence::Optional},
                     {"ProbeSurfaceOut", Access::Write},
                     {"ProbeLights", Access::ReadWrite},
                     {"ProbeRays", Access::Write}},
                    traceUses(tracer)}),
            {}, defines(tracer, choices)) {}

void ProbePass::record(FrameContext& frame, const gpu::Bindings& world, const gpu::Buffer* lists,
                       const shared::ProbeRequest& request, const Images& images, const Results& results) {
    const Targets& targets = frame.targets;
    gpu::Bindings choice;
    if (lists) {
        choice = {{"motion", targets.motion},
                  {"previousSurface", targets.previousSurface},
                  {"visibleLists", *lists},
                  {"noiseMask", *frame.noise},
                  {"samples", targets.samplesHalf ? targets.samplesHalf : targets.samples},
                  {"rayResults", targets.rayResults}};
    }
    pass_.record(frame.commands, frame.features,
                 joined({receiverBindings(frame),
                         choice,
                         {{"visibility", targets.visibility},
                          {"picture", images.picture},
                          {"viewValues", images.viewValues},
                          {"litDiffuse", images.diffuse},
                          {"GridCells", frame.grid.cells()},
                          {"gridIndices", frame.grid.indices()},
                          {"DirectionalSlots", frame.scene.directionalSlots()},
                          {"ProbeSurfaceOut", results.surface},
                          {"ProbeLights", results.lights},
                          {"ProbeRays", results.rays}},
                         world}),
                 request, {1});
}

} // namespace kilolux
