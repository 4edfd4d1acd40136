// How far a picture is from a reference, in linear light: squared errors, and energy per block of pixels.
// Pictures must have the same size; where a function cannot give a number (no pixels) it gives 0.
#pragma once

#include "renderer/measure/image_view.h"

namespace kilolux::measure {

// Rec. 709 luminance of linear RGB.
double luminance(const float* rgb);

// Mean over pixels and channels of (test - reference)^2.
double meanSquaredError(const ImageView& reference, const ImageView& test);

// Mean over pixels and channels of (test - reference)^2 / (reference^2 + epsilon). `epsilon` keeps black
// pixels finite; it is part of every number named.
double relativeMeanSquaredError(const ImageView& reference, const ImageView& test, double epsilon = 1e-2);

// 10 log10(peak^2 / MSE) in dB; infinite for equal pictures.
double peakSignalToNoiseDb(const ImageView& reference, const ImageView& test, double peak = 1.0);

// Energy kept per block of blockPx x blockPx pixels (blocks at the right and lower edge may be smaller).
struct BlockEnergy {
    double meanRatio = 0.0;     // of all luminance: test / reference
    double withinShare = 0.0;   // share of lit blocks whose ratio is within the tolerance of 1
    double worstRatio = 1.0;    // of a lit block, the one farthest from 1 in proportion
    int worstX = 0, worstY = 0; // its block indices
    int litBlocks = 0;          // blocks whose reference mean is above the floor
};
// `floorShare`: blocks darker than this share of the reference's mean luminance are left out.
BlockEnergy blockEnergy(const ImageView& reference, const ImageView& test, int blockPx, double tolerance,
                        double floorShare = 0.01);

// Value at share p (0 to 1) of the sorted values, linear between neighbours; p = 0.95 is the 95th percentile.
double percentile(std::span<const float> values, double p);

} // namespace kilolux::measure
