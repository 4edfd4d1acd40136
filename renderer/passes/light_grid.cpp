// Lights into cells of the view, in two passes over the coarse cells: all lights into each, then its list
// into the fine cells within.
#include "renderer/passes/passes.h"

namespace kilolux {

using gpu::Access;

LightGridPass::LightGridPass(gpu::PassResources& resources)
    : coarse_(resources, "cull_coarse",
              joined({{{"Frame"},
                       {"pyramid"},
                       {"CoarseCells", Access::Write},
                       {"GridIndices", Access::Write},
                       {"GridCounters", Access::ReadWrite}},
                      lightUses()})),
      fine_(resources, "cull_fine",
            joined({{{"Frame"},
                     {"pyramid"},
                     {"CoarseCells"},
                     {"GridCells", Access::Write},
                     {"GridIndices", Access::ReadWrite},
                     {"GridCounters", Access::ReadWrite}},
                    lightUses()})) {}

void LightGridPass::record(FrameContext& frame) {
    if (!frame.constants.grid.enabled) return;
    const LightGrid& grid = frame.grid;
    frame.commands.fillBuffer(grid.counters(), 0);
    const glm::uvec3 coarse = frame.constants.grid.coarseSize;
    coarse_.record(frame.commands, frame.features,
                   joined({{{"Frame", frame.frameBuffer},
                            {"pyramid", frame.targets.pyramid},
                            {"CoarseCells", grid.coarseCells()},
                            {"GridIndices", grid.indices()},
                            {"GridCounters", grid.counters()}},
                           frame.scene.lightBindings()}),
                   {coarse.x, coarse.y, coarse.z});
    fine_.record(frame.commands, frame.features,
                 joined({{{"Frame", frame.frameBuffer},
                          {"pyramid", frame.targets.pyramid},
                          {"CoarseCells", grid.coarseCells()},
                          {"GridCells", grid.cells()},
                          {"GridIndices", grid.indices()},
                          {"GridCounters", grid.counters()}},
                         frame.scene.lightBindings()}),
                 {coarse.x, coarse.y, coarse.z});
}

} // namespace kilolux
