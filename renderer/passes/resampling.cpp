// The baselines that resample lights: choice of a light and a point on it, reuse of reservoirs, shading.
#include "renderer/passes/passes.h"

namespace kilolux {

using gpu::Access;

ResampleLightsPass::ResampleLightsPass(gpu::PassResources& resources, TraceBackEnd tracer)
    : pass_(resources, "resample_lights",
            joined({receiverUses(),
                    {{"motion"},
                     {"previousSurface"},
                     {"previousReservoirs"},
                     {"GridCells"},
                     {"gridIndices"},
                     {"LightPowers", Access::Read, gpu::Presence::Optional},
                     {"LightTree", Access::Read, gpu::Presence::Optional},
                     {"reservoirsOut", Access::Write},
                     {"Counters", Access::ReadWrite}},
                    traceUses(tracer)}),
            {}, tracerDefines(tracer)) {}

void ResampleLightsPass::record(FrameContext& frame, const gpu::Bindings& world,
                                const shared::ResamplingConstants& how) {
    const Targets& targets = frame.targets;
    pass_.record(frame.commands, frame.features,
                 joined({receiverBindings(frame),
                         {{"motion", targets.motion},
                          {"previousSurface", targets.previousSurface},
                          {"previousReservoirs", targets.previousReservoirs},
                          {"GridCells", frame.grid.cells()},
                          {"gridIndices", frame.grid.indices()},
                          {"reservoirsOut", targets.newReservoirs},
                          {"Counters", frame.counters}},
                         frame.scene.lightDrawBindings(),
                         world}),
                 how, frame.tiles());
}

ReuseReservoirsPass::ReuseReservoirsPass(gpu::PassResources& resources, TraceBackEnd tracer)
    : pass_(resources, "reuse_reservoirs",
            joined({receiverUses(),
                    {{"newReservoirs"},
                     {"reservoirsOut", Access::Write},
                     {"rayResultsOut", Access::Write},
                     {"litDiffuseOut", Access::Write},
                     {"litSpecularOut", Access::Write},
                     {"Counters", Access::ReadWrite}},
                    traceUses(tracer)}),
            {}, tracerDefines(tracer)) {}

void ReuseReservoirsPass::record(FrameContext& frame, const gpu::Bindings& world,
                                 const shared::ResamplingConstants& how) {
    const Targets& targets = frame.targets;
    pass_.record(frame.commands, frame.features,
                 joined({receiverBindings(frame),
                         {{"newReservoirs", targets.newReservoirs},
                          {"reservoirsOut", targets.reservoirs},
                          {"rayResultsOut", targets.rayResults},
                          {"litDiffuseOut", targets.litDiffuse},
                          {"litSpecularOut", targets.litSpecular},
                          {"Counters", frame.counters}},
                         world}),
                 how, frame.tiles());
}

} // namespace kilolux
