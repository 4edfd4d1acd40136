// The filters that noise is adapted to, and the kernel through which two pixels of a mask act on each other
// (Donnelly et al., "Filter-Adapted Spatio-Temporal Sampling for Real-Time Rendering", I3D 2024, section 3).
#pragma once

#include <vector>

namespace kilolux {

// A filter over a mask: the product of a spatial and a temporal one.
struct NoiseFilter {
    double weight = 1.0; // of its error, white noise having 1
    bool blurs = true;   // spatially by the 5x5 binomial (1 4 6 4 1), close to a Gaussian of 1 px; or not
    double alpha = 1.0;  // (0, 1]: share of the new frame in an exponential mean; 1 is none
};

// Autocorrelation of the filters, weighted and summed. The squared error of a filtered mask, summed over all
// pixels, is the sum over pairs of pixels of the autocorrelation times a distance of their values.
struct NoiseKernel {
    static constexpr int kRadiusPx = 4; // the 5x5 binomial's autocorrelation spans 9x9
    static constexpr int kWidthPx = 2 * kRadiusPx + 1;

    int layers = 0;
    std::vector<float> taps; // [dy + 4][dx + 4][2 * layers]: over layers twice, so that rows start anywhere

    // Tap (dx, dy) for each layer 0 .. layers - 1, as seen from layer `from`: `layers` contiguous floats.
    const float* row(int dx, int dy, int from) const;
    float at(int dx, int dy, int dLayer) const { return row(dx, dy, 0)[dLayer]; }
};

// Time is cyclic over `layers`. Every filter's own error of white noise is scaled to its weight.
NoiseKernel makeNoiseKernel(const std::vector<NoiseFilter>& filters, int layers);

} // namespace kilolux
