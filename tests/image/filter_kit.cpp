#include "tests/image/filter_kit.h"

namespace kilolux::test {

RenderOptions filterOptions(const std::vector<std::string>& settings, int frames) {
    RenderOptions options = smallOptions(kFilteredWidth, kFilteredHeight, settings);
    options.method = "stochastic";
    options.frames = frames;
    return options;
}

Scene litStage() {
    return stageScene({lightCases()[0], lightCases()[2]});
}

LitTexels evenLight(float value, float valid) {
    LitTexels lit;
    for (std::size_t i = 0; i < kFilteredPixels; ++i) {
        lit.diffuse.insert(lit.diffuse.end(), {value, value, value, valid});
        lit.specular.insert(lit.specular.end(), {value, value, value, 255.0f});
    }
    return lit;
}

double meanOf(const FrameTargets& targets, const std::string& name) {
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < targets.pixels(); ++i) {
        if (!targets.surface(i).seen) continue;
        sum += luminanceOf(targets.rgb(name, i));
        count += 1.0;
    }
    return sum / count;
}

} // namespace kilolux::test
