// Builds acceleration structures over the pairs of a ray world.
#include "renderer/accel_gpu/ray_query_world.h"

#include <glm/gtc/matrix_transform.hpp>
#include <map>

namespace kilolux {

namespace {

using namespace shared;

constexpr std::uint32_t kNoBottom = 0xFFFFFFFFu;
constexpr VkDeviceAddress kScratchAlignment = 256; // no device asks for more

// Index triples of a BVH's opaque and alpha-tested triangles, and what each is: pair * 2 + which of the two.
struct IndexedTriangles {
    std::vector<std::uint32_t> indices[2];
    std::vector<std::uint32_t> names[2];
};

IndexedTriangles indexTriangles(const RayWorld& world, RayWorld::PairRange range) {
    IndexedTriangles result;
    for (std::uint32_t pair = range.first; pair < range.first + range.count; ++pair)
        for (std::uint32_t second = 0; second < 2; ++second) {
            const std::uint32_t id = second ? world.pairIds[pair].y : world.pairIds[pair].x;
            if (id == BVH_ID_NONE) continue;
            const std::size_t geometry = (id & BVH_ID_ALPHA) != 0 ? 1 : 0;
            const std::uint32_t a = pair * 4;
            const std::uint32_t corners[2][3] = {{a, a + 1, a + 2}, {a + 2, a + 1, a + 3}};
            result.indices[geometry].insert(result.indices[geometry].end(), corners[second],
                                            corners[second] + 3);
            result.names[geometry].push_back(pair * 2 + second);
        }
    return result;
}

gpu::Buffer buildInput(gpu::Device& device, const char* name, std::span<const std::byte> data) {
    gpu::BufferDesc desc;
    desc.name = name;
    desc.bytes = data.size();
    desc.usage = VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR |
                 VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    desc.cause = "acceleration structure builds";
    gpu::Buffer buffer(device, desc);
    buffer.upload(data);
    return buffer;
}

// Builds one structure and waits.
gpu::AccelerationStructure build(gpu::Device& device, const char* name, VkAccelerationStructureTypeKHR type,
                                 const std::vector<VkAccelerationStructureGeometryKHR>& geometries,
                                 const std::vector<std::uint32_t>& primitiveCounts) {
    VkAccelerationStructureBuildGeometryInfoKHR info{
        VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR};
    info.type = type;
    info.flags = VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR;
    info.mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR;
    info.geometryCount = std::uint32_t(geometries.size());
    info.pGeometries = geometries.data();
    VkAccelerationStructureBuildSizesInfoKHR sizes{
        VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR};
    device.getAccelerationStructureBuildSizes(device.handle(),
                                              VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &info,
                                              primitiveCounts.data(), &sizes);
    gpu::AccelerationStructure structure(device, name, type, sizes.accelerationStructureSize);
    gpu::BufferDesc scratchDesc;
    scratchDesc.name = "acceleration structure scratch";
    scratchDesc.bytes = sizes.buildScratchSize + kScratchAlignment;
    scratchDesc.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    scratchDesc.cause = "acceleration structure builds";
    const gpu::Buffer scratch(device, scratchDesc);
    info.dstAccelerationStructure = structure.handle();
    info.scratchData.deviceAddress = (scratch.address() + kScratchAlignment - 1) & ~(kScratchAlignment - 1);
    std::vector<VkAccelerationStructureBuildRangeInfoKHR> ranges;
    for (const std::uint32_t count : primitiveCounts)
        ranges.push_back({count, 0, 0, 0});
    const VkAccelerationStructureBuildRangeInfoKHR* rangePointer = ranges.data();
    gpu::Commands commands(device);
    commands.beginPass(name);
    device.cmdBuildAccelerationStructures(commands.handle(), 1, &info, &rangePointer);
    commands.endPass();
    commands.submitAndWait();
    return structure;
}

VkTransformMatrixKHR transformOf(const glm::dmat4& m) {
    VkTransformMatrixKHR result;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            result.matrix[row][column] = float(m[column][row]);
    return result;
}

} // namespace

RayQueryWorld::RayQueryWorld(gpu::Device& device, const RayWorld& world, const GpuRayWorld& buffers)
    : device_(device), buffers_(buffers), bottomOfEntry_(world.entries.size(), kNoBottom) {
    std::vector<std::uint32_t> table(world.entries.size(), 0);
    std::map<std::uint32_t, std::uint32_t> bottomOfPairs; // moving instances share their mesh's
    const auto place = [&](std::uint32_t entry, RayWorld::PairRange range) {
        if (range.count == 0) return;
        const auto [known, isNew] = bottomOfPairs.emplace(range.first, std::uint32_t(bottoms_.size()));
        if (isNew) {
            tableOfBottom_.push_back(std::uint32_t(table.size()));
            buildBottom(world, range, table);
        }
        bottomOfEntry_[entry] = known->second;
        table[entry] = tableOfBottom_[known->second];
    };
    place(RayWorld::kStaticEntry, world.staticPairs);
    for (std::size_t i = 0; i < world.moving.size(); ++i)
        place(RayWorld::kFirstMovingEntry + std::uint32_t(i), world.moving[i].pairRange);
    gpu::BufferDesc desc;
    desc.name = "rayQueryTriangles";
    desc.bytes = table.size() * sizeof(std::uint32_t);
    desc.usage = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
    desc.cause = "acceleration structures";
    desc.texelFormat = VK_FORMAT_R32_UINT;
    triangles_ = gpu::Buffer(device, desc);
    triangles_.upload(table);
    update(world);
}

void RayQueryWorld::buildBottom(const RayWorld& world, RayWorld::PairRange range,
                                std::vector<std::uint32_t>& table) {
    const IndexedTriangles triangles = indexTriangles(world, range);
    std::vector<gpu::Buffer> inputs;
    std::vector<VkAccelerationStructureGeometryKHR> geometries;
    std::vector<std::uint32_t> counts;
    const std::size_t header = table.size();
    table.resize(header + 2, 0);
    for (std::size_t kind = 0; kind < 2; ++kind) {
        // An empty geometry stays, so that the geometry's index says whether it is alpha-tested.
        inputs.push_back(
            buildInput(device_, "ray query indices", std::as_bytes(std::span(triangles.indices[kind]))));
        VkAccelerationStructureGeometryKHR geometry{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR};
        geometry.geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR;
        geometry.flags = kind == 0 ? VK_GEOMETRY_OPAQUE_BIT_KHR : 0;
        VkAccelerationStructureGeometryTrianglesDataKHR& data = geometry.geometry.triangles;
        data = {VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR};
        data.vertexFormat = VK_FORMAT_R32G32B32_SFLOAT;
        data.vertexData.deviceAddress = buffers_.pairs().address();
        data.vertexStride = sizeof(glm::vec3);
        data.maxVertex = std::uint32_t(world.pairs.size() * 4 - 1);
        data.indexType = VK_INDEX_TYPE_UINT32;
        data.indexData.deviceAddress = inputs.back().address();
        geometries.push_back(geometry);
        counts.push_back(std::uint32_t(triangles.names[kind].size()));
        table[header + kind] = std::uint32_t(table.size());
        table.insert(table.end(), triangles.names[kind].begin(), triangles.names[kind].end());
    }
    bottoms_.push_back(build(device_, "ray query bottom level",
                             VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, geometries, counts));
}

void RayQueryWorld::update(const RayWorld& world) {
    std::vector<VkAccelerationStructureInstanceKHR> instances;
    const auto add = [&](std::uint32_t entry, const glm::dmat4& anchoredFromLocal) {
        if (bottomOfEntry_[entry] == kNoBottom) return;
        VkAccelerationStructureInstanceKHR instance{};
        instance.transform = transformOf(anchoredFromLocal);
        instance.instanceCustomIndex = entry & 0xFFFFFFu;
        instance.mask = 0xFF;
        instance.accelerationStructureReference = bottoms_[bottomOfEntry_[entry]].address();
        instances.push_back(instance);
    };
    add(RayWorld::kStaticEntry, glm::translate(glm::dmat4(1.0), glm::dvec3(world.staticPivot)));
    for (std::size_t i = 0; i < world.moving.size(); ++i)
        if (world.moving[i].placed)
            add(RayWorld::kFirstMovingEntry + std::uint32_t(i), world.moving[i].anchoredFromLocal);
    const gpu::Buffer input = buildInput(device_, "ray query instances", std::as_bytes(std::span(instances)));
    VkAccelerationStructureGeometryKHR geometry{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR};
    geometry.geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR;
    geometry.geometry.instances = {VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR};
    geometry.geometry.instances.data.deviceAddress = input.address();
    top_ = build(device_, "ray query top level", VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, {geometry},
                 {std::uint32_t(instances.size())});
}

} // namespace kilolux
