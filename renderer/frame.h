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
    Method method = Method::Stochastic;
    int view = 0; // VIEW_*
    LightAllPass::Counts lightAll;
    bool transparent = false; // the scene has transparent surfaces
    bool halfSampling = false;
    std::uint32_t choices = 1; // samples of one evaluation of the candidate lights
    bool compactRays = false;  // trace and shade in the order of lights
    bool writeLists = true;    // false: frozen
    bool countLights = true;   // lights in range are counted, for statistics or a view
    // What becomes of noisy light. Methods that are references by themselves only average.
    bool denoise = false;
    bool antiAlias = false;
    bool mean = true;    // running mean of the frames as sampled
    bool settle = false; // the mean replaces the filtered picture as it converges
    bool keepsRaw() const { return denoise && mean; } // both the filtered and the sampled picture are needed
    shared::ResamplingConstants resampling{};         // of the methods that resample
    bool stochastic() const { return method == Method::Stochastic; }
    bool mapsShadows() const { return method == Method::ShadowMaps; }
    bool resamples() const { return method >= Method::Uniform; }
    bool filtersLight() const { return stochastic() || resamples(); } // their light is noisy and demodulated
};

// The passes that a plan needs; the others do not exist.
struct FramePasses {
    FramePasses(gpu::PassResources& resources, const FramePlan& plan);

    std::unique_ptr<RasterVisibilityPass> rasterVisibility;
    std::unique_ptr<TraceVisibilityPass> traceVisibility;
    ResolveGBufferPass resolveGBuffer;
    DepthPyramidPass depthPyramid;
    LightGridPass lightGrid;
    std::unique_ptr<ShadowMapsPass> shadowMaps;
    std::unique_ptr<LightAllPass> lightAll;
    std::unique_ptr<SampleLightsPass> sampleLights;
    std::unique_ptr<UpsampleSamplesPass> upsampleSamples;
    std::unique_ptr<CompactRaysPass> compactRays;
    std::unique_ptr<TraceSamplesPass> traceSamples;
    std::unique_ptr<VisibleListPass> visibleList;
    std::unique_ptr<ShadeSamplesPass> shadeSamples;
    std::unique_ptr<ResampleLightsPass> resampleLights;
    std::unique_ptr<ReuseReservoirsPass> reuseReservoirs;
    std::unique_ptr<CountLightsPass> countLights;
    std::unique_ptr<DenoiseTemporalPass> denoiseTemporal;
    std::unique_ptr<DenoiseSpatialPass> denoiseSpatial;
    CompositePass composite;
    std::unique_ptr<TransparentPass> transparent;
    std::unique_ptr<AntiAliasPass> antiAlias;
    std::unique_ptr<AccumulatePass> accumulate;
    std::unique_ptr<SettlePass> settle;
    ToneMapPass toneMap;
    std::unique_ptr<DebugViewPass> debugView;
    std::unique_ptr<ProbePass> probe; // made when first asked for
};

// What a method that resamples asks for.
shared::ResamplingConstants resamplingConstants(Method method, const Settings& settings);

// DRAW_FROM_* of shaders/shared/features.h.
int drawnFrom(Method method, const Settings& settings);

// The filters that the settings ask for, and no others.
void planFilters(FramePlan& plan, const Settings& settings);

// The image that a plan shows.
const gpu::Image& shownPicture(const Targets& targets, const FramePlan& plan);

// The settings of the filters as shaders read them.
shared::DenoisingConstants denoisingConstants(const Settings& settings);

// Records one frame. `framesBefore`: frames that the running mean holds already. `world`: bindings of the
// tracer.
void recordFrame(FrameContext& frame, FramePasses& passes, const FramePlan& plan, const gpu::Bindings& world,
                 std::uint32_t framesBefore, const shared::ViewConstants& viewScale);

} // namespace kilolux
