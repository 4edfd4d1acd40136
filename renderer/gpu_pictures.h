// The pictures of rectangle lights on the device: their pyramids in one layered image, and the tables that
// warp samples in one buffer. Neither exists where no light has a picture.
#pragma once

#include "renderer/gpu/pass.h"
#include "renderer/gpu/resource.h"
#include "renderer/lights_cpp/light_tables.h"

namespace kilolux {

class GpuPictures {
  public:
    // Uploads `layers` unless they are the ones of the call before. The device must be idle.
    void update(gpu::Device& device, const std::vector<std::shared_ptr<const SourcePicture>>& layers);
    gpu::Bindings bindings() const; // of shaders/lib/light_access.glsl

  private:
    std::vector<std::shared_ptr<const SourcePicture>> layers_;
    gpu::Image image_;
    gpu::Buffer warps_;
};

} // namespace kilolux
