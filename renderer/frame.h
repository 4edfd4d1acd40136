// The whole frame: which passes it needs, and their order.
#pragma once

#include "renderer/passes/passes.h"
#include "renderer/settings.h"
#include "renderer/views.h"

#include <memory>

namespace kilolux {

enum class GBufferProducer { Raster, Compute };

// What is decided before recording; conditions are resolved here and nowhere else.
struct FramePlan {
    GBufferProducer producer = GBufferProducer::Raster;
    TraceBackEnd tracer = TraceBackEnd::ComputeBvh;
    Method method = Method::AllLights;
    int view = 0; // VIEW_*
    std::uint32_t raysPerLight = 1;
    bool transparent = false; // the scene has transparent surfaces
    bool halfSampling = false;
    std::uint32_t choices = 1; // samples of one evaluation of the candidate lights
    bool writeLists = true;    // false: frozen
    bool countLights = true;   // lights in range are counted, for statistics or a view
    bool stochastic() const { return method == Method::Stochastic; }
};

// The passes that a plan needs; the others do not exist.
struct FramePasses {
    FramePasses(gpu::PassResources& resources, const FramePlan& plan);

    std::unique_ptr<RasterVisibilityPass> rasterVisibility;
    std::unique_ptr<TraceVisibilityPass> traceVisibility;
    ResolveGBufferPass resolveGBuffer;
    DepthPyramidPass depthPyramid;
    LightGridPass lightGrid;
    std::unique_ptr<LightAllPass> lightAll;
    std::unique_ptr<SampleLightsPass> sampleLights;
    std::unique_ptr<UpsampleSamplesPass> upsampleSamples;
    std::unique_ptr<TraceSamplesPass> traceSamples;
    std::unique_ptr<VisibleListPass> visibleList;
    std::unique_ptr<ShadeSamplesPass> shadeSamples;
    std::unique_ptr<CountLightsPass> countLights;
    CompositePass composite;
    std::unique_ptr<TransparentPass> transparent;
    AccumulatePass accumulate;
    ToneMapPass toneMap;
    std::unique_ptr<DebugViewPass> debugView;
};

// Records one frame. `framesBefore`: frames that the running mean holds already. `world`: bindings of the
// tracer.
void recordFrame(FrameContext& frame, FramePasses& passes, const FramePlan& plan, const gpu::Bindings& world,
                 std::uint32_t framesBefore, float depthScaleM);

} // namespace kilolux
