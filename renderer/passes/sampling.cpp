// The passes of stochastic direct lighting, from the choice of lights to shaded samples.
#include "renderer/passes/passes.h"

#include <fmt/format.h>

namespace kilolux {

using gpu::Access;

namespace {

std::vector<gpu::PassUse> receiverUses() {
    return joined({{{"Frame"}, {"gDepth"}, {"gNormals"}, {"gMaterial"}}, lightUses()});
}

gpu::Bindings receiverBindings(const FrameContext& frame) {
    return joined({{{"Frame", frame.frameBuffer},
                    {"gDepth", frame.targets.gDepth},
                    {"gNormals", frame.targets.gNormals},
                    {"gMaterial", frame.targets.gMaterial}},
                   frame.scene.lightBindings()});
}

// The reservoirs of a pixel live in registers. GLSL cannot pass structs with arrays that a specialization
// constant sizes, so their number is a definition: three variants of the shader.
std::string sampleRoom(std::uint32_t choices) {
    return fmt::format("KX_MAX_SAMPLES {}", choices <= 1 ? 1 : choices <= 4 ? 4 : 64);
}

} // namespace

SampleLightsPass::SampleLightsPass(gpu::PassResources& resources, std::uint32_t choices)
    : pass_(resources, "sample_lights",
            joined({receiverUses(),
                    {{"motion"},
                     {"previousDepth"},
                     {"visibleLists"},
                     {"noiseMask"},
                     {"GridCells"},
                     {"gridIndices"},
                     {"DirectionalSlots"},
                     {"samplesOut", Access::Write},
                     {"Counters", Access::ReadWrite}}}),
            {}, {sampleRoom(choices)}) {}

void SampleLightsPass::record(FrameContext& frame) {
    const Targets& targets = frame.targets;
    const bool half = frame.constants.sampling.choices != frame.constants.sampling.rays;
    const glm::uvec2 tiles = half ? (frame.constants.tiles + 1u) / 2u : frame.constants.tiles;
    pass_.record(frame.commands, frame.features,
                 joined({receiverBindings(frame),
                         {{"motion", targets.motion},
                          {"previousDepth", targets.previousDepth},
                          {"visibleLists", frame.lists->previous()},
                          {"noiseMask", *frame.noise},
                          {"GridCells", frame.grid.cells()},
                          {"gridIndices", frame.grid.indices()},
                          {"DirectionalSlots", frame.scene.directionalSlots()},
                          {"samplesOut", half ? targets.samplesHalf : targets.samples},
                          {"Counters", frame.counters}}}),
                 {tiles.x * tiles.y});
}

UpsampleSamplesPass::UpsampleSamplesPass(gpu::PassResources& resources)
    : pass_(resources, "upsample_samples",
            {{"Frame"}, {"gDepth"}, {"gNormals"}, {"samplesHalf"}, {"samplesOut", Access::Write}}) {}

void UpsampleSamplesPass::record(FrameContext& frame) {
    pass_.record(frame.commands, frame.features,
                 {{"Frame", frame.frameBuffer},
                  {"gDepth", frame.targets.gDepth},
                  {"gNormals", frame.targets.gNormals},
                  {"samplesHalf", frame.targets.samplesHalf},
                  {"samplesOut", frame.targets.samples}},
                 frame.tiles());
}

TraceSamplesPass::TraceSamplesPass(gpu::PassResources& resources, TraceBackEnd tracer)
    : pass_(resources, "trace_samples",
            joined({receiverUses(),
                    {{"samples"}, {"rayResultsOut", Access::Write}, {"Counters", Access::ReadWrite}},
                    traceUses(tracer)}),
            {}, tracerDefines(tracer)) {}

void TraceSamplesPass::record(FrameContext& frame, const gpu::Bindings& world) {
    for (std::uint32_t layer = 0; layer < frame.constants.sampling.rays; ++layer) {
        pass_.record(frame.commands, frame.features,
                     joined({receiverBindings(frame),
                             {{"samples", frame.targets.samples},
                              {"rayResultsOut", frame.targets.rayResults},
                              {"Counters", frame.counters}},
                             world}),
                     layer, frame.tiles());
    }
}

VisibleListPass::VisibleListPass(gpu::PassResources& resources)
    : pass_(resources, "visible_list",
            joined({{{"Frame"},
                     {"motion"},
                     {"samples"},
                     {"rayResults"},
                     {"visibleLists"},
                     {"VisibleListsOut", Access::Write},
                     {"Counters", Access::ReadWrite}},
                    lightUses()})) {}

void VisibleListPass::record(FrameContext& frame) {
    pass_.record(frame.commands, frame.features,
                 joined({{{"Frame", frame.frameBuffer},
                          {"motion", frame.targets.motion},
                          {"samples", frame.targets.samples},
                          {"rayResults", frame.targets.rayResults},
                          {"visibleLists", frame.lists->previous()},
                          {"VisibleListsOut", frame.lists->current()},
                          {"Counters", frame.counters}},
                         frame.scene.lightBindings()}),
                 frame.tiles());
}

ShadeSamplesPass::ShadeSamplesPass(gpu::PassResources& resources)
    : pass_(resources, "shade_samples",
            joined({receiverUses(),
                    {{"samples"},
                     {"rayResults"},
                     {"litDiffuseOut", Access::Write},
                     {"litSpecularOut", Access::Write}}})) {}

void ShadeSamplesPass::record(FrameContext& frame) {
    pass_.record(frame.commands, frame.features,
                 joined({receiverBindings(frame),
                         {{"samples", frame.targets.samples},
                          {"rayResults", frame.targets.rayResults},
                          {"litDiffuseOut", frame.targets.litDiffuse},
                          {"litSpecularOut", frame.targets.litSpecular}}}),
                 frame.tiles());
}

CountLightsPass::CountLightsPass(gpu::PassResources& resources)
    : pass_(resources, "count_lights",
            joined({receiverUses(),
                    {{"rayResults"},
                     {"GridCells"},
                     {"gridIndices"},
                     {"lightCountsOut", Access::Write},
                     {"Counters", Access::ReadWrite}}})) {}

void CountLightsPass::record(FrameContext& frame) {
    pass_.record(frame.commands, frame.features,
                 joined({receiverBindings(frame),
                         {{"rayResults", frame.targets.rayResults},
                          {"GridCells", frame.grid.cells()},
                          {"gridIndices", frame.grid.indices()},
                          {"lightCountsOut", frame.targets.lightCounts},
                          {"Counters", frame.counters}}}),
                 frame.tiles());
}

} // namespace kilolux
