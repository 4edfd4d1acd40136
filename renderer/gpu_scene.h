// A scene on the device: vertices, instances, materials, textures, lights and the ray world, each in the
// buffers that the passes bind by name.
#pragma once

#include "renderer/accel_gpu/gpu_ray_world.h"
#include "renderer/document/scene.h"
#include "renderer/gpu/pass.h"
#include "renderer/gpu_pictures.h"
#include "renderer/light_slots.h"
#include "shaders/shared/geometry.h"

#include <array>

namespace kilolux {

// Draws of one kind of instance, which the raster passes walk.
struct DrawItem {
    std::uint32_t instance = 0;
    std::uint32_t firstIndex = 0;
    std::uint32_t indexCount = 0;
    std::int32_t vertexOffset = 0;
    bool cullBackFaces = false;
    bool clockwise = false;    // mirrored
    bool emits = false;        // transparent only
    glm::dvec3 boundsMin{0.0}; // world, metres
    glm::dvec3 boundsMax{0.0};
};

class GpuScene {
  public:
    // `moving[i]` as in buildWorld(); empty for none. Errors: too many textures for the device's arrays.
    // The LTC table must be bound (ltc_table.h).
    static Result<std::unique_ptr<GpuScene>> create(gpu::Device& device, const Scene& scene,
                                                    const glm::dvec3& anchor, double exposureEv100,
                                                    TraceBackEnd backEnd = TraceBackEnd::ComputeBvh,
                                                    const std::vector<bool>& moving = {});

    // Takes over the scene's lights as they are now; `frame` counts up and says how long ago an edit was.
    // `offsetsM` moves the i-th light; empty: none. `timeS` moves light functions. The device must be idle.
    void updateLights(const Scene& scene, double exposureEv100, std::uint64_t frame,
                      const std::vector<glm::dvec3>& offsetsM = {}, double timeS = 0.0);
    // Takes over the lighting channels of the meshes; whether any has changed. The device must be idle.
    bool updateChannels(const Scene& scene);
    // Of all lights' sources as shadow rays see them, from the next updateLights() on; true: it is another
    // one.
    bool setPenumbraScale(double scale) { return std::exchange(penumbraScale_, scale) != scale; }
    void setEditMemory(const Settings& settings) { slots_.setEditMemory(settings); } // see LightSlots
    // Takes over the transforms of the instances that create() was told may move; what they were becomes the
    // previous one. Once a frame, also when nothing moved. The device must be idle.
    void updateMovingInstances(const Scene& scene);

    const LightSlots& slots() const { return slots_; }
    const std::vector<std::uint32_t>& freshSlots() const { return freshSlots_; } // just edited, ascending
    bool hasMovingInstances() const { return !movingInstances_.empty(); }

    const std::vector<Instance>& instances() const { return instances_; }
    const std::vector<DrawItem>& opaqueDraws() const { return opaque_; }
    const std::vector<DrawItem>& transparentDraws() const { return transparent_; }
    std::uint32_t lightCount() const { return lightCount_; }
    int derivedRanges() const { return derivedRanges_; }
    std::size_t triangles() const { return triangles_; }
    const BvhStats& bvhStats() const { return world_.stats; }
    const glm::dvec3& anchor() const { return anchor_; }

    // Features and choices that the scene decides.
    const gpu::SpecValues& features() const { return features_; }

    gpu::Bindings geometryBindings() const;                    // shaders/lib/geometry.glsl
    gpu::Bindings surfaceBindings() const;                     // shaders/lib/surface.glsl, geometry included
    const GpuRayWorld& rayWorld() const { return *rayWorld_; } // shaders/lib/trace.glsl and alpha.glsl
    gpu::Bindings lightBindings() const;                       // shaders/lib/light_access.glsl
    gpu::Binding environmentBrdf() const;                      // shaders/lib/environment_brdf_table.glsl
    const gpu::Buffer& directionalSlots() const { return directionalSlots_; }
    // What candidates are drawn from (DRAW_FROM_*), anew after every change of lights; empty where not asked
    // for.
    void prepareLightDraws(int drawnFrom, double sceneExtentM);
    gpu::Bindings lightDrawBindings() const;
    std::uint32_t directionalCount() const { return directionalCount_; } // the dome among them
    // The dome's picture as shaders/passes/composite.comp shows it behind the scene.
    bool showsDome() const { return showsDome_; }
    gpu::Bindings backgroundBindings() const;
    const DomeMaps* dome() const { return lightPictures_.dome.get(); }               // null without one
    const gpu::Buffer& previousInstances() const { return previousInstanceBuffer_; } // where some move
    const gpu::Buffer& indexBuffer() const { return indexBuffer_; }

  private:
    GpuScene(gpu::Device& device, const glm::dvec3& anchor) : device_(device), anchor_(anchor) {}
    void uploadGeometry(const Scene& scene, const std::vector<bool>& moving);
    void uploadMaterials(const Scene& scene, const std::vector<std::uint32_t>& placeOfImage);
    std::optional<Error> uploadTextures(const Scene& scene, std::vector<std::uint32_t>& placeOfImage);
    void uploadLtcTable();
    void decideFeatures(const Scene& scene);
    void decideLightFeatures();
    void uploadLightPictures(const LightTables& tables);
    void uploadDome(const std::shared_ptr<const DomeMaps>& dome);

    gpu::Device& device_;
    glm::dvec3 anchor_;
    std::vector<Instance> instances_;
    std::vector<DrawItem> opaque_, transparent_;
    RayWorld world_; // large arrays emptied after the upload
    std::unique_ptr<GpuRayWorld> rayWorld_;
    gpu::SpecValues features_;
    LightSlots slots_;
    std::vector<std::uint32_t> freshSlots_;
    std::vector<std::uint32_t> movingInstances_;
    std::vector<shared::GpuInstance> gpuInstances_;
    std::vector<shared::InstanceRows> previousRows_; // only where some move
    std::uint32_t lightCount_ = 0;
    double penumbraScale_ = 1.0;
    int derivedRanges_ = 0;
    std::size_t triangles_ = 0;
    gpu::Buffer vertexBuffer_, indexBuffer_, uv1Buffer_, instanceBuffer_, materialBuffer_;
    std::array<gpu::Image, shared::TEXTURE_CLASSES> textures_;
    gpu::Buffer lightsHot_, lightsCold_, lightShapings_, directionalSlots_, previousInstanceBuffer_;
    gpu::Buffer lightPowers_, lightTree_; // empty: to be made anew
    std::uint32_t directionalCount_ = 0;
    bool showsDome_ = false;
    gpu::Image ltcParameters_, ltcScales_, iesProfiles_, functionImages_;
    gpu::Image domeRadiances_, domeIrradiances_;
    gpu::Buffer domeDistribution_;
    LightTables lightPictures_; // what these hold; without shapings
    GpuPictures sourcePictures_;
};

} // namespace kilolux
