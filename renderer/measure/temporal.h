// How pictures change over frames: flicker of what stands still, how fast a change arrives, and how far the
// errors of samples are alike in neighbouring frames and pixels, which no filter can then take away. All
// pictures of a call have one size; light is linear. What cannot be told (no pixels, nothing changes) is 0 or
// nothing.
#pragma once

#include "renderer/measure/image_view.h"

#include <optional>
#include <vector>

namespace kilolux::measure {

// Root of the mean of (now - before)^2 / (reference^2 + epsilon), of luminance.
double flicker(const ImageView& before, const ImageView& now, const ImageView& reference,
               double epsilon = 1e-2);

// Correlation coefficients of errors relative to sqrt(reference^2 + epsilon), each limited to +-`limit` so
// that a few bright samples do not decide it.
struct Correlation {
    double inTime = 0.0;  // of a pixel in one frame and the next
    double inSpace = 0.0; // of a pixel and its right and lower neighbour in the same frame
};
// `frames`: pictures of consecutive frames.
Correlation sampleCorrelation(const ImageView& reference, const std::vector<ImageView>& frames,
                              double limit = 4.0, double epsilon = 1e-2);

// How much of a change has arrived: 0 where the picture is like `before`, 1 where like `after`, by projecting
// the difference of pictures on the change. Nothing where both are the same.
std::optional<double> arrivedShare(const ImageView& before, const ImageView& after, const ImageView& picture);

// The first frame, counted from 1, from which on at least `share` has arrived. Nothing when it never stays
// there.
std::optional<int> lagFrames(const std::vector<double>& arrived, double share = 0.9);

} // namespace kilolux::measure
