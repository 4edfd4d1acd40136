// make_noise OUT.bin [PROPOSALS]: optimizes the three masks, one after the other on one thread, and writes
// them (renderer/noise.h). The same number of proposals per pixel gives the same bytes.
#include "content/make/noise/optimize.h"
#include "renderer/noise.h"

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
    using namespace kilolux;
    NoiseEffort effort;
    if (argc > 2) effort.proposalsPerPixel = std::atoi(argv[2]);
    if (argc < 2 || argc > 3 || effort.proposalsPerPixel < 0) {
        std::fprintf(stderr, "usage: make_noise OUT.bin [PROPOSALS per pixel, default 700]\n");
        return 2;
    }
    const NoiseSize size{NoiseMask::kWidth, NoiseMask::kHeight, NoiseMask::kLayers};
    effort.seed = 1;
    const auto visible = optimizeScalarMask(size, renderingFilters(), effort);
    std::puts("numbers of the visible list: done");
    effort.seed = 2;
    const auto hidden = optimizeScalarMask(size, renderingFilters(), effort);
    std::puts("numbers of the hidden list: done");
    effort.seed = 3;
    const auto points = optimizePointMask(size, renderingFilters(), effort);
    NoiseMask mask;
    for (std::size_t i = 0; i < visible.size(); ++i)
        mask.texels.push_back({visible[i], hidden[i], points[i][0], points[i][1]});
    const auto saved = saveNoiseMask(mask, argv[1]);
    if (!saved) {
        std::fprintf(stderr, "%s\n", saved.error().c_str());
        return 3;
    }
    std::printf("wrote '%s'\n", argv[1]);
    return 0;
}
