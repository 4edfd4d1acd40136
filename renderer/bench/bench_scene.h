// One scene of a run, at one step of its sweep: rendering methods and holding them against references.
#pragma once

#include "renderer/bench/bench.h"
#include "renderer/bench/reference.h"
#include "renderer/measure/image_view.h"

namespace kilolux::bench {

inline constexpr double kEpsilon = 0.01; // of exposed light, squared
inline constexpr int kReferenceRays = 4; // per light and frame

// Linear RGB, exposed and clamped to what can be looked at; and as the display shows it, in 0..1 and in
// bytes.
std::vector<float> exposedLight(const std::vector<float>& rgb, double exposureEv100);
std::vector<std::uint8_t> bytesOf(const std::vector<float>& srgb);

class SceneBench {
  public:
    // `result` tells camera, size and step. All must outlive it.
    SceneBench(const BenchPlan& plan, const Scene& scene, SceneResult& result)
        : plan_(plan), scene_(scene), result_(result) {}

    // Jitter is off: light is compared on one G-buffer.
    RenderOptions options(const std::string& method, Settings settings, std::uint32_t seed) const;

    // 'split' or 'true'. `moved`: of the scene at another time, with settings that move it. Errors: no
    // device, cancelled.
    Result<Reference> reference(const std::string& method, const Settings& moved = {}) const;
    // The same of an edited scene, told apart by its tag.
    Result<Reference> reference(const Scene& edited, const std::string& tag, const std::string& method) const;

    // `rgb` after `frame` frames, linear and not exposed, 3 values a pixel; `flipMap` gets the FLIP of each
    // pixel.
    BenchPoint compare(const Reference& reference, const std::vector<float>& rgb, int frame,
                       std::vector<float>* flipMap = nullptr) const;

    // One repetition of one method. Fills in the pictures of `into` when they are wanted.
    std::optional<Error> run(MethodResult& into, const Reference& reference, PictureChoice picture,
                             int repetition) const;

    // StillFacts of a method.
    std::optional<Error> runStill(MethodResult& into, const Reference& reference) const;

    // A method while the scene changes; `references` by their method, of the scene at rest.
    std::optional<Error> runChange(MethodResult& into, const Reference& atRest, Change change) const;

    const SceneResult& result() const { return result_; }

  private:
    Result<std::unique_ptr<Renderer>> makeRenderer(const MethodResult& method, PictureChoice picture,
                                                   std::uint32_t seed, const Settings& moved = {}) const;
    std::optional<Error> frame(Renderer& renderer) const;
    std::optional<Error> switchLightsOn(MethodResult& into, const Reference& atRest,
                                        ChangeResult& change) const;
    std::optional<Error> keepMoving(MethodResult& into, ChangeResult& change) const;
    measure::ImageView view(const std::vector<float>& rgb) const {
        return {result_.width, result_.height, rgb};
    }

    const BenchPlan& plan_;
    const Scene& scene_;
    SceneResult& result_;
};

// "lights-on", ...
std::string_view changeName(Change change);
std::optional<Change> changeFromName(std::string_view name);

} // namespace kilolux::bench
