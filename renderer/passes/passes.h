// Every pass of a frame, in frame order. A pass is a class that makes its pipelines once and a record() call
// per frame; what it reads and writes is declared beside its shader's name in its own .cpp.
#pragma once

#include "renderer/gpu/pass.h"
#include "renderer/gpu_scene.h"
#include "renderer/light_grid.h"
#include "renderer/ray_list.h"
#include "renderer/shadow_maps.h"
#include "renderer/targets.h"
#include "renderer/visible_lists.h"
#include "shaders/shared/frame.h"
#include "shaders/shared/probe.h"
#include "shaders/shared/resampling.h"
#include "shaders/shared/views.h"

namespace kilolux {

// What record() calls share.
struct FrameContext {
    gpu::Commands& commands;
    const GpuScene& scene;
    const Targets& targets;
    const gpu::Buffer& frameBuffer;          // the uniform block `Frame`
    const shared::FrameConstants& constants; // what it holds
    const gpu::Buffer& counters;
    const LightGrid& grid;
    gpu::SpecValues features;
    const VisibleLists* lists = nullptr;    // of the stochastic method
    const gpu::Image* noise = nullptr;      // of the stochastic method
    const RayList* rays = nullptr;          // null: every pixel has its own place in a dispatch
    const ShadowMaps* shadowMaps = nullptr; // of the method with them
    // For tests: texels that replace litDiffuse and litSpecular once samples are shaded.
    const gpu::Buffer* replacedDiffuse = nullptr;
    const gpu::Buffer* replacedSpecular = nullptr;

    // One workgroup of 8 x 8 per tile, in the order of lib/dispatch.glsl. In two dimensions, as devices may
    // stop at 65,535 groups in one, which are 4 million pixels.
    gpu::GroupCount tiles() const { return {constants.tiles.x, constants.tiles.y}; }
    // The same over the shown picture.
    gpu::GroupCount outputTiles() const {
        const glm::uvec2 count = (constants.outputSize + 7u) / 8u;
        return {count.x, count.y};
    }
};

class RasterVisibilityPass {
  public:
    explicit RasterVisibilityPass(gpu::PassResources& resources);
    void record(FrameContext& frame);

  private:
    gpu::GraphicsPass pass_;
};

class TraceVisibilityPass {
  public:
    TraceVisibilityPass(gpu::PassResources& resources, TraceBackEnd tracer);
    void record(FrameContext& frame, const gpu::Bindings& world);

  private:
    gpu::ComputePass pass_;
};

class ResolveGBufferPass {
  public:
    explicit ResolveGBufferPass(gpu::PassResources& resources);
    void record(FrameContext& frame);

  private:
    gpu::ComputePass pass_;
};

class DepthPyramidPass {
  public:
    explicit DepthPyramidPass(gpu::PassResources& resources);
    void record(FrameContext& frame);

  private:
    gpu::ComputePass pass_;
};

class LightGridPass {
  public:
    explicit LightGridPass(gpu::PassResources& resources);
    void record(FrameContext& frame);

  private:
    gpu::ComputePass coarse_;
    gpu::ComputePass fine_;
};

// What is due of the lights' shadow maps.
class ShadowMapsPass {
  public:
    explicit ShadowMapsPass(gpu::PassResources& resources);
    void record(FrameContext& frame);

  private:
    void drawFace(VkCommandBuffer commands, const GpuScene& scene, const ShadowMaps::Face& face);

    gpu::GraphicsPass pass_;
};

class LightAllPass {
  public:
    struct Counts {
        std::uint32_t raysPerLight = 1;
        std::uint32_t shadowSamples = 16; // of a shadow map
    };
    LightAllPass(gpu::PassResources& resources, TraceBackEnd tracer);
    void record(FrameContext& frame, const gpu::Bindings& world, const Counts& counts);

  private:
    gpu::ComputePass pass_;
};

class SampleLightsPass {
  public:
    SampleLightsPass(gpu::PassResources& resources, std::uint32_t choices);
    void record(FrameContext& frame);

  private:
    gpu::ComputePass pass_;
};

class UpsampleSamplesPass {
  public:
    explicit UpsampleSamplesPass(gpu::PassResources& resources);
    void record(FrameContext& frame);

  private:
    gpu::ComputePass pass_;
};

class CompactRaysPass {
  public:
    explicit CompactRaysPass(gpu::PassResources& resources);
    void record(FrameContext& frame, std::uint32_t layer);

  private:
    gpu::ComputePass pass_;
};

class TraceSamplesPass {
  public:
    TraceSamplesPass(gpu::PassResources& resources, TraceBackEnd tracer);
    void record(FrameContext& frame, const gpu::Bindings& world, std::uint32_t layer);

  private:
    gpu::ComputePass pass_;
};

// The baselines' choice of a light and a point on it; see shared/resampling.h.
class ResampleLightsPass {
  public:
    ResampleLightsPass(gpu::PassResources& resources, TraceBackEnd tracer);
    void record(FrameContext& frame, const gpu::Bindings& world, const shared::ResamplingConstants& how);

  private:
    gpu::ComputePass pass_;
};

// Their reuse among neighbours, shadow ray and shading.
class ReuseReservoirsPass {
  public:
    ReuseReservoirsPass(gpu::PassResources& resources, TraceBackEnd tracer);
    void record(FrameContext& frame, const gpu::Bindings& world, const shared::ResamplingConstants& how);

  private:
    gpu::ComputePass pass_;
};

class VisibleListPass {
  public:
    explicit VisibleListPass(gpu::PassResources& resources);
    void record(FrameContext& frame);

  private:
    gpu::ComputePass pass_;
};

class ShadeSamplesPass {
  public:
    explicit ShadeSamplesPass(gpu::PassResources& resources);
    void record(FrameContext& frame);

  private:
    gpu::ComputePass pass_;
};

class CountLightsPass {
  public:
    explicit CountLightsPass(gpu::PassResources& resources);
    void record(FrameContext& frame);

  private:
    gpu::ComputePass pass_;
};

class DenoiseTemporalPass {
  public:
    explicit DenoiseTemporalPass(gpu::PassResources& resources);
    void record(FrameContext& frame);

  private:
    gpu::ComputePass pass_;
};

class DenoiseSpatialPass {
  public:
    explicit DenoiseSpatialPass(gpu::PassResources& resources);
    void record(FrameContext& frame);

  private:
    gpu::ComputePass pass_;
};

class CompositePass {
  public:
    explicit CompositePass(gpu::PassResources& resources);
    void record(FrameContext& frame);

  private:
    gpu::ComputePass pass_;
};

// BLEND and transmissive surfaces below half opacity, back to front: tint and emission only.
class TransparentPass {
  public:
    explicit TransparentPass(gpu::PassResources& resources);
    void record(FrameContext& frame, const gpu::Image& color);

  private:
    void draw(FrameContext& frame, gpu::GraphicsPass& pass, const std::vector<DrawItem>& items,
              const gpu::Image& color);

    gpu::GraphicsPass tint_;
    gpu::GraphicsPass emission_;
};

class AntiAliasPass {
  public:
    explicit AntiAliasPass(gpu::PassResources& resources);
    void record(FrameContext& frame);

  private:
    gpu::ComputePass pass_;
};

class AccumulatePass {
  public:
    explicit AccumulatePass(gpu::PassResources& resources);
    void record(FrameContext& frame, std::uint32_t framesBefore);

  private:
    gpu::ComputePass pass_;
};

class SettlePass {
  public:
    explicit SettlePass(gpu::PassResources& resources);
    void record(FrameContext& frame);

  private:
    gpu::ComputePass pass_;
};

class ToneMapPass {
  public:
    explicit ToneMapPass(gpu::PassResources& resources);
    void record(FrameContext& frame, const gpu::Image& picture);

  private:
    gpu::ComputePass pass_;
};

class DebugViewPass {
  public:
    explicit DebugViewPass(gpu::PassResources& resources);
    // `picture`: what tone_map shows.
    void record(FrameContext& frame, shared::ViewConstants scale, const gpu::Image& picture);

  private:
    gpu::ComputePass pass_;
};

// Looks into one pixel of a finished frame; see shared/probe.h.
class ProbePass {
  public:
    ProbePass(gpu::PassResources& resources, TraceBackEnd tracer, std::uint32_t choices);

    struct Images {
        const gpu::Image& picture;    // what tone_map shows
        const gpu::Image& viewValues; // of the view, or the picture
        const gpu::Image& diffuse;    // light without albedo
    };
    struct Results {
        const gpu::Buffer& surface; // shared::ProbeSurface
        const gpu::Buffer& lights;  // shared::ProbeLight, one a slot
        const gpu::Buffer& rays;    // vec4, PROBE_RAYS a slot
    };
    // `lists`: those that the frame's choice read; null without.
    void record(FrameContext& frame, const gpu::Bindings& world, const gpu::Buffer* lists,
                const shared::ProbeRequest& request, const Images& images, const Results& results);

  private:
    gpu::ComputePass pass_;
};

// --- Shared by the passes' files --------------------------------------------------------------------------

// Declarations that match the include files of shaders/lib.
std::vector<gpu::PassUse> geometryUses();
std::vector<gpu::PassUse> surfaceUses();
std::vector<gpu::PassUse> traceUses(TraceBackEnd tracer);
std::vector<gpu::PassUse> lightUses();
std::vector<gpu::PassUse> joined(std::initializer_list<std::vector<gpu::PassUse>> lists);
gpu::Bindings joined(std::initializer_list<gpu::Bindings> lists);
std::vector<gpu::PassUse> receiverUses();
gpu::Bindings receiverBindings(const FrameContext& frame);
// A definition for shaders that choose that many samples of a pixel.
std::string sampleRoom(std::uint32_t choices);
std::vector<std::string> tracerDefines(TraceBackEnd tracer);

// Draws the items that the camera may see; sets culling and winding where they change.
void drawVisible(VkCommandBuffer commands, const FrameContext& frame, const std::vector<DrawItem>& items);

} // namespace kilolux
