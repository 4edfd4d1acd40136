// Uploads a RayWorld.
#include "renderer/accel_gpu/gpu_ray_world.h"

#include "renderer/accel_gpu/ray_query_world.h"
#include "renderer/gpu/filled_buffer.h"

#include <fmt/format.h>

namespace kilolux {

namespace {

template<typename T>
gpu::Buffer texelBuffer(gpu::Device& device, const char* name, VkFormat format, const std::vector<T>& data,
                        VkBufferUsageFlags moreUsage = 0) {
    return gpu::texelBuffer(device, name, data, format, "ray world", moreUsage);
}

constexpr VkFormat kUint4 = VK_FORMAT_R32G32B32A32_UINT;
constexpr VkFormat kFloat4 = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat kUint2 = VK_FORMAT_R32G32_UINT;
constexpr VkBufferUsageFlags kBuildInput =
    VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR |
    VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;

} // namespace

GpuRayWorld::GpuRayWorld(gpu::Device& device, const RayWorld& world, TraceBackEnd backEnd)
    : hasAlpha_(world.hasAlpha()), nodes_(texelBuffer(device, "traceNodes", kUint4, world.nodes)),
      pairs_(texelBuffer(device, "tracePairs", kFloat4, world.pairs,
                         backEnd == TraceBackEnd::RayQuery ? kBuildInput : 0)),
      pairIds_(texelBuffer(device, "tracePairIds", kUint2, world.pairIds)),
      entries_(texelBuffer(device, "traceEntries", kUint4, world.entries)),
      worldEntry_(device, {"traceWorld", sizeof(shared::BvhEntry), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                           gpu::MemoryUse::DeviceOnly, "ray world"}),
      instances_(texelBuffer(device, "traceInstances", kUint2, world.instances)),
      alphaTexels_(texelBuffer(device, "alphaTexels", VK_FORMAT_R8_UNORM, world.alpha.texels)),
      alphaRecords_(texelBuffer(device, "alphaRecords", kUint4, world.alpha.records)),
      alphaTriangles_(texelBuffer(device, "alphaTriangles", kUint4, world.alpha.triangles)) {
    worldEntry_.upload(std::as_bytes(std::span(world.entries.data(), 1)));
    if (backEnd == TraceBackEnd::RayQuery) rayQuery_ = std::make_unique<RayQueryWorld>(device, world, *this);
}

GpuRayWorld::~GpuRayWorld() = default;

std::optional<Error> GpuRayWorld::excess(const gpu::Device& device, const RayWorld& world) {
    const std::uint64_t limit = device.limits().maxTexelBufferElements;
    const struct {
        const char* what;
        std::uint64_t texels;
    } buffers[] = {
        {"BVH nodes", world.nodes.size() * shared::BVH_NODE_TEXELS},
        {"triangle pairs", world.pairs.size() * shared::BVH_PAIR_TEXELS},
        {"BVH entries", world.entries.size() * shared::BVH_ENTRY_TEXELS},
        {"instances", world.instances.size()},
        {"alpha texels", world.alpha.texels.size()},
        {"alpha-tested triangles", world.alpha.triangles.size() * shared::ALPHA_TRIANGLE_TEXELS},
    };
    for (const auto& buffer : buffers)
        if (buffer.texels > limit)
            return Error{fmt::format("the scene's {} take {} texels, and device '{}' allows {} in a buffer",
                                     buffer.what, buffer.texels, device.name(), limit)};
    return std::nullopt;
}

void GpuRayWorld::update(const RayWorld& world) {
    entries_.upload(world.entries);
    worldEntry_.upload(std::as_bytes(std::span(world.entries.data(), 1)));
    if (world.topNodeCapacity > 0)
        nodes_.upload(std::as_bytes(std::span(world.nodes.data(), world.topNodeCapacity)));
    if (rayQuery_) rayQuery_->update(world);
}

void GpuRayWorld::updateChannels(const RayWorld& world) {
    instances_.upload(world.instances);
}

std::vector<gpu::PassUse> GpuRayWorld::alphaUses() {
    return {{"traceInstances"}, {"alphaTexels"}, {"alphaRecords"}, {"alphaTriangles"}};
}

gpu::Bindings GpuRayWorld::alphaBindings() const {
    return {{"traceInstances", instances_},
            {"alphaTexels", alphaTexels_},
            {"alphaRecords", alphaRecords_},
            {"alphaTriangles", alphaTriangles_}};
}

std::vector<gpu::PassUse> GpuRayWorld::traceUses(TraceBackEnd backEnd) {
    std::vector<gpu::PassUse> uses = alphaUses();
    for (const char* name : {"tracePairs", "tracePairIds", "traceEntries"})
        uses.push_back({name});
    if (backEnd == TraceBackEnd::ComputeBvh)
        uses.insert(uses.end(), {{"traceNodes"}, {"TraceWorld"}});
    else
        uses.insert(uses.end(), {{"rayQueryTriangles"}, {"rayQueryScene"}});
    return uses;
}

gpu::Bindings GpuRayWorld::traceBindings() const {
    gpu::Bindings bindings = alphaBindings();
    bindings.push_back({"tracePairs", pairs_});
    bindings.push_back({"tracePairIds", pairIds_});
    bindings.push_back({"traceEntries", entries_});
    if (rayQuery_) {
        bindings.push_back({"rayQueryTriangles", rayQuery_->triangles()});
        bindings.push_back({"rayQueryScene", rayQuery_->scene()});
    } else {
        bindings.push_back({"traceNodes", nodes_});
        bindings.push_back({"TraceWorld", worldEntry_});
    }
    return bindings;
}

} // namespace kilolux
