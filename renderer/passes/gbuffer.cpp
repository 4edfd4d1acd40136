// From seen triangles to the G-buffer, and its depth pyramid.
#include "renderer/passes/passes.h"

#include <algorithm>

namespace kilolux {

using gpu::Access;

ResolveGBufferPass::ResolveGBufferPass(gpu::PassResources& resources)
    : pass_(resources, "resolve_gbuffer",
            joined({{{"Frame"},
                     {"visibility"},
                     {"gDepthOut", Access::Write},
                     {"gSurfaceOut", Access::Write},
                     {"gMaterialOut", Access::Write},
                     {"gEmissiveOut", Access::Write},
                     {"motionOut", Access::Write, gpu::Presence::Optional},
                     {"PreviousInstances", Access::Read, gpu::Presence::Optional}},
                    surfaceUses()})) {}

void ResolveGBufferPass::record(FrameContext& frame) {
    const Targets& targets = frame.targets;
    gpu::Bindings bindings = joined({{{"Frame", frame.frameBuffer},
                                      {"visibility", targets.visibility},
                                      {"gDepthOut", targets.gDepth},
                                      {"gSurfaceOut", targets.gSurface},
                                      {"gMaterialOut", targets.gMaterial},
                                      {"gEmissiveOut", targets.gEmissive}},
                                     frame.scene.surfaceBindings()});
    if (targets.motion) bindings.emplace_back("motionOut", targets.motion);
    if (frame.scene.previousInstances())
        bindings.emplace_back("PreviousInstances", frame.scene.previousInstances());
    pass_.record(frame.commands, frame.features, bindings, frame.tiles());
}

DepthPyramidPass::DepthPyramidPass(gpu::PassResources& resources)
    : pass_(
          resources, "depth_pyramid",
          {{"gDepth"}, {"pyramidIn", Access::Read, gpu::Presence::Optional}, {"pyramidOut", Access::Write}}) {
}

void DepthPyramidPass::record(FrameContext& frame) {
    struct Push {
        glm::uvec2 sourceSize, targetSize;
        std::uint32_t firstLevel;
    };
    const gpu::Image& pyramid = frame.targets.pyramid;
    glm::uvec2 size = frame.constants.size;
    for (std::uint32_t mip = 0; mip < pyramid.desc().mips; ++mip) {
        const glm::uvec2 half = glm::max(size / 2u, glm::uvec2(1));
        gpu::Bindings bindings{{"gDepth", frame.targets.gDepth},
                               gpu::Binding::mip("pyramidOut", pyramid, mip)};
        if (mip > 0) bindings.push_back(gpu::Binding::mip("pyramidIn", pyramid, mip - 1));
        pass_.record(frame.commands, frame.features, bindings, Push{size, half, mip == 0 ? 1u : 0u},
                     pass_.cover(half.x, half.y));
        size = half;
    }
}

} // namespace kilolux
