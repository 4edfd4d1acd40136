// Shadow maps of lights: depth by raster, for the faces that do not stand; one rendering into the image of
// all.
#include "renderer/shadow_maps.h"
#include "renderer/passes/passes.h"

namespace kilolux {

ShadowMapsPass::ShadowMapsPass(gpu::PassResources& resources)
    : pass_(resources, "shadow_maps", joined({{{"ShadowMaps"}}, geometryUses(), GpuRayWorld::alphaUses()}),
            {.vertex = "draw_shadow", .colors = {}, .depth = VK_FORMAT_D32_SFLOAT}) {}

namespace {

void clearTile(VkCommandBuffer commands, const VkRect2D& tile) {
    VkClearAttachment nothing{};
    nothing.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT; // reversed: 0 is farthest
    const VkClearRect where{tile, 0, 1};
    vkCmdClearAttachments(commands, 1, &nothing, 1, &where);
}

} // namespace

void ShadowMapsPass::drawFace(VkCommandBuffer commands, const GpuScene& scene, const ShadowMaps::Face& face) {
    const VkRect2D tile{{std::int32_t(face.cornerPx.x), std::int32_t(face.cornerPx.y)},
                        {face.sizePx, face.sizePx}};
    const VkViewport viewport{
        float(face.cornerPx.x), float(face.cornerPx.y), float(face.sizePx), float(face.sizePx), 0.0f, 1.0f};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &tile);
    clearTile(commands, tile);
    pass_.pushAgain(commands, shared::ShadowFacePush{glm::mat4(face.clipFromWorld), face.map});
    // Both sides of every surface: shadow rays know no culling either.
    for (const DrawItem& item : scene.opaqueDraws()) {
        if (!ShadowMaps::mayCast(face, item.boundsMin - scene.anchor(), item.boundsMax - scene.anchor()))
            continue;
        vkCmdDrawIndexed(commands, item.indexCount, 1, item.firstIndex, item.vertexOffset, item.instance);
    }
}

void ShadowMapsPass::record(FrameContext& frame) {
    const ShadowMaps& maps = *frame.shadowMaps;
    if (maps.due().empty()) return;
    const GpuScene& scene = frame.scene;
    frame.commands.use(scene.indexBuffer(), gpu::Usage::IndexRead);
    const shared::ShadowFacePush none{};
    const gpu::ImageDesc& image = maps.depths().desc();
    pass_.record(
        frame.commands, frame.features,
        joined({{{"ShadowMaps", maps.maps()}}, scene.geometryBindings(), scene.rayWorld().alphaBindings()}),
        std::as_bytes(std::span(&none, 1)), image.width, image.height, {},
        {.image = &maps.depths(), .load = true}, [&](VkCommandBuffer commands) {
            vkCmdBindIndexBuffer(commands, scene.indexBuffer().handle(), 0, VK_INDEX_TYPE_UINT32);
            for (const ShadowMaps::Face& face : maps.due())
                drawFace(commands, scene, face);
        });
}

} // namespace kilolux
