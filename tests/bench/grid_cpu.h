// The light grid as a plain loop on one thread, in floats: what the two GPU passes are measured against.
#pragma once

#include "shaders/shared/frame.h"
#include "shaders/shared/gpu_light.h"

#include <cstdint>
#include <vector>

namespace kilolux::test {

struct CpuGrid {
    std::vector<shared::GridCell> cells;
    std::vector<std::uint32_t> indices; // coarse and fine lists
    std::size_t tests = 0;              // of a light against a cell
};

// `depthsM`: one a pixel. The depths of the cells' surfaces are found first, outside of what is measured.
class CpuGridBuilder {
  public:
    CpuGridBuilder(const shared::FrameConstants& frame, const std::vector<float>& depthsM,
                   const std::vector<shared::LightHot>& lights);
    // Coarse cells from all lights, fine ones from their coarse cell's list; with `coarse` false, fine cells
    // from all.
    enum class Passes { Two, One };
    void build(Passes passes);
    const CpuGrid& grid() const { return grid_; }

  private:
    struct Light {
        glm::vec3 center, axis;
        float radius2M2, cosine, sine;
        std::uint32_t type;
        bool on;
    };
    struct Cell {
        glm::vec3 center, right, down, forward, halfM;
        bool seen = false;
    };
    Cell cellOf(const glm::uvec3& firstFine, const glm::uvec3& endFine) const;
    static bool reaches(const Light& light, const Cell& cell);
    template<typename Slots>
    shared::GridCell fill(const Cell& cell, const Slots& slots, std::size_t count);

    const shared::FrameConstants& frame_;
    std::vector<shared::LightHot> hot_;
    std::vector<Light> lights_;
    std::vector<glm::vec2> columnDepths_; // nearest and farthest, of each column of fine cells
    CpuGrid grid_;
};

} // namespace kilolux::test
