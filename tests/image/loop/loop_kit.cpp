#include "tests/image/loop/loop_kit.h"

#include "shaders/shared/sampling.h"

#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <random>

namespace kilolux::test {

RenderOptions loopOptions(int width, int height, const std::vector<std::string>& settings) {
    std::vector<std::string> all{"picture=raw", "noise=white", "exposureEv100=10"};
    all.insert(all.end(), settings.begin(), settings.end());
    RenderOptions options = smallOptions(width, height, all);
    options.method = "stochastic";
    return options;
}

Scene withIds(Scene scene) {
    std::uint64_t id = 0;
    for (LightNode& light : scene.lights.write())
        light.id = ++id;
    return scene;
}

Scene crowdScene(int count, std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto within = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    std::vector<LightCase> lights;
    for (int i = 0; int(lights.size()) < count; ++i) {
        LightCase light = lightCases()[std::size_t(i) % lightCases().size()];
        if (light.def.type == LightType::Directional) continue;
        light.def.rangeM = within(4.0, 7.0);
        light.def.color = {within(0.05, 1.0), within(0.05, 1.0), within(0.05, 1.0)};
        light.def.intensity *= within(0.2, 1.0);
        const glm::dvec3 at(within(-2.2, 2.2), within(1.6, 2.8), within(-1.8, 2.2));
        light.worldFromLight = lookingAlong(at, glm::dvec3(within(-0.5, 0.5), -1.0, within(-0.8, 0.4)));
        lights.push_back(light);
    }
    return withIds(stageScene(lights));
}

// ---------------------------------------------------------------------------------------------------------
// Frames

Loop::Loop(const Scene& scene, RenderOptions options) {
    Result<std::unique_ptr<Renderer>> made = Renderer::create(scene, options);
    if (!made) throw std::runtime_error(made.error());
    renderer_ = std::move(made.value());
}

void Loop::frames(int count) {
    for (int i = 0; i < count; ++i) {
        if (const auto error = renderer_->renderFrame()) throw std::runtime_error(error->message);
    }
}

Picture Loop::next() {
    frames(1);
    return renderer_->picture();
}

FrameTargets Loop::targets() {
    Result<std::vector<NamedImage>> images = renderer_->targets();
    if (!images) throw std::runtime_error(images.error());
    return FrameTargets(std::move(images.value()));
}

std::vector<PixelSample> samplesOf(const FrameTargets& targets) {
    const std::vector<std::byte>& texels = targets.named("samples").texels;
    std::vector<PixelSample> result(texels.size() / 16);
    for (std::size_t i = 0; i < result.size(); ++i) {
        std::uint32_t words[4];
        std::memcpy(words, texels.data() + 16 * i, 16);
        PixelSample& sample = result[i];
        sample.slot = words[0] & shared::SAMPLE_SLOT_MASK;
        sample.list = words[0] >> shared::SAMPLE_LIST_SHIFT & shared::SAMPLE_LIST_MASK;
        sample.uv = words[1];
        std::memcpy(&sample.contribution, &words[2], 4);
        std::memcpy(&sample.weight, &words[3], 4);
    }
    return result;
}

// ---------------------------------------------------------------------------------------------------------
// Means

Light lightOf(const Picture& picture) {
    Light light;
    std::array<double, Light::Count> counts{};
    const auto add = [&](int value, double amount) {
        light.values[std::size_t(value)] += amount;
        ++counts[std::size_t(value)];
    };
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const float* p = &picture.rgb[3 * (std::size_t(y) * std::size_t(picture.width) + std::size_t(x))];
            const double luminance = luminanceOf({p[0], p[1], p[2]});
            add(Light::Luminance, luminance);
            for (int c = 0; c < 3; ++c)
                add(Light::Red + c, p[c]);
            add(Light::FirstRegion + y * 4 / picture.height * 4 + x * 4 / picture.width, luminance);
            add(Light::FirstPlace + (y & 1) * 2 + (x & 1), luminance);
        }
    }
    for (std::size_t i = 0; i < Light::Count; ++i)
        light.values[i] /= std::max(counts[i], 1.0);
    return light;
}

std::vector<double> Replicas::values(int value) const {
    std::vector<double> result;
    for (const Light& replica : light)
        result.push_back(replica.values[std::size_t(value)]);
    return result;
}

Replicas gather(const MakeReplica& make, double error, int most) {
    Replicas result;
    while (int(result.light.size()) < most) {
        result.light.push_back(make());
        if (int(result.light.size()) < measure::kMinReplicas) continue;
        const measure::ReplicaMean mean = result.mean(Light::Luminance);
        if (mean.standardError <= error * mean.mean) break;
    }
    return result;
}

MakeReplica framesOf(Loop& loop, int frames, int pixelsPerRay) {
    return [&loop, frames, pixelsPerRay] {
        Light sum;
        for (int i = 0; i < frames * pixelsPerRay; ++i) {
            const Light light = lightOf(loop.next());
            for (std::size_t v = 0; v < Light::Count; ++v)
                sum.values[v] += light.values[v] / frames;
        }
        return sum;
    };
}

Replicas splitReference(const Scene& scene, const RenderOptions& options, double error) {
    RenderOptions split = options;
    split.method = "split";
    Loop loop(scene, split);
    return gather(framesOf(loop, 1), error, 64);
}

void expectSameMean(const Replicas& tested, const Replicas& reference, const std::string& what,
                    double bound) {
    const auto compare = [&](int value, double factor, double significance) {
        std::vector<double> values = tested.values(value);
        for (double& v : values)
            v *= factor;
        return measure::testEquivalence(values, reference.values(value), bound, significance);
    };
    const measure::Equivalence mean = compare(Light::Luminance, 1.0, 0.05);
    std::printf("%-28s %+.3f %% (%+.3f .. %+.3f) over %zu replicas\n", what.c_str(),
                100 * mean.relativeDifference, 100 * mean.lower, 100 * mean.upper, tested.light.size());
    EXPECT_TRUE(mean.equivalent) << what << ": off by " << 100 * mean.relativeDifference << " %";
    for (const double planted : {1.0 - 2.0 * bound, 1.0 + 2.0 * bound}) {
        const measure::Equivalence biased = compare(Light::Luminance, planted, 0.05);
        EXPECT_TRUE(biased.different && !biased.equivalent)
            << what << ": would not see a bias of " << planted;
    }
    // So many values are looked at that chance would make some differ at a milder level.
    for (int value = Light::Red; value < Light::Count; ++value) {
        const measure::Equivalence part = compare(value, 1.0, 1e-5);
        EXPECT_TRUE(part.lower < bound && part.upper > -bound)
            << what << ": value " << value << " off by " << 100 * part.relativeDifference << " %, from "
            << 100 * part.lower << " to " << 100 * part.upper << " %";
    }
}

} // namespace kilolux::test
