// What several passes declare or do alike.
#include "renderer/camera.h"
#include "renderer/passes/passes.h"

#include <fmt/format.h>

namespace kilolux {

using gpu::Access;
using gpu::PassUse;
using gpu::Presence;

std::vector<PassUse> geometryUses() {
    return {{"vertices"}, {"indices"}, {"Instances"}};
}

std::vector<PassUse> surfaceUses() {
    constexpr Access read = Access::Read;
    constexpr Presence optional = Presence::Optional; // absent where the scene has no such texture
    return joined({geometryUses(),
                   {{"Materials"},
                    {"uv1s"},
                    {"textures0", read, optional},
                    {"textures1", read, optional},
                    {"textures2", read, optional},
                    {"textures3", read, optional},
                    {"texturesSrgb0", read, optional},
                    {"texturesSrgb1", read, optional},
                    {"texturesSrgb2", read, optional},
                    {"texturesSrgb3", read, optional}}});
}

std::vector<PassUse> traceUses(TraceBackEnd tracer) {
    return GpuRayWorld::traceUses(tracer);
}

std::vector<PassUse> lightUses() {
    // The uniform block holds a thousand lights; with more, a dummy stands in and the texels serve.
    return {{"LightsHot", Access::Read, Presence::Optional},
            {"lightsHotTexels"},
            {"LightsCold"},
            {"LightShapings", Access::Read, Presence::Optional}, // absent where no light has one
            {"iesProfiles", Access::Read, Presence::Optional},
            {"functionImages", Access::Read, Presence::Optional},
            {"domeRadiances", Access::Read, Presence::Optional},
            {"domeIrradiances", Access::Read, Presence::Optional},
            {"domeDistribution", Access::Read, Presence::Optional},
            {"lightPictures", Access::Read, Presence::Optional},
            {"LightWarps", Access::Read, Presence::Optional},
            {"ltcParameters"},
            {"ltcScales"}};
}

std::vector<PassUse> joined(std::initializer_list<std::vector<PassUse>> lists) {
    std::vector<PassUse> result;
    for (const auto& list : lists)
        result.insert(result.end(), list.begin(), list.end());
    return result;
}

gpu::Bindings joined(std::initializer_list<gpu::Bindings> lists) {
    gpu::Bindings result;
    for (const auto& list : lists)
        result.insert(result.end(), list.begin(), list.end());
    return result;
}

std::vector<gpu::PassUse> receiverUses() {
    return joined({{{"Frame"}, {"gSurface"}, {"gMaterial"}}, lightUses()});
}

gpu::Bindings receiverBindings(const FrameContext& frame) {
    return joined({{{"Frame", frame.frameBuffer},
                    {"gSurface", frame.targets.gSurface},
                    {"gMaterial", frame.targets.gMaterial}},
                   frame.scene.lightBindings()});
}

// The reservoirs of a pixel live in registers. GLSL cannot pass structs with arrays that a specialization
// constant sizes, so their number is a definition: three variants of the shader.
std::string sampleRoom(std::uint32_t choices) {
    return fmt::format("KX_MAX_SAMPLES {}", choices <= 1 ? 1 : choices <= 4 ? 4 : 64);
}

std::vector<std::string> tracerDefines(TraceBackEnd tracer) {
    if (tracer == TraceBackEnd::RayQuery) return {"KX_RAY_QUERY"};
    return {};
}

void drawVisible(VkCommandBuffer commands, const FrameContext& frame, const std::vector<DrawItem>& items) {
    vkCmdBindIndexBuffer(commands, frame.scene.indexBuffer().handle(), 0, VK_INDEX_TYPE_UINT32);
    const glm::dmat4 clipFromWorld(frame.constants.clipFromWorld);
    const glm::dvec3 anchor = frame.scene.anchor();
    int culling = -1, clockwise = -1;
    for (const DrawItem& item : items) {
        if (!boxMayBeSeen(clipFromWorld, item.boundsMin - anchor, item.boundsMax - anchor)) continue;
        if (culling != int(item.cullBackFaces)) {
            culling = item.cullBackFaces;
            vkCmdSetCullMode(commands, culling ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_NONE);
        }
        if (clockwise != int(item.clockwise)) {
            clockwise = item.clockwise;
            vkCmdSetFrontFace(commands,
                              clockwise ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE);
        }
        vkCmdDrawIndexed(commands, item.indexCount, 1, item.firstIndex, item.vertexOffset, item.instance);
    }
}

} // namespace kilolux
