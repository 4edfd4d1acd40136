// The oracle: direct light of a document in double precision on the CPU, independent of every shader. It
// shoots its own primary rays, reads its own materials and integrates each light by converged quadrature
// where nothing is hidden and by many shadow rays where something is (design: "The estimator, and
// correctness"). Embree finds candidate triangles only; which of them count, and where, is decided in double
// precision.
#pragma once

#include "renderer/document/scene.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace kilolux::oracle {

struct OracleLight;

enum class Estimator {
    True, // Int BRDF L NoL V dw: the BRDF at the sampled point
    Split // analytic unshadowed light times the mean visibility of the source's area
};

enum class PixelFilter {
    Box,           // one pixel wide
    BlackmanHarris // separable, radius 1.5 px
};

struct PointMaterial {
    glm::dvec3 baseColor{1.0};
    double metallic = 0.0;
    double roughness = 1.0;
};

// A surface as seen from somewhere. All vectors are unit and point away from the surface; both normals lie on
// the viewer's side.
struct OraclePoint {
    glm::dvec3 positionWs{0.0};
    glm::dvec3 geometricNormalWs{0.0, 1.0, 0.0};
    glm::dvec3 shadingNormalWs{0.0, 1.0, 0.0};
    glm::dvec3 viewDirWs{0.0, 1.0, 0.0};
    PointMaterial material;
    std::uint8_t channels = 255; // lighting channels of its mesh
};

struct OraclePointResult {
    glm::dvec3 irradianceLux{0.0}; // what the diffuse lobe receives, shadowed
    glm::dvec3 diffuseNit{0.0};
    glm::dvec3 specularNit{0.0};
    glm::dvec3 unshadowedIrradianceLux{0.0};
    glm::dvec3 unshadowedDiffuseNit{0.0};
    glm::dvec3 unshadowedSpecularNit{0.0};
    double visibility = 0.0; // Split: mean over the source's area; True: share of the irradiance that arrives
    glm::dvec3 standardErrorNit{0.0}; // of diffuseNit + specularNit
};

struct OracleOptions {
    Estimator estimator = Estimator::True;
    int samplesPerLight = 64; // shadow rays per light and primary ray, rounded up to a multiple of 8
    int pixelSamples = 1;     // primary rays per pixel
    // With a value, every primary ray goes through pixel centre + this offset (px, +x right, +y down), as for
    // a comparison on one G-buffer; without, offsets are drawn from the filter.
    std::optional<glm::dvec2> jitterPx = glm::dvec2(0.0);
    PixelFilter filter = PixelFilter::Box;
    std::uint64_t seed = 1;
    int threads = 0;     // 0: all the hardware has
    bool shadows = true; // without: every light reaches every point above its horizon
};

// Means over a pixel's primary rays; rays that leave the scene see the background.
struct OraclePixel {
    glm::dvec3 radianceNit{0.0}; // diffuse + specular + emission
    glm::dvec3 irradianceLux{0.0};
    glm::dvec3 diffuseNit{0.0};
    glm::dvec3 specularNit{0.0};
    glm::dvec3 emissionNit{0.0};
    glm::dvec3 standardErrorNit{0.0}; // of radianceNit
    glm::dvec3 baseColor{0.0};
    glm::dvec3 shadingNormalWs{0.0}; // of the last ray that hit, like all that follow
    glm::dvec3 geometricNormalWs{0.0};
    glm::dvec3 positionWs{0.0};
    double metallic = 0.0;
    double roughness = 0.0;
    double hitDistanceM = 0.0; // along the ray; 0 where nothing was hit
    int node = -1;             // into Scene::nodes
    int primitive = -1;        // of the node's mesh
    int triangle = -1;
    double coverage = 0.0; // share of rays that hit
};

struct OracleImage {
    int width = 0;
    int height = 0;
    std::vector<OraclePixel> pixels; // row-major, top row first
};

struct OracleHit {
    OraclePoint point;
    glm::dvec3 emissionNit{0.0};
    double distanceM = 0.0;
    int node = -1;
    int primitive = -1;
    int triangle = -1;
};

class Oracle {
  public:
    // Copies nothing that is shared in the document; the scene may go. `derivedRangesM`, one per
    // Scene::lights entry or empty, gives a range to lights whose definition has none (values <= 0 leave it
    // without).
    explicit Oracle(const Scene& scene, const std::vector<double>& derivedRangesM = {});
    ~Oracle();
    Oracle(Oracle&&) noexcept;

    std::size_t lightCount() const;                                // the dome, where it shines, is the last
    const OracleLight& light(std::size_t index) const;             // not of the dome
    glm::dvec3 backgroundNit(const glm::dvec3& directionWs) const; // what a ray that meets nothing sees

    // One light at one point. Muted lights give 0.
    OraclePointResult evaluatePoint(const OraclePoint& point, std::size_t lightIndex,
                                    const OracleOptions& options = {}) const;

    // Nearest visible surface; `directionWs` unit, from `minDistanceM` on.
    std::optional<OracleHit> tracePrimary(const glm::dvec3& originWs, const glm::dvec3& directionWs,
                                          double minDistanceM = 0.0) const;
    // True when something stands strictly between a surface point and a point `lengthM` along `directionWs`.
    // Only meshes that share a channel with `channels` do, where given.
    bool occluded(const glm::dvec3& originWs, const glm::dvec3& directionWs, double lengthM,
                  std::optional<std::uint8_t> channels = {}) const;

    // `camera` sees width x height pixels; its own aspect is ignored, the picture's is used.
    OracleImage render(const Camera& camera, int width, int height, const OracleOptions& options = {}) const;

    // All lights at each point, as render() does it for what its own rays hit: for comparisons on the
    // G-buffer of another renderer. Emission is not added. Noise differs between indices.
    std::vector<OraclePixel> shadePoints(const std::vector<OraclePoint>& points,
                                         const OracleOptions& options = {}) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

// Offset of a filter-importance-sampled primary ray from the pixel's centre, for u, v in [0,1), in pixels.
glm::dvec2 sampleFilter(PixelFilter filter, double u, double v);

// A ray through a picture position in pixels (0,0 the top left corner); direction unit.
struct CameraRay {
    glm::dvec3 originWs;
    glm::dvec3 directionWs;
    double minDistanceM; // to the near plane
};
CameraRay cameraRay(const Camera& camera, int width, int height, const glm::dvec2& positionPx);

} // namespace kilolux::oracle
