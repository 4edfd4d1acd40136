// A RayWorld in device buffers, bound under the names of shaders/lib/trace.glsl and alpha.glsl, and where
// asked for in acceleration structures too.
#pragma once

#include "renderer/accel/ray_world.h"
#include "renderer/gpu/pass.h"

#include <memory>
#include <optional>
#include <vector>

namespace kilolux {

class RayQueryWorld;

enum class TraceBackEnd {
    ComputeBvh, // every device
    RayQuery,   // where Device::hasRayQuery(); passes define KX_RAY_QUERY
};

class GpuRayWorld {
  public:
    // What of the world is more than the device's texel buffers hold, if anything; ask before constructing.
    static std::optional<Error> excess(const gpu::Device& device, const RayWorld& world);

    GpuRayWorld(gpu::Device& device, const RayWorld& world, TraceBackEnd backEnd = TraceBackEnd::ComputeBvh);
    ~GpuRayWorld();
    GpuRayWorld(const GpuRayWorld&) = delete;
    GpuRayWorld& operator=(const GpuRayWorld&) = delete;

    // After updateInstances(): the entries and the top level, nothing else. The device must be idle.
    void update(const RayWorld& world);
    void updateChannels(const RayWorld& world); // after the function of that name

    // What a pass that includes lib/trace.glsl declares and binds, beside its own.
    static std::vector<gpu::PassUse> traceUses(TraceBackEnd backEnd = TraceBackEnd::ComputeBvh);
    gpu::Bindings traceBindings() const;
    // The same for one that includes lib/alpha.glsl alone.
    static std::vector<gpu::PassUse> alphaUses();
    gpu::Bindings alphaBindings() const;

    // Pair corners as vertices: four of 12 bytes per pair. Readable by acceleration structure builds on
    // devices with ray queries.
    const gpu::Buffer& pairs() const { return pairs_; }
    const gpu::Buffer& pairIds() const { return pairIds_; }
    const gpu::Buffer& nodes() const { return nodes_; }
    const gpu::Buffer& entries() const { return entries_; }

    bool hasAlpha() const { return hasAlpha_; } // the value for FEATURE_ALPHA_MASK

  private:
    bool hasAlpha_ = false;
    gpu::Buffer nodes_, pairs_, pairIds_, entries_, worldEntry_, instances_;
    gpu::Buffer alphaTexels_, alphaRecords_, alphaTriangles_;
    std::unique_ptr<RayQueryWorld> rayQuery_;
};

} // namespace kilolux
