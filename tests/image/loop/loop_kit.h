// Frame after frame of the stochastic method for tests, and means of the raw estimator over replicas. Frames
// with white noise are replicas: each draws numbers of its own, and what earlier frames left in the lists
// must not change the mean, which is what the tests are about.
#pragma once

#include "renderer/measure/equivalence.h"
#include "tests/image/image_kit.h"
#include "tests/image/image_scenes.h"

namespace kilolux::test {

// Stochastic, the raw picture, white noise, fixed exposure, and then `settings` as --set reads them.
RenderOptions loopOptions(int width, int height, const std::vector<std::string>& settings = {});

// The scene with LightNode::id 1, 2, ... in order, as edits need them.
Scene withIds(Scene scene);

// The stage under `count` local lights of all kinds and colours, with ranges; box and ball throw shadows.
Scene crowdScene(int count, std::uint32_t seed);

// A renderer that throws what it reports.
class Loop {
  public:
    Loop(const Scene& scene, RenderOptions options);

    Renderer& renderer() { return *renderer_; }
    void frames(int count);
    Picture next(); // renders a frame
    FrameTargets targets();

  private:
    std::unique_ptr<Renderer> renderer_;
};

// What a pixel of the image `samples` holds (shaders/shared/sampling.h).
struct PixelSample {
    std::uint32_t slot = 0, list = 0; // LIST_* of shaders/math/selection_types.glsl
    std::uint32_t uv = 0;             // 16 bits each, u in the low ones
    float contribution = 0.0f;        // 0: no light
    float weight = 0.0f;
};
std::vector<PixelSample> samplesOf(const FrameTargets& targets); // row by row

// The light of one replica: means over the picture, over its 4 x 4 regions, and over the four pixels of all
// 2 x 2 blocks.
struct Light {
    enum Value {
        Luminance,
        Red,
        Green,
        Blue,
        FirstRegion,
        FirstPlace = FirstRegion + 16,
        Count = FirstPlace + 4
    };
    std::array<double, Count> values{};
};
Light lightOf(const Picture& picture);

using MakeReplica = std::function<Light()>;

struct Replicas {
    std::vector<Light> light;
    std::vector<double> values(int value) const;
    measure::ReplicaMean mean(int value) const { return measure::replicaMean(values(value)); }
};

// At least measure::kMinReplicas, then until the mean luminance is known to `error`, or `most` are done.
Replicas gather(const MakeReplica& make, double error = 0.0014, int most = 500);

// A replica of `frames` frames; of a loop below one ray per pixel, so many that every pixel has its turns.
MakeReplica framesOf(Loop& loop, int frames = 4, int pixelsPerRay = 1);

// The reference 'split' of the same scene, camera and exposure.
Replicas splitReference(const Scene& scene, const RenderOptions& options, double error = 0.0005);

// The mean luminance is equivalent within `bound` and a bias of twice that would have been seen; no channel,
// region or place in the 2 x 2 blocks contradicts it.
void expectSameMean(const Replicas& tested, const Replicas& reference, const std::string& what,
                    double bound = 0.005);

} // namespace kilolux::test
