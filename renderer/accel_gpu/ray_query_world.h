// A RayWorld as Vulkan acceleration structures, for shaders/lib/trace_ray_query.glsl: one bottom level per
// BVH, with opaque and alpha-tested triangles as two geometries, and one instance per entry. Corners are the
// pairs of GpuRayWorld, so both back ends test the same numbers.
#pragma once

#include "renderer/accel_gpu/gpu_ray_world.h"

#include <vector>

namespace kilolux {

class RayQueryWorld {
  public:
    // The device must have ray queries. Waits for the builds.
    RayQueryWorld(gpu::Device& device, const RayWorld& world, const GpuRayWorld& buffers);

    // After updateInstances(): rebuilds the top level. The device must be idle.
    void update(const RayWorld& world);

    // Bound as rayQueryTriangles and rayQueryScene.
    const gpu::Buffer& triangles() const { return triangles_; }
    const gpu::AccelerationStructure& scene() const { return top_; }

  private:
    void buildBottom(const RayWorld& world, RayWorld::PairRange range, std::vector<std::uint32_t>& table);

    gpu::Device& device_;
    const GpuRayWorld& buffers_;
    std::vector<gpu::AccelerationStructure> bottoms_;
    std::vector<std::uint32_t> tableOfBottom_; // into triangles_
    std::vector<std::uint32_t> bottomOfEntry_;
    gpu::AccelerationStructure top_;
    gpu::Buffer triangles_; // R32_UINT, see trace_ray_query.glsl
};

} // namespace kilolux
