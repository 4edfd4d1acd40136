// What the tests of the filters share: small stochastic pictures whose sampled light is replaced by one that
// is known.
#pragma once

#include "tests/image/image_kit.h"
#include "tests/image/image_scenes.h"

namespace kilolux::test {

constexpr int kFilteredWidth = 64, kFilteredHeight = 48; // pixels
constexpr std::size_t kFilteredPixels = std::size_t(kFilteredWidth) * std::size_t(kFilteredHeight);

RenderOptions filterOptions(const std::vector<std::string>& settings, int frames);
Scene litStage();

// The same light at every pixel and frame, all of it sampled; `valid` as alpha of litDiffuse says it.
LitTexels evenLight(float value, float valid = 1.0f);

double meanOf(const FrameTargets& targets, const std::string& name); // luminance of surfaces

} // namespace kilolux::test
