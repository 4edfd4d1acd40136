// LDR-FLIP: the difference that a viewer sees when two pictures are shown in turn at one place, 0 (none)
// to 1. Written from Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem, Fairchild, "FLIP: A Difference
// Evaluator for Alternating Images", HPG 2020, sections 4.1 (colour pipeline), 4.2 (features) and 4.3 (their
// product).
#pragma once

#include "renderer/measure/image_view.h"

#include <vector>

namespace kilolux::measure {

// The paper's viewing condition: 0.7 m from a 0.7 m wide screen of 3840 pixels.
inline constexpr double kDefaultPixelsPerDegree = 67.0;

struct FlipResult {
    double mean = 0.0;
    double percentile95 = 0.0;
    std::vector<float> map; // per pixel, row-major
};

// Both pictures are what the display gets, sRGB-encoded in 0..1 (values outside are clamped), of one size.
FlipResult flip(const ImageView& referenceSrgb, const ImageView& testSrgb,
                double pixelsPerDegree = kDefaultPixelsPerDegree);

// HDR-FLIP of linear pictures (Andersson, Nilsson, Shirley and Akenine-Moeller, "Visualizing Errors in
// Rendered High Dynamic Range Images", Eurographics 2021 short papers, sections 3 and 4): per pixel the
// largest LDR-FLIP over exposures, toned by the ACES curve as Narkowicz fits it, from the one that shows the
// reference's brightest pixel at 0.85 to the one that shows its median there.
struct HdrExposures {
    double startStops = 0.0, stopStops = 0.0; // factors are 2 to the power of these
    int count = 0;
};
HdrExposures hdrFlipExposures(const ImageView& reference);
FlipResult hdrFlip(const ImageView& reference, const ImageView& test,
                   double pixelsPerDegree = kDefaultPixelsPerDegree);

} // namespace kilolux::measure
