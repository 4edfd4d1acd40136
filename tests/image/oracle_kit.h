// Frames against the oracle on one G-buffer: pixels are matched triangle by triangle, then the lighting of
// the matched ones is compared by equivalence over frames, which are replicas with noise of their own.
#pragma once

#include "renderer/measure/equivalence.h"
#include "renderer/reference/oracle.h"
#include "tests/image/image_kit.h"

namespace kilolux::test {

// Pixels of a frame whose triangle the oracle sees too.
struct MatchedPixels {
    std::vector<std::size_t> pixels;
    std::vector<oracle::OracleHit> hits; // of the oracle, in double precision
    int ties = 0; // pixels that see another triangle, which the oracle sees within 1/100 px
};

// A pixel that sees anything else is a failure.
MatchedPixels matchPixels(const Scene& scene, const oracle::Oracle& oracle, const Camera& camera,
                          const FrameTargets& targets);

// Largest differences over matched pixels: what the G-buffer loses.
struct SurfaceErrors {
    double depth = 0.0;     // relative
    double normalRad = 0.0; // shading normal
    double geoNormalRad = 0.0;
    double baseColor = 0.0;
    double roughness = 0.0;
    double metallic = 0.0;
    double emission = 0.0; // relative to max(value, 1 nit)
};
SurfaceErrors compareSurfaces(const MatchedPixels& matched, const Camera& camera, const Rendered& frame);
std::ostream& operator<<(std::ostream& out, const SurfaceErrors& errors);

// Fails where a field loses more than its packing and the driver's texture filter explain.
void expectSurfaces(const SurfaceErrors& errors, const Scene& scene);

struct LightOptions {
    std::string method = "split"; // or "true"
    int width = 40, height = 30;
    int raysPerLight = 16;
    int frames = measure::kMinReplicas;
    int oracleSamples = 256;
    std::vector<std::string> settings;
};

// The mean light that the matched pixels send to the viewer, per channel, GPU against oracle.
struct LightComparison {
    measure::Equivalence channel[3];
    measure::Equivalence planted; // luminance with 1 % added: must be seen
    double oracleNit = 0.0;       // mean luminance
    double oracleError = 0.0;     // its relative standard error
    double diffuseRatio = 0.0;    // GPU over oracle, luminance, each lobe alone
    double specularRatio = 0.0;
    double worstBlock =
        0.0; // largest difference of an 8 x 8 block's mean, beyond noise, over the picture's mean
    int ties = 0;
    std::size_t compared = 0;
};
LightComparison compareLight(const Scene& scene, const LightOptions& options);
std::ostream& operator<<(std::ostream& out, const LightComparison& comparison);

// Equivalent within `bound` in each channel, and the planted bias seen.
void expectEquivalent(const LightComparison& comparison, double bound = 0.005);

} // namespace kilolux::test
