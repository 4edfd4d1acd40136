// The passes of stochastic direct lighting, from the choice of lights to shaded samples.
#include "renderer/passes/passes.h"

#include "shaders/shared/features.h"

namespace kilolux {

using gpu::Access;

namespace {

// Of lib/ray_list.glsl; dummies stand in where there is no list.
std::vector<gpu::PassUse> rayListUses() {
    return {{"RayListHeads", Access::Read, gpu::Presence::Optional},
            {"rayList", Access::Read, gpu::Presence::Optional}};
}

gpu::Bindings rayListBindings(const FrameContext& frame) {
    if (!frame.rays) return {};
    return {{"RayListHeads", frame.rays->heads}, {"rayList", frame.rays->entries}};
}

} // namespace

SampleLightsPass::SampleLightsPass(gpu::PassResources& resources, std::uint32_t choices)
    : pass_(resources, "sample_lights",
            joined({receiverUses(),
                    {{"motion"},
                     {"previousSurface"},
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
                          {"previousSurface", targets.previousSurface},
                          {"visibleLists", frame.lists->previous()},
                          {"noiseMask", *frame.noise},
                          {"GridCells", frame.grid.cells()},
                          {"gridIndices", frame.grid.indices()},
                          {"DirectionalSlots", frame.scene.directionalSlots()},
                          {"samplesOut", half ? targets.samplesHalf : targets.samples},
                          {"Counters", frame.counters}}}),
                 {tiles.x, tiles.y});
}

UpsampleSamplesPass::UpsampleSamplesPass(gpu::PassResources& resources)
    : pass_(resources, "upsample_samples",
            {{"Frame"}, {"gSurface"}, {"samplesHalf"}, {"samplesOut", Access::Write}}) {}

void UpsampleSamplesPass::record(FrameContext& frame) {
    pass_.record(frame.commands, frame.features,
                 {{"Frame", frame.frameBuffer},
                  {"gSurface", frame.targets.gSurface},
                  {"samplesHalf", frame.targets.samplesHalf},
                  {"samplesOut", frame.targets.samples}},
                 frame.tiles());
}

CompactRaysPass::CompactRaysPass(gpu::PassResources& resources)
    : pass_(resources, "compact_rays",
            {{"Frame"},
             {"samples"},
             {"RayListHeads", Access::ReadWrite},
             {"RayListOut", Access::Write},
             {"rayResultsOut", Access::Write},
             {"litDiffuseOut", Access::Write},
             {"litSpecularOut", Access::Write}}) {}

void CompactRaysPass::record(FrameContext& frame, std::uint32_t layer) {
    const glm::uvec2 tiles = (frame.constants.size + shared::RAY_TILE_PX - 1u) / shared::RAY_TILE_PX;
    const bool onlyRay = frame.constants.sampling.rays == 1;
    pass_.record(frame.commands, frame.features,
                 {{"Frame", frame.frameBuffer},
                  {"samples", frame.targets.samples},
                  {"RayListHeads", frame.rays->heads},
                  {"RayListOut", frame.rays->entries},
                  {"rayResultsOut", frame.targets.rayResults},
                  {"litDiffuseOut", frame.targets.litDiffuse},
                  {"litSpecularOut", frame.targets.litSpecular}},
                 glm::uvec2(layer, onlyRay), {tiles.x, tiles.y});
}

TraceSamplesPass::TraceSamplesPass(gpu::PassResources& resources, TraceBackEnd tracer)
    : pass_(resources, "trace_samples",
            joined({receiverUses(),
                    rayListUses(),
                    {{"samples"}, {"rayResultsOut", Access::Write}, {"Counters", Access::ReadWrite}},
                    traceUses(tracer)}),
            {}, tracerDefines(tracer)) {}

void TraceSamplesPass::record(FrameContext& frame, const gpu::Bindings& world, std::uint32_t layer) {
    const gpu::Bindings bindings = joined({receiverBindings(frame),
                                           rayListBindings(frame),
                                           {{"samples", frame.targets.samples},
                                            {"rayResultsOut", frame.targets.rayResults},
                                            {"Counters", frame.counters}},
                                           world});
    if (frame.rays) {
        pass_.recordIndirect(frame.commands, frame.features, bindings, layer, frame.rays->heads,
                             layer * sizeof(shared::RayListHead));
    } else {
        pass_.record(frame.commands, frame.features, bindings, layer, frame.tiles());
    }
}

VisibleListPass::VisibleListPass(gpu::PassResources& resources)
    : pass_(resources, "visible_list",
            joined({{{"Frame"},
                     {"motion"},
                     {"samples"},
                     {"rayResults"},
                     {"visibleLists"},
                     {"DirectionalSlots"},
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
                          {"DirectionalSlots", frame.scene.directionalSlots()},
                          {"VisibleListsOut", frame.lists->current()},
                          {"Counters", frame.counters}},
                         frame.scene.lightBindings()}),
                 frame.tiles());
}

ShadeSamplesPass::ShadeSamplesPass(gpu::PassResources& resources)
    : pass_(resources, "shade_samples",
            joined({receiverUses(),
                    rayListUses(),
                    {{"samples"},
                     {"rayResults"},
                     {"litDiffuseOut", Access::Write},
                     {"litSpecularOut", Access::Write}}})) {}

void ShadeSamplesPass::record(FrameContext& frame) {
    const gpu::Bindings bindings = joined({receiverBindings(frame),
                                           rayListBindings(frame),
                                           {{"samples", frame.targets.samples},
                                            {"rayResults", frame.targets.rayResults},
                                            {"litDiffuseOut", frame.targets.litDiffuse},
                                            {"litSpecularOut", frame.targets.litSpecular}}});
    // Several rays are summed per pixel, so that the list of one of them does not serve.
    if (frame.rays && frame.constants.sampling.rays == 1) {
        pass_.recordIndirect(frame.commands, frame.features, bindings, frame.rays->heads, 0);
    } else {
        gpu::SpecValues features = frame.features;
        features[shared::CHOICE_COMPACT_RAYS] = 0;
        pass_.record(frame.commands, features, bindings, frame.tiles());
    }
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
