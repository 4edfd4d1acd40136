// The light grid's buffers and sizes. Its passes are in passes/light_grid.cpp.
#pragma once

#include "renderer/gpu/resource.h"
#include "shaders/shared/frame.h"

namespace kilolux {

// What a frame's grid came to; read after the frame.
struct GridUse {
    std::uint32_t indices = 0; // that all lists wanted
    std::uint32_t capacity = 0;
    std::uint32_t coarseCells = 0; // fine cells that took their coarse cell's list for want of room
    std::uint32_t tests = 0;       // light-cell tests
};

class LightGrid {
  public:
    // Buffers for pictures up to this size. `lights` slots are in the scene.
    LightGrid(gpu::Device& device, std::uint32_t widthPx, std::uint32_t heightPx, std::uint32_t lights);

    // Cells for the frame's size; slices between 1/500 and 2 times `extentM` in depth. Off where the scene
    // has no light or more than GRID_MAX_LIGHTS.
    void describe(shared::FrameConstants& frame, double extentM) const;

    // After a frame: reads what was used and makes room for the next where it was short.
    GridUse finishFrame();
    // For tests of the fallback: room for the coarse lists and this many indices more.
    void limitFineIndices(std::uint32_t indices);

    const gpu::Buffer& cells() const { return cells_; }
    const gpu::Buffer& coarseCells() const { return coarseCells_; }
    const gpu::Buffer& indices() const { return indices_; }
    const gpu::Buffer& counters() const { return counters_; }

  private:
    void makeIndices(std::uint32_t capacity);

    gpu::Device& device_;
    std::uint32_t lights_;
    std::uint32_t coarseCapacity_ = 0; // what all coarse lists may need
    std::uint32_t capacity_ = 0;
    gpu::Buffer cells_, coarseCells_, indices_, counters_;
};

} // namespace kilolux
