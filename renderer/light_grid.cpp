#include "renderer/light_grid.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace kilolux {

namespace {

using namespace shared;

glm::uvec3 fineSize(glm::uvec2 px) {
    return {(px + GRID_TILE_PX - 1u) / GRID_TILE_PX, GRID_SLICES};
}

glm::uvec3 coarseSize(glm::uvec3 fine) {
    return (fine + GRID_COARSE - 1u) / GRID_COARSE;
}

std::uint32_t cellCount(glm::uvec3 size) {
    return size.x * size.y * size.z;
}

constexpr std::uint32_t kFirstIndicesPerCell = 16;

} // namespace

LightGrid::LightGrid(gpu::Device& device, std::uint32_t widthPx, std::uint32_t heightPx, std::uint32_t lights)
    : device_(device), lights_(std::min(lights, GRID_MAX_LIGHTS)) {
    const glm::uvec3 fine = fineSize({widthPx, heightPx});
    const std::uint32_t coarse = cellCount(coarseSize(fine));
    const auto storage = [&](const char* name, VkDeviceSize bytes) {
        return gpu::Buffer(device_, {name, bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                     gpu::MemoryUse::DeviceOnly, "light grid"});
    };
    cells_ = storage("gridCells", cellCount(fine) * sizeof(GridCell));
    coarseCells_ = storage("coarseCells", coarse * sizeof(GridCell));
    counters_ =
        gpu::Buffer(device_, {"gridCounters", GRID_COUNTER_COUNT * 4, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                              gpu::MemoryUse::HostReadback, "light grid"});
    coarseCapacity_ = coarse * lights_;
    makeIndices(coarseCapacity_ + cellCount(fine) * kFirstIndicesPerCell);
}

void LightGrid::makeIndices(std::uint32_t capacity) {
    capacity_ = capacity;
    indices_ =
        gpu::Buffer(device_, {"gridIndices", VkDeviceSize(capacity) * 4,
                              VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                              gpu::MemoryUse::DeviceOnly, "light grid", VK_FORMAT_R32_UINT});
}

void LightGrid::limitFineIndices(std::uint32_t indices) {
    makeIndices(coarseCapacity_ + indices);
}

void LightGrid::describe(FrameConstants& frame, double extentM) const {
    GridConstants& grid = frame.grid;
    grid.fineSize = fineSize(frame.size);
    grid.coarseSize = coarseSize(grid.fineSize);
    const double firstM = std::max(extentM / 500.0, 1e-4), lastM = std::max(2.0 * extentM, 2.0 * firstM);
    grid.firstDepthM = float(firstM);
    grid.slicesPerOctave = float((GRID_SLICES - 2) / std::log2(lastM / firstM));
    // Whatever lies beyond belongs to the last slice: its box is as deep as floats may sensibly be.
    grid.lastDepthM = float(lastM * 1e3);
    grid.capacity = capacity_;
    grid.enabled = frame.lightCount > 0 && frame.lightCount <= GRID_MAX_LIGHTS;
}

GridUse LightGrid::finishFrame() {
    const std::vector<std::uint32_t> counts = counters_.downloadAs<std::uint32_t>();
    const GridUse use{counts[GRID_COUNTER_USED], capacity_, counts[GRID_COUNTER_COARSE],
                      counts[GRID_COUNTER_TESTS]};
    if (use.indices > capacity_) makeIndices(use.indices + use.indices / 4);
    return use;
}

} // namespace kilolux
