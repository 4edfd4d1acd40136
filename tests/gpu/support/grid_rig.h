// The light grid by itself, for its tests and its bench: a scene's lights into the cells of a camera's view,
// over depths that the caller gives instead of a G-buffer.
#pragma once

#include "renderer/camera.h"
#include "renderer/passes/passes.h"

#include <random>

namespace kilolux::test {

// What the two passes wrote.
struct GridLists {
    std::vector<shared::GridCell> cells;
    std::vector<std::uint32_t> indices; // as many as the lists wanted, at most the capacity
    GridUse use;

    std::span<const std::uint32_t> of(std::size_t cell) const;
};

struct GridView {
    Camera camera;
    int widthPx = 0, heightPx = 0;
    double extentM = 1.0; // what the slices are spread over
};

// Made once: their shaders are compiled here.
struct GridPasses {
    explicit GridPasses(gpu::PassResources& passResources)
        : resources(passResources), pyramid(passResources), grid(passResources) {}
    gpu::PassResources& resources;
    DepthPyramidPass pyramid;
    LightGridPass grid;
};

class GridRig {
  public:
    // `scene` needs geometry that is no more than a token; ranges are derived for `exposureEv100`.
    GridRig(GridPasses& passes, const Scene& scene, const GridView& view, double exposureEv100);

    // One linear depth a pixel, row by row; DEPTH_SKY where there is no surface. Makes the pyramid.
    void setDepths(const std::vector<float>& depthsM);
    void submit(std::uint32_t threadLights); // the two passes; waits for them
    GridLists read();                        // what they wrote; makes room for what they wanted
    GridLists run(std::uint32_t threadLights);
    // Room for the fine lists, in indices, beyond that of all coarse ones.
    void limitFineIndices(std::uint32_t indices) { grid_.limitFineIndices(indices); }

    const shared::FrameConstants& constants() const { return constants_; }
    const GpuScene& scene() const { return *scene_; }
    const LightGrid& grid() const { return grid_; }
    const Targets& targets() const { return targets_; }
    const gpu::Buffer& frameBuffer() const { return frameBuffer_; }

  private:
    FrameContext context(gpu::Commands& commands);

    GridPasses& passes_;
    gpu::Device& device_;
    std::unique_ptr<GpuScene> scene_;
    Targets targets_;
    LightGrid grid_;
    shared::FrameConstants constants_{};
    gpu::Buffer frameBuffer_, counters_;
};

// A scene of `count` lights of every type within `spreadM` of the origin on each axis, turned anyhow. Ranges
// from a thousandth of the spread to `longestRange` of it, as many in every octave; cones from 0.06 to 90
// degrees; every other rectangle with barn doors, some lights with a profile; some lights muted, some without
// a range. Its geometry is one small box.
struct LightCrowd {
    int count = 100;
    double spreadM = 1.0;
    double longestRange = 1.0;
    std::uint32_t seed = 1;
};
Scene crowdScene(const LightCrowd& crowd);

} // namespace kilolux::test
