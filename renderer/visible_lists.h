// The buffers of stochastic light sampling that outlive a frame: the visible light lists of this frame and of
// the one before, and the slots of the directional lights.
#pragma once

#include "renderer/gpu/resource.h"
#include "renderer/settings.h"
#include "shaders/shared/frame.h"

#include <vector>

namespace kilolux {

class VisibleLists {
  public:
    // Room for a picture of at most width x height pixels.
    VisibleLists(gpu::Device& device, std::uint32_t widthPx, std::uint32_t heightPx);

    const gpu::Buffer& previous() const { return lists_[1 - current_]; }
    const gpu::Buffer& current() const { return lists_[current_]; }
    void turn() { current_ = 1 - current_; } // after a frame: its lists become the previous ones

    // For tests that force lists: LIST_TEXELS texels of two words a tile, as shared/sampling.h packs them.
    void replacePrevious(const std::vector<glm::uvec2>& texels);
    std::vector<glm::uvec2> readPrevious() const;

  private:
    gpu::Buffer lists_[2];
    int current_ = 0;
};

// The constants that follow from the settings alone.
shared::SamplingConstants samplingConstants(const Settings& settings);

} // namespace kilolux
