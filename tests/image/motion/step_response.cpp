#include "tests/image/motion/step_response.h"

#include "tests/image/image_scenes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>

namespace kilolux::test {

namespace {

struct Step {
    std::string name;
    Scene before, after;
    std::function<void(Renderer&)> change;
};

// The stage with a dim base light and one that changes.
Scene stageWith(const glm::dvec3& lampAt, bool muted) {
    LightCase base = lightCases()[0], lamp = lightCases()[2];
    base.def.intensity = 600;
    lamp.def.intensity = 4000;
    lamp.def.rangeM.reset();
    lamp.worldFromLight = glm::translate(glm::dmat4(1.0), lampAt);
    Scene scene = stageScene({base, lamp});
    scene.lights[0].id = 1;
    scene.lights[1].id = 2;
    scene.lights[1].muted = muted;
    return scene;
}

std::vector<Step> steps() {
    const glm::dvec3 place(0.9, 1.6, 0.9), other(-0.9, 1.6, 0.6);
    const Scene on = stageWith(place, false), off = stageWith(place, true), moved = stageWith(other, false);
    Scene without = on;
    without.lights.write().pop_back();
    Scene elsewhere = on;
    elsewhere.cameras[0] = cameraLooking({-2.5, 1.8, 2.5}, {0.2, 0.5, -0.4});
    const auto lights = [](const Scene& scene) {
        return [scene](Renderer& renderer) { renderer.setLights(scene); };
    };
    return {{"off", on, off, lights(off)},
            {"on", off, on, lights(on)},
            {"moved", on, moved, lights(moved)},
            {"new", without, on, lights(on)},
            {"deleted", on, without, lights(without)},
            {"cut", on, elsewhere,
             [camera = elsewhere.cameras[0]](Renderer& renderer) {
                 renderer.setCamera(camera, Renderer::CameraChange::Cut);
             }},
            {"+10 EV", on, on, [](Renderer& renderer) {
                 renderer.setExposureEv100(renderer.statistics().exposureEv100 + 10.0);
             }}};
}

std::unique_ptr<Renderer> makeRenderer(const Scene& scene, const StepOptions& how,
                                       const std::string& method) {
    RenderOptions options;
    options.width = how.width;
    options.height = how.height;
    options.seed = how.seed;
    options.method = method;
    options.cpuFilters = how.cpuFilters;
    options.settings.jitter = false;
    options.settings.picture = PictureChoice::Denoised;
    options.settings.exposureEv100 = {false, 6.0};
    options.settings.raysPerLight = 4;
    Result<std::unique_ptr<Renderer>> renderer = Renderer::create(scene, options);
    if (!renderer) throw std::runtime_error(renderer.error());
    return std::move(renderer.value());
}

std::vector<double> render(Renderer& renderer, int frames) {
    for (int i = 0; i < frames; ++i) {
        if (auto error = renderer.renderFrame()) throw std::runtime_error(error->message);
    }
    const Picture picture = renderer.picture();
    std::vector<double> luminance;
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
        luminance.push_back(0.2126 * picture.rgb[i] + 0.7152 * picture.rgb[i + 1] +
                            0.0722 * picture.rgb[i + 2]);
    return luminance;
}

std::vector<double> stillPicture(const Scene& scene, const StepOptions& how) {
    return render(*makeRenderer(scene, how, "all-lights"), how.referenceFrames);
}

struct Region {
    std::vector<std::size_t> pixels;
    double before = 0.0, after = 0.0;
};

double meanOf(const std::vector<double>& picture, const std::vector<std::size_t>& pixels) {
    double sum = 0.0;
    for (const std::size_t i : pixels)
        sum += picture[i];
    return sum / double(pixels.size());
}

// What became brighter and what became darker; all of it where the still picture is the same or not
// comparable.
std::vector<Region> regionsOf(const std::vector<double>& before, const std::vector<double>& after,
                              bool everything) {
    std::vector<Region> regions(everything ? 1 : 2);
    for (std::size_t i = 0; i < after.size(); ++i) {
        if (everything)
            regions[0].pixels.push_back(i);
        else if (after[i] > 1.1 * before[i])
            regions[0].pixels.push_back(i);
        else if (after[i] < 0.9 * before[i])
            regions[1].pixels.push_back(i);
    }
    // A handful of pixels says nothing.
    std::erase_if(regions, [&](const Region& r) { return r.pixels.size() * 50 < after.size(); });
    for (Region& region : regions) {
        region.before = meanOf(before, region.pixels);
        region.after = meanOf(after, region.pixels);
    }
    return regions;
}

StepResponse measure(const Step& step, const StepOptions& how) {
    StepResponse response;
    response.name = step.name;
    const bool everything = step.name == "cut" || step.name == "+10 EV";
    const std::vector<Region> regions =
        regionsOf(stillPicture(step.before, how), stillPicture(step.after, how), everything);
    for (const Region& region : regions)
        response.region += double(region.pixels.size()) / (double(how.width) * how.height);
    const std::unique_ptr<Renderer> renderer = makeRenderer(step.before, how, "stochastic");
    render(*renderer, how.framesBefore);
    step.change(*renderer);
    for (int frame = 0; frame < how.framesAfter; ++frame) {
        const std::vector<double> picture = render(*renderer, 1);
        double error = 0.0, rest = 0.0;
        for (const Region& region : regions) {
            const double off = meanOf(picture, region.pixels) - region.after;
            error = std::max(error, std::abs(off) / region.after);
            rest = std::max(rest, std::abs(off / (region.before - region.after)));
        }
        response.error.push_back(error);
        if (!everything) response.rest.push_back(rest);
    }
    return response;
}

} // namespace

int StepResponse::framesWithin(double bound) const {
    int first = -1;
    for (std::size_t i = 0; i < error.size(); ++i) {
        if (error[i] > bound)
            first = -1;
        else if (first < 0)
            first = int(i) + 1;
    }
    return first;
}

std::vector<StepResponse> measureStepResponses(const StepOptions& options) {
    std::vector<StepResponse> responses;
    for (const Step& step : steps())
        responses.push_back(measure(step, options));
    return responses;
}

std::string stepTable(const std::vector<StepResponse>& responses) {
    constexpr int kFrames[] = {1, 2, 4, 8, 16, 24};
    std::string text =
        fmt::format("{:8} {:>6} {:>7}  error of the mean after frame", "step", "region", "to 10%");
    text += "\n" + std::string(24, ' ');
    for (const int frame : kFrames)
        text += fmt::format(" {:>7}", frame);
    text += "   rest of the change";
    for (const StepResponse& r : responses) {
        text += fmt::format("\n{:8} {:>6.2f} {:>7} ", r.name, r.region, r.framesWithin(0.1));
        for (const std::vector<double>* series : {&r.error, &r.rest}) {
            for (const int frame : kFrames)
                if (std::size_t(frame) <= series->size())
                    text += fmt::format(" {:>7.3f}", (*series)[std::size_t(frame) - 1]);
            text += "  ";
        }
    }
    return text + "\n";
}

} // namespace kilolux::test
